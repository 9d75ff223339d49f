// A Body shines on an orbit of its own about the hole.
#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "pipeline/light/body_image.h"
#include "pipeline/show/placement.h"
#include "pipeline/sources/colour/colour_space.h"
#include "trajectories/directions.h"
#include "trajectories/observer_state.h"
#include "trajectories/trajectory.h"

namespace domefall {

struct Body;
// What a body is lit from that does not shine itself: a direction on the sky, another body, or what
// is about the hole.
struct LitFromHole {};
using BodyLamp = std::variant<SkyDirection, std::shared_ptr<const Body>, LitFromHole>;

// A BodyRing is one of the flat rings about a sphere: where it begins and ends, in radii of the sphere,
// the part of light from behind that it takes away at right angles, and the colour of what it
// scatters.
struct BodyRing {
  double inner, outer, opacity;
  WorkingRgb colour;
};

struct Body {
  std::string name;
  Trajectory trajectory = CircularOrbit{10};  // static, circular or free fall
  bool backward = false;                      // against the sense of its axis
  // The body goes counter-clockwise about the axis `normal`, and its azimuth counts from the
  // direction `node` in its plane.  Both are directions on the sky.  About a hole that spins they are its
  // axis and a direction in its equator, and the trajectory says how the orbit lies to these.
  SkyDirection normal{V3d(0, 0, 1)}, node{V3d(1, 0, 0)};
  // `start` and `azimuth` (radians) are those of the body at the instant when its v = t + r*,
  // counted from the show's start, is `null_time` (M).
  ProperTime start = 0.0;
  double azimuth = 0, null_time = 0;
  bool shines_before = true;  // else it begins to shine at that instant
  double temperature = 6000;  // of a blackbody, K
  // The magnitude is V as the body would have it at rest at a distance of kBodyMagnitudeDistance
  // without a hole.
  double magnitude = 0;
  double radius = 0;  // of a sphere, M; 0 of a point
  double tilt = 0;    // of its own axis from `normal` towards `node`, radians
  // An equirectangular image of the surface, whose middle is at `node` before it is tilted; empty for
  // none.
  std::filesystem::path texture{};
  std::optional<BodyLamp> lit_from{};
  double granulation = 0;  // contrast of the granules of a sphere that shines and has no texture
  std::vector<BodyRing> rings{};  // from the inmost one on, none within another
};
inline constexpr double kBodyMagnitudeDistance = 100;  // M

// Returns the axes of a sphere that does not turn, as columns: the middle and the east of its texture,
// and its north, at right angles to its rings.
M33d own_axes(const Body& body);

// Says whether an observer can see bodies.  Nothing comes from region I to region IV, and the
// mirrored frames are those of region III.
bool sees_bodies(const ObserverState& observer);

// Returns the motion of a body as an observer with these axes has to know it.  Proper time counts
// from Body::start.
BodyMotion motion_of(const Spacetime& spacetime, const Body& body, const M33d& sky_from_tetrad);

// Returns where an observer begins who moves as the body does, but `behind` later (M of v), and
// whose proper time is `start` + tau.
Beginning beginning_beside(const Spacetime& spacetime, const Body& body, double tau, double behind);

// Returns the tau at which the v of the body is `null_time`, or nothing where the body has not
// begun or has ended by then.
std::optional<double> time_of_null(const Spacetime& spacetime, const Body& body, double null_time);

}  // namespace domefall
