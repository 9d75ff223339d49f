#include "pipeline/show/titles_section.h"

#include <fmt/format.h>

#include "pipeline/show/lookup.h"
#include "pipeline/show/show_time.h"
#include "pipeline/show/timeline_section.h"

namespace domefall {
namespace {

constexpr Range kTitleSeconds{"seconds"};
// These defaults and bounds are those of docs/show-format.md.
constexpr double kHeightDeg = 2, kMostHeightDeg = 60;
// The audience of a dome looks there without leaning back.
constexpr double kTitleElevationDeg = 30;
constexpr double kBrightest = 1e4;          // pixel value
constexpr std::size_t kLongestText = 2000;  // bytes

// Reads the text of a title and how it is set.
void read_words(const Section& s, Title& title) {
  const Item* item = s.require("text", ", e.g. text: Sagittarius A*");
  const auto text = item ? read_lines(*item) : std::nullopt;
  if (text && text->size() > kLongestText)
    item->fail(fmt::format("may have {} bytes, got {}", kLongestText, text->size()));
  // A title in error stays in the show without a text, so that the rest of it is checked.
  title.text = text.value_or("");
  if (const Item* font = s.find("font")) title.style.font = read_text(*font).value_or("");
  using enum TextAlign;
  title.style.align =
      s.word<TextAlign>("align", {{"left", kLeft}, {"centre", kCentre}, {"right", kRight}})
          .value_or(kCentre);
}

// Reads where a title stands and how large it is, with a default elevation that suits the
// projection.
void read_title_place(const Section& s, const Projection& projection, Title& title) {
  const bool dome = has_zenith(projection);
  title.azimuth = radians(s.number("azimuth_deg", kDegrees.within(-360, 360), 0));
  title.elevation =
      radians(s.number("elevation_deg", kDegrees.within(-90, 90), dome ? kTitleElevationDeg : 0));
  title.height =
      radians(s.number("height_deg", kDegrees.above(0).at_most(kMostHeightDeg), kHeightDeg));
}

// Reads the light of a title, whose colour is given in linear Rec. 709.
void read_title_light(const Section& s, Title& title) {
  const double brightness = s.number("brightness", Range{"pixel values"}.within(0, kBrightest), 1);
  V3d colour(1, 1, 1);
  if (const Item* item = s.find("colour"))
    if (const auto rgb = read_numbers(*item, 3, kPureNumber.within(0, 1)))
      colour = {(*rgb)[0], (*rgb)[1], (*rgb)[2]};
  // Titles are drawn in the working space of frames, before any grading.
  const V3d light = apply(working_from_rec709(), colour * brightness);
  title.light = {static_cast<float>(light.x), static_cast<float>(light.y),
                 static_cast<float>(light.z)};
}

// Reads when a title is seen.  A marker in the place of its duration says when it ends.
void read_title_times(const Section& s, const TitleSpan& span, const Show& show, Title& title) {
  // `at_s` counts from the beginning of the span and must leave some of it for the title.
  const double length = span.end_s - span.begin_s;
  const Item* at = s.find("at_s");
  const double begin =
      at ? read_time(*at, kTitleSeconds.at_least(0).below(length), show.markers, span.begin_s)
               .value_or(0)
         : 0;
  title.begin_s = span.begin_s + begin;
  // By default a title stays to the end of the span.
  const Item* lasts = s.find("duration_s");
  const double duration = lasts ? read_time(*lasts, kTitleSeconds.above(0).at_most(length - begin),
                                            show.markers, title.begin_s)
                                      .value_or(length - begin)
                                : length - begin;
  title.end_s = title.begin_s + duration;
  title.fades = read_fades(s);
  check_fades(s, title.fades, duration, "the title");
}

// Reads one title of the show or of a segment, which is seen within the span.
Title read_title(const Item& item, const TitleSpan& span, const Show& show) {
  const Section s(item, {"text", "at_s", "duration_s", "fade_in_s", "fade_out_s", "azimuth_deg",
                         "elevation_deg", "height_deg", "font", "align", "colour", "brightness"});
  Title title;
  read_words(s, title);
  read_title_times(s, span, show, title);
  read_title_place(s, show.projection, title);
  read_title_light(s, title);
  return title;
}

}  // namespace

std::vector<Title> read_titles(const Section& section, const TitleSpan& span, const Show& show) {
  std::vector<Title> titles;
  const Item* list = section.find("titles");
  const auto items = list ? read_list(*list) : std::nullopt;
  if (!items) return titles;
  if (std::holds_alternative<Cubemap>(show.projection)) {
    list->fail(
        "cannot be drawn on a cubemap, whose faces would cut them; an equirectangular picture "
        "shows them");
    return titles;
  }
  titles.reserve(items->size());
  for (const Item& item : *items) titles.push_back(read_title(item, span, show));
  return titles;
}

}  // namespace domefall
