// A KerrChart is the table of one sky as it is seen near a hole that spins, by an observer who moves as
// the reference tetrad T: the unit vector to each place, by the angle eta about the hole and
//
//     s = ln((delta - edge)/(end - edge))        end = pi, or 0 for the sky of region III
//
// where `edge` is that of the sky at the same eta.  In these coordinates the sky is smooth up to its edge,
// towards which it is seen again and again.  Between the nodes, which are exact rays (kerr_ray.h), there
// are Lagrange's polynomials of eight.  Rays nearer to the edge than e^kLeast of the way are not in it.
#pragma once

#include <optional>
#include <vector>

#include "pipeline/light/kerr_ray.h"

namespace domefall {

// Returns the frequency seen of light from a direction, over that sent.
double kerr_frequency_ratio(const KerrPlace& at, double delta, double eta);

class KerrChart {
 public:
  static constexpr double kLeast = -13.8;

  // The sky is that of region I or III.  For III the observer must be between the horizons.
  KerrChart(const KerrPlace& at, KerrEdge sky);

  // Returns delta of the edge at eta, and its derivative.
  struct Edge {
    double delta, slope;
  };
  Edge edge(double eta) const;

  // A Place has the unit vector to a place of the sky, with the hole's axis as z, and by how much it
  // moves: by delta, and by an angle of view across that, sin(delta) eta.
  struct Place {
    V3d sky, by_delta, across;
  };
  // Returns that of a direction on the sky's side of the edge, from the exact ray where the chart has
  // none.
  Place place(double delta, double eta, const Edge& edge) const;

  int rows() const { return rows_; }        // of cells, from the edge on
  int columns() const { return columns_; }  // around the hole
  double end() const { return end_; }
  // Returns the direction of a place in the chart, which counts in cells.
  struct Direction {
    double delta, eta, by_row;  // the derivative of delta
  };
  Direction direction(double row, double column) const;
  // Returns the unit vector of a place in the chart, and its derivatives by row and by column.
  struct Value {
    V3d sky, by_row, by_column;
  };
  Value value(double row, double column) const;
  // Returns by how much polynomials of six and of eight nodes differ in the middle of its cell (radians),
  // which is more than the chart's error there.
  double error(double row, double column) const;

  const KerrPlace& at() const { return at_; }
  KerrEdge sky() const { return kind_; }

 private:
  static constexpr int kGuard = 4;  // rows of nodes beyond each end

  const V3d& node(int row, int column) const;
  template <int kCount>
  Value value_of(double row, double column) const;
  Place exact(double delta, double eta, const Edge& edge) const;

  KerrPlace at_;
  KerrEdge kind_;
  double end_, step_;
  int rows_, columns_;
  std::vector<double> edges_;  // evenly in eta
  std::vector<V3d> nodes_;
  std::vector<float> errors_;
};

}  // namespace domefall
