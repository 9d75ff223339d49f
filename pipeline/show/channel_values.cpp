#include "pipeline/show/channel_values.h"

#include <array>

namespace domefall {

namespace {

// A sky may have these keys in a segment.  The keys of backgrounds come last, since keyframes do
// not have them.
constexpr std::array<std::string_view, 5> kOutsideKeys{"gain", "stars", "background", "white_cd_m2",
                                                       "black_cd_m2"};
constexpr std::array<std::string_view, 5> kSingularityKeys{"gain", "background", "white_cd_m2",
                                                           "black_cd_m2", "period_m"};

// Reads one number for all colours, or a list of red, green and blue.
void read_colours(const Section& cdl, std::string_view key, const Range& range, Channel red,
                  ChannelValues& values) {
  const Item* item = cdl.find(key);
  if (!item) return;
  if (item->node.IsSequence()) {
    if (const auto numbers = read_numbers(*item, 3, range))
      for (std::size_t k = 0; k < 3; ++k) values[colour_channel(red, k)] = (*numbers)[k];
  } else if (const auto number = read_number(*item, range)) {
    for (std::size_t k = 0; k < 3; ++k) values[colour_channel(red, k)] = *number;
  }
}

}  // namespace

void read_cdl(const Section& grade, ChannelValues& values) {
  // The ASC CDL asks for a slope and a saturation of at least 0 and for a power above 0.  The other
  // bounds are those of docs/show-format.md.
  const Section cdl = subsection(grade, "cdl", {"slope", "offset", "power", "saturation"});
  read_colours(cdl, "slope", kPureNumber.within(0, 1e6), Channel::kSlopeR, values);
  read_colours(cdl, "offset", kPureNumber.within(-1e6, 1e6), Channel::kOffsetR, values);
  read_colours(cdl, "power", kPureNumber.above(0).at_most(100), Channel::kPowerR, values);
  values[Channel::kSaturation] = cdl.number("saturation", kPureNumber.within(0, 100));
}

ChannelValues read_values(const Section& section, bool has_backgrounds) {
  ChannelValues values;
  values[Channel::kEv] = subsection(section, "exposure", {"ev"}).number("ev", kStops);
  read_cdl(subsection(section, "grade", {"cdl"}), values);
  const Section sky = subsection(section, "sky", kSkyKeys.values);
  for (const SkyRegion region : kExteriorSkies) {
    // A segment's background is read by read_backgrounds(), but its keys must be known here, or
    // they would be reported.
    const Section own =
        subsection(sky, kSkyKeys[region], std::span(kOutsideKeys.data(), has_backgrounds ? 5 : 2));
    const Section stars = subsection(own, "stars", {"max_magnitude", "gain"});
    values[gain_channel(region)] = own.number("gain", kGain);
    values[star_gain_channel(region)] = stars.number("gain", kGain);
    values[max_magnitude_channel(region)] = stars.number("max_magnitude", kMagnitudes);
  }
  // Region IV has no stars.
  values[gain_channel(SkyRegion::kIV)] =
      subsection(sky, kSkyKeys[SkyRegion::kIV],
                 std::span(kSingularityKeys.data(), has_backgrounds ? 5 : 1))
          .number("gain", kGain);
  return values;
}

}  // namespace domefall
