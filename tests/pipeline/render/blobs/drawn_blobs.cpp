#include "tests/pipeline/render/blobs/drawn_blobs.h"

#include <algorithm>

namespace domefall {

namespace {

int band_count(const Projection& p) { return (rows(p) + kBandRows - 1) / kBandRows; }

std::size_t band_size(const Projection& p) {
  return static_cast<std::size_t>(columns(p)) * 3 * kBandRows;
}

}  // namespace

DrawnBlobs drawn(const BlobLayer& layer, const Projection& p) {
  DrawnBlobs image{p, {}, {}};
  image.rgb.resize(band_size(p) * band_count(p));
  draw_onto(image, layer);
  return image;
}

void redraw(DrawnBlobs& image, const BlobLayer& layer) {
  std::ranges::fill(image.rgb, 0.0f);
  draw_onto(image, layer);
}

void draw_onto(DrawnBlobs& image, const BlobLayer& layer) {
  layer.start_buffer(image.buffer);
  for (int band = 0; band < band_count(image.projection); ++band)
    layer.draw_band(band, image.buffer, image.rgb.data() + band_size(image.projection) * band);
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

float peak_of(const DrawnBlobs& image) { return *std::ranges::max_element(image.rgb); }

float largest_difference(const DrawnBlobs& a, const DrawnBlobs& b) {
  float largest = 0;
  for (std::size_t k = 0; k < a.rgb.size(); ++k)
    largest = std::max(largest, std::abs(a.rgb[k] - b.rgb[k]));
  return largest;
}

Brought brought(const StarImage& image, const Projection& p, const PointSpread& widths, int reach) {
  BlobLayer layer(p);
  layer.add({image}, widths);
  layer.sort_into_bands();
  const int bands = band_count(p), width = columns(p);
  std::vector<float> rgb(band_size(p));
  Brought sum;
  const int first = std::max(0, (static_cast<int>(image.y) - reach) / kBandRows);
  const int last = std::min(bands - 1, (static_cast<int>(image.y) + reach) / kBandRows);
  SplatBuffer buffer;
  layer.start_buffer(buffer);
  for (int band = first; band <= last; ++band) {
    std::ranges::fill(rgb, 0.0f);
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
