#include "pipeline/show/channel_values.h"

#include <array>

namespace domefall {

namespace {

// The keys of a sky in a segment, in which those of backgrounds come last.
constexpr std::array<std::string_view, 5> kOutsideKeys{"gain", "stars", "background", "white_cd_m2",
                                                       "black_cd_m2"};
constexpr std::array<std::string_view, 5> kSingularityKeys{"gain", "background", "white_cd_m2",
                                                           "black_cd_m2", "period_m"};

}  // namespace

ChannelValues read_values(const Section& section, bool has_backgrounds) {
  ChannelValues values;
  values[Channel::kEv] = subsection(section, "exposure", {"ev"}).number("ev", kStops);
  const Section sky = subsection(section, "sky", kSkyKeys.values);
  for (const SkyRegion region : {SkyRegion::kI, SkyRegion::kIII}) {
    const Section own =
        subsection(sky, kSkyKeys[region], std::span(kOutsideKeys.data(), has_backgrounds ? 5 : 2));
    const Section stars = subsection(own, "stars", {"max_magnitude", "gain"});
    values[gain_channel(region)] = own.number("gain", kGain);
    values[star_gain_channel(region)] = stars.number("gain", kGain);
    values[max_magnitude_channel(region)] = stars.number("max_magnitude", kMagnitudes);
  }
  values[gain_channel(SkyRegion::kIV)] =
      subsection(sky, kSkyKeys[SkyRegion::kIV],
                 std::span(kSingularityKeys.data(), has_backgrounds ? 5 : 1))
          .number("gain", kGain);
  return values;
}

}  // namespace domefall
