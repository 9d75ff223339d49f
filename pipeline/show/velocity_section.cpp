#include "pipeline/show/velocity_section.h"

#include <array>
#include <cmath>

#include "pipeline/show/placement.h"

namespace domefall {
namespace {

// Beyond it a speed in double precision no longer holds the factor to 1e-7.
constexpr double kMostLorentzFactor = 1e4;

std::optional<double> read_speed(const Section& s) {
  s.one_of({"speed", "lorentz_factor"});
  if (s.find("lorentz_factor")) {
    const auto factor = s.number("lorentz_factor", kPureNumber.within(1, kMostLorentzFactor));
    if (!factor) return std::nullopt;
    return std::sqrt((*factor - 1) * (*factor + 1)) / *factor;
  }
  return s.required_number("speed", Range{"speed of light = 1"}.at_least(0).below(1));
}

std::optional<V3d> read_components(const Item& item) {
  const Section s(item, {"radial", "theta", "phi"});
  const Range range = kPureNumber.within(-1e9, 1e9);
  const V3d v(s.number("radial", range, 0), s.number("theta", range, 0), s.number("phi", range, 0));
  const double size = std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)});
  if (size > 0) return (v / size).normalized();
  item.fail("must not be the zero vector; give radial, theta or phi");
  return std::nullopt;
}

bool names_sky_place(const Item& item) {
  return peek(item, "ra_deg") || peek(item, "dec_deg") || peek(item, "star");
}

std::optional<V3d> read_direction(const Item& item, const Stage& stage, Lookup& lookup) {
  static constexpr std::array<std::string_view, 4> kWords{"inward", "outward", "forward",
                                                          "backward"};
  static const std::array<V3d, 4> kDirections{V3d(-1, 0, 0), V3d(1, 0, 0), V3d(0, 0, 1),
                                              V3d(0, 0, -1)};
  for (std::size_t k = 0; k < kWords.size(); ++k)
    if (item.node.IsScalar() && item.node.Scalar() == kWords[k]) return kDirections[k];
  if (item.node.IsMap() && !names_sky_place(item)) return read_components(item);
  if (!stage.mass_solar) {
    const auto place = read_sky_place(item, lookup, kWords);
    if (!place) return std::nullopt;
    return apply_transposed(place_tetrad(stage.hole_at, stage.heading, 0), place->v);
  }
  if (names_sky_place(item)) {
    item.fail(
        "is a place on the sky, which near a black hole is no direction of motion; "
        "give {radial, theta, phi} or a word");
    return std::nullopt;
  }
  if (!item.node.IsScalar()) {
    Section(item, {"radial", "theta", "phi"});
    return std::nullopt;
  }
  read_choice(item, kWords);
  return std::nullopt;
}

}  // namespace

std::optional<V3d> read_celerity(const Section& s, const Stage& stage, const V3d& frame,
                                 Lookup& lookup) {
  const auto speed = read_speed(s);
  if (speed && *speed == 0 && !s.find("direction")) return frame;
  const Item* item =
      s.require("direction", ": inward, outward, forward, backward or {radial, theta, phi}");
  const auto direction = item ? read_direction(*item, stage, lookup) : std::nullopt;
  if (!speed || !direction) return std::nullopt;
  return celerity_against(frame, *speed, *direction);
}

}  // namespace domefall
