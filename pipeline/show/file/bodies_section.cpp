#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <stdexcept>

#include "pipeline/show/file/sections.h"
#include "pipeline/show/file/trajectory_section.h"
#include "pipeline/show/placement.h"
#include "pipeline/sources/colour/blackbody.h"
#include "pipeline/sources/sky/read_sky.h"
#include "trajectories/bound_orbit.h"
#include "trajectories/trajectory.h"

namespace domefall {
namespace {

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
    if (const auto* hole = std::get_if<ChargedHole>(&to.spacetime.kind())) {
      const auto r = read_number(*way, s.range("r").above(hole->light_circle()));
      if (r) body.trajectory = ChargedCircle{*hole, *r};
      return r.has_value();
    }
    if (to.spacetime.is<Wormhole>()) {
      way->fail("is a circular orbit about a hole; in a wormhole give a trajectory");
      return false;
    }
    if (const auto* hole = std::get_if<SpinningHole>(&to.spacetime.kind())) {
      const auto r = read_number(*way, s.range("r").above(kerr_light_circle(hole->kerr, true)));
      const auto circle = r ? kerr_circle(hole->kerr, *r, true) : std::nullopt;
      if (circle)
        body.trajectory =
            KerrCircling{hole->kerr, *r, std::numbers::pi / 2, circle->angle / circle->time};
      return circle.has_value();
    }
    const auto r = read_number(*way, s.range("r"));
    if (r) body.trajectory = CircularOrbit{*r};
    return r.has_value();
  }
  if (const auto type = peek(*way, "type");
      type && !read_choice(*type, trajectories_of_bodies(to.spacetime)))
    return false;
  // These keys choose the part of a trajectory that a segment shows, the rate of its clock or a
  // region.  A body has neither part nor clock, and it is in region I or comes from there.
  for (const std::string_view key : {"to_r", "to_l", "to_leg", "to_tau_m", "orbits", "rate_m_per_s",
                                     "time_lapse", "pace", "region"})
    if (const auto given = peek(*way, key)) {
      given->fail("is for the trajectories of segments");
      return false;
    }
  // The default end of a trajectory follows from the duration of its segment.  A body has no
  // segment, so that a moment stands in for the duration.
  constexpr double kMoment = 1e-9;  // seconds
  const Stage stage{to.spacetime, place_tetrad(to.hole_at, to.heading, 0), kMoment};
  const auto read = read_trajectory(*way, stage, lookup);
  if (!read) return false;
  if (read->placement.mirrored || read->placement.turn != 0) {
    way->fail("leaves the body's plane, which inclination_deg and node_deg give");
    return false;
  }
  if (is_within_inner_horizon(point_at(read->trajectory, read->timing.tau_begin).region)) {
    way->fail("begins within the inner horizon; bodies begin outside the hole");
    return false;
  }
  body.trajectory = read->trajectory;
  body.backward = read->placement.backward;
  body.start = read->timing.tau_begin;
  return true;
}

// About a hole that spins the orbit says how it lies to the hole's axis.
OrbitPlane read_body_plane(const Section& s, const Show& to) {
  const auto* hole = std::get_if<SpinningHole>(&to.spacetime.kind());
  if (!hole) return read_orbit_plane(s, to);
  for (const std::string_view key : {"inclination_deg", "node_deg"})
    if (const Item* given = s.find(key))
      given->fail(
          "is that of a plane, which orbits about a spin do not keep; give inclination_deg or "
          "latitude_deg in its trajectory");
  const V3d axis = axis_of(*hole);
  const M33d first = place_tetrad(to.hole_at, to.heading, 0);
  return {{column(moved_about(axis, first, std::numbers::pi / 2, 0), 0)}, {axis}};
}

// The elements are those of visual binaries, and of the stars about Sagittarius A* (Gillessen
// et al. 2009, ApJ 692, 1075; 2017, ApJ 837, 30).  Angles are in radians.
struct OrbitalElements {
  double period;        // of the ellipse, M
  double eccentricity;  // [0, 1)
  double inclination;   // of its plane to that of the sky: 0 counter-clockwise, pi clockwise
  double node;          // position angle, from north through east, where the body recedes
  double pericentre;    // from the node, in the sense of the motion
};

// Returns p = a (1 - e^2), where a follows from Kepler's third law.  With M = 1 that law is a^3 =
// (period/2 pi)^2, and 1 - e^2 is a product that keeps its digits next to e = 1.
double semi_latus_rectum(const OrbitalElements& elements) {
  const double e = elements.eccentricity;
  return std::pow(elements.period / (2 * std::numbers::pi), 2.0 / 3) * (1 - e) * (1 + e);
}

// Lays the orbit into space as it is seen on the way to the hole.  Sets the trajectory, whose tau is
// 0 at the pericentre, its plane, and the azimuth of the pericentre.  The semilatus rectum is
// p = a (1 - e^2), where a is Kepler's, a^3 = (period/2 pi)^2.  From pericentre to pericentre the
// orbit therefore takes longer than the period by a part of about 3/a.  Throws std::domain_error
// where the trajectory does (bound_orbit.h).
//
// With N, E and Z to the north, to the east and away from us, the body is at
//     N: r (cos Omega cos u - sin Omega sin u cos i),
//     E: r (sin Omega cos u + cos Omega sin u cos i),
//     Z: r sin u sin i,
// where u is its angle from the node.  These are the rotations by u, i and Omega, one after the
// other.
void set_orbit(const OrbitalElements& elements, const Show& to, Body& body) {
  const SkyDirection& line_of_sight = to.hole_at;
  const double p = semi_latus_rectum(elements), e = elements.eccentricity;
  if (const auto* hole = std::get_if<ChargedHole>(&to.spacetime.kind()))
    body.trajectory = ChargedOrbit::between(*hole, p / (1 + e), p / (1 - e));
  else
    body.trajectory = bound_by_shape(p, e);
  body.start = 0;
  // The tangents of the sky there are found like those at an observer's own place (placement.h).
  const M33d sky = place_tetrad({-line_of_sight.v}, std::numbers::pi / 2, 0);
  const V3d away = column(sky, 0), north = -column(sky, 1), east = column(sky, 2);
  const double cos_i = std::cos(elements.inclination), sin_i = std::sin(elements.inclination);
  const double cos_node = std::cos(elements.node), sin_node = std::sin(elements.node);
  const V3d node = north * cos_node + east * sin_node;
  const V3d onward = (east * cos_node - north * sin_node) * cos_i + away * sin_i;
  body.node = {node.normalized()};
  body.normal = {node.cross(onward).normalized()};
  body.azimuth = elements.pericentre;
}

void read_elements(const Item& item, const Show& to, std::optional<double> year, Body& body) {
  const Section s(item, {"elements"});
  const auto period = s.required("period_years"), eccentricity = s.required("eccentricity"),
             inclination = s.required("inclination_deg"), node = s.required("node_deg"),
             pericentre = s.required("pericentre_deg"), passage = s.required("pericentre_year");
  if (passage && !year) {
    s.find("pericentre_year")->fail("needs the show's begins_year, the year in which it begins");
    return;
  }
  if (!period || !eccentricity || !inclination || !node || !pericentre || !passage) return;
  constexpr double kSecondsPerYear = 365.25 * 86400;  // Julian
  const double years_m = kSecondsPerYear / to.spacetime.seconds_per_m();
  try {
    set_orbit({*period * years_m, *eccentricity, radians(*inclination), radians(*node),
               radians(*pericentre)},
              to, body);
  } catch (const std::domain_error& error) {
    item.fail(std::string("has an orbit that this hole does not have: ") + error.what());
  }
  body.null_time = (*passage - *year) * years_m;
}

// Returns V at kBodyMagnitudeDistance of a body with this absolute magnitude, which is that at 10
// pc.  The two differ by 5 log10 of the ratio of the distances (the distance modulus).
double near_magnitude(double absolute, double seconds_per_m) {
  // A parsec is 648000/pi astronomical units (IAU 2015), of 149,597,870,700 m each.
  constexpr double kTenParsecs = 1.0292712503e9;  // light seconds
  const double distance = kBodyMagnitudeDistance * seconds_per_m;
  return absolute + 5 * std::log10(distance / kTenParsecs);
}

// Reads the light of a body.  Its magnitude is V at kBodyMagnitudeDistance, or an absolute one.
void read_light(const Section& s, const Show& to, Body& body) {
  body.temperature = s.number("temperature_k");
  const Item* magnitude = s.one_of({"magnitude", "absolute_magnitude"});
  const auto given = magnitude ? read_number(*magnitude, s.range("magnitude")) : std::nullopt;
  if (given)
    body.magnitude = magnitude == s.find("magnitude")
                         ? *given
                         : near_magnitude(*given, to.spacetime.seconds_per_m());
  body.radius = s.given("radius").value_or(0);
}

// Returns the bolometric flux of a body at rest at kBodyMagnitudeDistance, in W/m^2.
double flux_of(const Body& body) {
  return std::pow(10, -0.4 * body.magnitude) * bolometric_flux_at_v_zero(body.temperature);
}

// Returns the radius (M) of a blackbody of that light.  One of the radius rho at the distance d
// sends sigma T^4 (rho/d)^2.
double radius_of_light(const Body& body) {
  const double at_surface = std::numbers::pi * blackbody_radiance(body.temperature);
  return kBodyMagnitudeDistance * std::sqrt(flux_of(body) / at_surface);
}

}  // namespace

// What falls in need only be clear of the hole where its fall begins.
void check_body(const Body& body, const Spacetime& spacetime, const Item& light,
                const Item* own_size) {
  constexpr double kMostFlux = 1e30;  // W/m^2
  const double horizon = spacetime.horizon();
  const auto [low, high] = reach(body.trajectory);
  const double r = low > horizon ? low : high, clear = r - horizon;
  const double radius = body.radius > 0 ? body.radius : radius_of_light(body);
  const std::string limit =
      fmt::format("{} ({})", short_number(clear),
                  spacetime.is<Wormhole>() ? "radii of the throat" : "units of M");
  std::string reason = "it moves at r = " + short_number(r);
  if (horizon > 0) reason += " M, and the horizon is at " + short_number(horizon) + " M";
  if (!(radius < clear) && own_size)
    own_size->fail("must stay below " + limit + ", got " + as_written(*own_size) + ": " + reason);
  else if (!(radius < clear))
    light.fail(
        fmt::format("asks for a sphere of the radius {:.3g} at {} K, which must stay below {}: {}; "
                    "give a fainter magnitude, a higher temperature_k, or a radius",
                    radius, short_number(body.temperature), limit, reason));
  else if (!(flux_of(body) < kMostFlux))
    light.fail(
        fmt::format("asks for {:.3g} W/m^2 at {} K, which must stay below {}; give a fainter "
                    "magnitude or a higher temperature_k",
                    flux_of(body), short_number(body.temperature), short_number(kMostFlux)));
}

namespace {

Body read_body(const std::string& name, const Item& item, const Section& s, const Show& to,
               std::optional<double> year, Lookup& lookup) {
  Body body;
  body.name = name;
  const std::size_t problems = item.problems->count();
  if (const Item* elements = s.find("elements")) {
    if (to.spacetime.is<Wormhole>())
      elements->fail("is an orbit about a hole; in a wormhole give a trajectory");
    if (to.spacetime.is<SpinningHole>())
      elements->fail("is an orbit about a hole without spin; give a trajectory");
    for (const std::string_view key :
         {"r", "trajectory", "begins_m", "inclination_deg", "node_deg", "azimuth_deg"})
      s.one_of({"elements", key});
    if (item.problems->count() == problems) read_elements(*elements, to, year, body);
  } else {
    read_way(s, to, lookup, body);
    const OrbitPlane plane = read_body_plane(s, to);
    body.node = plane.node, body.normal = plane.normal;
    body.azimuth = s.angle("azimuth_deg");
    const auto begins = s.given("begins_m");
    body.null_time = begins.value_or(0);
    body.shines_before = !begins;
  }
  read_light(s, to, body);
  const Item* light = s.find("magnitude") ? s.find("magnitude") : s.find("absolute_magnitude");
  if (item.problems->count() == problems)
    check_body(body, to.spacetime, light ? *light : item, s.find("radius"));
  return body;
}

// Reads one ring, which begins outside the one before it.
std::optional<BodyRing> read_ring(const Item& item, const std::vector<BodyRing>& before) {
  const Section s(item, {"ring"});
  const auto inner = s.required("inner"), outer = s.required("outer");
  V3d colour(1, 1, 1);
  if (const Item* given = s.find("colour"))
    if (const auto rgb = read_numbers(*given, 3, s.range("colour")))
      colour = {(*rgb)[0], (*rgb)[1], (*rgb)[2]};
  const V3d light = apply(working_from_rec709(), colour);
  const double opacity = s.number("opacity");
  if (!inner || !outer) return std::nullopt;
  if (!(*outer > *inner))
    s.find("outer")->fail("must exceed inner = " + short_number(*inner) + ", got " +
                          as_written(*s.find("outer")));
  if (!before.empty() && *inner < before.back().outer)
    s.find("inner")->fail("must not be below the outer = " + short_number(before.back().outer) +
                          " of the ring before it, got " + as_written(*s.find("inner")));
  return BodyRing{
      *inner,
      *outer,
      opacity,
      {static_cast<float>(light.x), static_cast<float>(light.y), static_cast<float>(light.z)}};
}

// Reads one ring, or a list of them.
void read_rings(const Item& item, const Spacetime& spacetime, Body& body) {
  if (spacetime.is<Wormhole>()) item.fail("are about bodies near a hole");
  const auto add = [&](const Item& one) {
    if (const auto ring = read_ring(one, body.rings)) body.rings.push_back(*ring);
  };
  if (!item.node.IsSequence())
    add(item);
  else if (const auto list = read_list(item))
    for (const Item& one : *list) add(one);
  if (body.rings.empty() || !(body.radius > 0)) return;
  const auto [low, high] = reach(body.trajectory);
  const double horizon = spacetime.horizon(), clear = (low > horizon ? low : high) - horizon,
               outer = body.rings.back().outer * body.radius;
  if (!(outer < clear))
    item.fail(fmt::format("reach to {} M from the body, which must stay below {}: the horizon",
                          short_number(outer), short_number(clear)));
}

// Reads what the surface of a body looks like.  The other bodies may follow this one.
void read_surface(const Section& s, const Show& to, const std::map<std::string, Item>& names,
                  Lookup& lookup, Body& body) {
  const Item* texture = s.find("texture");
  const Item* lamp = s.find("lit_from");
  const Item* granulation = s.find("granulation");
  const Item *rings = s.find("rings"), *tilt = s.find("tilt_deg");
  for (const Item* item : {texture, lamp, granulation, rings, tilt})
    if (item && !(body.radius > 0)) item->fail("is for a sphere, which has a radius");
  body.tilt = s.angle("tilt_deg");
  if (rings) read_rings(*rings, to.spacetime, body);
  const Item* even = texture ? texture : lamp;
  if (granulation && even)
    granulation->fail("is for the surface of a star, which has no texture and shines itself");
  // Where gas is hotter it does not rise and sink at the surface.
  constexpr double kHottest = 8000, kContrast = 0.12;
  if (!even)
    body.granulation = s.given("granulation").value_or(body.temperature > kHottest ? 0 : kContrast);
  if (texture)
    if (const auto file = lookup.picture(*texture, try_sky)) body.texture = *file;
  if (!lamp) return;
  const auto name = lamp->node.IsScalar() ? read_text(*lamp) : std::nullopt;
  static constexpr std::array<std::string_view, 1> kWords{"disc"};
  if (name == body.name)
    lamp->fail("must be another body");
  else if (name && names.contains(*name))
    body.lit_from = std::make_shared<const Body>(Body{*name});
  else if (name == kWords[0])
    body.lit_from = LitFromHole{};
  else if (const auto place = read_sky_place(*lamp, lookup, kWords))
    body.lit_from = *place;
}

}  // namespace

std::vector<Body> read_bodies(const Section& show, const Show& to, Lookup& lookup) {
  std::vector<Body> bodies;
  const Item* list = show.find("bodies");
  if (list == nullptr) return bodies;
  if (to.spacetime.is_flat()) list->fail("need a black hole: give the show black_hole.mass_solar");
  if (!list->node.IsMap()) {
    list->fail("must be a map of names and bodies, e.g. {beacon: {r: 10}}, got " + kind_of(*list));
    return bodies;
  }
  std::map<std::string, Item> names;
  for (const auto& [name, item] : entries_of(*list)) names.emplace(name, item);
  for (const auto& [name, item] : entries_of(*list)) {
    const Section s(item, {"bodies", "body.light"});
    bodies.push_back(read_body(name, item, s, to, to.begins_year, lookup));
    read_surface(s, to, names, lookup, bodies.back());
  }
  const std::vector<Body> all = bodies;
  const auto lamp_of = [](auto& body) {
    return body.lit_from ? std::get_if<std::shared_ptr<const Body>>(&*body.lit_from) : nullptr;
  };
  for (Body& body : bodies)
    if (auto* lamp = lamp_of(body)) {
      *lamp = std::make_shared<const Body>(*std::ranges::find(all, (*lamp)->name, &Body::name));
      const auto* other = lamp_of(**lamp);
      if (other && (*other)->name == body.name)
        names.at(body.name).fail(
            fmt::format("is lit from '{}', which is lit from it: one of them must shine by itself",
                        shown((*lamp)->name)));
    }
  return bodies;
}

}  // namespace domefall
