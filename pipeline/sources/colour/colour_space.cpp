#include "pipeline/sources/colour/colour_space.h"

#include <Imath/ImathVec.h>

namespace domefall {
namespace {

using Imath::V3d;

V3d multiply(const ColourMatrix& m, const V3d& v) {
  return {m[0][0] * v.x + m[0][1] * v.y + m[0][2] * v.z,
          m[1][0] * v.x + m[1][1] * v.y + m[1][2] * v.z,
          m[2][0] * v.x + m[2][1] * v.y + m[2][2] * v.z};
}

V3d xyz_of(const double (&xy)[2]) { return {xy[0] / xy[1], 1, (1 - xy[0] - xy[1]) / xy[1]}; }

// This is Bradford's cone response (Lam, "Metamerism and colour constancy", 1985).
const ColourMatrix kBradford(0.8951, 0.2664, -0.1614, -0.7502, 1.7135, 0.0367, 0.0389, -0.0685,
                             1.0296);

ColourMatrix adaptation(const double (&from)[2], const double (&to)[2]) {
  const V3d a = multiply(kBradford, xyz_of(from)), b = multiply(kBradford, xyz_of(to));
  const ColourMatrix scale(b.x / a.x, 0, 0, 0, b.y / a.y, 0, 0, 0, b.z / a.z);
  return kBradford.inverse() * scale * kBradford;
}

}  // namespace

// By SMPTE RP 177 the primaries are scaled so that they add up to the white.
ColourMatrix xyz_from_rgb(const RgbPrimaries& space) {
  const V3d r = xyz_of(space.red), g = xyz_of(space.green), b = xyz_of(space.blue);
  const ColourMatrix primaries(r.x, g.x, b.x, r.y, g.y, b.y, r.z, g.z, b.z);
  const V3d scale = multiply(primaries.inverse(), xyz_of(space.white));
  return primaries * ColourMatrix(scale.x, 0, 0, 0, scale.y, 0, 0, 0, scale.z);
}

const ColourMatrix& working_from_xyz() {
  static const ColourMatrix m =
      xyz_from_rgb(kAp1).inverse() * adaptation(kRec709.white, kAp1.white);
  return m;
}

const ColourMatrix& working_from_rec709() {
  static const ColourMatrix m = working_from_xyz() * xyz_from_rgb(kRec709);
  return m;
}

// Rec.709 has the very numbers of working_from_rec709(), which the shipped maps are made with.
ColourMatrix working_from_rgb(const std::array<double, 8>& xy) {
  constexpr std::array<double, 8> kRec709Places{0.640, 0.330, 0.300,  0.600,
                                                0.150, 0.060, 0.3127, 0.3290};
  if (xy == kRec709Places) return working_from_rec709();
  const ColourMatrix primaries(xy[0], xy[2], xy[4], xy[1], xy[3], xy[5], 1 - xy[0] - xy[1],
                               1 - xy[2] - xy[3], 1 - xy[4] - xy[5]);
  const double white[2] = {xy[6], xy[7]};
  const V3d scale = multiply(primaries.inverse(), xyz_of(white));
  return xyz_from_rgb(kAp1).inverse() * adaptation(white, kAp1.white) * primaries *
         ColourMatrix(scale.x, 0, 0, 0, scale.y, 0, 0, 0, scale.z);
}

WorkingRgb to_working(const Xyz& colour) {
  const V3d rgb = multiply(working_from_xyz(), {colour.x, colour.y, colour.z});
  return {static_cast<float>(rgb.x), static_cast<float>(rgb.y), static_cast<float>(rgb.z)};
}

const std::array<float, 3>& luminance_weights() {
  static const std::array<float, 3> weights = [] {
    const ColourMatrix xyz = working_from_xyz().inverse();
    return std::array{static_cast<float>(xyz[1][0]), static_cast<float>(xyz[1][1]),
                      static_cast<float>(xyz[1][2])};
  }();
  return weights;
}

double luminance(const WorkingRgb& c) {
  static const ColourMatrix xyz = working_from_xyz().inverse();
  return xyz[1][0] * c.r + xyz[1][1] * c.g + xyz[1][2] * c.b;
}

}  // namespace domefall
