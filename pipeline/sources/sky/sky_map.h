// A sky map is a panorama as the renderer samples it: six square faces of a cube with a mip chain.
// A sample costs no trigonometry, meets no pole and no seam, and is filtered by its footprint.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include "pipeline/sources/colour/colour_space.h"
#include "trajectories/directions.h"

namespace domefall {

// A texel holds four channels, as IEEE binary16 numbers.  None is negative, infinite, NaN or subnormal.
struct SkyTexel {
  std::uint16_t channel[4];
};

// Returns the half that is nearest to a value from 0 to 65504.  It is 0 where that half would be
// subnormal (below 2^-14).
std::uint16_t half_bits(float value);
float half_value(std::uint16_t bits);

// The kind says what the channels of a texel hold, in units of SkyMap::unit().
enum class SkyMapKind : std::uint32_t {
  // The channels are r, g and b of the working space, and 0.
  kColour = 0,
  // The channels are I, I theta, 0 and 0.  They describe blackbody light of the bolometric radiance
  // I, which is sigma T^4/pi for a full surface, and of theta = log2(T/kThermalBase).  Both I and I
  // theta add up when light is added, so a filter gives the radiance and the mean of log T weighted
  // by it.
  kThermal = 1,
};

// Every temperature of a map exceeds this one (kelvin), so that theta > 0.
inline constexpr double kThermalBase = 256;

// No map has a level that is finer than this number of texels along an edge of a face.
inline constexpr int kLargestFace = 8192;

// A level has six faces (cube_face.h) of (size + 2)^2 texels, row by row.  A border of one texel
// around each face serves samples between the outermost texels of two faces.
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

// This is blackbody light of a temperature (K) and of a bolometric radiance (W/m^2/sr), which is
// less than that of a full surface.  At a frequency ratio g its colour is
// BlackbodyColours::per_flux(g temperature) times radiance g^4.
struct ThermalLight {
  double radiance, temperature;
};

class SkyMap {
 public:
  // The sizes of the levels are powers of two, each half of the one before, down to 1.  `owner`
  // keeps the texels alive.
  SkyMap(SkyMapKind kind, double unit, std::vector<SkyLevel> levels,
         std::shared_ptr<const void> owner);

  SkyMapKind kind() const { return kind_; }
  // The unit is the light that a half of value 1 stands for, in cd/m^2 (kColour) or W/m^2/sr
  // (kThermal).  sky_unit() makes the brightest texel 2^13 to 2^14.  The smallest normal half is
  // 2^-14, so that light down to 2^-27 of the brightest is kept, to a half's precision of 2^-11.
  double unit() const { return unit_; }
  const std::vector<SkyLevel>& levels() const { return levels_; }
  // Returns the map without the levels that have more than `size` texels along an edge of a face,
  // but keeps at least one level.
  SkyMap without_levels_above(int size) const;

  // Returns the light (cd/m^2, working space) in a direction of any length, averaged over about
  // `footprint` radians.  The light of a thermal map is that at frequency ratio 1.
  WorkingRgb sample(const V3d& direction, double footprint) const;
  // Returns the light of a thermal map before it becomes a colour.  It is {0, kThermalBase} where
  // the map is dark.
  ThermalLight sample_thermal(const V3d& direction, double footprint) const;

  std::size_t bytes() const;

 private:
  struct Value {
    float channel[4];  // those of texels, not yet multiplied by the unit
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
