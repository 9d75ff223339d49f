// Says how large the stars of a frame are drawn, by the Gaussians that stand for an image of a
// given brightness.
#pragma once

#include <array>

#include "pipeline/render/scene/star_image.h"
#include "pipeline/show/show.h"

namespace domefall {

// No Gaussian is narrower than this.  A narrower one would twinkle, since its peak would change by
// half as it drifts across pixels.
inline constexpr double kLeastSigmaPixels = 0.9;

// A blob ends where its weight has fallen to the part `cut` of its peak.  That part is subtracted
// from the whole blob, so that it ends at 0.  The pixel value at its end is kUnseen, which no
// display shows.  The end is at least 3.5 sigma from the middle, since the sums over pixels of a
// smaller blob would depend on its position by more than 1e-3, and at most 6.3 sigma.
inline constexpr double kUnseen = 4.4e-5;
inline constexpr double kHighestCut = 0.002187491118182885;  // exp(-3.5^2 / 2)
inline constexpr double kLowestCut = 2.061153622438558e-09;  // exp(-20)

// Returns the cut of a blob with this pixel value in its middle.
inline double cut_of(double peak) {
  const double cut = kUnseen / peak;
  const double low = cut < kHighestCut ? cut : kHighestCut;
  return low > kLowestCut ? low : kLowestCut;
}

// PointSpreadParts holds the Gaussians that together draw one image: its middle, and three for the
// halo of a bright image.
struct PointSpreadParts {
  StarImage image;  // the middle, which has the light that the halo leaves
  double sigma;     // radians; width of the middle
  struct Halo {
    double sigma;  // radians
    double share;  // of the image's light; 0 where the halo would not be seen
  };
  std::array<Halo, 3> halo;
};

// A PointSpread is a show's point-spread law at the size and exposure of one frame.
class PointSpread {
 public:
  // `exposure` is the pixel value of 1 cd/m^2.
  PointSpread(const PointSpreadLaw& law, const Projection& projection, double exposure);

  // Returns the smallest sigma of the frame, in radians.  It is at least kLeastSigmaPixels.
  double least() const { return least_; }
  // Returns how far a blob or halo of the frame extends from its middle at most, in radians.
  double reach() const;
  // Returns the sigma, in radians, of the middle of an image.
  double sigma_of(const StarImage& image) const;
  PointSpreadParts parts(const StarImage& image) const;
  // An image whose brightest channel is at most this is a single blob of the least width.
  double single_blob_light() const { return single_blob_light_; }
  // A blob is half white where its luminance, as a pixel value, is 1/paling().  With 0 it keeps its
  // colour everywhere.
  float paling() const { return paling_; }

 private:
  PointSpreadLaw law_;
  double least_, most_;       // bounds of sigma, radians
  double reference_;          // the luminance of an image's light beyond which its blob grows
  double halo_sigma_;         // radians
  double single_blob_light_;  // as a value of StarImage::rgb
  float paling_;
};

}  // namespace domefall
