#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "pipeline/image/read_image.h"
#include "pipeline/show/file/sections.h"
#include "pipeline/show/placement.h"
#include "pipeline/sources/colour/blackbody.h"
#include "pipeline/sources/disc/disc_light.h"

namespace domefall {
namespace {

// Reads the radii.  A disc ends at the last stable orbit, or at the horizon if its gas plunges in.
void read_radii(const Section& s, Disc& disc) {
  const double horizon = disc.orbits.horizon();
  if (disc.plunging)
    disc.inner = s.given("inner_r", s.range("inner_r").at_least(horizon)).value_or(horizon);
  else
    disc.inner = s.given("inner_r", s.range("inner_r")
                                        .at_least(disc.orbits.last_stable())
                                        .because("gas inside the last stable orbit falls in, with "
                                                 "plunging: true"))
                     .value_or(disc.orbits.last_stable());
  disc.outer = s.number("outer_r");
  if (disc.outer > disc.inner) return;
  if (const Item* outer = s.find("outer_r"))
    outer->fail(fmt::format("must exceed inner_r = {} (units of M), got {}",
                            short_number(disc.inner), as_written(*outer)));
  else if (const Item* inner = s.find("inner_r"))
    inner->fail(fmt::format("must be below outer_r = {} (units of M), got {}",
                            short_number(disc.outer), as_written(*inner)));
}

// Reads a picture of the disc.
std::optional<PatternKind> read_map(const Item& item, const Disc& disc, const Lookup& lookup) {
  const Section s(item, {"pattern", "pattern.file"});
  MapPattern map{{}, s.number("at_m"), disc.inner, disc.outer};
  const Item* name = s.require("file", ", a picture");
  const auto file =
      name ? lookup.picture(*name, [](const std::filesystem::path& path) { read_image(path); })
           : std::nullopt;
  if (!file) return std::nullopt;
  map.file = *file;
  return map;
}

std::optional<PatternKind> read_pattern(const Item& item, const Disc& disc, const Lookup& lookup) {
  enum class Type { kTurbulence, kRings, kSpot, kFile, kNone };
  const Item* map = item.node.IsMap() ? &item : nullptr;
  const auto type = map ? peek(item, "type") : std::optional(item);
  if (!type && map && peek(item, "file")) return read_map(item, disc, lookup);
  if (!type) return item.fail("needs a type: turbulence, rings, spot or file");
  const auto chosen = read_choice(*type, keys_of("pattern")[0].words());
  if (!chosen) return std::nullopt;
  switch (static_cast<Type>(*chosen)) {
    case Type::kTurbulence: {
      const Section s(map, {"pattern", "turbulence"});
      return TurbulencePattern{s.number("contrast"), s.number("orbits"),
                               static_cast<std::uint32_t>(s.whole("seed"))};
    }
    case Type::kRings: {
      const Section s(map, {"pattern", "rings"});
      return RingPattern{s.number("spacing_r"), s.number("contrast"), s.number("inward_speed")};
    }
    case Type::kSpot: {
      const Section s(map, {"pattern", "spot"});
      const double stable = disc.orbits.last_stable();
      const double r =
          s.given("r", s.range("r").at_least(stable)).value_or(std::max(SpotPattern().r, stable));
      if (!(r >= disc.inner && r <= disc.outer))
        (s.find("r") ? *s.find("r") : item)
            .fail(fmt::format("is of a spot at r = {} (units of M), which the disc from {} to {} "
                              "does not hold",
                              short_number(r), short_number(disc.inner), short_number(disc.outer)));
      return SpotPattern{r, s.angle("azimuth_deg"), s.number("size_r"), s.number("brightness")};
    }
    case Type::kFile:
      return read_map(item, disc, lookup);
    case Type::kNone:
      break;
  }
  return std::nullopt;
}

// Reads one pattern, or a list of them.
std::vector<PatternKind> read_patterns(const Item& item, const Disc& disc, const Lookup& lookup) {
  std::vector<PatternKind> patterns;
  const auto add = [&](const Item& one) {
    const std::optional<PatternKind> pattern = read_pattern(one, disc, lookup);
    if (!pattern) return;
    const bool again = !std::holds_alternative<SpotPattern>(*pattern) &&
                       std::any_of(patterns.begin(), patterns.end(), [&](const PatternKind& other) {
                         return other.index() == pattern->index();
                       });
    if (again) one.fail("is of a type that is there already: only spots can be several");
    patterns.push_back(*pattern);
  };
  if (!item.node.IsSequence())
    add(item);
  else if (const auto list = read_list(item))
    for (const Item& one : *list) add(one);
  return patterns;
}

// Returns the orbits of gas about the hole of a show, and reports a show where none circles.
std::optional<GasOrbits> orbits_of_gas(const Item& item, const Show& to, bool retrograde = false) {
  if (to.spacetime.is_flat()) item.fail("needs a black hole: give the show black_hole.mass_solar");
  if (to.spacetime.is<Wormhole>()) item.fail("needs a black hole: nothing circles a wormhole");
  if (const auto* spinning = std::get_if<SpinningHole>(&to.spacetime.kind()))
    return GasOrbits(spinning->kerr, retrograde);
  const auto* hole = std::get_if<ChargedHole>(&to.spacetime.kind());
  if (!hole) return GasOrbits();
  if (!hole->is_naked()) return GasOrbits(*hole);
  item.fail("needs a hole with a horizon: gas about a naked singularity is not drawn");
  return std::nullopt;
}

// Returns the plane of gas, which is the equator of a hole that spins.  There gas that goes against the
// hole has the other end of the axis as its normal.
OrbitPlane read_gas_plane(const Section& s, const Show& to, bool retrograde) {
  const auto* hole = std::get_if<SpinningHole>(&to.spacetime.kind());
  if (!hole) return read_orbit_plane(s, to);
  if (const Item* tilt = s.find("inclination_deg"))
    tilt->fail("cannot be given: about a hole that spins gas lies in its equator");
  const V3d axis = axis_of(*hole), normal = retrograde ? -axis : axis;
  const M33d at_start = place_tetrad(to.hole_at, to.heading, 0);
  const V3d place = column(at_start, 0), along = place - axis * axis.dot(place);
  constexpr double kOnAxis = 1e-6;
  const V3d from =
      (along.length() > kOnAxis ? along : axis.cross(column(at_start, 1))).normalized();
  const double angle = s.angle("node_deg");
  return {{from * std::cos(angle) + normal.cross(from) * std::sin(angle)}, {normal}};
}

// Reads a halo or a jet, by what is its own and by what they have in common.  Their axis is the disc's
// unless they have their own.
template <class Gas, class Own>
std::optional<Gas> read_thin_gas(const Section& show, std::string_view key, const Show& to,
                                 const Own& own) {
  const Item* item = show.find(key);
  if (item == nullptr) return std::nullopt;
  const Section s(item, {key});
  orbits_of_gas(*item, to);
  if (to.disc && !(to.disc->height > 0))
    item->fail("needs a disc with a height, which it can shine through: give disc.height");
  Gas gas;
  const bool tilted = s.find("inclination_deg") || s.find("node_deg");
  const bool spins = to.spacetime.is<SpinningHole>();
  if (const Item* node = s.find("node_deg"); node && spins)
    node->fail("cannot be given: about a hole that spins gas lies in its equator");
  gas.normal = to.disc && !tilted && !spins ? to.disc->normal : read_gas_plane(s, to, false).normal;
  gas.r = s.number("r");
  gas.luminance = s.number("luminance_cd_m2");
  gas.temperature = s.given("t_k");
  own(s, gas);
  return gas;
}

}  // namespace

OrbitPlane read_orbit_plane(const Section& s, const Show& to) {
  const double inclination = s.angle("inclination_deg");
  const M33d at_node = place_tetrad(to.hole_at, to.heading, s.angle("node_deg"));
  const V3d north = -column(at_node, 1), onward = column(at_node, 2);
  // The motion at the node, normal x node = onward cos i + north sin i, rises to the north by the
  // inclination i.  The axes have north x node = onward and onward x node = -north.
  return {{column(at_node, 0)},
          {(north * std::cos(inclination) - onward * std::sin(inclination)).normalized()}};
}

// About a hole that spins the same gas is hotter next to the hole.  Were the hottest ring no hotter by
// default than without a spin, the rest of the disc would be dark; were it as hot as that gas, all of the
// disc would be white behind its own glare.  Between them gold stays gold.
void read_light(const Section& s, Disc& disc) {
  disc.t_max_k = s.number("t_max_k"), disc.luminance = s.number("luminance_cd_m2");
  if (disc.orbits.spin() == 0) return;
  const GasOrbits without(ChargedHole{1, std::sqrt(disc.orbits.charge_squared())});
  const auto greatest = [&](const GasOrbits& orbits) {
    return PageThorneProfile(disc.plunging, orbits).greatest();
  };
  // Two thirds of the way: flux goes with T^4.
  const double hotter = std::pow(greatest(disc.orbits) / greatest(without), 1.0 / 6);
  // By the default temperature, since cool gas that a show asks for would be brighter without bounds.
  constexpr double kUsual = 3000;
  if (s.find("t_max_k") == nullptr) disc.t_max_k *= hotter;
  if (s.find("luminance_cd_m2") == nullptr)
    disc.luminance *= std::sqrt(blackbody_xyz(kUsual * hotter).y / blackbody_xyz(kUsual).y);
}

std::optional<Disc> read_disc(const Section& show, const Show& to, const Lookup& lookup) {
  const Item* item = show.find("disc");
  if (item == nullptr) return std::nullopt;
  const Section s(item, {"disc", "disc.light"});
  Disc disc;
  const bool retrograde = s.flag("retrograde");
  if (retrograde && !to.spacetime.is<SpinningHole>())
    s.find("retrograde")->fail("needs a hole that spins: give black_hole.spin");
  if (const auto orbits = orbits_of_gas(*item, to, retrograde)) disc.orbits = *orbits;
  disc.plunging = s.flag("plunging");
  read_radii(s, disc);
  const OrbitPlane plane = read_gas_plane(s, to, retrograde);
  disc.node = plane.node, disc.normal = plane.normal;
  read_light(s, disc);
  disc.optical_depth = s.number("optical_depth"), disc.rim = s.number("rim");
  disc.height = s.number("height");
  // A lower slab would be finer than the rays by which it is looked at.
  constexpr double kLeastHeight = 0.01;
  if (disc.height > 0 && disc.height < kLeastHeight)
    s.find("height")->fail(fmt::format("must be 0, for a sheet, or at least {}, got {}",
                                       kLeastHeight, as_written(*s.find("height"))));
  disc.opacity = s.number("opacity");
  if (const Item* pattern = s.find("pattern"))
    disc.patterns = read_patterns(*pattern, disc, lookup);
  disc.slow_light = s.flag("slow_light");
  return disc;
}

std::optional<Halo> read_halo(const Section& show, const Show& to) {
  return read_thin_gas<Halo>(
      show, "halo", to, [](const Section& s, Halo& halo) { halo.height = s.number("height"); });
}

std::optional<Jet> read_jet(const Section& show, const Show& to) {
  return read_thin_gas<Jet>(show, "jet", to, [](const Section& s, Jet& jet) {
    jet.lorentz = s.number("lorentz_factor"), jet.opening = s.angle("opening_deg");
    jet.length = s.number("length_r");
  });
}

}  // namespace domefall
