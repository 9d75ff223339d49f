#include "pipeline/sky/make/microwave_background.h"

#include <algorithm>
#include <cmath>

#include "pipeline/colour/blackbody.h"

namespace domefall {
namespace {

double mean_temperature(const CmbSettings& cmb) { return kCmbTemperature * cmb.redshift; }

// Returns the factor that thins the radiance of a full surface to the luminance of the settings.
double thinning(const CmbSettings& cmb) {
  return cmb.luminance / luminance(blackbody_colours().surface(mean_temperature(cmb)));
}

// The second channel of a thermal map is the radiance times this (SkyMapKind::kThermal).
double theta(double temperature) { return std::log2(temperature / kThermalBase); }

}  // namespace

double cmb_unit(const CmbSettings& cmb) {
  const double hottest = mean_temperature(cmb) * (1 + kCmbLargest);
  // The greater of the two channels of the hottest texel decides.
  const double radiance = thinning(cmb) * blackbody_radiance(hottest);
  return sky_unit(radiance * std::max(1.0, theta(hottest)));
}

void paint_cmb(const HealpixMap& map, SkyFrame frame, const CmbSettings& cmb,
               const SkyPyramid& pyramid) {
  const M33d turn = frame_from_equatorial(frame);
  const double scale = thinning(cmb) / pyramid.unit, mean = mean_temperature(cmb);
  // The map's value times this is contrast dT/2.725 K.
  const double amplified = cmb.contrast * cmb.kelvin / kCmbTemperature;
  const auto painter = [&](const V3d& d, float* channel) {
    // The cut keeps T above 0 and below the hottest place, for which cmb_unit() leaves room.
    const double part = std::clamp(amplified * map.at(apply(turn, d)), -kCmbLargest, kCmbLargest);
    const double t = mean * (1 + part), radiance = scale * blackbody_radiance(t);
    channel[0] = static_cast<float>(radiance);
    channel[1] = static_cast<float>(radiance * theta(t));
  };
  paint(pyramid.levels[0], painter, samples_across(map, pyramid.levels[0]));
}

}  // namespace domefall
