#include <fmt/format.h>

#include <array>
#include <stdexcept>
#include <system_error>

#include "pipeline/show/assets.h"
#include "pipeline/show/file/sections.h"
#include "pipeline/sources/sky/panorama.h"
#include "pipeline/sources/sky/sky_file.h"
#include "pipeline/sources/stars/solar_system.h"
#include "pipeline/sources/stars/star_catalogue.h"

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
  return item.fail("must be " + listed(kWords) + " or an image file, got '" + shown(*text) + "'" +
                   did_you_mean(*text, kWords));
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

// Sets the luminance of an image's value 1.  Other backgrounds have a light of their own.
void read_white(const Item* white, const Section& keys, SkyBackground& background) {
  if (!is_own_image(background)) {
    if (white) white->fail("is the white of an image; this background has its own light, see gain");
    return;
  }
  std::get<PanoramaSky>(background).brightness = keys.number("white_cd_m2") / kPanoramaUnit;
}

// Sets the luminance that is black on a map.  A background that is a formula has no dark level to
// take away.
void read_black(const Item& item, const Section& keys, SkyBackground& background) {
  auto* panorama = std::get_if<PanoramaSky>(&background);
  if (!panorama) {
    item.fail("is the black of a map; the background must be milky_way, a .sky file or an image");
  } else if (is_word(item, "auto")) {
    panorama->black.reset();
  } else if (is_word(item, "none")) {
    panorama->black = 0;
  } else if (const auto level = read_number(item, keys.range("black_cd_m2"))) {
    panorama->black = *level;
  }
}

// Reads the keys of a region's background, which stays where they do not name another.  Region IV
// may be a word alone, `item`.  If the background itself is in error, the keys that depend on it are
// not judged.
void read_background_keys(const Section& keys, const Item* item, SkyRegion region,
                          const Lookup& lookup, SkyBackground& background) {
  const bool singularity = region == SkyRegion::kIV;
  const Item *white = keys.find("white_cd_m2"), *black = keys.find("black_cd_m2");
  const auto found = item ? read_background(*item, lookup, singularity) : std::nullopt;
  const bool failed = item && !found;
  if (found) background = *found;
  if (!failed && (found || white)) read_white(white, keys, background);
  if (black && !failed) read_black(*black, keys, background);
  if (!singularity) return;
  const auto period = keys.given("period_m");
  if (auto* rings = std::get_if<RingsSky>(&background))
    rings->period = period.value_or(rings->period);
  else if (period && !failed)
    keys.find("period_m")->fail("is the period of rings; the background must be rings");
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
  return item.fail(
      "must be standard, naked_eye, deepest, none or a star catalogue (.stars, .csv), got '" +
      shown(*text) + "'" + did_you_mean(*text, kWords));
}

void read_catalogue(const Item& item, const Lookup& lookup, RegionSky& sky) {
  if (item.node.IsScalar()) {
    if (item.node.Scalar() == "none") {
      sky.stars.reset();
    } else if (const auto field = read_catalogue(item, lookup)) {
      sky.stars = *field;
    }
    return;
  }
  const Section section(item, {"sky.catalogue", "sky.light"});
  StarField field = sky.stars.value_or(StarField{});
  const Item* catalogue = section.find("catalogue");
  // A section that names no catalogue keeps that of the region, and has the standard one where
  // there is none.
  if (catalogue || field.catalogue.empty())
    field = (catalogue ? read_catalogue(*catalogue, lookup)
                       : field_of(lookup.shipped(item, kStandardStars), kStandardLimit))
                .value_or(StarField{});
  field.max_magnitude = section.number("max_magnitude", field.max_magnitude);
  sky.star_gain = section.number("gain", sky.star_gain);
  sky.stars = field;
}

void read_region(const Section& section, SkyRegion region, const Lookup& lookup, RegionSky& sky) {
  read_background_keys(section, section.find("background"), region, lookup, sky.background);
  sky.background_gain = section.number("gain", sky.background_gain);
  if (const Item* stars = section.find("stars")) read_catalogue(*stars, lookup, sky);
}

void read_region_four(const Item& item, const Lookup& lookup, RegionSky& sky) {
  const bool word = !item.node.IsMap();
  const Section section(word ? nullptr : &item, {"sky.background", "sky.rings", "sky.gain"});
  read_background_keys(section, word ? &item : section.find("background"), SkyRegion::kIV, lookup,
                       sky.background);
  sky.background_gain = section.number("gain");
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

void read_planets(const Item& item, Show& show) {
  const YearSpan known = years_of(SolarBody::kSun);
  auto& stars = show.sky[SkyRegion::kI].stars;
  if (!show.begins_year) {
    item.fail("needs the show's begins_year, the year in which it begins");
  } else if (*show.begins_year < known.first || *show.begins_year > known.last) {
    item.fail(fmt::format("needs a begins_year from {} to {}, got {}", known.first, known.last,
                          *show.begins_year));
  } else if (!stars) {
    item.fail("needs stars in region_I, among which they are drawn");
  } else {
    stars->planets_year = show.begins_year;
  }
}

}  // namespace

void fail_next_sky(const Item& next, const Spacetime& spacetime) {
  next.fail(spacetime.is<ChargedHole>()
                ? "is the sky beyond a hole, but a naked singularity has no inside to go through"
                : "is the sky beyond a charged hole, through which the next universe is reached; "
                  "give black_hole.charge");
}

void read_sky(const Item& root, const Section& section, Lookup& lookup, Show& show) {
  const Section sky(section.find("sky"), {"sky", "sky.law"});
  for (const SkyRegion region : kExteriorSkies) {
    const Item* given = sky.find(kSkyKeys[region]);
    if (region == SkyRegion::kNext && !show.spacetime.leads_on()) {
      if (given) fail_next_sky(*given, show.spacetime);
      continue;
    }
    const Section own(given, {"sky.gain", "sky.stars", "sky.background"});
    RegionSky read = show.sky[SkyRegion::kI];  // all begin with what region I has
    if (region == SkyRegion::kI) {
      const double star_gain = read.star_gain;  // the point-spread law's default
      read = default_sky(root, own, lookup);
      read.star_gain = star_gain;
    }
    read_region(own, region, lookup, read);
    suit_milky_way(root, lookup, read.stars, read.background);
    show.sky[region] = read;
  }
  if (const Item* four = sky.find(kSkyKeys[SkyRegion::kIV])) {
    if (!show.spacetime.is_flat() && !show.spacetime.is<Schwarzschild>())
      four->fail(
          "is the light of the past singularity, which is seen of holes without charge and spin "
          "only");
    read_region_four(*four, lookup, show.sky[SkyRegion::kIV]);
  }
  show.panorama_shift.blueshift_power = sky.number("blueshift_power");
  show.star_epoch = sky.number("epoch");
  if (sky.flag("planets")) read_planets(*sky.find("planets"), show);
}

void read_segment_background(const Section& keys, SkyRegion region, const Lookup& lookup,
                             const RegionSky& of_show, std::optional<SkyBackground>& background) {
  const Item* given = nullptr;
  for (const char* key : {"background", "white_cd_m2", "black_cd_m2", "period_m"})
    if (const Item* item = keys.find(key)) given = item;
  if (!given) return;
  background = of_show.background;
  read_background_keys(keys, keys.find("background"), region, lookup, *background);
  suit_milky_way(*given, lookup, of_show.stars, *background);
}

}  // namespace domefall
