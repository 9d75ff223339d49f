#include "pipeline/render/scene/point_spread.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "pipeline/base/simd/vector_math.h"
#include "pipeline/render/scene/exposure.h"
#include "pipeline/sources/colour/colour_space.h"

namespace domefall {
namespace {

using std::numbers::pi;

// A Gaussian of a halo is drawn if the pixel value of its peak is above this.
constexpr double kFaintestHalo = 0.02;
// These are the widths of a halo's Gaussians in units of the first one's, and their shares of its
// light.  From one to the next the peak falls to about a tenth.  Together they fall off like the
// power -2.4 of the distance from 1 to 10 of the units, while the glare of a lens or an eye falls
// with its square (CIE 146:2002).
constexpr std::array<double, 3> kHaloSigma{1, 2.5, 6}, kHaloShare{0.5, 0.3, 0.2};

// Returns the factor to the widths of a law, which are those for a dome, whose frame is 180 degrees
// wide.  In a flat frame of another field of view a blob takes the same part of the frame's width.
// Around an audience it has the same angle in every frame.
double width_factor(const Projection& p) {
  return has_zenith(p) ? 1 : field_of_view(p).value_or(pi) / pi;
}

// Returns the light of an image's brightest channel for which a Gaussian with this share of it has
// a peak of kFaintestHalo.  The peak of a Gaussian of light 1 is 1/(2 pi sigma^2).
double least_halo_light(double share, double sigma) {
  return kFaintestHalo * 2 * pi * sigma * sigma / share;
}

}  // namespace

PointSpread::PointSpread(const PointSpreadLaw& law, const Projection& projection, double exposure)
    : law_(law),
      least_(std::max(law.min_sigma * width_factor(projection),
                      kLeastSigmaPixels * largest_pixel_angle(projection))),
      most_(std::max(law.max_sigma * width_factor(projection), least_)),
      reference_(kMagnitudeZeroLux * exposure *
                 exponential(-0.4 * std::numbers::ln10 * law.reference_magnitude)),
      halo_sigma_(std::max(law.halo_sigma * width_factor(projection), least_)),
      single_blob_light_(law.halo > 0 ? least_halo_light(law.halo * kHaloShare[0], halo_sigma_)
                                      : reference_),
      paling_(law.white_core > 0 ? static_cast<float>(1 / law.white_core) : 0.0f) {}

double PointSpread::reach() const {
  // A Gaussian exp(-x^2/2) has fallen to the cut at this x, in units of sigma.
  static const double farthest = std::sqrt(-2 * std::log(kLowestCut));
  return farthest * std::max(most_, law_.halo > 0 ? kHaloSigma.back() * halo_sigma_ : 0.0);
}

double PointSpread::sigma_of(const StarImage& image) const {
  // A law with halos spreads the light of bright stars by these, and keeps their middles narrow.
  if (law_.halo > 0) return least_;
  const double brightness = luminance({image.rgb[0], image.rgb[1], image.rgb[2]}) / reference_;
  if (!(brightness > 1)) return least_;
  return std::min(least_ * exponential(law_.growth * logarithm(brightness)), most_);
}

PointSpreadParts PointSpread::parts(const StarImage& image) const {
  PointSpreadParts parts{image, sigma_of(image), {}};
  if (!(law_.halo > 0)) return parts;
  const double light = std::max({image.rgb[0], image.rgb[1], image.rgb[2]});
  double left = 1;
  for (std::size_t k = 0; k < kHaloSigma.size(); ++k) {
    const double share = law_.halo * kHaloShare[k], sigma = halo_sigma_ * kHaloSigma[k];
    // A halo grows from nothing as the star brightens, so that it does not appear at once.
    const double seen = 1 - least_halo_light(share, sigma) / light;
    if (!(seen > 0)) continue;
    parts.halo[k] = {sigma, share * seen};
    left -= share * seen;
  }
  for (float& c : parts.image.rgb) c *= static_cast<float>(left);
  return parts;
}

}  // namespace domefall
