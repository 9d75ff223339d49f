// A KerrGrid has nodes in the view of an observer near a hole that spins, who moves as the reference
// tetrad T: even in the angle eta about the hole and in
//
//     s = ln((delta - edge)/(2 end - edge - delta))        end = pi, or 0 for the side of the hole
//
// where `edge` is that of a sky at the same eta.  In these coordinates what is seen is smooth up to the
// edge, towards which it is seen again and again, and through the end, where all eta meet.  Places in the
// grid count in cells, rows from the edge on and columns around the hole.
#pragma once

#include <cstddef>
#include <vector>

#include "pipeline/light/kerr_start.h"

namespace domefall {

// A KerrEdgeCurve is an edge at every eta.
class KerrEdgeCurve {
 public:
  KerrEdgeCurve(const KerrPlace& at, KerrEdge edge);

  struct Point {
    double delta, slope;  // and its derivative by eta
  };
  Point at(double eta) const;

 private:
  std::vector<double> deltas_;  // evenly in eta
};

// Returns how many times wider, and higher, cells may be if pixels are so many radians wide.
int kerr_stride(double pixel);

class KerrGrid {
 public:
  // Directions nearer to the edge than 2 e^kLeast of the way are not in it.
  static constexpr double kLeast = -13.8;
  static constexpr int kGuard = 4;  // rows of nodes beyond each end

  // `end` is pi or 0.
  KerrGrid(const KerrPlace& at, KerrEdge edge, double end, int rows, int columns);

  const KerrPlace& at() const { return at_; }
  KerrEdge kind() const { return kind_; }
  double end() const { return end_; }
  int rows() const { return rows_; }
  int columns() const { return columns_; }

  // Nodes have rows from -kGuard to rows() + kGuard, and columns go around.
  std::size_t nodes() const {
    return static_cast<std::size_t>(rows_ + 1 + 2 * kGuard) * static_cast<std::size_t>(columns_);
  }
  std::size_t node(int row, int column) const {
    return static_cast<std::size_t>(row + kGuard) * static_cast<std::size_t>(columns_) +
           static_cast<std::size_t>((column % columns_ + columns_) % columns_);
  }
  KerrDirection direction(int row, int column) const;

  using Edge = KerrEdgeCurve::Point;
  Edge edge(double eta) const { return edge_.at(eta); }
  // Returns where a direction on this side of the edge is, and the derivatives of the row.
  struct Place {
    double row, column, row_by_delta, row_by_eta;
  };
  Place place(double delta, double eta, const Edge& edge) const;
  double column_by_eta() const;
  // Returns the direction of a place, and the derivative of delta.
  struct Direction {
    double delta, eta, by_row;
  };
  Direction direction(double row, double column) const;

 private:
  KerrPlace at_;
  KerrEdge kind_;
  double end_, step_;
  int rows_, columns_;
  KerrEdgeCurve edge_;
};

}  // namespace domefall
