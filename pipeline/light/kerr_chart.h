// A KerrChart is the table of one sky as it is seen near a hole that spins, by an observer who moves as
// the reference tetrad T: the unit vector to each place, and apart from it the angle by which the hole has
// dragged the light around, at the nodes of a KerrGrid, which are exact rays (kerr_ray.h).  Between the
// nodes there are Lagrange's polynomials of eight.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

#include "pipeline/light/kerr_grid.h"
#include "pipeline/light/kerr_ray.h"
#include "pipeline/light/kerr_view.h"

namespace domefall {

class KerrChart {
 public:
  static constexpr double kLeast = KerrGrid::kLeast;

  // The sky is that of region I or III.  For III the observer must be between the horizons.  Cells are wider
  // by `stride` (kerr_stride()).
  KerrChart(const KerrPlace& at, KerrEdge sky, int stride = 1);

  // Returns delta of the edge at eta, and its derivative.
  using Edge = KerrGrid::Edge;
  Edge edge(double eta) const { return grid_.edge(eta); }

  // A Place has the unit vector to a place of the sky, with the hole's axis as z, and by how much it
  // moves: by delta, and by an angle of view across that, sin(delta) eta.
  struct Place {
    V3d sky, by_delta, across;
  };
  // Returns that of a direction on the sky's side of the edge, from the exact ray where the chart has
  // none.
  Place place(double delta, double eta, const Edge& edge) const;

  int rows() const { return grid_.rows(); }        // of cells, from the edge on
  int columns() const { return grid_.columns(); }  // around the hole
  double end() const { return grid_.end(); }
  // Returns the direction of a place in the chart, which counts in cells.
  using Direction = KerrGrid::Direction;
  Direction direction(double row, double column) const { return grid_.direction(row, column); }
  // Returns the unit vector of a place in the chart, and its derivatives by row and by column.
  struct Value {
    V3d sky, by_row, by_column;
  };
  Value value(double row, double column) const;
  // Returns by how much polynomials of six and of eight nodes differ (radians), at most, in the middles of
  // its cell and of those around it, which is more than the chart's error there.
  double error(double row, double column) const;
  // Where error() is larger, exact rays are followed instead.
  double rough() const { return 3e-5 * stride_ * stride_; }
  int stride() const { return stride_; }

  // Returns the frequency seen of light from a direction, over that sent.
  double frequency_ratio(double delta, double eta) const {
    return 1 / std::abs(energy_(delta, eta));
  }

  const KerrPlace& at() const { return grid_.at(); }
  KerrEdge sky() const { return grid_.kind(); }

 private:
  template <std::size_t kCount>
  Value value_of(double row, double column) const;
  Place exact(double delta, double eta, const Edge& edge) const;

  int stride_;
  KerrGrid grid_;
  KerrEnergy energy_;
  std::vector<std::array<double, 4>> nodes_;  // TracedKerr's undragged and dragged
  std::vector<float> errors_;
};

}  // namespace domefall
