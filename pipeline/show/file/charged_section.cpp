// Reads trajectories near a charged hole, by the keys that they have near one without a charge.
#include <fmt/format.h>

#include <cmath>
#include <stdexcept>

#include "pipeline/show/file/orbit_reading.h"
#include "pipeline/show/file/trajectory_section.h"
#include "trajectories/charged_orbit.h"

namespace domefall {
namespace {

const ChargedHole& hole_of(const Stage& stage) {
  return std::get<ChargedHole>(stage.spacetime.kind());
}

// Returns the radii outside of the hole.
Range outside(const ChargedHole& hole, std::string_view why) {
  return kUnitsOfM.above(hole.horizon()).because(why).at_most(kFarthest);
}

Defaults from_apoastron(const ChargedOrbit& orbit) {
  Defaults start;
  start.tau = start.after = -orbit.radial_period() / 2;
  return start;
}

// What counts by which part an orbit lies above the barrier has no form near a charge.
bool has_excess(const Section& s) {
  const Item* excess = s.find("excess");
  if (excess) excess->fail("is for holes without charge; give the orbit by other keys");
  return excess != nullptr;
}

std::optional<TimedTrajectory> timed(const Section& s, const Stage& stage,
                                     const ChargedOrbit& orbit, const Defaults& start,
                                     const Item& item) {
  const bool mirrored = is_in_region_three(s);
  const auto timing = read_timing(s, stage, orbit, start);
  if (!timing) return std::nullopt;
  const auto turn = orbit.next_periastron(timing->tau_begin);
  if (orbit.innermost() < kNearest && turn && *turn <= timing->tau_end)
    return item.fail(fmt::format("turns at r = {} M; shows go from {} to {} M",
                                 short_number(orbit.innermost()), short_number(kNearest),
                                 short_number(kFarthest)));
  return TimedTrajectory{orbit, *timing, {mirrored}};
}

std::optional<ChargedOrbit> read_escape(const Section& s, const ChargedHole& hole) {
  const Item* by = s.one_of({"periastron", "angular_momentum"});
  if (!by) {
    s.require("periastron", " (units of M); or give angular_momentum (units of M)");
    return std::nullopt;
  }
  if (const auto r = s.given("periastron"))
    return made(s, *by, [&] { return ChargedOrbit::by_periastron(hole, *r, 0); });
  const auto l = s.given("angular_momentum");
  if (!l) return std::nullopt;
  return made(s, *by, [&] { return ChargedOrbit::through(hole, kFarthest, 0, *l); });
}

std::optional<ChargedOrbit> read_scattering(const Section& s, const ChargedHole& hole) {
  const Item* by = s.one_of({"periastron", "impact_parameter"});
  if (!by) s.require("periastron", " (units of M); or give impact_parameter (units of M)");
  const auto v = s.required("v_inf");
  if (!by || !v) return std::nullopt;
  const double excess = *v * *v / ((1 - *v) * (1 + *v));
  if (const auto r = s.given("periastron"))
    return made(s, *by, [&] { return ChargedOrbit::by_periastron(hole, *r, excess); });
  const auto b = s.given("impact_parameter");
  if (!b) return std::nullopt;
  return made(s, *by, [&] {
    return ChargedOrbit::through(hole, kFarthest, excess, *b * std::sqrt(excess));
  });
}

std::optional<ChargedOrbit> read_ellipse(const Section& s, const ChargedHole& hole) {
  for (const std::string_view shape : {"semilatus_rectum", "eccentricity"})
    for (const std::string_view turn : {"periastron", "apoastron"}) s.one_of({turn, shape});
  if (s.find("periastron") || s.find("apoastron")) {
    const auto low = s.required("periastron");
    const auto high = s.required("apoastron");
    if (!low || !high) return std::nullopt;
    return made(s, *s.find("periastron"), [&] { return ChargedOrbit::between(hole, *low, *high); });
  }
  const auto e = s.required("eccentricity");
  const auto p = s.required("semilatus_rectum");
  if (!e || !p) return std::nullopt;
  return made(s, *s.find("semilatus_rectum"),
              [&] { return ChargedOrbit::between(hole, *p / (1 + *e), *p / (1 - *e)); });
}

std::optional<ChargedOrbit> read_fall(const Section& s, const Item& item, const ChargedHole& hole) {
  s.one_of({"rest_r", "v_inf"});
  s.one_of({"rest_r", "impact_parameter"});
  const double momentum = s.number("angular_momentum");
  if (s.find("rest_r")) {
    const auto rest_r = s.given("rest_r", outside(hole, "nothing rests at or inside the horizon"));
    if (!rest_r) return std::nullopt;
    return made(s, *s.find("rest_r"),
                [&] { return ChargedOrbit::from_rest(hole, *rest_r, momentum); });
  }
  const auto from_r = s.required("from_r");
  if (!from_r) return std::nullopt;
  if (!s.find("v_inf"))
    return made(s, item, [&] { return ChargedOrbit::through(hole, *from_r, 0, momentum); });
  const auto v = s.given("v_inf");
  const double b = s.number("impact_parameter", 0);
  if (!v) return std::nullopt;
  const double excess = *v * *v / ((1 - *v) * (1 + *v));
  return made(s, item,
              [&] { return ChargedOrbit::through(hole, *from_r, excess, b * std::sqrt(excess)); });
}

}  // namespace

std::optional<TimedTrajectory> read_charged_parabola(const Item& item, const Stage& stage,
                                                     Lookup&) {
  const Section s = orbit_section(item, "parabolic");
  const auto orbit = has_excess(s) ? std::nullopt : read_escape(s, hole_of(stage));
  return orbit ? timed(s, stage, *orbit, {}, item) : std::nullopt;
}

std::optional<TimedTrajectory> read_charged_hyperbola(const Item& item, const Stage& stage,
                                                      Lookup&) {
  const Section s = orbit_section(item, "hyperbolic");
  const auto orbit = has_excess(s) ? std::nullopt : read_scattering(s, hole_of(stage));
  return orbit ? timed(s, stage, *orbit, {}, item) : std::nullopt;
}

std::optional<TimedTrajectory> read_charged_ellipse(const Item& item, const Stage& stage, Lookup&) {
  const Section s = orbit_section(item, "bound");
  const auto orbit = has_excess(s) ? std::nullopt : read_ellipse(s, hole_of(stage));
  return orbit ? timed(s, stage, *orbit, from_apoastron(*orbit), item) : std::nullopt;
}

std::optional<TimedTrajectory> read_charged_fall(const Item& item, const Stage& stage, Lookup&) {
  const Section s = orbit_section(item, "infall");
  const auto orbit = read_fall(s, item, hole_of(stage));
  if (!orbit) return std::nullopt;
  // A fall from rest begins where it rests.
  Defaults start;
  if (s.find("rest_r")) start = from_apoastron(*orbit);
  if (hole_of(stage).inner_horizon() > 0) start.to_r = hole_of(stage).inner_horizon() * 1.001;
  return timed(s, stage, *orbit, start, item);
}

std::optional<TimedTrajectory> read_charged_circle(const Item& item, const Stage& stage, Lookup&) {
  const ChargedHole& hole = hole_of(stage);
  const Section s(item, {"trajectory", "region", "circular", "rates", "pace"});
  find_end(s, {"orbits"});
  const double least = std::max(hole.light_circle(), hole.charge * hole.charge);
  const auto r = s.required(
      "r", kUnitsOfM.above(least)
               .because("at the light circle an orbit needs the speed of light, below it more")
               .at_most(kFarthest));
  const bool mirrored = is_in_region_three(s);
  const auto orbit = r ? std::optional(ChargedCircle{hole, *r}) : std::nullopt;
  const auto rate = read_rate(s, stage, orbit ? std::optional(period(*orbit)) : std::nullopt);
  if (!orbit || !rate) return std::nullopt;
  return paced_circle(item, s, stage, *orbit, period(*orbit), *rate, mirrored);
}

}  // namespace domefall
