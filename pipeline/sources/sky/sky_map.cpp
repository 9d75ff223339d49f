#include "pipeline/sources/sky/sky_map.h"

#include <Imath/half.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "pipeline/sources/colour/blackbody.h"
#include "pipeline/sources/sky/cube_face.h"

namespace domefall {

std::uint16_t half_bits(float value) {
  constexpr std::uint16_t kSmallestNormal = 0x0400;  // 2^-14
  // Halves of one sign are ordered as their bits are, so that one comparison finds those that are
  // subnormal.
  const std::uint16_t bits = Imath::half(value).bits();
  return bits < kSmallestNormal ? 0 : bits;
}

float half_value(std::uint16_t bits) {
  Imath::half h;
  h.setBits(bits);
  return h;
}

using std::numbers::pi;

SkyMap::SkyMap(SkyMapKind kind, double unit, std::vector<SkyLevel> levels,
               std::shared_ptr<const void> owner)
    : kind_(kind), unit_(unit), levels_(std::move(levels)), owner_(std::move(owner)) {}

SkyMap SkyMap::without_levels_above(int size) const {
  // The last level is not asked, so that it is kept whatever its size.
  auto first = std::find_if(levels_.begin(), levels_.end() - 1,
                            [size](const SkyLevel& level) { return level.size <= size; });
  return {kind_, unit_, {first, levels_.end()}, owner_};
}

// Returns the channels at a point of a face, from the four texels around it.  Texels are counted
// with the border, whose first has its centre at x = 0, that is at u = -1 - 1/n.
SkyMap::Value SkyMap::bilinear(const SkyLevel& level, int face, double u, double v) {
  const int n = level.size;
  const double x = (u + 1) / 2 * n + 0.5, y = (v + 1) / 2 * n + 0.5;  // counted from the border on
  // x and y go from 0.5 to n + 0.5, so that texels i and i + 1 are among the n + 2 of a row.
  const int i = std::min(static_cast<int>(x), n), j = std::min(static_cast<int>(y), n);
  const auto fx = static_cast<float>(x - i), fy = static_cast<float>(y - j);
  const SkyTexel* a = level.face(face) + static_cast<std::size_t>(j) * (n + 2) + i;
  const SkyTexel* b = a + (n + 2);
  const auto between = [fx](const SkyTexel* row, int k) {
    const float left = half_value(row[0].channel[k]), right = half_value(row[1].channel[k]);
    return left + fx * (right - left);
  };
  Value out;
  for (int k = 0; k < 4; ++k) {
    const float top = between(a, k), bottom = between(b, k);
    out.channel[k] = top + fy * (bottom - top);
  }
  return out;
}

SkyMap::Value SkyMap::filtered(const V3d& direction, double footprint) const {
  const FacePoint at = face_of(direction);
  // A face spans a quarter of a turn.  A level of half the size has texels of twice the width, so
  // the footprint's log2 in texels of the finest level says which two levels to mix.
  const double texels = footprint * levels_[0].size / (pi / 2);
  if (texels <= 1) return bilinear(levels_[0], at.face, at.u, at.v);
  // The weight is linear between powers of two, because log2 would need a function of the library.
  const auto octave = static_cast<std::size_t>(std::ilogb(texels));
  // A footprint that exceeds the texel of the coarsest level gets that level.
  const std::size_t last = levels_.size() - 1;
  const std::size_t fine = std::min(octave, last), coarse = std::min(octave + 1, last);
  const auto w = static_cast<float>(std::ldexp(texels, -static_cast<int>(octave)) - 1);
  const Value a = bilinear(levels_[fine], at.face, at.u, at.v);
  const Value b = bilinear(levels_[coarse], at.face, at.u, at.v);
  Value out;
  // Mixing two levels in this way is trilinear filtering (Williams 1983).
  for (int k = 0; k < 4; ++k) out.channel[k] = a.channel[k] + w * (b.channel[k] - a.channel[k]);
  return out;
}

ThermalLight SkyMap::thermal(const Value& value) const {
  if (!(value.channel[0] > 0)) return {0, kThermalBase};
  // T is kThermalBase times 2^theta (SkyMapKind::kThermal).
  return {unit_ * value.channel[0], kThermalBase * std::exp2(value.channel[1] / value.channel[0])};
}

ThermalLight SkyMap::sample_thermal(const V3d& direction, double footprint) const {
  return thermal(filtered(direction, footprint));
}

WorkingRgb SkyMap::sample(const V3d& direction, double footprint) const {
  const Value value = filtered(direction, footprint);
  if (kind_ == SkyMapKind::kThermal) {
    const ThermalLight light = thermal(value);
    // The colour is light per unit of bolometric flux, which the radiance multiplies.
    const WorkingRgb c = blackbody_colours().per_flux(light.temperature);
    const auto f = static_cast<float>(light.radiance);
    return {c.r * f, c.g * f, c.b * f};
  }
  const auto f = static_cast<float>(unit_);
  return {value.channel[0] * f, value.channel[1] * f, value.channel[2] * f};
}

std::size_t SkyMap::bytes() const {
  std::size_t sum = 0;
  for (const SkyLevel& level : levels_)
    sum += 6 * SkyLevel::face_texels(level.size) * sizeof(SkyTexel);
  return sum;
}

}  // namespace domefall
