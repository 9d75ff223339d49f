#include "tests/pipeline/render/blobs/drawn_blobs.h"

#include <algorithm>

namespace domefall {

DrawnBlobs drawn(const BlobLayer& layer, const Projection& p) {
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

DrawnBlobs drawn(const std::vector<StarImage>& images, const Projection& p,
                 const PointSpread& widths) {
  BlobLayer layer(p);
  layer.add(images, widths);
  layer.sort_into_bands();
  return drawn(layer, p);
}

double flux_of(const DrawnBlobs& image) {
  double flux = 0;
  const int width = columns(image.projection);
  for (std::size_t k = 0; k < image.rgb.size() / 3; ++k) {
    const auto column = static_cast<int>(k) % width, row = static_cast<int>(k) / width;
    const double value = image.rgb[3 * k];
    if (value != 0) flux += value * pixel_solid_angle(image.projection, {column + 1.0, row + 1.0});
  }
  return flux;
}

Brought brought(const StarImage& image, const Projection& p, const PointSpread& widths, int reach) {
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

}  // namespace domefall
