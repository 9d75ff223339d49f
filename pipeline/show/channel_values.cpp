#include "pipeline/show/channel_values.h"

namespace domefall {

ChannelValues read_values(const Section& section) {
  ChannelValues values;
  values[Channel::kEv] = subsection(section, "exposure", {"ev"}).number("ev", kStops);
  const Section sky = subsection(section, "sky", kSkyKeys.values);
  for (const SkyRegion region : {SkyRegion::kI, SkyRegion::kIII}) {
    const Section own = subsection(sky, kSkyKeys[region], {"gain", "stars"});
    const Section stars = subsection(own, "stars", {"max_magnitude", "gain"});
    values[gain_channel(region)] = own.number("gain", kGain);
    values[star_gain_channel(region)] = stars.number("gain", kGain);
    values[max_magnitude_channel(region)] = stars.number("max_magnitude", kMagnitudes);
  }
  values[gain_channel(SkyRegion::kIV)] =
      subsection(sky, kSkyKeys[SkyRegion::kIV], {"gain"}).number("gain", kGain);
  return values;
}

}  // namespace domefall
