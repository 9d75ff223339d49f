#include "pipeline/sky/sky_map.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace domefall {
namespace {

using std::numbers::pi;

struct FacePoint {
  int face;     // 2 * axis, + 1 on the negative side
  double u, v;  // in [-1, 1], along the next two axes
};

FacePoint face_of(const V3d& d) {
  const double x = std::abs(d.x), y = std::abs(d.y), z = std::abs(d.z);
  if (x >= y && x >= z) return {d.x < 0 ? 1 : 0, d.y / x, d.z / x};
  if (y >= z) return {d.y < 0 ? 3 : 2, d.z / y, d.x / y};
  return {d.z < 0 ? 5 : 4, d.x / z, d.y / z};
}

// The inverse, also beyond the face's edges.
V3d direction_of(const FacePoint& p) {
  const int axis = p.face / 2;
  V3d d;
  d[axis] = p.face % 2 ? -1 : 1;
  d[(axis + 1) % 3] = p.u;
  d[(axis + 2) % 3] = p.v;
  return d;
}

// Catmull-Rom weights at t in [0, 1) between the second and the third of four samples.
std::array<double, 4> catmull_rom(double t) {
  const double t2 = t * t, t3 = t2 * t;
  return {(-t3 + 2 * t2 - t) / 2, (3 * t3 - 5 * t2 + 2) / 2, (-3 * t3 + 4 * t2 + t) / 2,
          (t3 - t2) / 2};
}

// Cubic look into the equirectangular image; a row beyond a pole is the one across it.
std::array<double, 3> equirectangular_at(const FloatImage& image, const V3d& d) {
  const int w = image.width, h = image.height;
  const double x = (0.5 - std::atan2(d.y, d.x) / (2 * pi)) * w - 0.5;
  const double y = (0.5 - std::atan2(d.z, std::hypot(d.x, d.y)) / pi) * h - 0.5;
  const double x0 = std::floor(x), y0 = std::floor(y);
  const auto wx = catmull_rom(x - x0), wy = catmull_rom(y - y0);
  std::array<double, 3> sum{};
  for (int j = 0; j < 4; ++j) {
    int row = static_cast<int>(y0) - 1 + j, turn = 0;
    if (row < 0) row = -1 - row, turn = w / 2;
    if (row >= h) row = 2 * h - 1 - row, turn = w / 2;
    const float* line = image.row(row);
    for (int i = 0; i < 4; ++i) {
      const int column = (static_cast<int>(x0) - 1 + i + turn + 2 * w) % w;
      const float* texel = line + 3 * column;
      for (int c = 0; c < 3; ++c) sum[c] += wx[i] * wy[j] * texel[c];
    }
  }
  for (double& c : sum) c = std::max(c, 0.0);  // a cubic undershoots beside a bright spot
  return sum;
}

// Half as fine as the panorama's own pixels, so that bilinear looks between texels stay smooth.
int face_size(const FloatImage& image) {
  int size = 4;
  while (size < image.width / 2) size *= 2;
  return std::min(size, 4096);
}

}  // namespace

const SkyMap::Texel* SkyMap::Level::face(int k) const {
  const auto side = static_cast<std::size_t>(size + 2);
  return texels.data() + static_cast<std::size_t>(k) * side * side;
}

SkyMap::Texel* SkyMap::Level::face(int k) {
  const auto side = static_cast<std::size_t>(size + 2);
  return texels.data() + static_cast<std::size_t>(k) * side * side;
}

SkyMap::SkyMap(const FloatImage& equirectangular) {
  const auto make_level = [](int size) {
    const auto side = static_cast<std::size_t>(size + 2);
    return Level{size, std::vector<Texel>(6 * side * side)};
  };
  const int size = face_size(equirectangular);
  const ColourMatrix& m = working_from_rec709();
  levels_.push_back(make_level(size));
  for (int face = 0; face < 6; ++face) {
    Texel* texel = levels_[0].face(face);
    for (int j = -1; j <= size; ++j)
      for (int i = -1; i <= size; ++i, ++texel) {
        const FacePoint at{face, (2 * i + 1.0) / size - 1, (2 * j + 1.0) / size - 1};
        const auto c = equirectangular_at(equirectangular, direction_of(at));
        for (int k = 0; k < 3; ++k)
          texel->rgb0[k] = static_cast<float>(kPanoramaUnit *
                                              (m[k][0] * c[0] + m[k][1] * c[1] + m[k][2] * c[2]));
      }
  }
  for (int half = size / 2; half >= 1; half /= 2) {
    levels_.push_back(make_level(half));
    const Level& fine = levels_[levels_.size() - 2];
    Level& coarse = levels_.back();
    const auto fine_row = static_cast<std::size_t>(fine.size + 2);
    for (int face = 0; face < 6; ++face)
      for (int j = 0; j < half; ++j)
        for (int i = 0; i < half; ++i) {
          const Texel* a =
              fine.face(face) + static_cast<std::size_t>(2 * j + 1) * fine_row + 2 * i + 1;
          Texel& out = coarse.face(face)[static_cast<std::size_t>(j + 1) * (half + 2) + i + 1];
          for (int k = 0; k < 4; ++k)
            out.rgb0[k] =
                (a[0].rgb0[k] + a[1].rgb0[k] + a[fine_row].rgb0[k] + a[fine_row + 1].rgb0[k]) / 4;
        }
    fill_border(coarse);
  }
}

// Each border texel looks across the edge, at the face that owns its direction.
void SkyMap::fill_border(Level& level) const {
  const int n = level.size;
  for (int face = 0; face < 6; ++face)
    for (int j = -1; j <= n; ++j)
      for (int i = -1; i <= n; ++i) {
        if (i >= 0 && i < n && j >= 0 && j < n) continue;
        const FacePoint at =
            face_of(direction_of({face, (2 * i + 1.0) / n - 1, (2 * j + 1.0) / n - 1}));
        const int x = std::clamp(static_cast<int>((at.u + 1) / 2 * n), 0, n - 1);
        const int y = std::clamp(static_cast<int>((at.v + 1) / 2 * n), 0, n - 1);
        level.face(face)[static_cast<std::size_t>(j + 1) * (n + 2) + i + 1] =
            level.face(at.face)[static_cast<std::size_t>(y + 1) * (n + 2) + x + 1];
      }
}

SkyMap::Texel SkyMap::bilinear(const Level& level, int face, double u, double v) {
  const int n = level.size;
  const double x = (u + 1) / 2 * n + 0.5, y = (v + 1) / 2 * n + 0.5;  // texel 0 is the border
  const int i = std::min(static_cast<int>(x), n), j = std::min(static_cast<int>(y), n);
  const auto fx = static_cast<float>(x - i), fy = static_cast<float>(y - j);
  const Texel* a = level.face(face) + static_cast<std::size_t>(j) * (n + 2) + i;
  const Texel* b = a + (n + 2);
  Texel out;
  for (int k = 0; k < 4; ++k) {
    const float top = a[0].rgb0[k] + fx * (a[1].rgb0[k] - a[0].rgb0[k]);
    const float bottom = b[0].rgb0[k] + fx * (b[1].rgb0[k] - b[0].rgb0[k]);
    out.rgb0[k] = top + fy * (bottom - top);
  }
  return out;
}

WorkingRgb SkyMap::sample(const V3d& direction, double footprint) const {
  const FacePoint at = face_of(direction);
  const double texels = footprint * levels_[0].size / (pi / 2);
  if (texels <= 1) {
    const Texel c = bilinear(levels_[0], at.face, at.u, at.v);
    return {c.rgb0[0], c.rgb0[1], c.rgb0[2]};
  }
  // The logarithm, straight between powers of two: as good a passage between levels.
  const auto octave = static_cast<std::size_t>(std::ilogb(texels));
  const std::size_t last = levels_.size() - 1;
  const std::size_t fine = std::min(octave, last), coarse = std::min(octave + 1, last);
  const auto w = static_cast<float>(std::ldexp(texels, -static_cast<int>(octave)) - 1);
  const Texel a = bilinear(levels_[fine], at.face, at.u, at.v);
  const Texel b = bilinear(levels_[coarse], at.face, at.u, at.v);
  Texel out;
  for (int k = 0; k < 4; ++k) out.rgb0[k] = a.rgb0[k] + w * (b.rgb0[k] - a.rgb0[k]);
  return {out.rgb0[0], out.rgb0[1], out.rgb0[2]};
}

std::size_t SkyMap::bytes() const {
  std::size_t sum = 0;
  for (const Level& level : levels_) sum += level.texels.size() * sizeof(Texel);
  return sum;
}

}  // namespace domefall
