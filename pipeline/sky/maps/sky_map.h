// A panorama as the renderer reads it: six square faces of a cube with a mip chain, so that a look
// costs no trigonometry, has no pole and no seam, and can be filtered by its footprint.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include "pipeline/colour/colour_space.h"
#include "pipeline/sky/maps/sky_texel.h"
#include "trajectories/directions.h"

namespace domefall {

// The luminance (cd/m^2) that a pixel value of 1 in a panorama file stands for.
inline constexpr double kPanoramaUnit = 1e-4;

// What a texel's channels hold, in units of SkyMap::unit().
enum class SkyMapKind : std::uint32_t {
  // r, g, b of the working space, 0.
  kColour = 0,
  // I, I theta, 0, 0: a patch of blackbody light of bolometric radiance I (sigma T^4/pi of a full
  // surface) and theta = log2(T / kThermalBase).  Both add up when light is added, so a filter gives
  // the radiance and the mean of log T that it weighs.
  kThermal = 1,
};

// Kelvin.  T exceeds it, so that theta > 0.
inline constexpr double kThermalBase = 256;

// Six faces of (size + 2)^2 texels, row by row, with a border of one texel around each (what a look
// between the outermost texels of two faces needs).  Faces and their axes: cube_face.h.
struct SkyLevel {
  int size;  // texels along an edge of a face, without the border
  const SkyTexel* texels;

  static std::size_t face_texels(int size) {
    return static_cast<std::size_t>(size + 2) * static_cast<std::size_t>(size + 2);
  }
  const SkyTexel* face(int k) const {
    return texels + static_cast<std::size_t>(k) * face_texels(size);
  }
};

// Light that a blackbody of some temperature (K) gives, of this bolometric radiance (W/m^2/sr).  At
// frequency ratio g its luminance is BlackbodyColours::per_flux(g temperature) radiance g^4.
struct ThermalLight {
  double radiance, temperature;
};

class SkyMap {
 public:
  // Of levels that `owner` keeps alive: sizes are powers of two, each half the one before, down to 1.
  SkyMap(SkyMapKind kind, double unit, std::vector<SkyLevel> levels,
         std::shared_ptr<const void> owner);

  SkyMapKind kind() const { return kind_; }
  // What a half of value 1 stands for: cd/m^2 (kColour) or W/m^2/sr (kThermal).  A power of two near
  // which the brightest texel is 2^13 to 2^15, so that light down to 2^-27 of it is kept to 2^-11.
  double unit() const { return unit_; }
  const std::vector<SkyLevel>& levels() const { return levels_; }

  // Light (cd/m^2, working space) in a direction (of any length), averaged over about `footprint`
  // radians.  Of a thermal map: at frequency ratio 1.
  WorkingRgb sample(const V3d& direction, double footprint) const;
  // Of a thermal map: {0, kThermalBase} where it is dark.
  ThermalLight sample_thermal(const V3d& direction, double footprint) const;

  std::size_t bytes() const;

 private:
  struct Value {
    float channel[4];  // halves, decoded; without the unit
  };
  static Value bilinear(const SkyLevel& level, int face, double u, double v);
  Value filtered(const V3d& direction, double footprint) const;
  ThermalLight thermal(const Value& value) const;

  SkyMapKind kind_ = SkyMapKind::kColour;
  double unit_ = 1;
  std::vector<SkyLevel> levels_;
  std::shared_ptr<const void> owner_;
};

}  // namespace domefall
