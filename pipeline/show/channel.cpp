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
    default:
      return "exposure.ev";
  }
}

}  // namespace domefall
