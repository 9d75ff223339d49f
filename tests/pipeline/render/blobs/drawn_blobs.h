// Blobs drawn the way a frame draws them, and what they bring.
#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "pipeline/render/blobs/blob_layer.h"

namespace domefall {

// A whole picture of blobs.
struct DrawnBlobs {
  Projection projection;
  std::vector<float> rgb;

  float at(int row, int column, int channel = 0) const {
    return rgb[3 * (static_cast<std::size_t>(row) * columns(projection) + column) + channel];
  }
};

inline DrawnBlobs drawn(const BlobLayer& layer, const Projection& p) {
  DrawnBlobs picture{p, {}};
  const auto row = static_cast<std::size_t>(columns(p)) * 3;
  const int bands = (rows(p) + kBandRows - 1) / kBandRows;
  picture.rgb.resize(row * kBandRows * bands);
  SplatCanvas dots;
  layer.start_canvas(dots);
  for (int band = 0; band < bands; ++band)
    layer.draw_band(band, dots, picture.rgb.data() + row * kBandRows * band);
  return picture;
}

inline DrawnBlobs drawn(const std::vector<StarImage>& images, const Projection& p,
                        const PointSpread& widths) {
  BlobLayer layer(p);
  layer.add(images, widths);
  layer.sort_into_bands();
  return drawn(layer, p);
}

// Sum over the picture, or the bands about a row, of a channel times the pixels' solid angles.
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
  SplatCanvas dots;
  layer.start_canvas(dots);
  for (int band = first; band <= last; ++band) {
    std::fill(rgb.begin(), rgb.end(), 0.0f);
    layer.draw_band(band, dots, rgb.data());
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

// An image at a direction of the camera, of a given light in red.
inline StarImage image_at(const Projection& p, double theta, double azimuth, double flux) {
  const auto at = pixel_of(p, {{std::sin(theta) * std::cos(azimuth),
                                std::sin(theta) * std::sin(azimuth), std::cos(theta)}});
  const auto light = static_cast<float>(flux);
  return {static_cast<float>(at->i - 1), static_cast<float>(at->j - 1), {light, light, light}};
}

// The flux that has this peak value where the blob is at its smallest.
inline double flux_of_peak(const PointSpread& widths, double peak) {
  return peak * 2 * std::numbers::pi * widths.least() * widths.least();
}

}  // namespace domefall
