#include "pipeline/render/star_blobs.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "pipeline/colour/colour_space.h"
#include "pipeline/render/photometry.h"
#include "pipeline/render/vector_math.h"

namespace domefall {
namespace {

using std::numbers::pi;

// The Gaussian at its reach is taken off it, so that it ends at 0.
const double kCut = std::exp(-kBlobReach * kBlobReach / 2);

// Blob widths are given for a dome, 180 degrees across the picture.  A flat picture of another
// opening angle keeps the blob's share of its width.
double width_factor(const Projection& p) {
  const auto* flat = std::get_if<Stereographic>(&p);
  return flat ? flat->fov / pi : 1;
}

// Integral of the weights over the sphere, where a solid angle is 2 pi times chord times its
// differential.  With sigma >= 0.9 pixel the sum over pixel centres differs from it by
// 4 exp(-2 pi^2 0.9^2) = 5e-7 at most, wherever between them the centre lies.
double weight_integral(double sigma) {
  const double reach2 = kBlobReach * kBlobReach / 2;
  return 2 * pi * sigma * sigma * (1 - kCut - kCut * reach2);
}

constexpr int kChunk = 64;

DOMEFALL_SIMD void weigh(const CameraDirection* n, int count, const V3d& middle,
                         double inverse_two_sigma2, float* weight) {
  const double cut = kCut;
  const double x = middle.x, y = middle.y, z = middle.z;
  for (int k = 0; k < count; ++k) {
    const double dx = n[k].v.x - x, dy = n[k].v.y - y, dz = n[k].v.z - z;
    const double q = (dx * dx + dy * dy + dz * dz) * inverse_two_sigma2;
    const double w = exponential(-q) - cut;
    weight[k] = static_cast<float>(w > 0 ? w : 0);
  }
}

// Pixels per radian at most, up to an angle `reach` from a direction `theta` off the middle.
double densest(const Projection& p, double theta, double reach) {
  const double far = std::min(theta + reach, 3.0), centre = 1 / central_pixel_angle(p);
  if (std::holds_alternative<Domemaster>(p)) return centre * std::max(1.0, far / std::sin(far));
  const double c = std::cos(far / 2);
  return centre / (c * c);
}

}  // namespace

BlobWidths::BlobWidths(const StarBlobs& law, const Projection& projection, double exposure_scale)
    : law_(law),
      scale_(exposure_scale),
      least_(std::max(law.min_sigma * width_factor(projection),
                      kLeastSigmaPixels * central_pixel_angle(projection))),
      most_(std::max(law.max_sigma * width_factor(projection), least_)) {}

double BlobWidths::of(const StarImage& image) const {
  const double lux = luminance({image.rgb[0], image.rgb[1], image.rgb[2]}) / scale_;
  const double magnitude = -2.5 * std::log10(lux / kMagnitudeZeroLux);
  return std::clamp(
      least_ * std::pow(10, 0.4 * law_.growth * (law_.reference_magnitude - magnitude)), least_,
      most_);
}

bool place_blob(const Projection& projection, StarBlob& blob) {
  blob.first_row = blob.first_column = 0;
  blob.last_row = blob.last_column = -1;
  const auto at = pixel_of(projection, blob.centre);
  if (!at) return false;
  const double reach = kBlobReach * blob.sigma;
  const double theta = std::acos(std::clamp(blob.centre.v.z, -1.0, 1.0));
  const bool dome = std::holds_alternative<Domemaster>(projection);
  if (theta - reach > (dome ? pi / 2 : 0.999 * pi) || (!dome && theta + reach > 0.999 * pi))
    return false;
  const double half = reach * densest(projection, theta, reach) + 1;
  const double width = columns(projection), height = rows(projection);
  if (at->i + half < 0.5 || at->j + half < 0.5 || at->i - half > width + 0.5 ||
      at->j - half > height + 0.5)
    return false;
  const int i0 = static_cast<int>(std::ceil(at->i - half)),
            i1 = static_cast<int>(std::floor(at->i + half));
  const int j0 = static_cast<int>(std::ceil(at->j - half)),
            j1 = static_cast<int>(std::floor(at->j + half));
  blob.norm = static_cast<float>(1 / weight_integral(blob.sigma));
  blob.first_row = std::max(j0 - 1, 0), blob.last_row = std::min(j1, static_cast<int>(height)) - 1;
  blob.first_column = std::max(i0 - 1, 0),
  blob.last_column = std::min(i1, static_cast<int>(width)) - 1;
  return blob.first_row <= blob.last_row && blob.first_column <= blob.last_column;
}

void draw_row(const StarBlob& blob, const Projection& projection, int row, float* rgb) {
  const double inverse = 1 / (2 * blob.sigma * blob.sigma);
  const ColumnRange inside = inside_columns(projection, row);
  const int last_column = std::min(blob.last_column, inside.last);
  const float scale[3] = {blob.rgb[0] * blob.norm, blob.rgb[1] * blob.norm,
                          blob.rgb[2] * blob.norm};
  std::array<CameraDirection, kChunk> n;
  std::array<float, kChunk> weight;
  for (int first = std::max(blob.first_column, inside.first); first <= last_column;
       first += kChunk) {
    const int last = std::min(last_column, first + kChunk - 1), count = last - first + 1;
    inside_directions(projection, row, {first, last}, n.data());
    weigh(n.data(), count, blob.centre.v, inverse, weight.data());
    float* out = rgb + 3 * first;
    for (int k = 0; k < count; ++k, out += 3)
      for (int c = 0; c < 3; ++c) out[c] += scale[c] * weight[static_cast<std::size_t>(k)];
  }
}

}  // namespace domefall
