// Flat rings about a sphere near the hole as one observer sees them, traced like the sphere itself
// (sphere_surface.h).
//
// In the plane of R and e what the observer sees of the rings' plane, where q is at right angles to
// its normal, is close to a straight line.
#pragma once

#include <array>
#include <optional>
#include <utility>
#include <vector>

#include "pipeline/light/sphere_rays.h"

namespace domefall {

// A RingNode is what is seen of a place of the rings' plane.
struct RingNode {
  double angle = 0, ratio = 0;  // from the hole, of frequencies
  V3d place{0, 0, 0};           // q, in radii of the sphere
  V3d leaving{0, 0, 0};         // the direction of its light, in the body's frame

  void add(double weight, const RingNode& node) {
    angle += weight * node.angle;
    ratio += weight * node.ratio;
    place += node.place * weight;
    leaving += node.leaving * weight;
  }
};

class TracedRings : public SphereRays {
 public:
  static constexpr int kChords = 16, kAlong = 14;
  using Node = RingNode;

  // `radius` is the sphere's.
  TracedRings(const SphereView& view, const BodyMotion& motion, const BodyImage& image,
              double radius, const RingPlane& rings)
      : SphereRays(view, motion, image, radius * rings.edges.back().second),
        rings_(rings),
        sphere_(radius) {}

  // Returns them traced, in parts that each have a range of azimuths, without what is not
  // seen.
  std::vector<TracedRings> parts() const;

  const Azimuths& azimuths() const { return azimuths_; }
  // Returns the nodes along the chord of t, from rim to rim.
  std::array<Node, kAlong> chord(double t) const { return chord_of(nodes_, t); }

 private:
  // The places of the rings' plane that are seen in one of R and e.
  struct Line {
    V3d e, middle;  // where |q| is least
    V3d way, off;   // along it, by the outermost radius, and the step off the plane by 1
    double clear;   // 1 - |q|^2 in the middle, over the outermost radius
    double axis;    // r at which it crosses the axis
  };
  using Row = std::array<Node, kAlong>;
  bool trace(const std::pair<double, double>& range);
  void add_parts(const std::pair<double, double>& range, int halvings,
                 std::vector<TracedRings>& parts) const;
  std::optional<Row> row(double azimuth) const;
  std::optional<Line> line(const V3d& e) const;
  std::optional<Met> met(const Line& line, double share) const;
  std::optional<double> rim(const Line& line, double side) const;
  std::optional<Node> node(const Line& line, double share) const;

  const RingPlane& rings_;
  double sphere_;
  Azimuths azimuths_;
  std::array<Row, kChords> nodes_;
};

}  // namespace domefall
