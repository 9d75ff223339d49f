#include "pipeline/render/sky/formula_shader.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

#include "pipeline/sources/sky/formula_sky.h"

namespace domefall {
namespace {

constexpr int kSize = SampleBatch::kSize;

// The formulas take columns of doubles.
using Doubles = std::array<double, kSize>;

}  // namespace

// Squares holds the luminance of pixels on the grid, in both of its colours.  `even` is 0 where a
// border may cross the pixel.
struct FormulaShader::Squares {
  alignas(64) std::array<float, kSize> squares, discs, even;
  GridLights columns() { return {squares.data(), discs.data(), even.data()}; }
};

FormulaShader::FormulaShader(const SkyLight& light, double null_time, int samples)
    : light_(light), samples_(std::min(samples, kMostSamples)) {
  const Rings* rings = light.rings();
  if (rings == nullptr) return;
  per_time_ = 1 / rings->period;
  const double phase = null_time * per_time_;
  // Rings repeat with every period.  Without the whole periods a float holds the phase more
  // precisely.
  phase_ = phase - std::round(phase);
}

FormulaShader::RingNode FormulaShader::ring_node(double emission_time, double time_scale,
                                                 double pixel_angle) const {
  return {static_cast<float>(phase_ + emission_time * per_time_),
          static_cast<float>(std::abs(time_scale) * pixel_angle * per_time_)};
}

void FormulaShader::find_squares(const SampleBatch& pixels, int count, Squares& seen) const {
  alignas(64) Doubles x, y, z, footprint, reach;
  for (int k = 0; k < count; ++k) {
    x[k] = pixels.x[k];
    y[k] = pixels.y[k];
    z[k] = pixels.z[k];
    footprint[k] = pixels.wide[k];
    reach[k] = kGridReach * pixels.wide[k];
  }
  grid_lights({x.data(), y.data(), z.data(), footprint.data(), reach.data()}, count,
              seen.columns());
}

// BorderSamples holds the directions of samples within pixels.  Within a pixel the direction is
// taken to be linear, since pixels in which it bends more are not interpolated.
struct FormulaShader::BorderSamples {
  alignas(64) Doubles x, y, z, footprint, reach{};
  int count = 0;

  // Adds samples^2 samples of pixel k.  The slopes of the direction are differences between
  // neighbours in the same square of kSide by kSide pixels.
  void add(const SampleBatch& pixels, int k, int samples) {
    const int column = k % kSide, row = k / kSide % kSide;
    const int left = column > 0 ? k - 1 : k, right = column < kSide - 1 ? k + 1 : k;
    const int above = row > 0 ? k - kSide : k, below = row < kSide - 1 ? k + kSide : k;
    const auto at = [&](int pixel) {
      return V3d(pixels.x[pixel], pixels.y[pixel], pixels.z[pixel]);
    };
    // Differences span two pixels, or one pixel at the rim of the square.
    const V3d to_right = (at(right) - at(left)) / (right - left),
              down = (at(below) - at(above)) / ((below - above) / double{kSide});
    for (int j = 0; j < samples; ++j)
      for (int i = 0; i < samples; ++i, ++count) {
        const V3d n =
            at(k) + to_right * ((i + 0.5) / samples - 0.5) + down * ((j + 0.5) / samples - 0.5);
        x[count] = n.x;
        y[count] = n.y;
        z[count] = n.z;
        footprint[count] = pixels.narrow[k] / static_cast<float>(samples);
      }
  }
};

// Replaces the light of pixels that a border may cross by the mean of samples.
void FormulaShader::sample_borders(const SampleBatch& pixels, int count, Squares& seen) const {
  // The columns hold the samples of one pixel at least; else no pixel would ever be taken.
  static_assert(kMostSamples * kMostSamples <= kSize);
  const int per_pixel = samples_ * samples_, at_once = kSize / per_pixel;
  Squares light;
  for (int next = 0; next < count;) {
    BorderSamples samples;
    std::array<int, kSize> members;
    int some = 0;
    // Pixels are collected until their samples fill the columns.
    for (; next < count && some < at_once; ++next)
      if (seen.even[next] == 0) {
        samples.add(pixels, next, samples_);
        members[some++] = next;
      }
    grid_lights({samples.x.data(), samples.y.data(), samples.z.data(), samples.footprint.data(),
                 samples.reach.data()},
                samples.count, light.columns());
    for (int m = 0; m < some; ++m) {
      const auto mean = [&](const auto& of) {
        const float* first = of.data() + m * per_pixel;
        return std::accumulate(first, first + per_pixel, 0.0f) / static_cast<float>(per_pixel);
      };
      seen.squares[members[m]] = mean(light.squares);
      seen.discs[members[m]] = mean(light.discs);
    }
  }
}

void FormulaShader::shade_grid(const SampleBatch& pixels, int count, float* rgb) const {
  Squares seen;
  find_squares(pixels, count, seen);
  if (samples_ > 1) sample_borders(pixels, count, seen);
  for (int k = 0; k < count; ++k, rgb += 3) {
    const WorkingRgb c = grid_colour({seen.squares[k], seen.discs[k]}, pixels.tone[k]);
    rgb[0] = c.r * pixels.gain[k];
    rgb[1] = c.g * pixels.gain[k];
    rgb[2] = c.b * pixels.gain[k];
  }
}

void FormulaShader::shade_rings(const SampleBatch& pixels, int count, float* rgb) const {
  alignas(64) std::array<float, kSize> light;
  ring_lights(pixels.x.data(), pixels.wide.data(), count, light.data());
  const WorkingRgb colour = light_.ring_colour();
  for (int k = 0; k < count; ++k, rgb += 3) {
    rgb[0] = colour.r * light[k];
    rgb[1] = colour.g * light[k];
    rgb[2] = colour.b * light[k];
  }
}

void FormulaShader::shade(const SampleBatch& pixels, int count, float* rgb) const {
  if (light_.is_grid())
    shade_grid(pixels, count, rgb);
  else
    shade_rings(pixels, count, rgb);
}

}  // namespace domefall
