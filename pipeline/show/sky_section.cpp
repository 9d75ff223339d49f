#include "pipeline/show/sky_section.h"

#include <array>
#include <system_error>

#include "pipeline/show/assets.h"
#include "pipeline/show/channel_values.h"
#include "pipeline/show/nearest_word.h"
#include "pipeline/sky/make/panorama.h"
#include "pipeline/sky/maps/sky_file.h"

namespace domefall {
namespace {

std::optional<SkyBackground> milky_way(const Item& item, const Lookup& lookup) {
  if (const auto file = lookup.shipped(item, kMilkyWay)) return PanoramaSky{*file};
  return std::nullopt;
}

// Beyond these years a star's motion is no straight line.
constexpr Range kEpochs = Range{"Julian years"}.within(-10000, 30000);
constexpr Range kLuminance = Range{"cd/m^2, or auto, or none"}.within(0, 1e6);
constexpr Range kPeriod = Range{"M"}.within(1e-3, 1e9);
constexpr Range kWhite = Range{"cd/m^2"}.above(0).at_most(1e12);
// What the white of a show's own image is unless the show says otherwise: pixel value 1 at 0 EV.
constexpr double kShownWhite = 1e-3;

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

// Whether a background is an image that the show names, whose values have no unit of their own.
bool is_own_image(const SkyBackground& background) {
  const auto* panorama = std::get_if<PanoramaSky>(&background);
  std::error_code error;
  return panorama &&
         !std::filesystem::equivalent(panorama->image, shipped_asset(kMilkyWay), error) &&
         !is_sky_file(panorama->image);
}

// What a show or a segment says of the background of one region.  Each item may be null.
struct BackgroundKeys {
  const Item *background = nullptr, *white = nullptr, *black = nullptr, *period = nullptr;
  bool singularity = false;  // region IV alone may have rings
};

// Sets what the value 1 of an image is.  Other backgrounds have a light of their own.
void read_white(const Item* white, SkyBackground& background) {
  if (!is_own_image(background)) {
    if (white) white->fail("is the white of an image; this background has its own light, see gain");
    return;
  }
  const auto luminance = white ? read_number(*white, kWhite) : std::nullopt;
  std::get<PanoramaSky>(background).brightness = luminance.value_or(kShownWhite) / kPanoramaUnit;
}

// Sets what is black on a map.  Formulas have no floor to take away.
void read_black(const Item& item, SkyBackground& background) {
  auto* panorama = std::get_if<PanoramaSky>(&background);
  if (!panorama) {
    item.fail("is the black of a map; the background must be milky_way, a .sky file or an image");
  } else if (is_word(item, "auto")) {
    panorama->black.reset();
  } else if (is_word(item, "none")) {
    panorama->black = 0;
  } else if (const auto level = read_number(item, kLuminance)) {
    panorama->black = *level;
  }
}

// Reads the keys into a background, which stays where they do not name another.
void read_background_keys(const BackgroundKeys& keys, const Lookup& lookup,
                          SkyBackground& background) {
  const auto found =
      keys.background ? read_background(*keys.background, lookup, keys.singularity) : std::nullopt;
  const bool failed = keys.background && !found;
  if (found) background = *found;
  if (!failed && (found || keys.white)) read_white(keys.white, background);
  if (keys.black && !failed) read_black(*keys.black, background);
  const auto period = keys.period ? read_number(*keys.period, kPeriod) : std::nullopt;
  if (auto* rings = std::get_if<RingsSky>(&background))
    rings->period = period.value_or(rings->period);
  else if (period && !failed)
    keys.period->fail("is the period of rings; the background must be rings");
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
  read_background_keys(
      {section.find("background"), section.find("white_cd_m2"), section.find("black_cd_m2")},
      lookup, sky.background);
  sky.background_gain = section.number("gain", kGain, sky.background_gain);
  if (const Item* stars = section.find("stars")) read_stars(*stars, lookup, sky);
}

// Reads the sky of the past singularity, which is a background alone: a word, or a map.
void read_region_four(const Item& item, const Lookup& lookup, RegionSky& sky) {
  if (!item.node.IsMap()) {
    read_background_keys({&item, nullptr, nullptr, nullptr, true}, lookup, sky.background);
    return;
  }
  const Section section(item, {"background", "gain", "black_cd_m2", "period_m", "white_cd_m2"});
  sky.background_gain = section.number("gain", kGain, sky.background_gain);
  read_background_keys({section.find("background"), section.find("white_cd_m2"),
                        section.find("black_cd_m2"), section.find("period_m"), true},
                       lookup, sky.background);
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
    const Section own = subsection(sky, kSkyKeys[region],
                                   {"background", "gain", "black_cd_m2", "stars", "white_cd_m2"});
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

void read_backgrounds(const Item& sky, const Lookup& lookup, const PerSky<RegionSky>& of_show,
                      PerSky<std::optional<SkyBackground>>& backgrounds) {
  for (const SkyRegion region : kEverySky) {
    const auto own = peek(sky, kSkyKeys[region]);
    if (!own) continue;
    const auto background = peek(*own, "background"), white = peek(*own, "white_cd_m2"),
               black = peek(*own, "black_cd_m2"), period = peek(*own, "period_m");
    if (!background && !white && !black && !period) continue;
    const auto item = [](const std::optional<Item>& found) { return found ? &*found : nullptr; };
    backgrounds[region] = of_show[region].background;
    read_background_keys(
        {item(background), item(white), item(black), item(period), region == SkyRegion::kIV},
        lookup, *backgrounds[region]);
  }
}

}  // namespace domefall
