#include "pipeline/show/channel.h"

#include <fmt/format.h>

namespace domefall {

std::string key_of(Channel channel) {
  for (const SkyRegion sky : kEverySky) {
    if (channel == gain_channel(sky)) return fmt::format("sky.{}.gain", kSkyKeys[sky]);
    if (channel == star_gain_channel(sky)) return fmt::format("sky.{}.stars.gain", kSkyKeys[sky]);
    if (channel == max_magnitude_channel(sky))
      return fmt::format("sky.{}.stars.max_magnitude", kSkyKeys[sky]);
  }
  switch (channel) {
    case Channel::kRoll:
      return "roll_deg";
    case Channel::kElevation:
      return "elevation_deg";
    case Channel::kDomeTilt:
      return "dome_tilt_deg";
    case Channel::kFov:
      return "fov_deg";
    // The three colours of a triple share one key.
    case Channel::kSlopeR:
    case Channel::kSlopeG:
    case Channel::kSlopeB:
      return "grade.cdl.slope";
    case Channel::kOffsetR:
    case Channel::kOffsetG:
    case Channel::kOffsetB:
      return "grade.cdl.offset";
    case Channel::kPowerR:
    case Channel::kPowerG:
    case Channel::kPowerB:
      return "grade.cdl.power";
    case Channel::kSaturation:
      return "grade.cdl.saturation";
    // The channels of skies have returned above, so that only kEv is left.
    default:
      return "exposure.ev";
  }
}

}  // namespace domefall
