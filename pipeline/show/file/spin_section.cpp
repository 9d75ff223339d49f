// Reads trajectories about a hole that spins.
#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "pipeline/show/file/orbit_reading.h"
#include "pipeline/show/file/trajectory_section.h"

namespace domefall {
namespace {

constexpr double kRightAngle = std::numbers::pi / 2;

const KerrHole& hole_of(const Stage& stage) {
  return std::get<SpinningHole>(stage.spacetime.kind()).kerr;
}

// Returns the angle from the axis.
double read_theta(const Section& s) { return kRightAngle - s.angle("latitude_deg"); }

GivenVelocity frame_of(double r, double theta, const KerrMotion& motion) {
  GivenVelocity frame;
  frame.r = r, frame.theta = theta, frame.celerity = motion.celerity;
  return frame;
}

Range outside(const Stage& stage) {
  return kUnitsOfM.above(stage.spacetime.horizon())
      .because("everything falls at and inside the horizon")
      .at_most(kFarthest);
}

std::optional<TimedTrajectory> falling(const Section& s, const Stage& stage, const Item& item,
                                       double r, double theta, const KerrMotion& motion,
                                       const Defaults& defaults) {
  const auto orbit = made(s, item, [&] { return KerrOrbit(hole_of(stage), r, theta, motion); });
  if (!orbit) return std::nullopt;
  // What begins at the orbit's own beginning does so at 0 exactly.
  const auto from_r = s.given("from_r");
  if (s.find("from_r") && !from_r) return std::nullopt;
  const bool there = from_r && *from_r == r && !s.find("from_leg") && !s.find("from_tau_m");
  const auto timing =
      there ? read_end(s, stage, *orbit, 0, defaults) : read_timing(s, stage, *orbit, defaults);
  if (!timing) return std::nullopt;
  return TimedTrajectory{*orbit, *timing, {}};
}

// Reads a circle of any speed at any latitude, which engines keep up.
std::optional<TimedTrajectory> read_driven_circle(const Item& item, const Section& s,
                                                  const Stage& stage) {
  const KerrHole& hole = hole_of(stage);
  const auto speed = s.given("speed"), r = s.required("r", outside(stage));
  const double theta = read_theta(s);
  if (const Item* given = s.find("retrograde"))
    return given->fail("goes with a free circle; give a negative speed");
  if (!speed || !r) return std::nullopt;
  if (std::sin(theta) < 1e-6)
    return s.find("latitude_deg")->fail("is that of the axis, about which nothing circles there");
  const KerrCircling circle{hole, *r, theta, dragged_velocity(hole, *r, theta, *speed)};
  const double turn = 2 * std::numbers::pi / std::abs(circle.at(1).azimuth);
  if (!(turn < 1e15)) return s.find("speed")->fail("leaves it at rest; give type static");
  const auto rate = read_rate(s, stage, turn);
  if (!rate) return std::nullopt;
  return paced_circle(item, s, stage, circle, turn, *rate, false);
}

// Returns the greatest r below `from` at which a fall turns around outside the horizon, if it does.
std::optional<double> turn_of_fall(const KerrHole& hole, double from, const KerrMotion& motion) {
  constexpr int kSteps = 4000;
  const auto a = static_cast<double>(hole.spin), horizon = static_cast<double>(hole.horizon());
  for (int k = 1; k < kSteps; ++k) {
    const double r = from * std::pow(horizon / from, k / static_cast<double>(kSteps));
    const double p = (r * r + a * a) * motion.energy - a * motion.momentum;
    if (p * p < static_cast<double>(hole.delta(r)) * (r * r + motion.carter)) return r;
  }
  return std::nullopt;
}

// Returns the smallest r above `low` from which orbits with that apoastron turn.
double least_periastron(const KerrHole& hole, double low, double apoastron, double inclination) {
  double high = apoastron;
  for (int n = 0; n < 60; ++n) {
    const double middle = (low + high) / 2;
    (kerr_bound(hole, middle, apoastron, inclination) ? high : low) = middle;
  }
  return high;
}

// ---- engines and held velocities ----

Range beyond_inner_horizon(const Stage& stage) {
  return kUnitsOfM.above(stage.spacetime.inner_horizon())
      .because("what is seen within the inner horizon is not computed")
      .at_most(kFarthest);
}

enum class MeasuredBy { kDragged, kStatic, kFreeFall };

// Returns the motion of the observer against whom a speed is given, or reports that there is none.
std::optional<KerrMotion> measuring_motion(const Section& s, const Stage& stage, MeasuredBy against,
                                           double r, double theta) {
  const KerrHole& hole = hole_of(stage);
  if (against == MeasuredBy::kFreeFall) return kerr_motion(hole, r, theta, 1, 0, 0, -1, 0);
  const bool dragged = against == MeasuredBy::kDragged;
  auto motion = kerr_circling(hole, r, theta, dragged ? dragged_velocity(hole, r, theta) : 0);
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
  const double theta = read_theta(s);
  if (!at || !r) return std::nullopt;
  PathKey key{*at, *r, s.angle("azimuth_deg"), {}, {}, theta};
  const Item* speed = s.one_of({"speed", "lorentz_factor"});
  if (!speed) return key;
  if (!(*r > stage.spacetime.horizon()))
    return speed->fail(
        "is against who turns with space, which nothing does within the horizon; "
        "leave it out");
  const KerrHole& hole = hole_of(stage);
  const GivenVelocity frame = frame_of(*r, theta, kerr_dragged(hole, *r, theta));
  const auto own = read_own_celerity(s, stage, frame, lookup);
  if (!own) return std::nullopt;
  const auto celerity = celerity_against(frame.celerity, *own);
  if (!(kerr_motion(hole, *r, theta, celerity).energy > 0))
    return speed->fail("gives a negative energy there, which paths do not have; type thrown has");
  set_kerr_rates(hole, key, celerity);
  return key;
}

}  // namespace

std::optional<TimedTrajectory> read_spin_rest(const Item& item, const Stage& stage, Lookup&) {
  const Section s(item, {"trajectory", "static about a spin", "rates"});
  const KerrHole& hole = hole_of(stage);
  const auto r = s.required("r", outside(stage));
  const double theta = read_theta(s);
  const bool dragged = s.flag("dragged");
  Timing timing{0, proper_time_in(stage, stage.duration_s)};
  if (find_end(s, {})) {
    const auto rate = read_rate(s, stage);
    if (!rate) return std::nullopt;
    timing = {0, rate->span, Pace::kSteady, rate->begin, rate->end};
  }
  if (!r) return std::nullopt;
  const KerrCircling rest{hole, *r, theta, dragged ? dragged_velocity(hole, *r, theta) : 0};
  if (!kerr_circling(hole, *r, theta, rest.angular_velocity)) {
    const auto a = static_cast<double>(hole.spin), q = static_cast<double>(hole.charge);
    const double along = a * std::cos(theta);
    return s.find("r")->fail(fmt::format(
        "must exceed {} (units of M) at that latitude, got {}: within the ergosphere nothing rests "
        "against the stars; with dragged: true it turns with the hole",
        short_number(1 + std::sqrt(1 - along * along - q * q)), as_written(*s.find("r"))));
  }
  return TimedTrajectory{rest, timing, {}};
}

std::optional<TimedTrajectory> read_spin_circle(const Item& item, const Stage& stage, Lookup&) {
  const Section s(item, {"trajectory", "circular about a spin", "rates", "pace"});
  find_end(s, {"orbits"});
  const KerrHole& hole = hole_of(stage);
  if (s.find("speed")) return read_driven_circle(item, s, stage);
  if (const Item* given = s.find("latitude_deg"))
    return given->fail(
        "needs a speed: free circles lie in the equator; inclined orbits of one r are "
        "of type bound");
  const bool retrograde = s.flag("retrograde");
  const auto r = s.required("r", kUnitsOfM.above(kerr_light_circle(hole, !retrograde))
                                     .because("at the light circle an orbit needs the speed of "
                                              "light, below it more")
                                     .at_most(kFarthest));
  const auto circle = r ? kerr_circle(hole, *r, !retrograde) : std::nullopt;
  if (!circle) return std::nullopt;
  const double turn = 2 * std::numbers::pi / std::abs(circle->angle);
  const auto rate = read_rate(s, stage, turn);
  if (!rate) return std::nullopt;
  return paced_circle(item, s, stage,
                      KerrCircling{hole, *r, kRightAngle, circle->angle / circle->time}, turn,
                      *rate, false);
}

// Falls from rest far away, or without angular momentum from rest nearby.
std::optional<TimedTrajectory> read_spin_fall(const Item& item, const Stage& stage, Lookup&) {
  for (const char* key : {"v_inf", "impact_parameter"})
    if (const auto given = peek(item, key))
      return given->fail(
          "is of a fall into a hole without spin; into one with a spin a fall with a speed from "
          "far away is of type thrown");
  const Section s(item, {"trajectory", "begin", "infall about a spin", "end", "rates", "pace"});
  const KerrHole& hole = hole_of(stage);
  const auto a = static_cast<double>(hole.spin);
  const double theta = read_theta(s), sine = std::sin(theta), cosine = std::cos(theta);
  const auto rest_r = s.given("rest_r");
  const double momentum = s.number("angular_momentum");
  Defaults defaults;
  defaults.to_r = std::max(0.05, stage.spacetime.inner_horizon() * 1.01);
  if (sine < 1e-9 && momentum != 0)
    return s.find("angular_momentum")->fail("must be 0 on the axis");
  const auto falls = [&](double r, const KerrMotion& motion) -> std::optional<TimedTrajectory> {
    if (const auto turn = momentum != 0 ? turn_of_fall(hole, r, motion) : std::nullopt)
      return s.find("angular_momentum")
          ->fail(
              fmt::format("is too much for a fall, which turns around at r = {:.4g}: type thrown "
                          "flies past the hole",
                          *turn));
    defaults.tau = 0;
    return falling(s, stage, item, r, theta, motion, defaults);
  };
  if (s.find("rest_r")) {
    if (!rest_r || !in_range(*s.find("rest_r"), *rest_r, outside(stage))) return std::nullopt;
    return falls(*rest_r, kerr_dragged(hole, *rest_r, theta, momentum));
  }
  const auto from_r = s.required("from_r");
  if (!from_r) return std::nullopt;
  if (!(*from_r > stage.spacetime.inner_horizon()))
    return s.find("from_r")->fail(fmt::format("must exceed {} (units of M), the inner horizon",
                                              short_number(stage.spacetime.inner_horizon())));
  // It neither rises nor sinks at from_r.
  const double around = sine > 0 ? momentum / sine - a * sine : 0, over = momentum - a;
  const double carter_q = a * a * cosine * cosine + around * around - over * over;
  const auto motion = kerr_motion(hole, *from_r, theta, 1, momentum, carter_q, -1, 0);
  if (!motion)
    return s.find("angular_momentum")
        ->fail(fmt::format("is too much for a fall from infinity to come to r = {}",
                           short_number(*from_r)));
  return falls(*from_r, *motion);
}

std::optional<TimedTrajectory> read_spin_bound(const Item& item, const Stage& stage, Lookup&) {
  for (const char* key : {"eccentricity", "semilatus_rectum", "excess"})
    if (const auto given = peek(item, key))
      return given->fail(
          "is of an orbit about a hole without spin; about a spin give periastron, apoastron and "
          "perhaps inclination_deg");
  const Section s(item, {"trajectory", "begin", "bound about a spin", "end", "rates", "pace"});
  const KerrHole& hole = hole_of(stage);
  const auto least = s.required("periastron", outside(stage));
  const auto most = s.required("apoastron", outside(stage).at_most(s.range("apoastron").high));
  const double inclination = s.angle("inclination_deg");
  if (!least || !most) return std::nullopt;
  if (*most < *least)
    return s.find("apoastron")
        ->fail(fmt::format("must be at least the periastron, {}, got {}", short_number(*least),
                           as_written(*s.find("apoastron"))));
  const auto motion = kerr_bound(hole, *least, *most, inclination);
  if (!motion)
    return s.find("periastron")
        ->fail(fmt::format(
            "must be at least {:.6g} (units of M), got {}: nearer no orbit with this apoastron and "
            "inclination turns",
            least_periastron(hole, *least, *most, inclination), as_written(*s.find("periastron"))));
  Defaults defaults;
  defaults.tau = 0;
  return falling(s, stage, item, *least, kRightAngle, *motion, defaults);
}

std::optional<TimedTrajectory> read_spin_throw(const Item& item, const Stage& stage,
                                               Lookup& lookup) {
  const Section s(item, {"trajectory", "thrown about a spin", "speed", "end", "rates", "pace"});
  const KerrHole& hole = hole_of(stage);
  const auto from_r = s.required("from_r", outside(stage));
  const double theta = read_theta(s);
  if (!from_r) return std::nullopt;
  const GivenVelocity frame = frame_of(*from_r, theta, kerr_dragged(hole, *from_r, theta));
  const auto own = read_own_celerity(s, stage, frame, lookup);
  if (!own) return std::nullopt;
  const KerrMotion motion =
      kerr_motion(hole, *from_r, theta, celerity_against(frame.celerity, *own));
  const auto orbit = made(s, item, [&] { return KerrOrbit(hole, *from_r, theta, motion); });
  const auto timing = orbit ? read_end(s, stage, *orbit, 0) : std::nullopt;
  if (!timing) return std::nullopt;
  return TimedTrajectory{*orbit, *timing, {}};
}

std::optional<TimedTrajectory> read_spin_velocity(const Item& item, const Stage& stage,
                                                  Lookup& lookup) {
  const Section s(item, {"trajectory", "velocity about a spin", "speed", "pace"});
  using enum MeasuredBy;
  const auto against = s.word("against", {kDragged, kStatic, kFreeFall});
  const auto r = s.required("r", beyond_inner_horizon(stage));
  const double theta = read_theta(s);
  const auto motion = r ? measuring_motion(s, stage, against, *r, theta) : std::nullopt;
  if (!motion) return std::nullopt;
  GivenVelocity frame = frame_of(*r, theta, *motion);
  if (!(*r > stage.spacetime.horizon())) frame.region = Region::kII;
  const auto trajectory = read_velocity_trajectory(s, stage, frame, lookup);
  Timing timing{0, proper_time_in(stage, stage.duration_s)};
  if (!trajectory || !read_pace(s, *trajectory, timing)) return std::nullopt;
  return TimedTrajectory{*trajectory, timing, {}};
}

std::optional<TimedTrajectory> read_spin_path(const Item& item, const Stage& stage,
                                              Lookup& lookup) {
  const Section s(item, {"trajectory", "path about a spin", "begin", "end", "rates", "pace"});
  const auto table =
      read_path_table(s, stage, lookup, read_kerr_key, "at_m, r, latitude_deg, azimuth_deg");
  return flown(table, [&](const PathTable& way) -> std::optional<TimedTrajectory> {
    const KerrFlight flight(hole_of(stage), way.keys);
    const Defaults whole{flight.begin(), Leg::kInward, flight.begin(), {}, flight.end()};
    const auto timing = read_timing(s, stage, flight, whole);
    if (!timing) return std::nullopt;
    return TimedTrajectory{flight, *timing, {}};
  });
}

}  // namespace domefall
