#include "pipeline/render/star_blobs.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "pipeline/colour/blackbody.h"
#include "pipeline/render/effect_light.h"
#include "pipeline/render/photometry.h"
#include "pipeline/render/vector_math.h"

namespace domefall {
namespace {

using std::numbers::pi;

// Images up to this order are always tried, since either side may be the bright one; beyond, the
// flux falls by exp(-2 pi) with every second order and the first faint one ends the series.
constexpr int kAlwaysTried = 4, kLastOrder = 24;
constexpr int kWithoutAmplification = 2;

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

// The part of a star's light that a frame takes.
double part_taken(const Picture::Sky& sky, double magnitude) {
  constexpr double kFade = 0.5;  // magnitudes
  if (!sky.soft_limit) return magnitude <= sky.max_magnitude ? 1 : 0;
  return std::clamp((sky.max_magnitude - magnitude) / kFade, 0.0, 1.0);
}

// Pixels per radian at most, up to an angle `reach` from a direction `theta` off the middle.
double densest(const Projection& p, double theta, double reach) {
  const double far = std::min(theta + reach, 3.0), centre = 1 / central_pixel_angle(p);
  if (std::holds_alternative<Domemaster>(p)) return centre * std::max(1.0, far / std::sin(far));
  const double c = std::cos(far / 2);
  return centre / (c * c);
}

}  // namespace

BlobMaker::BlobMaker(const Show& show, const FrameState& state, const Picture::Sky& sky,
                     const SkyTable* table)
    : law_(show.blobs),
      sky_(sky),
      effects_(show.effects),
      projection_(state.projection),
      sky_from_tetrad_(state.observer.sky_from_tetrad),
      tetrad_from_camera_(state.observer.tetrad_from_camera),
      vantage_(vantage_of(state.observer, show.effects)),
      from_tetrad_(-vantage_.celerity),
      to_measured_(-vantage_.measured.value_or(V3d(0, 0, 0))),
      from_rest_(vantage_.rest),
      straight_ratio_(effects_.lensing ? 1 : gravitational_ratio(state.observer.r)),
      table_(table),
      scale_(exposure_scale(state.picture)),
      min_sigma_(std::max(show.blobs.min_sigma * width_factor(projection_),
                          kLeastSigmaPixels * central_pixel_angle(projection_))),
      max_sigma_(std::max(show.blobs.max_sigma * width_factor(projection_), min_sigma_)) {}

void BlobMaker::append(const SceneStar& catalogued, std::vector<StarBlob>& blobs) const {
  const double taken = sky_.star_gain * part_taken(sky_, catalogued.magnitude);
  if (!(taken > 0)) return;
  SceneStar star = catalogued;
  star.flux *= taken;
  const V3d source = apply_transposed(sky_from_tetrad_, star.direction.v);
  if (table_ == nullptr) {
    append_image(star, source, 0, blobs);
    return;
  }
  const bool amplified = effects_.amplification != Amplification::kNone;
  const int orders = amplified ? kLastOrder : kWithoutAmplification;
  for (int order = 0; order < orders; ++order) {
    const bool bright = append_image(star, source, order, blobs);
    if (!bright && order + 1 >= kAlwaysTried) return;
  }
}

// In the frame of the tetrad.
SkyImage BlobMaker::image(const SceneStar& star, const V3d& source, int order) const {
  if (effects_.lensing) return image_of(table_, source, order, star.angular_radius);
  const AberratedLight at = from_rest_.to_rest(source);
  const double ratio = at.frequency_ratio;
  return {{at.direction}, straight_ratio_ * ratio, 1 / (ratio * ratio)};
}

// Whether the image is bright enough to matter, be it in the picture or not.
// [Riazuelo] sec. sec_stars_eff: m_obs = m + 10 log10(1+z) - 2.5 log10(f), T_obs = T/(1+z).
bool BlobMaker::append_image(const SceneStar& star, const V3d& source, int order,
                             std::vector<StarBlob>& blobs) const {
  const SkyImage at = image(star, source, order);
  const AberratedLight seen = from_tetrad_.to_rest(at.direction.v);
  const double doppler = seen.frequency_ratio;
  double g = at.frequency_ratio * doppler;
  if (vantage_.measured) g *= to_measured_.to_rest(seen.direction).frequency_ratio;
  double flux = star.flux;
  if (effects_.amplification != Amplification::kNone)
    flux *= at.amplification / (doppler * doppler);
  if (effects_.intensity) flux = flux * g * g * g * g;
  if (!effects_.doppler_colour) flux = std::min(flux, kSaturated);
  const WorkingRgb per_flux =
      blackbody_colours().per_flux(star.temperature * colour_ratio(effects_, g));
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
  if (place_blob(projection_, blob)) blobs.push_back(blob);
  return true;
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
