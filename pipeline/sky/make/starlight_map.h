// A starless Milky Way: the light of a catalogue's faint stars, run together.
#pragma once

#include <vector>

#include "pipeline/sky/catalogue/star_catalogue.h"
#include "pipeline/sky/maps/sky_pyramid.h"

namespace domefall {

// Flux (W/m^2, over all wavelengths) of a star, and the blackbody (K) that it is drawn as.
struct FaintStar {
  V3d direction;  // unit
  double flux, temperature;
  double v_magnitude;
};

// Those of a catalogue that are fainter than a magnitude.
std::vector<FaintStar> fainter_stars(const StarCatalogue& catalogue, double v_magnitude);

// Gaussian blurs that a map may have (its standard deviation, radians): the widest still has its cap
// on less than half the sphere, the narrowest is 1.5 texels of the largest face.
inline constexpr double kNarrowestBlur = 5e-4, kWidestBlur = 0.15;

// Stars that are spread alike.
struct BlurClass {
  double blur;
  std::vector<FaintStar> stars;
};
// The few bright stars of a catalogue would stand out of the many faint ones as spots.  A star brighter
// than `smooth_to` (V) has a blur as much wider as takes its peak down to that of a star of smooth_to:
// in steps of 1.5, up to kWidestBlur.
std::vector<BlurClass> blur_classes(const std::vector<FaintStar>& stars, double blur,
                                    double smooth_to);

// Texels along a face that show a blur smoothly: at least three for its standard deviation, as far as
// `kLargestStarlightFace` allows.
inline constexpr int kLargestStarlightFace = 4096;
int starlight_face(double blur);

// Radiance, and radiance times theta (SkyMapKind::kThermal), of stars' light, each spread by a
// Gaussian of standard deviation `blur` on the sphere, cut smoothly at 4 of them.  Each star's light
// over the texels sums up to its flux (to single precision), wherever it stands on the cube.  Stars
// closer to each other than two thirds of the blur are spread together, about their common centre.
class StarlightMap {
 public:
  // Dark.  `size`: of a face, a power of two.
  explicit StarlightMap(int size);
  // One texel is at most 1.5 `blur`.
  void add(const std::vector<FaintStar>& stars, double blur);

  // Of any texel, W/m^2/sr, also of radiance times theta: for sky_unit().
  double greatest() const;
  // W/m^2: the sum of radiance times solid angle.
  double flux() const;
  // Sets the finest level of a thermal pyramid of this size, multiplied by `gain`.
  void write(const SkyPyramid& pyramid, double gain) const;

 private:
  struct Light {
    float radiance, weighted;  // weighted by theta
  };
  void spread(const V3d& direction, double flux, double weighted, double blur);

  int size_;
  std::vector<float> inverse_length_;  // of (1, u, v) at each texel of any face
  std::vector<Light> light_;           // six faces, without borders
  std::vector<float> kernel_;          // by squared chord, to where it ends
  std::vector<float> weights_;         // of the texels of one star: scratch
};

// Steradians of a texel of a face of `size`, whose centre is at u, v; midpoint rule, to 1e-4 at 64.
double texel_solid_angle(int size, double u, double v);

}  // namespace domefall
