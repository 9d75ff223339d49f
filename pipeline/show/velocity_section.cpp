#include "pipeline/show/velocity_section.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "pipeline/optics/aberration.h"
#include "pipeline/optics/hole_optics.h"
#include "pipeline/show/placement.h"

namespace domefall {
namespace {

constexpr double kMostLorentzFactor = 1e9;

// gamma v: a speed in double precision would not hold a Lorentz factor of 1e9.
std::optional<double> read_gamma_v(const Section& s) {
  s.one_of({"speed", "lorentz_factor"});
  if (s.find("lorentz_factor")) {
    const auto factor = s.number("lorentz_factor", kPureNumber.within(1, kMostLorentzFactor));
    return factor ? std::optional(std::sqrt((*factor - 1) * (*factor + 1))) : std::nullopt;
  }
  const auto v = s.required_number("speed", Range{"speed of light = 1"}.at_least(0).below(1));
  return v ? std::optional(*v / std::sqrt((1 - *v) * (1 + *v))) : std::nullopt;
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

// Where an observer of celerity `frame` at radius r sees a place on the sky.
V3d seen_towards(const SkyDirection& place, const Stage& stage, double r, const V3d& frame) {
  const M33d tetrad = place_tetrad(stage.hole_at, stage.heading, stage.azimuth);
  return to_observer(frame, primary_image(r, apply_transposed(tetrad, place.v)).v).direction;
}

std::optional<V3d> read_direction(const Item& item, const Stage& stage, double r, const V3d& frame,
                                  Lookup& lookup) {
  static constexpr std::array<std::string_view, 6> kWords{"inward",   "outward", "forward",
                                                          "backward", "north",   "south"};
  static const std::array<V3d, 6> kDirections{V3d(-1, 0, 0), V3d(1, 0, 0),  V3d(0, 0, 1),
                                              V3d(0, 0, -1), V3d(0, -1, 0), V3d(0, 1, 0)};
  for (std::size_t k = 0; k < kWords.size(); ++k)
    if (item.node.IsScalar() && item.node.Scalar() == kWords[k]) return kDirections[k];
  if (item.node.IsMap() && !names_sky_place(item)) return read_components(item);
  const auto place = read_sky_place(item, lookup, kWords);
  return place ? std::optional(seen_towards(*place, stage, r, frame)) : std::nullopt;
}

}  // namespace

std::optional<V3d> read_celerity(const Section& s, const Stage& stage, double r, const V3d& frame,
                                 Lookup& lookup) {
  const auto gamma_v = read_gamma_v(s);
  if (gamma_v && *gamma_v == 0 && !s.find("direction")) return frame;
  const Item* item =
      s.require("direction",
                ": a word such as inward or forward, {radial, theta, phi} or a place on the sky");
  const auto direction = item ? read_direction(*item, stage, r, frame, lookup) : std::nullopt;
  if (!gamma_v || !direction) return std::nullopt;
  return celerity_against(frame, *direction * *gamma_v);
}

}  // namespace domefall
