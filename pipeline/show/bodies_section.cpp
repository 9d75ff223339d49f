#include "pipeline/show/bodies_section.h"

#include <array>
#include <cmath>

#include "pipeline/show/nearest_word.h"
#include "pipeline/show/placement.h"
#include "pipeline/show/trajectory_section.h"

namespace domefall {
namespace {

constexpr double kCoolestBodyK = 100, kHottestBodyK = 1e9, kLargestBody = 1e6;
constexpr double kBrightestMagnitude = -100, kFaintestMagnitude = 100;

// What a body does by itself.  The others need a segment, or an engine.
constexpr std::array<std::string_view, 7> kTypes{"static", "circular", "parabolic", "hyperbolic",
                                                 "bound",  "infall",   "thrown"};

// Reads where it moves, and from where on.  Returns whether there was no mistake.
bool read_way(const Section& s, const Show& to, Lookup& lookup, Body& body) {
  const Item* way = s.one_of({"r", "trajectory"});
  if (!way) {
    s.require("trajectory", ": how the body moves, or r, the radius of its circular orbit");
    return false;
  }
  if (way == s.find("r")) {
    const auto r = read_number(*way, kUnitsOfM.above(3).at_most(kFarthest));
    if (r) body.trajectory = CircularOrbit{*r};
    return r.has_value();
  }
  if (const auto type = peek(*way, "type"); type && !read_choice(*type, kTypes)) return false;
  // A body shows no part of its way and has no clock to run, and it is in region I, or comes from
  // it.
  for (const std::string_view key :
       {"to_r", "to_leg", "to_tau_m", "orbits", "rate_m_per_s", "time_lapse", "pace", "region"})
    if (const auto given = peek(*way, key)) {
      given->fail("is for the trajectories of segments");
      return false;
    }
  constexpr double kMoment = 1e-9;  // of which a segment's default ends want something
  const Stage stage{to.mass_solar, place_tetrad(to.hole_at, to.heading, 0), kMoment, nullptr};
  const auto read = read_trajectory(*way, stage, lookup);
  if (!read) return false;
  if (read->placement.mirrored || read->placement.turn != 0) {
    way->fail("leaves the body's plane, which inclination_deg and node_deg give");
    return false;
  }
  body.trajectory = read->trajectory;
  body.backward = read->placement.backward;
  body.start = read->timing.tau_begin;
  return true;
}

Body read_body(const std::string& name, const Item& item, const Show& to, Lookup& lookup) {
  const Section s(item, {"r", "trajectory", "begins_m", "inclination_deg", "node_deg",
                         "azimuth_deg", "temperature_k", "magnitude", "radius"});
  Body body;
  body.name = name;
  read_way(s, to, lookup, body);
  const double inclination = radians(s.number("inclination_deg", kDegrees.within(0, 180), 0));
  const double node = radians(s.number("node_deg", kDegrees.within(-360, 360), 0));
  const M33d at_node = place_tetrad(to.hole_at, to.heading, node);
  const V3d north = -column(at_node, 1), onward = column(at_node, 2);
  body.node = {column(at_node, 0)};
  body.normal = {(north * std::cos(inclination) - onward * std::sin(inclination)).normalized()};
  body.azimuth = radians(s.number("azimuth_deg", kDegrees.within(-3600, 3600), 0));
  const auto begins = s.number("begins_m", kUnitsOfM.within(-kFarthest, kFarthest));
  body.null_time = begins.value_or(0);
  body.shines_before = !begins;
  body.temperature = s.number("temperature_k", Range{"kelvin"}.within(kCoolestBodyK, kHottestBodyK),
                              body.temperature);
  body.magnitude =
      s.number("magnitude", Range{"magnitudes"}.within(kBrightestMagnitude, kFaintestMagnitude),
               body.magnitude);
  body.radius = s.number("radius", kUnitsOfM.above(0).at_most(kLargestBody), body.radius);
  return body;
}

}  // namespace

std::vector<Body> read_bodies(const Section& show, const Show& to, Lookup& lookup) {
  std::vector<Body> bodies;
  const Item* list = show.find("bodies");
  if (list == nullptr) return bodies;
  if (!to.mass_solar) list->fail("need a black hole: give the show black_hole.mass_solar");
  if (!list->node.IsMap()) {
    list->fail("must be a map of names and bodies, e.g. {beacon: {r: 10}}, got " + kind_of(*list));
    return bodies;
  }
  for (const auto& [name, item] : entries_of(*list))
    bodies.push_back(read_body(name, item, to, lookup));
  return bodies;
}

}  // namespace domefall
