// Blobs drawn the way a frame draws them, and the light that they bring.
#pragma once

#include <cmath>
#include <numbers>
#include <vector>

#include "pipeline/render/blobs/blob_layer.h"

namespace domefall {

// Gauss-Legendre quadrature by 4 points between -1 and 1.
inline constexpr double kGaussPoints[] = {-0.8611363115940526, -0.3399810435848563,
                                          0.3399810435848563, 0.8611363115940526};
inline constexpr double kGaussWeights[] = {0.3478548451374538, 0.6521451548625461,
                                           0.6521451548625461, 0.3478548451374538};

// All the pixels of an image with nothing but blobs.
struct DrawnBlobs {
  Projection projection;
  std::vector<float> rgb;
  SplatBuffer buffer = {};  // of the last layer

  float at(int row, int column, int channel = 0) const {
    return rgb[3 * (static_cast<std::size_t>(row) * columns(projection) + column) + channel];
  }
};

DrawnBlobs drawn(const BlobLayer& layer, const Projection& p);
// Draws a layer into an image that drawn() has made of another one.  To take new memory for each of
// many images would cost more than to draw them.
void redraw(DrawnBlobs& image, const BlobLayer& layer);
// Adds the light of a layer to an image that drawn() has made.
void draw_onto(DrawnBlobs& image, const BlobLayer& layer);
DrawnBlobs drawn(const std::vector<StarImage>& images, const Projection& p,
                 const PointSpread& widths);

// Returns the sum of red over the image, each pixel times its solid angle.
double flux_of(const DrawnBlobs& image);
// Returns the largest value of any channel.
float peak_of(const DrawnBlobs& image);
// Returns the largest difference of any channel between two images of the same size.
float largest_difference(const DrawnBlobs& a, const DrawnBlobs& b);

// The sum of red over the bands about a blob, each pixel times its solid angle, and the brightest
// pixel.
struct Brought {
  double flux = 0, peak = 0;
};
Brought brought(const StarImage& image, const Projection& p, const PointSpread& widths,
                int reach = 48);

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
