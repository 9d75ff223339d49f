// Blobs drawn the way a frame draws them, and the light that they bring.
#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "pipeline/render/blobs/blob_layer.h"

namespace domefall {

// All the pixels of an image with nothing but blobs.
struct DrawnBlobs {
  Projection projection;
  std::vector<float> rgb;

  float at(int row, int column, int channel = 0) const {
    return rgb[3 * (static_cast<std::size_t>(row) * columns(projection) + column) + channel];
  }
};

inline DrawnBlobs drawn(const BlobLayer& layer, const Projection& p) {
  DrawnBlobs image{p, {}};
  const auto row = static_cast<std::size_t>(columns(p)) * 3;
  const int bands = (rows(p) + kBandRows - 1) / kBandRows;
  image.rgb.resize(row * kBandRows * bands);
  SplatBuffer buffer;
  layer.start_buffer(buffer);
  for (int band = 0; band < bands; ++band)
    layer.draw_band(band, buffer, image.rgb.data() + row * kBandRows * band);
  return image;
}

inline DrawnBlobs drawn(const std::vector<StarImage>& images, const Projection& p,
                        const PointSpread& widths) {
  BlobLayer layer(p);
  layer.add(images, widths);
  layer.sort_into_bands();
  return drawn(layer, p);
}

// The sum of red over the bands about a blob, each pixel times its solid angle, and the brightest
// pixel.
struct Brought {
  double flux = 0, peak = 0;
};
inline Brought brought(const StarImage& image, const Projection& p, const PointSpread& widths,
                       int reach = 48) {
  BlobLayer layer(p);
  layer.add({image}, widths);
  layer.sort_into_bands();
  const int bands = (rows(p) + kBandRows - 1) / kBandRows, width = columns(p);
  std::vector<float> rgb(static_cast<std::size_t>(width) * 3 * kBandRows);
  Brought sum;
  const int first = std::max(0, (static_cast<int>(image.y) - reach) / kBandRows);
  const int last = std::min(bands - 1, (static_cast<int>(image.y) + reach) / kBandRows);
  SplatBuffer buffer;
  layer.start_buffer(buffer);
  for (int band = first; band <= last; ++band) {
    std::fill(rgb.begin(), rgb.end(), 0.0f);
    layer.draw_band(band, buffer, rgb.data());
    for (int k = 0; k < width * kBandRows; ++k) {
      const double value = rgb[3 * static_cast<std::size_t>(k)];
      if (value == 0) continue;
      sum.peak = std::max(sum.peak, value);
      sum.flux +=
          value * pixel_solid_angle(p, {k % width + 1.0, band * kBandRows + k / width + 1.0});
    }
  }
  return sum;
}

// A white image in a direction of the camera, with the given light in each channel.
inline StarImage image_at(const Projection& p, double theta, double azimuth, double flux) {
  const auto at = pixel_of(p, {{std::sin(theta) * std::cos(azimuth),
                                std::sin(theta) * std::sin(azimuth), std::cos(theta)}});
  const auto light = static_cast<float>(flux);
  return {static_cast<float>(at->i - 1), static_cast<float>(at->j - 1), {light, light, light}};
}

// The flux of a blob with this peak value where blobs are at their smallest.
inline double flux_of_peak(const PointSpread& widths, double peak) {
  return peak * 2 * std::numbers::pi * widths.least() * widths.least();
}

}  // namespace domefall
