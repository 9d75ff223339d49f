#include "pipeline/sky/make/healpix_sky.h"

#include <algorithm>
#include <cmath>

#include "pipeline/colour/blackbody.h"

namespace domefall {
namespace {

M33d frame_from_equatorial(SkyFrame frame) {
  Orientation o;
  o.frame = frame;
  return picture_from_equatorial(o);
}

// Finer looks for a level that is coarser than the map.
int looks_for(const HealpixMap& map, const SkyPyramid::Level& level) {
  return std::max(healpix_face(map.nside()) / level.size, 1);
}

double mean_temperature(const CmbLook& look) { return kCmbTemperature * look.redshift; }

// What the radiance of a full surface is multiplied by.
double thinning(const CmbLook& look) {
  return look.luminance / luminance(blackbody_colours().surface(mean_temperature(look)));
}

double theta(double temperature) { return std::log2(temperature / kThermalBase); }

}  // namespace

double healpix_unit(const HealpixMap& map, double luminance) {
  return sky_unit(luminance *
                  std::max(0.0f, *std::max_element(map.values().begin(), map.values().end())));
}

void paint_healpix(const HealpixMap& map, SkyFrame frame, double luminance,
                   const SkyPyramid& pyramid) {
  const M33d turn = frame_from_equatorial(frame);
  const double scale = luminance / pyramid.unit;
  const ColourMatrix& m = working_from_rec709();
  const auto painter = [&](const V3d& d, float* channel) {
    const double grey = std::max(map.at(apply(turn, d)), 0.0) * scale;
    for (int k = 0; k < 3; ++k)
      channel[k] = static_cast<float>(grey * (m[k][0] + m[k][1] + m[k][2]));
  };
  paint(pyramid.levels[0], painter, looks_for(map, pyramid.levels[0]));
}

double cmb_unit(const CmbLook& look) {
  const double hottest = mean_temperature(look) * (1 + kCmbLargest);
  const double radiance = thinning(look) * blackbody_radiance(hottest);
  return sky_unit(radiance * std::max(1.0, theta(hottest)));
}

void paint_cmb(const HealpixMap& map, SkyFrame frame, const CmbLook& look,
               const SkyPyramid& pyramid) {
  const M33d turn = frame_from_equatorial(frame);
  const double scale = thinning(look) / pyramid.unit, mean = mean_temperature(look);
  const double amplified = look.contrast * look.kelvin / kCmbTemperature;
  const auto painter = [&](const V3d& d, float* channel) {
    const double part = std::clamp(amplified * map.at(apply(turn, d)), -kCmbLargest, kCmbLargest);
    const double t = mean * (1 + part), radiance = scale * blackbody_radiance(t);
    channel[0] = static_cast<float>(radiance);
    channel[1] = static_cast<float>(radiance * theta(t));
  };
  paint(pyramid.levels[0], painter, looks_for(map, pyramid.levels[0]));
}

}  // namespace domefall
