#include "pipeline/show/bodies_section.h"

#include <array>
#include <cmath>
#include <stdexcept>

#include "pipeline/show/nearest_word.h"
#include "pipeline/show/orbital_elements.h"
#include "pipeline/show/placement.h"
#include "pipeline/show/trajectory_section.h"

namespace domefall {
namespace {

// A Julian year has 365.25 days of 86,400 s.
constexpr double kLongestPeriod = 1e9, kSecondsPerYear = 31557600;  // Julian years
constexpr Range kYears = Range{"years"}.within(-1e6, 1e6);
constexpr double kCoolestBodyK = 100, kHottestBodyK = 1e9, kLargestBody = 1e6;
constexpr double kBrightestMagnitude = -100, kFaintestMagnitude = 100;

// Reads the trajectory of a body and the proper time at which it begins.  Returns true if there was
// no mistake.
bool read_way(const Section& s, const Show& to, Lookup& lookup, Body& body) {
  const Item* way = s.one_of({"r", "trajectory"});
  if (!way) {
    s.require("trajectory",
              ": how the body moves, or r, the radius of its circular orbit, or elements");
    return false;
  }
  if (way == s.find("r")) {
    const auto r = read_number(*way, kUnitsOfM.above(3).at_most(kFarthest));
    if (r) body.trajectory = CircularOrbit{*r};
    return r.has_value();
  }
  if (const auto type = peek(*way, "type"); type && !read_choice(*type, trajectories_of_bodies()))
    return false;
  // These keys choose the part of a trajectory that a segment shows, the rate of its clock or a
  // region.  A body has neither part nor clock, and it is in region I or comes from there.
  for (const std::string_view key :
       {"to_r", "to_leg", "to_tau_m", "orbits", "rate_m_per_s", "time_lapse", "pace", "region"})
    if (const auto given = peek(*way, key)) {
      given->fail("is for the trajectories of segments");
      return false;
    }
  // The default end of a trajectory follows from the duration of its segment.  A body has no
  // segment, so that a moment stands in for the duration.
  constexpr double kMoment = 1e-9;  // seconds
  const Stage stage{to.mass_solar, place_tetrad(to.hole_at, to.heading, 0), kMoment};
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

// Reads the plane of an orbit, which is given against that of the observer's first orbit, the
// azimuth in it, and the instant when the body begins to shine.
void read_orbit_plane(const Section& s, const Show& to, Body& body) {
  const double inclination = radians(s.number("inclination_deg", kDegrees.within(0, 180), 0));
  const double node = radians(s.number("node_deg", kDegrees.within(-360, 360), 0));
  const M33d at_node = place_tetrad(to.hole_at, to.heading, node);
  const V3d north = -column(at_node, 1), onward = column(at_node, 2);
  // The motion at the node, normal x node = onward cos i + north sin i, rises to the north by the
  // inclination i.
  body.node = {column(at_node, 0)};
  body.normal = {(north * std::cos(inclination) - onward * std::sin(inclination)).normalized()};
  body.azimuth = radians(s.number("azimuth_deg", kDegrees.within(-3600, 3600), 0));
  const auto begins = s.number("begins_m", kUnitsOfM.within(-kFarthest, kFarthest));
  body.null_time = begins.value_or(0);
  body.shines_before = !begins;
}

// Reads an orbit that is given by its astronomical elements.  `year` is that in which the show
// begins, if the show gives it.
void read_elements(const Item& item, const Show& to, std::optional<double> year, Body& body) {
  const Section s(item, {"period_years", "eccentricity", "inclination_deg", "node_deg",
                         "pericentre_deg", "pericentre_year"});
  const auto period =
      s.required_number("period_years", Range{"years"}.above(0).at_most(kLongestPeriod));
  const auto eccentricity = s.required_number("eccentricity", kPureNumber.at_least(0).below(1));
  const auto inclination = s.required_number("inclination_deg", kDegrees.within(0, 180));
  const auto node = s.required_number("node_deg", kDegrees.within(-360, 360));
  const auto pericentre = s.required_number("pericentre_deg", kDegrees.within(-360, 360));
  const auto passage = s.required_number("pericentre_year", kYears);
  if (passage && !year) {
    s.find("pericentre_year")->fail("needs the show's begins_year, the year in which it begins");
    return;
  }
  if (!period || !eccentricity || !inclination || !node || !pericentre || !passage) return;
  // One M lasts kSecondsPerSolarMass seconds per solar mass, so that this many M make a year.
  const double years_m = kSecondsPerYear / (kSecondsPerSolarMass * to.mass_solar.value_or(1));
  try {
    set_orbit({*period * years_m, *eccentricity, radians(*inclination), radians(*node),
               radians(*pericentre)},
              to.hole_at, body);
  } catch (const std::domain_error& error) {
    item.fail(std::string("has an orbit that this hole does not have: ") + error.what());
  }
  body.null_time = (*passage - *year) * years_m;
}

// Returns V at kBodyMagnitudeDistance of a body with this absolute magnitude, which is that at 10
// pc.  The two differ by 5 log10 of the ratio of the distances (the distance modulus).
double near_magnitude(double absolute, double mass_solar) {
  // A parsec is 648000/pi astronomical units (IAU 2015), of 149,597,870,700 m each.
  constexpr double kTenParsecs = 1.0292712503e9;  // light seconds
  const double distance = kBodyMagnitudeDistance * kSecondsPerSolarMass * mass_solar;
  return absolute + 5 * std::log10(distance / kTenParsecs);
}

// Reads the light of a body.  Its magnitude is V at kBodyMagnitudeDistance, or an absolute one.
void read_light(const Section& s, const Show& to, Body& body) {
  constexpr Range kMagnitudes = Range{"magnitudes"}.within(kBrightestMagnitude, kFaintestMagnitude);
  body.temperature = s.number("temperature_k", Range{"kelvin"}.within(kCoolestBodyK, kHottestBodyK),
                              body.temperature);
  const Item* magnitude = s.one_of({"magnitude", "absolute_magnitude"});
  const auto given = magnitude ? read_number(*magnitude, kMagnitudes) : std::nullopt;
  if (given)
    body.magnitude = magnitude == s.find("magnitude")
                         ? *given
                         : near_magnitude(*given, to.mass_solar.value_or(1));
  body.radius = s.number("radius", kUnitsOfM.above(0).at_most(kLargestBody), body.radius);
}

// Reads one body, whose orbit is given by elements, by a trajectory or by the radius of a circle.
Body read_body(const std::string& name, const Item& item, const Show& to,
               std::optional<double> year, Lookup& lookup) {
  const Section s(item,
                  {"r", "trajectory", "elements", "begins_m", "inclination_deg", "node_deg",
                   "azimuth_deg", "temperature_k", "magnitude", "absolute_magnitude", "radius"});
  Body body;
  body.name = name;
  if (const Item* elements = s.find("elements")) {
    // Elements exclude the keys that give an orbit in another way.
    for (const std::string_view key :
         {"r", "trajectory", "begins_m", "inclination_deg", "node_deg", "azimuth_deg"})
      s.one_of({"elements", key});
    read_elements(*elements, to, year, body);
  } else {
    read_way(s, to, lookup, body);
    read_orbit_plane(s, to, body);
  }
  read_light(s, to, body);
  return body;
}

}  // namespace

std::vector<Body> read_bodies(const Section& show, const Show& to, Lookup& lookup) {
  std::vector<Body> bodies;
  const auto year = show.number("begins_year", kYears);
  const Item* list = show.find("bodies");
  if (list == nullptr) return bodies;
  if (!to.mass_solar) list->fail("need a black hole: give the show black_hole.mass_solar");
  if (!list->node.IsMap()) {
    list->fail("must be a map of names and bodies, e.g. {beacon: {r: 10}}, got " + kind_of(*list));
    return bodies;
  }
  for (const auto& [name, item] : entries_of(*list))
    bodies.push_back(read_body(name, item, to, year, lookup));
  return bodies;
}

}  // namespace domefall
