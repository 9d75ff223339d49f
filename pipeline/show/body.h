// A body that shines on an orbit of its own about the hole.
#pragma once

#include <optional>
#include <string>

#include "pipeline/optics/body_image.h"
#include "pipeline/show/placement.h"
#include "trajectories/directions.h"
#include "trajectories/observer_state.h"
#include "trajectories/trajectory.h"

namespace domefall {

struct Body {
  std::string name;
  Trajectory trajectory = CircularOrbit{10};  // static, circular or free fall
  bool backward = false;                      // against the sense of its axis
  // The axis about which it goes counter-clockwise, and the direction in its plane from which its
  // azimuth counts, both on the sky.
  SkyDirection normal{V3d(0, 0, 1)}, node{V3d(1, 0, 0)};
  // Its proper time and its azimuth (radians) when its v = t + r*, counted from the show's start,
  // is `null_time` (M).
  ProperTime start = 0.0;
  double azimuth = 0, null_time = 0;
  bool shines_before = true;  // or it begins to shine then
  double temperature = 6000;  // of a blackbody, K
  // V, as it would be at rest at a distance of kBodyMagnitudeDistance without a hole.
  double magnitude = 0;
  double radius = 0;  // of a glowing sphere, M; 0 of a point
};
inline constexpr double kBodyMagnitudeDistance = 100;  // M

// Whether an observer can see bodies: nothing comes from region I to region IV, and the mirrored
// frames are those of region III.
bool sees_bodies(const ObserverState& observer);

// How it moves as an observer in that frame has to know it: proper time counts from Body::start.
BodyMotion motion_of(const Body& body, const M33d& sky_from_tetrad);

// Where an observer begins who moves as the body does, `behind` later (M of v), and is at its
// proper time `start` + tau.
Beginning beginning_beside(const Body& body, double tau, double behind);

// The tau at which its v is `null_time`; nothing where it is not there, before or after.
std::optional<double> time_of_null(const Body& body, double null_time);

}  // namespace domefall
