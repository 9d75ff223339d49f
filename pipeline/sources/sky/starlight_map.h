// A starless Milky Way is the light of a catalogue's faint stars, spread until they run together.
#pragma once

#include <vector>

#include "pipeline/sources/sky/sky_pyramid.h"
#include "pipeline/sources/stars/star_catalogue.h"

namespace domefall {

// A star has a flux (W/m^2, over all wavelengths) and the temperature (K) of the blackbody that it
// is drawn as.
struct FaintStar {
  V3d direction;  // unit
  double flux, temperature;
  double v_magnitude;
};

// Returns the stars of a catalogue that are fainter than a magnitude.
std::vector<FaintStar> fainter_stars(const StarCatalogue& catalogue, double v_magnitude);

// Stars are blurred by a Gaussian whose standard deviation (radians) has these limits.  The widest
// blur still ends within half the sphere.  The narrowest is 1.3 texels of the largest face.
inline constexpr double kNarrowestBlur = 5e-4, kWidestBlur = 0.15;

// The stars of a class have the same blur.
struct BlurClass {
  double blur;
  std::vector<FaintStar> stars;
};
// Sorts stars by their blurs.  The few bright ones would stand out of the many faint ones.  A star
// brighter than `smooth_to` (V) therefore has a wider blur, with which its peak, flux over blur
// squared, is that of a star of V = smooth_to.  Blurs go in steps of 1.5 up to kWidestBlur.
std::vector<BlurClass> blur_classes(const std::vector<FaintStar>& stars, double blur,
                                    double smooth_to);

// Returns the number of texels along a face that show a blur smoothly, which is at least three for
// its standard deviation unless kLargestStarlightFace limits it.
inline constexpr int kLargestStarlightFace = 4096;
int starlight_face(double blur);

// The map holds the light of stars as radiance and as radiance times theta (SkyMapKind::kThermal).
// Each star is spread by a Gaussian on the sphere, which ends smoothly at 4 standard deviations.
// Its light over the texels sums up to its flux, to single precision, wherever it stands on the
// cube.  Stars within a cell of two thirds of the blur are spread together, about their common
// centre.
class StarlightMap {
 public:
  // Makes a dark map.  The size of a face is a power of two.
  explicit StarlightMap(int size);
  // Adds stars with a blur (standard deviation, radians) of at least two thirds of a texel.
  void add(const std::vector<FaintStar>& stars, double blur);

  // Returns the greatest radiance, or radiance times theta, of any texel (W/m^2/sr), for
  // sky_unit().
  double greatest() const;
  // Returns the sum of radiance times solid angle, W/m^2.
  double flux() const;
  // Sets the finest level, including its border, of a thermal map of this size to the light times
  // `gain`.
  void write(const SkyPyramid& pyramid, double gain) const;

 private:
  struct Light {
    float radiance, weighted;  // weighted by theta
  };
  void spread(const V3d& direction, double flux, double weighted, double blur);

  int size_;
  std::vector<float> inverse_length_;  // of (1, u, v) at each texel of any face
  std::vector<Light> light_;           // six faces, without borders
  std::vector<float> kernel_;          // the Gaussian by squared chord, up to its end
  std::vector<float> weights_;         // of one star's texels, kept to save allocations
};

}  // namespace domefall
