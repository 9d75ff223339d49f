// A Channel is a number of a show that keyframes can change, each along a curve of its own.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

#include "pipeline/grade/grade_settings.h"
#include "pipeline/spacetime/regions.h"

namespace domefall {

enum class Channel {
  kRoll,  // the camera's, in radians; kFov is for fisheyes and flat projections
  kElevation,
  kDomeTilt,
  kFov,
  kEv,
  kGainI,  // of a sky's background; each four are in the order of SkyRegion
  kGainIII,
  kGainIV,
  kGainNext,
  kStarGainI,  // region IV has no stars, so that no show file changes its channels of stars
  kStarGainIII,
  kStarGainIV,
  kStarGainNext,
  kMaxMagnitudeI,  // of the faintest stars taken
  kMaxMagnitudeIII,
  kMaxMagnitudeIV,
  kMaxMagnitudeNext,
  kDiscLuminance,
  kDiscOpacity,
  kTitleGain,  // of all titles
  kTitleOpacity,
  kSlopeR,  // of the CDL; each triple is red, green and blue
  kSlopeG,
  kSlopeB,
  kOffsetR,
  kOffsetG,
  kOffsetB,
  kPowerR,
  kPowerG,
  kPowerB,
  kSaturation
};
inline constexpr std::size_t kChannels = 31;

inline constexpr std::array<Channel, kChannels> kEveryChannel = [] {
  std::array<Channel, kChannels> all{};
  for (std::size_t k = 0; k < kChannels; ++k) all[k] = static_cast<Channel>(k);
  return all;
}();

constexpr Channel gain_channel(SkyRegion sky) {
  return kEveryChannel[static_cast<std::size_t>(Channel::kGainI) + static_cast<std::size_t>(sky)];
}
constexpr Channel star_gain_channel(SkyRegion sky) {
  return kEveryChannel[static_cast<std::size_t>(Channel::kStarGainI) +
                       static_cast<std::size_t>(sky)];
}
constexpr Channel max_magnitude_channel(SkyRegion sky) {
  return kEveryChannel[static_cast<std::size_t>(Channel::kMaxMagnitudeI) +
                       static_cast<std::size_t>(sky)];
}

// Returns the channel of red, green or blue (0, 1, 2) in that triple of the CDL which begins with
// `red`.
constexpr Channel colour_channel(Channel red, std::size_t colour) {
  return kEveryChannel[static_cast<std::size_t>(red) + colour];
}

// A PerChannel holds one value for each channel.
template <class T>
struct PerChannel {
  std::array<T, kChannels> values{};  // in the order of Channel

  constexpr T& operator[](Channel channel) { return values[static_cast<std::size_t>(channel)]; }
  constexpr const T& operator[](Channel channel) const {
    return values[static_cast<std::size_t>(channel)];
  }
};

// ChannelValues hold what a camera, a segment or a keyframe says of the channels, and nothing for a
// channel that it does not name.
using ChannelValues = PerChannel<std::optional<double>>;

// Puts the values that `above` gives in the place of those of `below`.
inline void lay_over(ChannelValues& below, const ChannelValues& above) {
  for (const Channel channel : kEveryChannel)
    if (above[channel]) below[channel] = above[channel];
}

// Returns the CDL whose numbers value(channel, neutral) gives, where `neutral` is the number that
// leaves a picture as it is.
template <class Value>
Cdl cdl_from(const Value& value) {
  Cdl cdl;
  for (std::size_t k = 0; k < 3; ++k) {
    cdl.slope[k] = value(colour_channel(Channel::kSlopeR, k), 1.0);
    cdl.offset[k] = value(colour_channel(Channel::kOffsetR, k), 0.0);
    cdl.power[k] = value(colour_channel(Channel::kPowerR, k), 1.0);
  }
  cdl.saturation = value(Channel::kSaturation, 1.0);
  return cdl;
}

// Each sky has a key of its own in the section `sky` of show files.
inline constexpr PerSky<std::string_view> kSkyKeys{{"region_I", "region_III", "region_IV", "next"}};

// Returns the key of a channel in show files, such as "roll_deg".  The key of a channel outside
// `camera` is a whole path, and the colours of a triple share one.
inline std::string key_of(Channel channel) {
  constexpr std::array<std::string_view, kChannels> kKeys{"roll_deg",
                                                          "elevation_deg",
                                                          "dome_tilt_deg",
                                                          "fov_deg",
                                                          "exposure.ev",
                                                          "sky.region_I.gain",
                                                          "sky.region_III.gain",
                                                          "sky.region_IV.gain",
                                                          "sky.next.gain",
                                                          "sky.region_I.stars.gain",
                                                          "sky.region_III.stars.gain",
                                                          "sky.region_IV.stars.gain",
                                                          "sky.next.stars.gain",
                                                          "sky.region_I.stars.max_magnitude",
                                                          "sky.region_III.stars.max_magnitude",
                                                          "sky.region_IV.stars.max_magnitude",
                                                          "sky.next.stars.max_magnitude",
                                                          "disc.luminance_cd_m2",
                                                          "disc.opacity",
                                                          "title_light.gain",
                                                          "title_light.opacity",
                                                          "grade.cdl.slope",
                                                          "grade.cdl.slope",
                                                          "grade.cdl.slope",
                                                          "grade.cdl.offset",
                                                          "grade.cdl.offset",
                                                          "grade.cdl.offset",
                                                          "grade.cdl.power",
                                                          "grade.cdl.power",
                                                          "grade.cdl.power",
                                                          "grade.cdl.saturation"};
  return std::string(kKeys[static_cast<std::size_t>(channel)]);
}

}  // namespace domefall
