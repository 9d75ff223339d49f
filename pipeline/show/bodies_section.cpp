#include "pipeline/show/bodies_section.h"

#include <cmath>

#include "pipeline/show/lookup.h"
#include "pipeline/show/placement.h"

namespace domefall {
namespace {

constexpr double kWidestOrbit = 1e9, kCoolestBodyK = 100, kHottestBodyK = 1e9;
constexpr double kBrightestMagnitude = -100, kFaintestMagnitude = 100;

Body read_body(const std::string& name, const Item& item, const Show& to) {
  const Section s(
      item, {"r", "inclination_deg", "node_deg", "azimuth_deg", "temperature_k", "magnitude"});
  Body body;
  body.name = name;
  body.r = s.required_number("r", kUnitsOfM.above(3).at_most(kWidestOrbit)).value_or(body.r);
  const double inclination = radians(s.number("inclination_deg", kDegrees.within(0, 180), 0));
  const double node = radians(s.number("node_deg", kDegrees.within(-360, 360), 0));
  const M33d at_node = place_tetrad(to.hole_at, to.heading, node);
  const V3d north = -column(at_node, 1), onward = column(at_node, 2);
  body.node = {column(at_node, 0)};
  body.normal = {(north * std::cos(inclination) - onward * std::sin(inclination)).normalized()};
  body.azimuth = radians(s.number("azimuth_deg", kDegrees.within(-3600, 3600), 0));
  body.temperature = s.number("temperature_k", Range{"kelvin"}.within(kCoolestBodyK, kHottestBodyK),
                              body.temperature);
  body.magnitude =
      s.number("magnitude", Range{"magnitudes"}.within(kBrightestMagnitude, kFaintestMagnitude),
               body.magnitude);
  return body;
}

}  // namespace

std::vector<Body> read_bodies(const Section& show, const Show& to) {
  std::vector<Body> bodies;
  const Item* list = show.find("bodies");
  if (list == nullptr) return bodies;
  if (!to.mass_solar) list->fail("need a black hole: give the show black_hole.mass_solar");
  if (!list->node.IsMap()) {
    list->fail("must be a map of names and bodies, e.g. {beacon: {r: 10}}, got " + kind_of(*list));
    return bodies;
  }
  for (const auto& [name, item] : entries_of(*list)) bodies.push_back(read_body(name, item, to));
  return bodies;
}

}  // namespace domefall
