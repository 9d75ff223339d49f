// The numbers of a show that keyframes can change, each a channel with a curve of its own.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

#include "trajectories/sky_region.h"

namespace domefall {

enum class Channel {
  kRoll,  // the camera's, in radians; kFov is for flat projections
  kElevation,
  kDomeTilt,
  kFov,
  kEv,
  kGainI,  // of a sky's background; each triple is in the order of SkyRegion
  kGainIII,
  kGainIV,
  kStarGainI,  // region IV has no stars, so that no show file changes its channels of stars
  kStarGainIII,
  kStarGainIV,
  kMaxMagnitudeI,  // of the faintest stars taken
  kMaxMagnitudeIII,
  kMaxMagnitudeIV
};
inline constexpr std::size_t kChannels = 14;

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

// One value for each channel.
template <class T>
struct PerChannel {
  std::array<T, kChannels> values{};  // in the order of Channel

  constexpr T& operator[](Channel channel) { return values[static_cast<std::size_t>(channel)]; }
  constexpr const T& operator[](Channel channel) const {
    return values[static_cast<std::size_t>(channel)];
  }
};

// What a camera, a segment or a keyframe says of the channels; nothing where it does not name one.
using ChannelValues = PerChannel<std::optional<double>>;

// Puts those of `above` that are given in the place of `below`'s.
inline void lay_over(ChannelValues& below, const ChannelValues& above) {
  for (const Channel channel : kEveryChannel)
    if (above[channel]) below[channel] = above[channel];
}

// The keys of the skies in the section `sky` of show files.
inline constexpr PerSky<std::string_view> kSkyKeys{{"region_I", "region_III", "region_IV"}};

// The key of a channel in show files, with its path for one outside `camera`: "roll_deg",
// "sky.region_I.stars.gain".
std::string key_of(Channel channel);

}  // namespace domefall
