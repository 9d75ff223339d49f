// A sphere near the hole as one observer sees it, traced at a few places (sphere_surface.h).
#pragma once

#include <array>
#include <optional>
#include <utility>
#include <vector>

#include "pipeline/light/chebyshev.h"
#include "pipeline/light/sphere_rays.h"

namespace domefall {

// A Node is what is seen of a place of the sphere.
struct SphereNode {
  double angle = 0, ratio = 0, cosine = 0;  // from the hole, of frequencies, of emission
  V3d place{0, 0, 0};                       // q/a

  void add(double weight, const SphereNode& node) {
    angle += weight * node.angle;
    ratio += weight * node.ratio;
    cosine += weight * node.cosine;
    place += node.place * weight;
  }
};

// In the plane of R and e the observer sees places at the times at which their light left, and those
// that were within the sphere then are a small oval.  q is nearly linear in the place, so that the
// oval is found from the place in its middle, where |q| is least, and from the derivatives there:
// cos(u) p1 + sin(u) p2 is close to its rim, where p1 points to the observer.  The angle from the hole
// grows with u over what is visible.
class TracedSphere : public SphereRays {
 public:
  static constexpr int kChords = 16, kAlong = 12;
  using Node = SphereNode;

  using SphereRays::SphereRays;

  // Returns the ranges of azimuths at which the sphere is seen.
  std::vector<std::pair<double, double>> seen_ranges() const {
    return ranges([this](const V3d& e) {
      const auto found = oval(e);
      return found ? found->clear : -1;
    });
  }
  // Traces the nodes of one.  Returns false where one is not seen.
  bool trace(const std::pair<double, double>& range);

  const Azimuths& azimuths() const { return azimuths_; }
  // Returns the nodes along the chord of t.
  std::array<Node, kAlong> chord(double t) const { return chord_of(nodes_, t); }

 private:
  struct Oval {
    V3d e, middle, p1, p2;
    double clear;  // 1 - |q/a|^2 in the middle
  };

  std::optional<Oval> oval(const V3d& e) const;
  std::optional<Node> node(const Oval& oval, double u) const;
  std::optional<double> limb(const Oval& oval, double side) const;
  bool set_nodes(const Oval& oval, double begin, double end, std::array<Node, kAlong>& nodes) const;

  Azimuths azimuths_;
  std::array<std::array<Node, kAlong>, kChords> nodes_;
};

}  // namespace domefall
