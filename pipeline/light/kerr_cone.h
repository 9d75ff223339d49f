// The past light cone of an observer near a spinning hole as a coarse net of events, by which images of
// bodies are searched.  Its rays go all around the observer, closest at the silhouette's edge, and are
// followed by steps, to some part in a thousand.
#pragma once

#include <memory>
#include <vector>

#include "pipeline/light/kerr_start.h"
#include "trajectories/directions.h"

namespace domefall {

class KerrCone {
 public:
  explicit KerrCone(const KerrPlace& at);

  // Light is followed until it has swept this angle, kappa times the Mino time (radians).
  static constexpr double kFarthest = 10.5;

  struct Node {
    float w;     // 1/r; negative where the ray has ended before
    float mino;  // times |E|
    double null_time;
    float x, y, z;  // of the unit vector to the place

    V3d place() const { return {x, y, z}; }
  };
  int rows() const { return static_cast<int>(offsets_.size()); }
  int columns() const { return kColumns; }  // around the hole
  int samples() const { return static_cast<int>(shares_.size()); }
  const Node& node(int row, int column, int sample) const {
    return nodes_[(static_cast<std::size_t>(row) * kColumns +
                   static_cast<std::size_t>(column % kColumns)) *
                      shares_.size() +
                  static_cast<std::size_t>(sample)];
  }
  // Returns delta and eta of a place in the net, whose row and column need not be whole.
  struct Direction {
    double delta, eta;
  };
  Direction direction(double row, double column) const;

  const KerrPlace& at() const { return at_; }

 private:
  static constexpr int kColumns = 64;

  void follow(int row, int column);  // adds the nodes of the next ray

  KerrPlace at_;
  // The rows' places beside the edge: delta is edge + offset (pi - edge), or edge (1 + offset) on the
  // inner side, where offsets are negative.
  std::vector<double> offsets_;
  std::vector<double> shares_;  // of a ray's Mino time
  std::vector<Node> nodes_;
};

// Returns the cone of a place.  Those of the last few places are kept.
std::shared_ptr<const KerrCone> kerr_cone(const KerrPlace& at);

}  // namespace domefall
