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

const float* SkyMap::Level::face(int k) const {
  const auto side = static_cast<std::size_t>(size + 2);
  return texels.data() + static_cast<std::size_t>(k) * side * side * 3;
}

float* SkyMap::Level::face(int k) {
  const auto side = static_cast<std::size_t>(size + 2);
  return texels.data() + static_cast<std::size_t>(k) * side * side * 3;
}

SkyMap::SkyMap(const FloatImage& equirectangular) {
  const auto make_level = [](int size) {
    const auto side = static_cast<std::size_t>(size + 2);
    return Level{size, std::vector<float>(6 * side * side * 3)};
  };
  const int size = face_size(equirectangular);
  const ColourMatrix& m = working_from_rec709();
  levels_.push_back(make_level(size));
  for (int face = 0; face < 6; ++face) {
    float* texel = levels_[0].face(face);
    for (int j = -1; j <= size; ++j)
      for (int i = -1; i <= size; ++i, texel += 3) {
        const FacePoint at{face, (2 * i + 1.0) / size - 1, (2 * j + 1.0) / size - 1};
        const auto c = equirectangular_at(equirectangular, direction_of(at));
        for (int k = 0; k < 3; ++k)
          texel[k] = static_cast<float>(kPanoramaUnit *
                                        (m[k][0] * c[0] + m[k][1] * c[1] + m[k][2] * c[2]));
      }
  }
  for (int half = size / 2; half >= 1; half /= 2) {
    levels_.push_back(make_level(half));
    const Level& fine = levels_[levels_.size() - 2];
    Level& coarse = levels_.back();
    const std::size_t fine_row = static_cast<std::size_t>(fine.size + 2) * 3;
    for (int face = 0; face < 6; ++face)
      for (int j = 0; j < half; ++j)
        for (int i = 0; i < half; ++i) {
          const float* a =
              fine.face(face) + static_cast<std::size_t>(2 * j + 1) * fine_row + (2 * i + 1) * 3;
          float* out =
              coarse.face(face) + (static_cast<std::size_t>(j + 1) * (half + 2) + i + 1) * 3;
          for (int k = 0; k < 3; ++k)
            out[k] = (a[k] + a[k + 3] + a[fine_row + k] + a[fine_row + k + 3]) / 4;
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
        const float* from =
            level.face(at.face) + (static_cast<std::size_t>(y + 1) * (n + 2) + x + 1) * 3;
        std::copy_n(from, 3,
                    level.face(face) + (static_cast<std::size_t>(j + 1) * (n + 2) + i + 1) * 3);
      }
}

std::array<float, 3> SkyMap::bilinear(const Level& level, int face, double u, double v) const {
  const int n = level.size;
  const double x = (u + 1) / 2 * n + 0.5, y = (v + 1) / 2 * n + 0.5;  // texel 0 is the border
  const int i = std::min(static_cast<int>(x), n), j = std::min(static_cast<int>(y), n);
  const auto fx = static_cast<float>(x - i), fy = static_cast<float>(y - j);
  const float* a = level.face(face) + (static_cast<std::size_t>(j) * (n + 2) + i) * 3;
  const float* b = a + static_cast<std::size_t>(n + 2) * 3;
  std::array<float, 3> out;
  for (int k = 0; k < 3; ++k) {
    const float top = a[k] + fx * (a[k + 3] - a[k]), bottom = b[k] + fx * (b[k + 3] - b[k]);
    out[k] = top + fy * (bottom - top);
  }
  return out;
}

WorkingRgb SkyMap::sample(const V3d& direction, double footprint) const {
  const FacePoint at = face_of(direction);
  const double texels = footprint * levels_[0].size / (pi / 2);
  if (texels <= 1) {
    const auto c = bilinear(levels_[0], at.face, at.u, at.v);
    return {c[0], c[1], c[2]};
  }
  const double level = std::min(std::log2(texels), static_cast<double>(levels_.size() - 1));
  const auto fine = static_cast<std::size_t>(level);
  const std::size_t coarse = std::min(fine + 1, levels_.size() - 1);
  const auto w = static_cast<float>(level - static_cast<double>(fine));
  const auto a = bilinear(levels_[fine], at.face, at.u, at.v);
  const auto b = bilinear(levels_[coarse], at.face, at.u, at.v);
  return {a[0] + w * (b[0] - a[0]), a[1] + w * (b[1] - a[1]), a[2] + w * (b[2] - a[2])};
}

std::size_t SkyMap::bytes() const {
  std::size_t sum = 0;
  for (const Level& level : levels_) sum += level.texels.size() * sizeof(float);
  return sum;
}

}  // namespace domefall
