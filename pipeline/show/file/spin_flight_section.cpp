// Reads flights with engines, and held velocities, about a hole that spins.
#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "pipeline/show/file/orbit_reading.h"
#include "pipeline/show/file/trajectory_section.h"

namespace domefall {
namespace {

const KerrHole& kerr_of(const Stage& stage) {
  return std::get<SpinningHole>(stage.spacetime.kind()).kerr;
}

// Returns the angle from the axis.
double read_angle(const Section& s) { return std::numbers::pi / 2 - s.angle("latitude_deg"); }

Range beyond_inner_horizon(const Stage& stage) {
  return kUnitsOfM.above(stage.spacetime.inner_horizon())
      .because("what is seen within the inner horizon is not computed")
      .at_most(kFarthest);
}

enum class MeasuredBy { kDragged, kStatic, kFreeFall };

// Returns the motion of the observer against whom a speed is given, or reports that there is none.
std::optional<KerrMotion> measuring_motion(const Section& s, const Stage& stage, MeasuredBy against,
                                           double r, double theta) {
  const KerrHole& hole = kerr_of(stage);
  if (against == MeasuredBy::kFreeFall) {
    const double around = static_cast<double>(hole.spin) * std::sin(theta);
    const double cosine = static_cast<double>(hole.spin) * std::cos(theta);
    return kerr_motion(
        hole, r, theta, 1, 0,
        cosine * cosine + around * around - static_cast<double>(hole.spin * hole.spin), -1, 0);
  }
  const bool dragged = against == MeasuredBy::kDragged;
  const auto motion = kerr_circling(hole, r, theta, dragged ? dragged_velocity(hole, r, theta) : 0);
  if (motion) return motion;
  s.find("r")->fail(
      dragged
          ? fmt::format("must exceed {} (units of M), the horizon, got {}: within it speeds are "
                        "'against: free_fall'",
                        short_number(stage.spacetime.horizon()), as_written(*s.find("r")))
          : fmt::format("is within the ergosphere at that latitude, where nothing is static, "
                        "got {}; give 'against: dragged'",
                        as_written(*s.find("r"))));
  return std::nullopt;
}

// Reads a keyframe, all of whose speeds are against who has no angular momentum.
std::optional<PathKey> read_kerr_key(const Item& item, const Stage& stage, Lookup& lookup) {
  const Section s(item, {"keyframes about a spin", "speed"});
  const auto at = s.required("at_m"), r = s.required("r", beyond_inner_horizon(stage));
  const double theta = read_angle(s);
  if (!at || !r) return std::nullopt;
  PathKey key{*at, *r, s.angle("azimuth_deg"), {}, {}, theta};
  const Item* speed = s.one_of({"speed", "lorentz_factor"});
  if (!speed) return key;
  if (!(*r > stage.spacetime.horizon()))
    return speed->fail(
        "is against who turns with space, which nothing does within the horizon; "
        "leave it out");
  const auto motion = measuring_motion(s, stage, MeasuredBy::kDragged, *r, theta);
  GivenVelocity frame;
  frame.r = *r, frame.theta = theta, frame.celerity = motion->celerity;
  const auto own = read_own_celerity(s, stage, frame, lookup);
  if (!own) return std::nullopt;
  const auto celerity = celerity_against(frame.celerity, *own);
  const KerrHole& hole = kerr_of(stage);
  if (!(kerr_motion(hole, *r, theta, celerity).energy > 0))
    return speed->fail("gives a negative energy there, which paths do not have; type thrown has");
  set_kerr_rates(hole, key, celerity);
  return key;
}

}  // namespace

std::optional<TimedTrajectory> read_spin_velocity(const Item& item, const Stage& stage,
                                                  Lookup& lookup) {
  const Section s(item, {"trajectory", "velocity about a spin", "speed", "pace"});
  using enum MeasuredBy;
  const auto against = s.word("against", {kDragged, kStatic, kFreeFall});
  const auto r = s.required("r", beyond_inner_horizon(stage));
  const double theta = read_angle(s);
  const auto motion = r ? measuring_motion(s, stage, against, *r, theta) : std::nullopt;
  if (!motion) return std::nullopt;
  GivenVelocity frame;
  frame.r = *r, frame.theta = theta, frame.celerity = motion->celerity;
  if (!(*r > stage.spacetime.horizon())) frame.region = Region::kII;
  const auto trajectory = read_velocity_trajectory(s, stage, frame, lookup);
  Timing timing{0, proper_time_in(stage, stage.duration_s)};
  if (!trajectory || !read_pace(s, *trajectory, timing)) return std::nullopt;
  return TimedTrajectory{*trajectory, timing, {}};
}

std::optional<TimedTrajectory> read_spin_path(const Item& item, const Stage& stage,
                                              Lookup& lookup) {
  const Section s(item, {"trajectory", "path about a spin", "begin", "end", "rates", "pace"});
  const Item* list = s.require("keyframes", ": a list of {at_m, r, latitude_deg, azimuth_deg}");
  const auto items = list ? read_list(*list) : std::nullopt;
  if (!items) return std::nullopt;
  std::vector<PathKey> keys;
  for (const Item& one : *items)
    if (const auto key = read_kerr_key(one, stage, lookup)) keys.push_back(*key);
  if (keys.size() < items->size()) return std::nullopt;
  try {
    const KerrFlight flight(kerr_of(stage), keys);
    const Defaults whole{flight.begin(), Leg::kInward, flight.begin(), {}, flight.end()};
    const auto timing = read_timing(s, stage, flight, whole);
    if (!timing) return std::nullopt;
    return TimedTrajectory{flight, *timing, {}};
  } catch (const std::domain_error& error) {
    return list->fail(std::string("cannot be flown: ") + error.what());
  }
}

}  // namespace domefall
