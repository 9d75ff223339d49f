#include <fmt/format.h>

#include <map>

#include "pipeline/show/file/sections.h"
#include "pipeline/show/file/show_time.h"
#include "pipeline/show/title_text.h"

namespace domefall {
namespace {

constexpr std::size_t kLongestText = 2000;  // bytes

void read_words(const Section& s, const Show& show, Title& title) {
  const Item* item =
      s.find("figure") ? s.find("text") : s.require("text", ", e.g. text: Sagittarius A*");
  const auto text = item ? read_lines(*item) : std::nullopt;
  if (text && text->size() > kLongestText)
    item->fail(fmt::format("may have {} bytes, got {}", kLongestText, text->size()));
  title.text = text.value_or("");
  if (const std::string mistake = counter_mistake(title.text, show); !mistake.empty())
    item->fail(mistake);
  title.style.even_digits = has_counters(title.text);
  title.style.font = s.text("font");
  using enum TextAlign;
  title.style.align = s.word("align", {kLeft, kCentre, kRight});
}

// Reads the light of a title, whose colour is given in linear Rec. 709.
void read_title_light(const Section& s, Title& title) {
  V3d colour(1, 1, 1);
  if (const Item* item = s.find("colour"))
    if (const auto rgb = read_numbers(*item, 3, s.range("colour")))
      colour = {(*rgb)[0], (*rgb)[1], (*rgb)[2]};
  const V3d light = apply(working_from_rec709(), colour * s.number("brightness"));
  title.light = {static_cast<float>(light.x), static_cast<float>(light.y),
                 static_cast<float>(light.z)};
}

// Reads when a title is seen.  A marker in the place of its duration says when it ends.
void read_title_times(const Section& s, const TitleSpan& span, const Show& show, Title& title) {
  // `at_s` counts from the beginning of the span and must leave some of it for the title.
  const double length = span.end_s - span.begin_s;
  const Item* at = s.find("at_s");
  const double begin =
      at ? read_time(*at, s.range("at_s").below(length), show.markers, span.begin_s).value_or(0)
         : 0;
  title.begin_s = span.begin_s + begin;
  const Item* lasts = s.find("duration_s");
  const double duration = lasts ? read_time(*lasts, s.range("duration_s").at_most(length - begin),
                                            show.markers, title.begin_s)
                                      .value_or(length - begin)
                                : length - begin;
  title.end_s = title.begin_s + duration;
  title.fades = read_fades(s);
  check_fades(s, title.fades, duration, "the title");
}

// Reads what a title belongs to on the sky, or which body, which says where it stands.
void read_title_place(const Section& s, const Show& show, Lookup& lookup, Title& title) {
  if (const Item* body = s.find("body")) {
    for (const char* other : {"place", "figure"}) s.one_of({"body", other});
    std::map<std::string, std::size_t, std::less<>> bodies;
    for (std::size_t k = 0; k < show.bodies.size(); ++k) bodies[show.bodies[k].name] = k;
    if (const auto* found = find_named(*body, bodies, "names a body that the show does not have"))
      title.body = *found;
  }
  if (const Item* figure = s.find("figure")) {
    title.figure = lookup.figure(*figure).value_or(SkyFigure());
    // The name of a constellation is that of a place, too: the middle of its figure.
    if (!title.figure.empty() && !s.find("place")) title.place = lookup.place(*figure);
  }
  if (const Item* place = s.find("place")) title.place = read_sky_place(*place, lookup);
  if (title.place || title.body)
    for (const char* key : {"azimuth_deg", "elevation_deg"})
      if (const Item* fixed = s.find(key))
        fixed->fail("is for titles of the dome; this one stands where what it names is seen");
}

Title read_title(const Item& item, const TitleSpan& span, const Show& show, Lookup& lookup) {
  const Section s(item, {"titles"});
  Title title;
  read_words(s, show, title);
  read_title_times(s, span, show, title);
  read_title_place(s, show, lookup, title);
  title.azimuth = s.angle("azimuth_deg");
  // The audience of a dome looks there without leaning back.
  const bool lies = s.find("elevation_deg") || has_zenith(show.projection);
  title.elevation = lies ? s.angle("elevation_deg") : 0;
  title.height = s.angle("height_deg");
  read_title_light(s, title);
  title.plate = s.number("plate");
  title.shadow = s.number("shadow");
  return title;
}

}  // namespace

std::vector<Title> read_titles(const Section& section, const TitleSpan& span, const Show& show,
                               Lookup& lookup) {
  std::vector<Title> titles;
  const Item* list = section.find("titles");
  const auto items = list ? read_list(*list) : std::nullopt;
  if (!items) return titles;
  if (traits_of(show.projection).has_faces && show.draws_titles) {
    list->fail(
        "cannot be drawn on a cubemap, whose faces would cut them; an equirectangular picture "
        "shows them, and draw_titles: false leaves them out");
    return titles;
  }
  titles.reserve(items->size());
  for (const Item& item : *items) titles.push_back(read_title(item, span, show, lookup));
  return titles;
}

}  // namespace domefall
