// Reads the wormhole of a show, and trajectories in it.
#include <cmath>
#include <numbers>
#include <stdexcept>

#include "pipeline/show/file/orbit_reading.h"
#include "pipeline/show/file/sections.h"
#include "pipeline/show/file/trajectory_section.h"
#include "trajectories/wormhole_path.h"

namespace domefall {
namespace {

const Wormhole& wormhole_of(const Stage& stage) {
  return std::get<Wormhole>(stage.spacetime.kind());
}

// Returns what rests at l, against which speeds are given.
GivenVelocity rest_at(const Wormhole& wormhole, double l) {
  GivenVelocity rest;
  rest.region = Wormhole::side(l);
  rest.r = wormhole.radius(l);
  rest.l = l;
  return rest;
}

std::optional<PathKey> read_wormhole_key(const Item& item, const Stage& stage, Lookup& lookup) {
  const Section s(item, {"keyframes in a wormhole", "speed"});
  const auto at = s.required("at_m"), l = s.required("l");
  if (!at || !l) return std::nullopt;
  PathKey key{*at, *l, s.angle("azimuth_deg"), {}, {}};
  const Wormhole& wormhole = wormhole_of(stage);
  if (const auto own = read_speed_on_path(s, stage, rest_at(wormhole, *l), lookup)) {
    key.radial_rate = own->x;
    key.azimuth_rate = own->z / wormhole.radius(*l);
  }
  return key;
}

}  // namespace

std::optional<TimedTrajectory> read_wormhole_rest(const Item& item, const Stage& stage, Lookup&) {
  const Section s(item, {"trajectory", "static in a wormhole", "rates"});
  const auto l = s.required("l");
  Timing timing{0, proper_time_in(stage, stage.duration_s)};
  if (find_end(s, {})) {
    const auto rate = read_rate(s, stage);
    if (!rate) return std::nullopt;
    timing = {0, rate->span, Pace::kSteady, rate->begin, rate->end};
  }
  if (!l) return std::nullopt;
  return TimedTrajectory{WormholeCircle{wormhole_of(stage), *l}, timing, {}};
}

std::optional<TimedTrajectory> read_wormhole_circle(const Item& item, const Stage& stage, Lookup&) {
  const Section s(item, {"trajectory", "circular in a wormhole", "rates", "pace"});
  find_end(s, {"orbits"});
  const auto l = s.required("l"), speed = s.required("speed");
  if (!l || !speed) return std::nullopt;
  const Wormhole& wormhole = wormhole_of(stage);
  const double turn =
      2 * std::numbers::pi * wormhole.radius(*l) * std::sqrt((1 - *speed) * (1 + *speed)) / *speed;
  const auto rate = read_rate(s, stage, turn);
  if (!rate) return std::nullopt;
  return paced_circle(item, s, stage, WormholeCircle{wormhole, *l, *speed}, turn, *rate, false);
}

std::optional<TimedTrajectory> read_wormhole_fall(const Item& item, const Stage& stage, Lookup&) {
  const Section s(item,
                  {"trajectory", "infall in a wormhole", "end in a wormhole", "rates", "pace"});
  const auto from_l = s.required("from_l"), speed = s.required("speed");
  const double impact = s.number("impact_parameter");
  if (!from_l || !speed) return std::nullopt;
  const auto fall = made(
      s, item, [&] { return WormholeFall(wormhole_of(stage), *from_l, *speed, impact, true); });
  const auto timing = fall ? read_end(s, stage, *fall, 0) : std::nullopt;
  if (!timing) return std::nullopt;
  return TimedTrajectory{*fall, *timing, {}};
}

std::optional<TimedTrajectory> read_wormhole_throw(const Item& item, const Stage& stage,
                                                   Lookup& lookup) {
  const Section s(
      item, {"trajectory", "thrown in a wormhole", "speed", "end in a wormhole", "rates", "pace"});
  const auto from_l = s.required("from_l");
  if (!from_l) return std::nullopt;
  const auto own = read_own_celerity(s, stage, rest_at(wormhole_of(stage), *from_l), lookup);
  if (!own) return std::nullopt;
  const auto fall = made(s, item, [&] {
    return WormholeFall::thrown(wormhole_of(stage), *from_l, own->x, std::hypot(own->y, own->z));
  });
  const auto timing = fall ? read_end(s, stage, *fall, 0) : std::nullopt;
  if (!timing) return std::nullopt;
  return TimedTrajectory{*fall, *timing, placement_of(*own, false)};
}

std::optional<TimedTrajectory> read_wormhole_path(const Item& item, const Stage& stage,
                                                  Lookup& lookup) {
  const Section s(item, {"trajectory", "path in a wormhole", "end in a wormhole", "rates", "pace"});
  const auto table = read_path_table(s, stage, lookup, read_wormhole_key, "at_m, l, azimuth_deg");
  return flown(table, [&](const PathTable& way) -> std::optional<TimedTrajectory> {
    const WormholeFlight flight(wormhole_of(stage), way.keys);
    Defaults whole;
    whole.to_tau = flight.end();
    const auto timing = read_end(s, stage, flight, flight.begin(), whole);
    if (!timing) return std::nullopt;
    return TimedTrajectory{flight, *timing, {}};
  });
}

std::optional<TimedTrajectory> read_wormhole_velocity(const Item& item, const Stage& stage,
                                                      Lookup& lookup) {
  const Section s(item, {"trajectory", "static in a wormhole", "speed", "pace"});
  const auto l = s.required("l");
  if (!l) return std::nullopt;
  const auto trajectory =
      read_velocity_trajectory(s, stage, rest_at(wormhole_of(stage), *l), lookup);
  Timing timing{0, proper_time_in(stage, stage.duration_s)};
  if (!trajectory || !read_pace(s, *trajectory, timing)) return std::nullopt;
  return TimedTrajectory{*trajectory, timing, {}};
}

Wormhole read_wormhole(const Section& s) {
  Wormhole wormhole;
  wormhole.radius_km = s.required("radius_km").value_or(1);
  wormhole.profile = s.word("profile", {Wormhole::Profile::kDngr, Wormhole::Profile::kEllis});
  if (wormhole.profile == Wormhole::Profile::kEllis)
    for (const char* key : {"length", "lensing_width"})
      if (const Item* given = s.find(key)) given->fail("is of the profile dngr; ellis has none");
  wormhole.length = s.number("length");
  wormhole.lensing_width = s.number("lensing_width");
  return wormhole;
}

}  // namespace domefall
