#include "pipeline/sky/sky_pyramid.h"

#include <Imath/half.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "pipeline/sky/cube_face.h"
#include "pipeline/sky/large_pages.h"

namespace domefall {
namespace {

constexpr std::uint16_t kSmallestNormal = 0x0400;  // 2^-14
constexpr int kGreatestExponent = 14;

// Of four texels that become one.
SkyTexel mean(const SkyTexel& a, const SkyTexel& b, const SkyTexel& c, const SkyTexel& d) {
  SkyTexel out{};
  for (int k = 0; k < 4; ++k)
    out.channel[k] = half_bits((half_value(a.channel[k]) + half_value(b.channel[k]) +
                                half_value(c.channel[k]) + half_value(d.channel[k])) /
                               4);
  return out;
}

void halve(const SkyPyramid::Level& fine, const SkyPyramid::Level& coarse) {
  for (int face = 0; face < 6; ++face)
    for (int j = 0; j < coarse.size; ++j) {
      const SkyTexel* a = &fine.at(face, 0, 2 * j);
      const SkyTexel* b = &fine.at(face, 0, 2 * j + 1);
      SkyTexel* out = &coarse.at(face, 0, j);
      for (int i = 0; i < coarse.size; ++i, a += 2, b += 2) out[i] = mean(a[0], a[1], b[0], b[1]);
    }
  fill_border(coarse);
}

}  // namespace

std::uint16_t half_bits(float value) {
  const std::uint16_t bits = Imath::half(value).bits();
  return bits < kSmallestNormal ? 0 : bits;
}

float half_value(std::uint16_t bits) {
  Imath::half h;
  h.setBits(bits);
  return h;
}

double sky_unit(double greatest) {
  if (!(greatest > 0)) return 1;
  return std::ldexp(1.0, std::ilogb(greatest) + 1 - kGreatestExponent);
}

std::vector<int> level_sizes(int size) {
  std::vector<int> sizes;
  for (; size >= 1; size /= 2) sizes.push_back(size);
  return sizes;
}

SkyTexel& SkyPyramid::Level::at(int k, int i, int j) const {
  return face(k)[static_cast<std::size_t>(j + 1) * static_cast<std::size_t>(size + 2) +
                 static_cast<std::size_t>(i + 1)];
}

SkyPyramid::SkyPyramid(SkyMapKind of_kind, double in_unit, int size)
    : kind(of_kind), unit(in_unit) {
  const std::vector<int> sizes = level_sizes(size);
  std::size_t total = 0;
  for (const int n : sizes) total += 6 * SkyLevel::face_texels(n);
  owner = large_pages(total * sizeof(SkyTexel));
  auto* next = static_cast<SkyTexel*>(owner.get());
  for (const int n : sizes) {
    levels.push_back({n, next});
    next += 6 * SkyLevel::face_texels(n);
  }
}

SkyPyramid::SkyPyramid(SkyMapKind of_kind, double in_unit, std::vector<Level> in,
                       std::shared_ptr<void> of_owner)
    : kind(of_kind), unit(in_unit), levels(std::move(in)), owner(std::move(of_owner)) {}

void SkyPyramid::finish() const {
  for (std::size_t k = 1; k < levels.size(); ++k) halve(levels[k - 1], levels[k]);
}

SkyMap SkyPyramid::map() const {
  std::vector<SkyLevel> read;
  read.reserve(levels.size());
  for (const Level& level : levels) read.push_back({level.size, level.texels});
  return {kind, unit, std::move(read), owner};
}

void fill_border(const SkyPyramid::Level& level) {
  const int n = level.size;
  const auto look_across = [&level, n](int face, int i, int j) {
    const FacePoint at = face_of(direction_of(texel_centre(face, i, j, n)));
    const int x = std::clamp(static_cast<int>((at.u + 1) / 2 * n), 0, n - 1);
    const int y = std::clamp(static_cast<int>((at.v + 1) / 2 * n), 0, n - 1);
    level.at(face, i, j) = level.at(at.face, x, y);
  };
  for (int face = 0; face < 6; ++face)
    for (int k = -1; k <= n; ++k) {
      look_across(face, k, -1);
      look_across(face, k, n);
      look_across(face, -1, k);
      look_across(face, n, k);
    }
}

void paint(const SkyPyramid::Level& level, const SkyPainter& painter) {
  const int n = level.size;
  for (int face = 0; face < 6; ++face)
    for (int j = -1; j <= n; ++j)
      for (int i = -1; i <= n; ++i) {
        float channel[4] = {0, 0, 0, 0};
        painter(direction_of(texel_centre(face, i, j, n)), channel);
        SkyTexel& texel = level.at(face, i, j);
        for (int k = 0; k < 4; ++k) texel.channel[k] = half_bits(channel[k]);
      }
}

}  // namespace domefall
