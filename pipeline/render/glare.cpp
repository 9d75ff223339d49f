#include "pipeline/render/glare.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <span>
#include <vector>

#include "pipeline/base/simd/half_row.h"
#include "pipeline/render/sphere_blur.h"

namespace domefall {
namespace {

using Rgb = SphereBlur::Rgb;

// The narrowest Gaussian, in pixels.  What is left of it when a pixel's light has been spread to its
// corners has a sigma of 0.69 pixels, and a sum over pixels that is right to 2 exp(-2 pi^2 0.69^2) =
// 2e-4, by Poisson's sum formula.
constexpr double kLeastPixels = 0.85;

// A GlarePart is an image without a seam in a frame, the whole one or a face of a cubemap.
struct GlarePart {
  CubemapFace face;
  int width, height;

  explicit GlarePart(const CubemapFace& of)
      : face(of), width(columns(of.projection)), height(rows(of.projection)) {}
  CameraDirection direction(double column, double row) const {
    const V3d n = direction_at(face.projection, {column, row}).v;
    return {n.x * face.axes[0] + n.y * face.axes[1] + n.z * face.axes[2]};
  }
};

std::vector<GlarePart> parts_of(const Projection& projection) {
  std::vector<GlarePart> parts;
  for (const CubemapFace& face : cubemap_faces(projection)) parts.emplace_back(face);
  if (parts.empty())
    parts.emplace_back(CubemapFace{0, 0, projection, {V3d(1, 0, 0), V3d(0, 1, 0), V3d(0, 0, 1)}});
  return parts;
}

// Adds the light of blocks of so many pixels on a side.
template <class T>
void gather(const GlarePart& part, int step, const ImageRgb<T>& picture, SphereBlur& sphere) {
  struct Block {
    SphereBlur::Place place;
    Rgb light;
  };
  const int across = (part.width + step - 1) / step, down = (part.height + step - 1) / step;
  std::vector<Block> blocks(static_cast<std::size_t>(across) * static_cast<std::size_t>(down));
  tbb::parallel_for(0, down, [&](int y) {
    for (int x = 0; x < across; ++x) {
      const int left = x * step, right = std::min(part.width, left + step), top = y * step,
                bottom = std::min(part.height, top + step);
      Rgb sum{};
      for (int row = top; row < bottom; ++row) {
        const T* pixel = picture.row(part.face.row + row) + 3 * (part.face.column + left);
        for (int k = 0; k < 3 * (right - left); ++k)
          sum[static_cast<std::size_t>(k % 3)] += static_cast<float>(pixel[k]);
      }
      Block& block = blocks[static_cast<std::size_t>(y) * static_cast<std::size_t>(across) +
                            static_cast<std::size_t>(x)];
      block.light = {};
      if (sum == Rgb{}) continue;
      const PixelPosition middle{(left + right + 1) / 2.0, (top + bottom + 1) / 2.0};
      const auto area = static_cast<float>(pixel_solid_angle(part.face.projection, middle));
      block.place = sphere.place(part.direction(middle.i, middle.j));
      for (std::size_t c = 0; c < 3; ++c) block.light[c] = area * sum[c];
    }
  });
  for (const Block& block : blocks)
    if (block.light != Rgb{}) sphere.add(block.place, block.light);
}

// A GlareGrid is the scattered light at the corners of those blocks.
class GlareGrid {
 public:
  GlareGrid(const GlarePart& part, int step, const SphereBlur& sphere)
      : step_(step), across_((part.width + step - 1) / step + 1) {
    const int down = (part.height + step - 1) / step + 1;
    corners_.resize(static_cast<std::size_t>(across_) * static_cast<std::size_t>(down));
    tbb::parallel_for(0, down, [&](int y) {
      for (int x = 0; x < across_; ++x) {
        Rgb& corner = corners_[index(x, y)];
        corner = sphere.at(sphere.place(part.direction(x * step + 0.5, y * step + 0.5)));
        // Far from a place that is brighter by far the series may swing below 0 a little.
        for (float& light : corner) light = std::max(light, 0.0f);
      }
    });
  }

  // Sets the light of the pixels of a row, `factor` times that which is scattered.
  void fill_row(int row, float factor, std::span<float> light) const {
    const int y = row / step_;
    const float below = (static_cast<float>(row - y * step_) + 0.5f) / static_cast<float>(step_);
    const auto corner = [&](int x, std::size_t c) {
      return factor *
             ((1 - below) * corners_[index(x, y)][c] + below * corners_[index(x, y + 1)][c]);
    };
    auto out = light.begin();
    for (int x = 0; out != light.end(); ++x) {
      const Rgb left{corner(x, 0), corner(x, 1), corner(x, 2)},
          right{corner(x + 1, 0), corner(x + 1, 1), corner(x + 1, 2)};
      for (int k = 0; k < step_ && out != light.end(); ++k) {
        const float part = (static_cast<float>(k) + 0.5f) / static_cast<float>(step_);
        for (std::size_t c = 0; c < 3; ++c) *out++ = left[c] + part * (right[c] - left[c]);
      }
    }
  }

 private:
  std::size_t index(int x, int y) const {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(across_) +
           static_cast<std::size_t>(x);
  }

  int step_, across_;
  std::vector<Rgb> corners_;
};

// Stores values, those beyond the largest half as that one.
void store(std::span<const float> values, Imath::half* out) {
  static_assert(sizeof(Imath::half) == sizeof(std::uint16_t));
  to_half(values.data(), static_cast<int>(values.size()), reinterpret_cast<std::uint16_t*>(out));
}
void store(std::span<const float> values, float* out) { std::ranges::copy(values, out); }

template <class T>
void scatter(const GlarePart& part, float share, const GlareGrid& grid, LayeredFrame<T>& frame) {
  LayerImage<T>* const layer = frame.find(Layer::kGlare);
  const auto planes = frame.lights();
  tbb::parallel_for(0, part.height, [&](int row) {
    const ColumnRange inside = inside_columns(part.face.projection, row);
    if (inside.last < inside.first) return;
    std::vector<float> light(3 * static_cast<std::size_t>(part.width)), values(light.size());
    grid.fill_row(row, share, light);
    const auto first = 3 * static_cast<std::size_t>(inside.first),
               count = 3 * static_cast<std::size_t>(inside.last - inside.first + 1);
    const std::size_t at = first + 3 * (static_cast<std::size_t>(part.face.row + row) *
                                            static_cast<std::size_t>(frame.picture.width) +
                                        static_cast<std::size_t>(part.face.column));
    for (std::vector<T>* plane : planes) {
      if (plane->empty()) continue;
      const bool gains = plane == &frame.picture.pixels || (layer && plane == &layer->light.pixels);
      for (std::size_t k = 0; k < count; ++k)
        values[k] =
            (1 - share) * static_cast<float>((*plane)[at + k]) + (gains ? light[first + k] : 0.0f);
      store({values.data(), count}, plane->data() + at);
    }
  });
}

// Returns k_l of the law, less what the blocks and the grid spread by themselves.  No Gaussian is
// narrower than `least`.
std::vector<double> kernel_of(double sigma, double least, double own_variance, int orders) {
  std::vector<double> kernel(static_cast<std::size_t>(orders));
  for (const auto& [width, share] : kGlareGaussians) {
    const double variance = std::pow(std::max(sigma * width, least), 2) - own_variance;
    for (std::size_t l = 0; l < kernel.size(); ++l)
      kernel[l] += share * std::exp(-static_cast<double>(l * (l + 1)) * variance / 2);
  }
  return kernel;
}

}  // namespace

template <class T>
void add_glare(const Glare& glare, const Projection& projection, LayeredFrame<T>& frame) {
  const double pixel = largest_pixel_angle(projection), least = kLeastPixels * pixel,
               narrowest = std::max(glare.sigma, least);
  const int step = std::max(1, static_cast<int>(std::lround(0.5 * narrowest / pixel)));
  // The blocks and the grid of their corners widen the light by this variance, so that the series is
  // that of what is left.
  const double blocks = std::pow(step * pixel, 2) / 4;
  SphereBlur sphere(std::sqrt(narrowest * narrowest - blocks));
  const std::vector<GlarePart> parts = parts_of(projection);
  for (const GlarePart& part : parts) gather(part, step, frame.picture, sphere);
  sphere.blur(kernel_of(glare.sigma, least, sphere.own_variance() + blocks, sphere.orders()));
  if (LayerImage<T>* layer = frame.find(Layer::kGlare)) layer->add_pixels(false);
  for (const GlarePart& part : parts)
    scatter(part, static_cast<float>(glare.share), GlareGrid(part, step, sphere), frame);
}

template void add_glare(const Glare&, const Projection&, LayeredHalfFrame&);
template void add_glare(const Glare&, const Projection&, LayeredFloatFrame&);

}  // namespace domefall
