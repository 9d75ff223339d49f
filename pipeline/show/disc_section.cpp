#include "pipeline/show/disc_section.h"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <span>

#include "pipeline/show/lookup.h"
#include "pipeline/show/placement.h"

namespace domefall {
namespace {

// The observer's first place lies 10 degrees above the plane, as in Luminet's picture of 1979.
constexpr double kInclinationDeg = 10, kNodeDeg = 90;
// docs/show-format.md specifies these bounds.
constexpr double kWidestDisc = 1e6;
constexpr double kCoolestDiscK = 1000, kHottestDiscK = 1e9, kBrightestDisc = 1e12;
constexpr int kLargestSeed = 1'000'000'000;

// Returns the word true or false under a key, or the fallback.  Other words that YAML has for
// these, such as yes and on, are refused.
bool read_switch_of(const Section& s, std::string_view key, bool fallback) {
  return s.word<bool>(key, {{"true", true}, {"false", false}}).value_or(fallback);
}

// Reads the radii.  A disc ends at the last stable orbit, or at the horizon if its gas plunges in.
void read_radii(const Section& s, Disc& disc) {
  const Range radius = kUnitsOfM.at_most(kWidestDisc);
  Range stable = radius.at_least(kLastStableOrbit);
  stable.low_reason = "gas inside the last stable orbit falls in, with plunging: true";
  disc.inner = s.number("inner_r", disc.plunging ? radius.at_least(kHorizonRadius) : stable,
                        disc.plunging ? kHorizonRadius : kLastStableOrbit);
  disc.outer = s.number("outer_r", radius.above(kHorizonRadius), disc.outer);
  // The defaults are in order, so that of a pair out of order one key at least is given.
  if (disc.outer > disc.inner) return;
  if (const Item* outer = s.find("outer_r"))
    outer->fail(fmt::format("must exceed inner_r = {} (units of M), got {}",
                            short_number(disc.inner), as_written(*outer)));
  else if (const Item* inner = s.find("inner_r"))
    inner->fail(fmt::format("must be below outer_r = {} (units of M), got {}",
                            short_number(disc.outer), as_written(*inner)));
}

// Reads two elements of celestial mechanics: the angle between the two planes, and the place where
// matter rises to the north of the orbit's plane.
void read_disc_plane(const Section& s, const Show& to, Disc& disc) {
  const double inclination =
      radians(s.number("inclination_deg", kDegrees.within(0, 180), kInclinationDeg));
  const double node = radians(s.number("node_deg", kDegrees.within(-360, 360), kNodeDeg));
  const M33d at_node = place_tetrad(to.hole_at, to.heading, node);
  const V3d north = -column(at_node, 1), onward = column(at_node, 2);
  // The motion at the node, normal x node = onward cos i + north sin i, rises to the north.  The
  // axes have north x node = onward and onward x node = -north.
  disc.normal = {(north * std::cos(inclination) - onward * std::sin(inclination)).normalized()};
  disc.node = {column(at_node, 0)};
}

// ---- patterns ----

constexpr Range kContrast = kPureNumber.within(0, 1);

// Returns the keys of a pattern, which is a map with its type and these keys, or its type alone.
Section keys_of(const Item& pattern, std::initializer_list<std::string_view> known) {
  return pattern.node.IsMap() ? Section(pattern, known) : Section();
}

// Reads filaments, whose life is counted in orbits of their own place.
PatternKind read_turbulence(const Item& item) {
  const Section s = keys_of(item, {"type", "contrast", "orbits", "seed"});
  TurbulencePattern pattern;
  pattern.contrast = s.number("contrast", kContrast, pattern.contrast);
  pattern.orbits = s.number("orbits", Range{"orbits"}.within(0.5, 20), pattern.orbits);
  if (const Item* seed = s.find("seed"))
    pattern.seed = static_cast<std::uint32_t>(
        read_whole_number(*seed, kPureNumber.within(0, kLargestSeed)).value_or(1));
  return pattern;
}

// Reads rings that drift inwards, as fast as half the speed of light at most.
PatternKind read_rings(const Item& item) {
  const Section s = keys_of(item, {"type", "spacing_r", "contrast", "inward_speed"});
  RingPattern pattern;
  pattern.spacing = s.number("spacing_r", kUnitsOfM.within(0.01, 1000), pattern.spacing);
  pattern.contrast = s.number("contrast", kContrast, pattern.contrast);
  pattern.inward_speed = s.number(
      "inward_speed", Range{"parts of the speed of light"}.within(0, 0.5), pattern.inward_speed);
  return pattern;
}

// Reads a spot, which keeps to a circular orbit and so to the last stable one and those outside.
PatternKind read_spot(const Item& item) {
  const Section s = keys_of(item, {"type", "r", "azimuth_deg", "size_r", "brightness"});
  SpotPattern pattern;
  pattern.r = s.number("r", kUnitsOfM.within(kLastStableOrbit, kWidestDisc), pattern.r);
  pattern.azimuth = radians(s.number("azimuth_deg", kDegrees.within(-360, 360), 0));
  pattern.size = s.number("size_r", kUnitsOfM.within(0.01, 10), pattern.size);
  pattern.brightness =
      s.number("brightness", Range{"times the gas beside it"}.within(1, 1e4), pattern.brightness);
  return pattern;
}

// Reads the pattern of a disc, by the reader that its type has.
std::optional<PatternKind> read_pattern(const Item& item) {
  using Reader = PatternKind (*)(const Item&);
  // The word none has no reader, and so leaves the disc without a pattern.
  constexpr Words<Reader, 4> kPatterns{{{"turbulence", read_turbulence},
                                        {"rings", read_rings},
                                        {"spot", read_spot},
                                        {"none", nullptr}}};
  const auto type = item.node.IsMap() ? peek(item, "type") : std::optional(item);
  if (!type) {
    item.fail("needs a type: turbulence, rings or spot");
    return std::nullopt;
  }
  const auto chosen = read_choice(*type, names_of(kPatterns));
  const Reader read = chosen ? kPatterns[*chosen].second : nullptr;
  return read ? std::optional(read(item)) : std::nullopt;
}

}  // namespace

std::optional<Disc> read_disc(const Section& show, const Show& to) {
  const Item* item = show.find("disc");
  if (item == nullptr) return std::nullopt;
  const Section s(*item, {"inner_r", "outer_r", "inclination_deg", "node_deg", "t_max_k",
                          "luminance_cd_m2", "opacity", "plunging", "pattern", "slow_light"});
  if (!to.mass_solar) item->fail("needs a black hole: give the show black_hole.mass_solar");
  Disc disc;
  // Whether gas plunges in is read first, since it decides where a disc may end inside.
  disc.plunging = read_switch_of(s, "plunging", disc.plunging);
  read_radii(s, disc);
  read_disc_plane(s, to, disc);
  disc.t_max_k =
      s.number("t_max_k", Range{"kelvin"}.within(kCoolestDiscK, kHottestDiscK), disc.t_max_k);
  disc.luminance =
      s.number("luminance_cd_m2", Range{"cd/m^2"}.above(0).at_most(kBrightestDisc), disc.luminance);
  disc.opacity = s.number("opacity", kPureNumber.within(0, 1), disc.opacity);
  if (const Item* pattern = s.find("pattern")) disc.pattern = read_pattern(*pattern);
  disc.slow_light = read_switch_of(s, "slow_light", disc.slow_light);
  return disc;
}

}  // namespace domefall
