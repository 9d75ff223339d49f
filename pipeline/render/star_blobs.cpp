#include "pipeline/render/star_blobs.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "pipeline/colour/blackbody.h"
#include "pipeline/render/photometry.h"

namespace domefall {
namespace {

using std::numbers::pi;

constexpr double kLeastSigmaPixels = 0.8;
// Images up to this order are always tried, since either side may be the bright one; beyond, the
// flux falls by exp(-2 pi) with every second order and the first faint one ends the series.
constexpr int kAlwaysTried = 4, kLastOrder = 24;

const double kCut = std::exp(-kBlobReach * kBlobReach / 2);

// Blob widths are given for a dome, 180 degrees across the picture.  A flat picture of another
// opening angle keeps the blob's share of its width.
double width_factor(const Projection& p) {
  const auto* flat = std::get_if<Stereographic>(&p);
  return flat ? flat->fov / pi : 1;
}

double weight(const V3d& a, const V3d& b, double inverse_two_sigma2) {
  const V3d d = a - b;
  const double q = d.dot(d) * inverse_two_sigma2;
  return q < kBlobReach * kBlobReach / 2 ? std::exp(-q) - kCut : 0;
}

// Pixels per radian at most, up to an angle `reach` from a direction `theta` off the middle.
double densest(const Projection& p, double theta, double reach) {
  const double far = std::min(theta + reach, 3.0), centre = 1 / central_pixel_angle(p);
  if (std::holds_alternative<Domemaster>(p)) return centre * std::max(1.0, far / std::sin(far));
  const double c = std::cos(far / 2);
  return centre / (c * c);
}

}  // namespace

BlobMaker::BlobMaker(const Show& show, const FrameState& state, const HoleOptics& optics,
                     const SkyTable* table)
    : law_(show.blobs),
      projection_(state.projection),
      sky_from_tetrad_(state.observer.sky_from_tetrad),
      tetrad_from_camera_(state.observer.tetrad_from_camera),
      from_tetrad_(-state.observer.celerity),
      optics_(optics),
      table_(table),
      scale_(exposure_scale(show.exposure)),
      min_sigma_(std::max(show.blobs.min_sigma * width_factor(projection_),
                          kLeastSigmaPixels * central_pixel_angle(projection_))),
      max_sigma_(std::max(show.blobs.max_sigma * width_factor(projection_), min_sigma_)) {}

void BlobMaker::append(const SceneStar& star, std::vector<StarBlob>& blobs) const {
  const V3d source = apply_transposed(sky_from_tetrad_, star.direction.v);
  if (table_ == nullptr) {
    append_image(star, source, 0, blobs);
    return;
  }
  for (int order = 0; order < kLastOrder; ++order) {
    const bool bright = append_image(star, source, order, blobs);
    if (!bright && order + 1 >= kAlwaysTried) return;
  }
}

// Whether the image is bright enough to matter, be it in the picture or not.
// [Riazuelo] sec. sec_stars_eff: m_obs = m + 10 log10(1+z) - 2.5 log10(f), T_obs = T/(1+z).
bool BlobMaker::append_image(const SceneStar& star, const V3d& source, int order,
                             std::vector<StarBlob>& blobs) const {
  const SkyImage image = image_of(optics_, table_, source, order, star.angular_radius);
  const AberratedLight seen = from_tetrad_.to_rest(image.direction.v);
  const double doppler = seen.frequency_ratio;
  const double g = image.frequency_ratio * doppler;
  const double amplification = image.amplification / (doppler * doppler);
  const double flux = star.flux * amplification * g * g * g * g;
  const WorkingRgb per_flux = blackbody_colours().per_flux(star.temperature * g);
  const double lux = luminance(per_flux) * flux;
  const double faintest_peak = lux * scale_ / (2 * pi * min_sigma_ * min_sigma_);
  if (!(faintest_peak > kFaintestPeak)) return false;
  const double magnitude = -2.5 * std::log10(lux / kMagnitudeZeroLux);
  StarBlob blob;
  blob.sigma = std::clamp(
      min_sigma_ * std::pow(10, 0.4 * law_.growth * (law_.reference_magnitude - magnitude)),
      min_sigma_, max_sigma_);
  blob.centre = {apply_transposed(tetrad_from_camera_, seen.direction)};
  const double pixel_flux = flux * scale_;
  blob.rgb[0] = static_cast<float>(per_flux.r * pixel_flux);
  blob.rgb[1] = static_cast<float>(per_flux.g * pixel_flux);
  blob.rgb[2] = static_cast<float>(per_flux.b * pixel_flux);
  place(blob);
  if (blob.first_row <= blob.last_row && blob.first_column <= blob.last_column)
    blobs.push_back(blob);
  return true;
}

// The pixels it covers, and the sum of its weights over all of them, in the picture or beyond its
// edge: a star at the rim is cut, not dimmed.
void BlobMaker::place(StarBlob& blob) const {
  blob.first_row = blob.first_column = 0;
  blob.last_row = blob.last_column = -1;
  const auto at = pixel_of(projection_, blob.centre);
  if (!at) return;
  const double reach = kBlobReach * blob.sigma;
  const double theta = std::acos(std::clamp(blob.centre.v.z, -1.0, 1.0));
  const bool dome = std::holds_alternative<Domemaster>(projection_);
  if (theta - reach > (dome ? pi / 2 : 0.999 * pi) || (!dome && theta + reach > 0.999 * pi)) return;
  const double half = reach * densest(projection_, theta, reach) + 1;
  const double width = columns(projection_), height = rows(projection_);
  if (at->i + half < 0.5 || at->j + half < 0.5 || at->i - half > width + 0.5 ||
      at->j - half > height + 0.5)
    return;
  const int i0 = static_cast<int>(std::ceil(at->i - half)),
            i1 = static_cast<int>(std::floor(at->i + half));
  const int j0 = static_cast<int>(std::ceil(at->j - half)),
            j1 = static_cast<int>(std::floor(at->j + half));
  const double inverse = 1 / (2 * blob.sigma * blob.sigma);
  double sum = 0;
  for (int j = j0; j <= j1; ++j)
    for (int i = i0; i <= i1; ++i) {
      const PixelPosition pixel{static_cast<double>(i), static_cast<double>(j)};
      const double w = weight(direction_at(projection_, pixel).v, blob.centre.v, inverse);
      if (w > 0) sum += w * pixel_solid_angle(projection_, pixel);
    }
  if (!(sum > 0)) return;
  blob.norm = static_cast<float>(1 / sum);
  blob.first_row = std::max(j0 - 1, 0), blob.last_row = std::min(j1, static_cast<int>(height)) - 1;
  blob.first_column = std::max(i0 - 1, 0),
  blob.last_column = std::min(i1, static_cast<int>(width)) - 1;
}

void draw_row(const StarBlob& blob, const Projection& projection, int row, float* rgb) {
  const double inverse = 1 / (2 * blob.sigma * blob.sigma);
  for (int i = blob.first_column; i <= blob.last_column; ++i) {
    const PixelPosition pixel{i + 1.0, row + 1.0};
    if (!is_inside(projection, pixel)) continue;
    const auto w =
        static_cast<float>(weight(direction_at(projection, pixel).v, blob.centre.v, inverse));
    if (w <= 0) continue;
    for (int c = 0; c < 3; ++c) rgb[3 * i + c] += blob.rgb[c] * (blob.norm * w);
  }
}

}  // namespace domefall
