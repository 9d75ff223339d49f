// How wide the blobs of a frame's stars are drawn, by the brightness of their images.
#pragma once

#include <array>

#include "pipeline/render/scene/star_image.h"
#include "pipeline/show/show.h"

namespace domefall {

// A Gaussian narrower than this would twinkle: its peak would change by half as it drifts across
// pixels.
inline constexpr double kLeastSigmaPixels = 0.9;

// A blob ends where its weight has fallen to `cut` of its peak, and what is left there is taken off it,
// so that it ends at 0.  The value at its end is kUnseen, which no display shows.  The cut is never
// nearer than 3.5 sigma, where the sums over pixels would begin to depend on the centre by 1e-3, and
// never farther out than 6.3 sigma.
inline constexpr double kUnseen = 4.4e-5;
inline constexpr double kHighestCut = 0.002187491118182885;  // exp(-3.5^2 / 2)
inline constexpr double kLowestCut = 2.061153622438558e-09;  // exp(-20)

inline double cut_of(double peak) {
  const double cut = kUnseen / peak;
  const double low = cut < kHighestCut ? cut : kHighestCut;
  return low > kLowestCut ? low : kLowestCut;
}

// The Gaussians that together draw one image: its middle, and the halo of a bright one.
struct PointSpreadParts {
  StarImage image;  // the middle, with the light that the halo leaves it
  double sigma;     // radians, of the middle
  struct Halo {
    double sigma;  // radians
    double share;  // of the image's light; 0 where the halo would not be seen
  };
  std::array<Halo, 2> halo;
};

// The point-spread function of one frame.
class PointSpread {
 public:
  // exposure: pixel value of 1 cd/m^2.
  PointSpread(const PointSpreadLaw& law, const Projection& projection, double exposure);

  double least() const { return least_; }  // smallest sigma, radians; at least kLeastSigmaPixels
  // No blob or halo reaches farther from its middle, radians.
  double reach() const;
  // The sigma of an image without its halo, radians.
  double sigma_of(const StarImage& image) const;
  PointSpreadParts parts(const StarImage& image) const;
  // An image whose brightest channel is no more than this is one blob of the least width.
  double plain() const { return plain_; }
  // Where this times a blob's luminance, as a pixel value, passes 1, its colour is half white; 0: nowhere.
  float paling() const { return paling_; }

 private:
  PointSpreadLaw law_;
  double least_, most_;  // sigma, radians
  double reference_;     // luminance of an image's light from which blobs grow
  double halo_sigma_, plain_;
  float paling_;
};

}  // namespace domefall
