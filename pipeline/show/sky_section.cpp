#include "pipeline/show/sky_section.h"

#include <array>

#include "pipeline/show/assets.h"
#include "pipeline/show/channel_values.h"
#include "pipeline/show/nearest_word.h"

namespace domefall {
namespace {

std::optional<SkyBackground> milky_way(const Item& item, const Lookup& lookup) {
  if (const auto file = lookup.shipped(item, kMilkyWay)) return PanoramaSky{*file};
  return std::nullopt;
}

// Beyond these years a star's motion is no straight line.
constexpr Range kEpochs = Range{"Julian years"}.within(-10000, 30000);
constexpr Range kPeriod = Range{"M"}.within(1e-3, 1e9);

// Reads a background as a word or as a file.  Only the past singularity may have rings.
std::optional<SkyBackground> read_background(const Item& item, const Lookup& lookup,
                                             bool singularity = false) {
  static constexpr std::array<std::string_view, 4> kAllWords{"milky_way", "grid", "black", "rings"};
  const std::span kWords(kAllWords.data(), singularity ? 4 : 3);
  const auto text = read_text(item);
  if (!text) return std::nullopt;
  if (*text == kWords[0]) return milky_way(item, lookup);
  if (*text == kWords[1]) return GridSky{};
  if (*text == kWords[2]) return BlackSky{};
  if (singularity && *text == kWords[3]) return RingsSky{};
  const bool looks_like_file = text->find_first_of("./") != std::string::npos;
  if (looks_like_file || lookup.find(*text)) {
    if (const auto file = lookup.file(item, *text)) return PanoramaSky{*file};
    return std::nullopt;
  }
  item.fail("must be " + listed(kWords) + " or an image file, got '" + shown(*text) + "'" +
            did_you_mean(*text, kWords));
  return std::nullopt;
}

std::optional<std::filesystem::path> read_catalogue(const Item& item, const Lookup& lookup) {
  static constexpr std::array<std::string_view, 2> kWords{"naked_eye", "none"};
  const auto text = read_text(item);
  if (!text) return std::nullopt;
  if (*text == kWords[0]) return lookup.shipped(item, kNakedEyeStars);
  const bool looks_like_file = text->find_first_of("./") != std::string::npos;
  if (looks_like_file || lookup.find(*text)) return lookup.file(item, *text);
  item.fail("must be naked_eye, none or a star catalogue (.stars, .csv), got '" + shown(*text) +
            "'" + did_you_mean(*text, kWords));
  return std::nullopt;
}

void read_stars(const Item& item, const Lookup& lookup, RegionSky& sky) {
  if (item.node.IsScalar()) {
    if (item.node.Scalar() == "none") {
      sky.stars.reset();
    } else if (const auto file = read_catalogue(item, lookup)) {
      sky.stars = StarField{*file, sky.stars.value_or(StarField{}).max_magnitude};
    }
    return;
  }
  const Section section(item, {"catalogue", "max_magnitude", "gain"});
  StarField field = sky.stars.value_or(StarField{});
  const Item* catalogue = section.find("catalogue");
  if (catalogue || field.catalogue.empty()) {
    const auto file =
        catalogue ? read_catalogue(*catalogue, lookup) : lookup.shipped(item, kNakedEyeStars);
    field.catalogue = file.value_or("");
  }
  field.max_magnitude = section.number("max_magnitude", kMagnitudes, field.max_magnitude);
  sky.star_gain = section.number("gain", kGain, sky.star_gain);
  sky.stars = field;
}

// Reads the sky of region I or III into `sky`, which keeps what the section does not name.
void read_region(const Section& section, const Lookup& lookup, RegionSky& sky) {
  if (const Item* background = section.find("background"))
    if (const auto found = read_background(*background, lookup)) sky.background = *found;
  sky.background_gain = section.number("gain", kGain, sky.background_gain);
  if (const Item* stars = section.find("stars")) read_stars(*stars, lookup, sky);
}

void read_singularity(const Section& section, const Lookup& lookup, RegionSky& sky) {
  sky.background_gain = section.number("gain", kGain, sky.background_gain);
  const Item* background = section.find("background");
  const auto found = background ? read_background(*background, lookup, true) : std::nullopt;
  if (found) sky.background = *found;
  const auto period = section.number("period_m", kPeriod);
  if (auto* rings = std::get_if<RingsSky>(&sky.background))
    rings->period = period.value_or(rings->period);
  else if (period && (found || !background))
    section.find("period_m")->fail("is the period of rings; the background must be rings");
}

// Reads the sky of the past singularity, which is a background alone: a word, or a map.
void read_region_four(const Item& item, const Lookup& lookup, RegionSky& sky) {
  if (item.node.IsMap()) {
    read_singularity(Section(item, {"background", "gain", "period_m"}), lookup, sky);
    return;
  }
  if (const auto found = read_background(item, lookup, true)) sky.background = *found;
}

// The sky of region I where the show says nothing else.  The shipped files are asked for only where
// it does not name others.
RegionSky default_sky(const Item& root, const Section& own, const Lookup& lookup) {
  RegionSky sky;
  if (!own.find("background"))
    if (const auto background = milky_way(root, lookup)) sky.background = *background;
  if (!own.find("stars"))
    if (const auto file = lookup.shipped(root, kNakedEyeStars)) sky.stars = StarField{*file};
  return sky;
}

}  // namespace

void read_sky(const Item& root, const Section& section, Lookup& lookup, Show& show) {
  const Section sky = subsection(
      section, "sky", {"region_I", "region_III", "region_IV", "blueshift_power", "epoch"});
  RegionSky before;  // region III has what region I has, but for what its own section names
  for (const SkyRegion region : {SkyRegion::kI, SkyRegion::kIII}) {
    const Section own = subsection(sky, kSkyKeys[region], {"background", "gain", "stars"});
    if (region == SkyRegion::kI) before = default_sky(root, own, lookup);
    read_region(own, lookup, before);
    show.sky[region] = before;
  }
  if (const Item* four = sky.find(kSkyKeys[SkyRegion::kIV]))
    read_region_four(*four, lookup, show.sky[SkyRegion::kIV]);
  show.panorama_shift.blueshift_power =
      sky.number("blueshift_power", kPureNumber.within(0, 10), show.panorama_shift.blueshift_power);
  show.star_epoch = sky.number("epoch", kEpochs, show.star_epoch);
}

}  // namespace domefall
