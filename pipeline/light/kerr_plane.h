// A KerrPlane says where rays of one observer near a hole that spins cross its equatorial plane: once,
// twice and so on, as they are followed back.  It has exact crossings (kerr_ray.h) at the nodes of a
// KerrGrid on each side of the silhouette's edge, and Lagrange's polynomials between them.
#pragma once

#include <array>
#include <memory>
#include <mutex>
#include <vector>

#include "pipeline/light/kerr_grid.h"

namespace domefall {

// The rings are those of inner <= r <= outer (M), from the horizon on.
struct KerrRings {
  double inner, outer;
  bool operator==(const KerrRings&) const = default;
};

class KerrPlane {
 public:
  static constexpr int kOrders = 4;

  // Cells are wider by `stride` (kerr_stride()).
  KerrPlane(const KerrPlace& at, const KerrRings& rings, int stride = 1);

  // A Value changes by these with delta, and with an angle of view across that, sin(delta) eta.
  struct Value {
    double value, by_delta, across;
  };
  struct Crossing {
    // 1/r; the angle from the observer's in the coordinates of light that falls; v less the observer's;
    // and the speed r' of the photon over r^2.
    Value w, angle, time, speed;
  };
  struct Sight {
    bool from_region_one;
    double energy, momentum,
        about_axis;     // E, sqrt K and L of light that is one in the tetrad's frame
    double to_edge;     // radians of delta
    double edge_slope;  // by how much the edge's delta changes with an angle across
    // Whether an order crosses the plane in region I near the rings, or else nearer to the hole.
    std::array<bool, kOrders> crosses, within;
    std::array<Crossing, kOrders> at;
  };
  // Returns what a ray meets.
  Sight sight(double delta, double eta) const;
  // Returns the same from exact rays.
  Sight exact_sight(double delta, double eta) const;

  const KerrPlace& at() const { return sides_[0].grid.at(); }

 private:
  enum class Cell : unsigned char { kOutside, kInside, kSmooth, kRough };
  using Node = std::array<double, 4>;
  struct Side {
    KerrGrid grid;
    std::vector<Node> nodes;  // of each order
    std::vector<Cell> cells;  // of each order
  };
  void fill(Side& side);
  void continue_column(Side& side, int column, int order) const;
  void judge(Side& side) const;
  template <int kCount>
  Node interpolated(const Side& side, int order, double row, double column, Node* by_row,
                    Node* by_column) const;
  Sight beginning(double delta, double eta, const KerrGrid::Edge& edge) const;
  bool exact_nodes(const KerrDirection& n, std::array<Node, kOrders>& nodes) const;

  KerrRings rings_;
  int rows_, columns_;
  double most_off_;          // of 1/r, where cells are smooth
  std::vector<Side> sides_;  // beyond the edge, and towards the hole
};

// A KerrPlaneKeeper keeps the last plane of one place, for all threads.
class KerrPlaneKeeper {
 public:
  std::shared_ptr<const KerrPlane> plane(const KerrPlace& at, const KerrRings& rings, int stride);

 private:
  std::mutex mutex_;
  KerrRings rings_{};
  std::shared_ptr<const KerrPlane> plane_;
};

}  // namespace domefall
