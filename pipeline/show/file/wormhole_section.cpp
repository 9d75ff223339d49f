// Reads the wormhole of a show, and trajectories in it.
#include <cmath>
#include <limits>
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
  if (!(*speed > 0)) {
    s.find("speed")->fail("must be above 0; what keeps its place is of type static");
    return std::nullopt;
  }
  const Wormhole& wormhole = wormhole_of(stage);
  const double turn =
      2 * std::numbers::pi * wormhole.radius(*l) * std::sqrt((1 - *speed) * (1 + *speed)) / *speed;
  const auto rate = read_rate(s, stage, turn);
  if (!rate) return std::nullopt;
  return paced_circle(item, s, stage, WormholeCircle{wormhole, *l, *speed}, turn, *rate, false);
}

std::optional<TimedTrajectory> read_wormhole_fall(const Item& item, const Stage& stage, Lookup&) {
  const Section s(item, {"trajectory", "infall in a wormhole", "rates", "pace"});
  const Item* given = find_end(s, {"to_l"});
  const auto from_l = s.required("from_l"), speed = s.required("speed");
  const double impact = s.number("impact_parameter");
  const auto to_l = s.given("to_l");
  if (!from_l || !speed || (s.find("to_l") && !to_l)) return std::nullopt;
  const Wormhole& wormhole = wormhole_of(stage);
  const auto fall =
      made(s, item, [&] { return WormholeFall(wormhole, *from_l, *speed, impact, true); });
  if (!fall) return std::nullopt;
  Timing timing{0, proper_time_in(stage, stage.duration_s)};
  if (to_l) {
    const auto end = fall->time_at_l(*to_l, std::numeric_limits<double>::min());
    if (!end) {
      s.find("to_l")->fail(
          "is where this fall does not come; with impact_parameter above 1 it turns "
          "before the throat");
      return std::nullopt;
    }
    timing.tau_end = *end;
    if (!read_end_rates(s, stage, timing)) return std::nullopt;
  } else if (given) {
    const auto rate = read_rate(s, stage);
    if (!rate) return std::nullopt;
    timing = {0, rate->span, Pace::kSteady, rate->begin, rate->end};
  }
  if (!read_pace(s, *fall, timing)) return std::nullopt;
  return TimedTrajectory{*fall, timing, {}};
}

std::optional<TimedTrajectory> read_wormhole_path(const Item& item, const Stage& stage, Lookup&) {
  const Section s(item, {"trajectory", "path in a wormhole", "rates", "pace"});
  const Item* list = s.require("keyframes", ": a list of {at_m, l, azimuth_deg}");
  const auto items = list ? read_list(*list) : std::nullopt;
  if (!items) return std::nullopt;
  std::vector<WormholeKey> keys;
  for (const Item& one : *items) {
    const Section key(one, {"keyframes in a wormhole"});
    const auto at = key.required("at_m"), l = key.required("l");
    if (!at || !l) return std::nullopt;
    keys.push_back({*at, *l, key.angle("azimuth_deg")});
  }
  try {
    const WormholeFlight flight(wormhole_of(stage), keys);
    Timing timing{flight.begin(), flight.end()};
    if (!read_end_rates(s, stage, timing) || !read_pace(s, flight, timing)) return std::nullopt;
    return TimedTrajectory{flight, timing, {}};
  } catch (const std::domain_error& error) {
    list->fail(std::string("cannot be flown: ") + error.what());
    return std::nullopt;
  }
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
