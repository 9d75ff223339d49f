#include "pipeline/show/values_section.h"

namespace domefall {
namespace {

struct RegionChannels {
  std::string_view key;
  Channel gain, star_gain, max_magnitude;
};
constexpr std::array<RegionChannels, 2> kRegions{{
    {"region_I", Channel::kGainOne, Channel::kStarGainOne, Channel::kMagnitudeOne},
    {"region_III", Channel::kGainThree, Channel::kStarGainThree, Channel::kMagnitudeThree},
}};

}  // namespace

ChannelValues read_values(const Section& section) {
  ChannelValues values;
  const auto set = [&values](Channel channel, std::optional<double> value) {
    values[static_cast<std::size_t>(channel)] = value;
  };
  set(Channel::kEv, subsection(section, "exposure", {"ev"}).number("ev", kStops));
  const Section sky = subsection(section, "sky", {"region_I", "region_III", "region_IV"});
  for (const RegionChannels& region : kRegions) {
    const Section own = subsection(sky, region.key, {"gain", "stars"});
    const Section stars = subsection(own, "stars", {"max_magnitude", "gain"});
    set(region.gain, own.number("gain", kGain));
    set(region.star_gain, stars.number("gain", kGain));
    set(region.max_magnitude, stars.number("max_magnitude", kMagnitudes));
  }
  set(Channel::kGainFour, subsection(sky, "region_IV", {"gain"}).number("gain", kGain));
  return values;
}

}  // namespace domefall
