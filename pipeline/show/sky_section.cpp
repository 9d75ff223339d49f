#include "pipeline/show/sky_section.h"

#include <array>
#include <stdexcept>
#include <system_error>

#include "pipeline/show/assets.h"
#include "pipeline/show/channel_values.h"
#include "pipeline/show/nearest_word.h"
#include "pipeline/sky/catalogue/read_star_catalogue.h"
#include "pipeline/sky/make/panorama.h"
#include "pipeline/sky/maps/sky_file.h"

namespace domefall {
namespace {

// Returns the shipped Milky Way.  suit_milky_way() may put the other of its two maps in its place.
std::optional<SkyBackground> milky_way(const Item& item, const Lookup& lookup) {
  if (const auto file = lookup.shipped(item, kMilkyWay)) return PanoramaSky{*file};
  return std::nullopt;
}

// This is the number of stars of V < 10.3.  With more stars than that, the word milky_way means the
// map that has no star of kDeepestStars in it.
constexpr std::size_t kDeepCount = 500'000;

// Returns what `ask` finds in a catalogue's header, or nothing for a damaged one.  The damage is
// reported, with its byte, when the stars are read.
template <class Ask>
auto of_header(const Ask& ask) -> decltype(ask()) {
  try {
    return ask();
  } catch (const std::runtime_error&) {
    return std::nullopt;
  }
}

// Gives a background that is the shipped Milky Way the map that suits the region's stars, so that
// no star is seen both as a star and in the map.
void suit_milky_way(const Item& item, const Lookup& lookup, const std::optional<StarField>& stars,
                    SkyBackground& background) {
  auto* panorama = std::get_if<PanoramaSky>(&background);
  if (!panorama) return;
  // A file of the show's own that bears the same name is left alone.
  const auto name = panorama->image.filename();
  if ((name != kMilkyWay && name != kDeepMilkyWay) ||
      panorama->image != shipped_asset(name.string()))
    return;
  std::size_t count = 0;
  if (stars && !stars->catalogue.empty())
    count = of_header([&] {
              return star_file_count(stars->catalogue, stars->max_magnitude);
            }).value_or(0);
  if (const auto file = lookup.shipped(item, count > kDeepCount ? kDeepMilkyWay : kMilkyWay))
    panorama->image = *file;
}

// Beyond these years a star's motion is no straight line.
constexpr Range kEpochs = Range{"Julian years"}.within(-10000, 30000);
constexpr Range kLuminance = Range{"cd/m^2, or auto, or none"}.within(0, 1e6);
constexpr Range kPeriod = Range{"M"}.within(1e-3, 1e9);
constexpr Range kWhiteLuminance = Range{"cd/m^2"}.above(0).at_most(1e12);
// The white of a show's own image has this luminance (cd/m^2) unless the show says otherwise.  It
// is that of pixel value 1 at 0 EV.
constexpr double kShownWhite = 1e-3;

// Reads a background, which is a word or a file.  Only the past singularity may have rings.
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
  // A text with a dot or a slash is meant as a file, even where there is none.
  const bool looks_like_file = text->find_first_of("./") != std::string::npos;
  if (looks_like_file || lookup.find(*text)) {
    if (const auto file = lookup.file(item, *text)) return PanoramaSky{*file};
    return std::nullopt;
  }
  item.fail("must be " + listed(kWords) + " or an image file, got '" + shown(*text) + "'" +
            did_you_mean(*text, kWords));
  return std::nullopt;
}

// Says whether a background is an image of the show's own, whose values have no unit.  The images
// that come with Domefall have one, and so have .sky files.
bool is_own_image(const SkyBackground& background) {
  const auto* panorama = std::get_if<PanoramaSky>(&background);
  std::error_code error;
  return panorama &&
         !std::filesystem::equivalent(panorama->image.parent_path(), shipped_asset("."), error) &&
         !is_sky_file(panorama->image);
}

// BackgroundKeys hold what a show or a segment says of the background of one region.  Each item may
// be null.
struct BackgroundKeys {
  const Item *background = nullptr, *white = nullptr, *black = nullptr, *period = nullptr;
  bool singularity = false;  // region IV alone may have rings
};

// Sets the luminance of an image's value 1.  Other backgrounds have a light of their own.
void read_white(const Item* white, SkyBackground& background) {
  if (!is_own_image(background)) {
    if (white) white->fail("is the white of an image; this background has its own light, see gain");
    return;
  }
  const auto luminance = white ? read_number(*white, kWhiteLuminance) : std::nullopt;
  std::get<PanoramaSky>(background).brightness = luminance.value_or(kShownWhite) / kPanoramaUnit;
}

// Sets the luminance that is black on a map.  A background that is a formula has no dark level to
// take away.
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

// Reads the keys into a background, which stays where they do not name another.  If the background
// itself is in error, the keys that depend on it are not judged.
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

std::optional<StarField> field_of(const std::optional<std::filesystem::path>& catalogue,
                                  double max_magnitude) {
  if (!catalogue) return std::nullopt;
  return StarField{*catalogue, max_magnitude};
}

// Returns all stars of a .stars file, and of a table those of the limit that a show has without
// one.
std::optional<StarField> whole_field(const std::optional<std::filesystem::path>& catalogue) {
  if (!catalogue) return std::nullopt;
  return field_of(catalogue, of_header([&] {
                               return star_file_faintest(*catalogue);
                             }).value_or(kStandardLimit));
}

// Reads the word or the file of a catalogue, with the faintest magnitude that goes with it.
std::optional<StarField> read_catalogue(const Item& item, const Lookup& lookup) {
  static constexpr std::array<std::string_view, 4> kWords{"standard", "naked_eye", "deepest",
                                                          "none"};
  const auto text = read_text(item);
  if (!text) return std::nullopt;
  if (*text == kWords[0]) return field_of(lookup.shipped(item, kStandardStars), kStandardLimit);
  if (*text == kWords[1]) return field_of(lookup.shipped(item, kStandardStars), kNakedEyeLimit);
  if (*text == kWords[2]) return whole_field(lookup.deepest_stars(item));
  const bool looks_like_file = text->find_first_of("./") != std::string::npos;
  if (looks_like_file || lookup.find(*text)) return whole_field(lookup.file(item, *text));
  item.fail("must be standard, naked_eye, deepest, none or a star catalogue (.stars, .csv), got '" +
            shown(*text) + "'" + did_you_mean(*text, kWords));
  return std::nullopt;
}

// Reads `stars`, which is a catalogue alone or a section, into `sky`.
void read_catalogue(const Item& item, const Lookup& lookup, RegionSky& sky) {
  if (item.node.IsScalar()) {
    if (item.node.Scalar() == "none") {
      sky.stars.reset();
    } else if (const auto field = read_catalogue(item, lookup)) {
      sky.stars = *field;
    }
    return;
  }
  const Section section(item, {"catalogue", "max_magnitude", "gain"});
  StarField field = sky.stars.value_or(StarField{});
  const Item* catalogue = section.find("catalogue");
  // A section that names no catalogue keeps that of the region, and has the standard one where
  // there is none.
  if (catalogue || field.catalogue.empty())
    field = (catalogue ? read_catalogue(*catalogue, lookup)
                       : field_of(lookup.shipped(item, kStandardStars), kStandardLimit))
                .value_or(StarField{});
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
  if (const Item* stars = section.find("stars")) read_catalogue(*stars, lookup, sky);
}

// Reads the sky of the past singularity, which is a background alone, given by a word or a section.
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

// Returns the sky of region I where the show says nothing else.  The shipped files are asked for
// only where the show does not name others.
RegionSky default_sky(const Item& root, const Section& own, const Lookup& lookup) {
  RegionSky sky;
  if (!own.find("background"))
    if (const auto background = milky_way(root, lookup)) sky.background = *background;
  if (!own.find("stars"))
    if (const auto file = lookup.shipped(root, kStandardStars))
      sky.stars = StarField{*file, kStandardLimit};
  return sky;
}

}  // namespace

void read_sky(const Item& root, const Section& section, Lookup& lookup, Show& show) {
  const Section sky = subsection(
      section, "sky", {"region_I", "region_III", "region_IV", "blueshift_power", "epoch"});
  RegionSky before;  // region III begins with what region I has
  for (const SkyRegion region : kExteriorSkies) {
    const Section own = subsection(sky, kSkyKeys[region],
                                   {"background", "gain", "black_cd_m2", "stars", "white_cd_m2"});
    if (region == SkyRegion::kI) {
      const double star_gain = show.sky[region].star_gain;  // the point-spread law's default
      before = default_sky(root, own, lookup);
      before.star_gain = star_gain;
    }
    read_region(own, lookup, before);
    suit_milky_way(root, lookup, before.stars, before.background);
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
    // read_values() has checked the keys of this section, so that they need only be looked at.
    const auto background = peek(*own, "background"), white = peek(*own, "white_cd_m2"),
               black = peek(*own, "black_cd_m2"), period = peek(*own, "period_m");
    if (!background && !white && !black && !period) continue;
    const auto item = [](const std::optional<Item>& found) { return found ? &*found : nullptr; };
    backgrounds[region] = of_show[region].background;
    read_background_keys(
        {item(background), item(white), item(black), item(period), region == SkyRegion::kIV},
        lookup, *backgrounds[region]);
    suit_milky_way(sky, lookup, of_show[region].stars, *backgrounds[region]);
  }
}

}  // namespace domefall
