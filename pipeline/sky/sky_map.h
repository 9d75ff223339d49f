// A panorama as the renderer reads it: six square faces of a cube with a mip chain, so that a look
// costs no trigonometry, has no pole and no seam, and can be filtered by its footprint.
#pragma once

#include <array>
#include <vector>

#include "pipeline/colour/colour_space.h"
#include "pipeline/image/frame_buffer.h"
#include "trajectories/directions.h"

namespace domefall {

// The luminance (cd/m^2) that a pixel value of 1 in a panorama file stands for.
inline constexpr double kPanoramaUnit = 1e-4;

class SkyMap {
 public:
  // From an equirectangular image, linear Rec.709, equatorial J2000, seen from inside: the middle
  // column is RA 0h, RA grows to the left, the top row is Dec +90.  Twice as wide as high, at least 4 x 2.
  explicit SkyMap(const FloatImage& equirectangular);

  // Light (cd/m^2, working space) in a direction, averaged over about `footprint` radians.
  WorkingRgb sample(const V3d& direction, double footprint) const;

  std::size_t bytes() const;

 private:
  struct alignas(16) Texel {
    float rgb0[4];  // padded to a register
  };
  struct Level {
    int size;                   // texels along an edge of a face, without the border
    std::vector<Texel> texels;  // 6 faces of (size + 2)^2, a border of one texel around each
    const Texel* face(int k) const;
    Texel* face(int k);
  };

  static Texel bilinear(const Level& level, int face, double u, double v);
  void fill_border(Level& level) const;

  std::vector<Level> levels_;
};

}  // namespace domefall
