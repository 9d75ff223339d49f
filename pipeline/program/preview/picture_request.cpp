#include "pipeline/program/preview/picture_request.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <iterator>

#include "pipeline/base/errors.h"
#include "pipeline/show/nearest_word.h"
#include "pipeline/show/show.h"
#include "trajectories/degree.h"

namespace domefall {
namespace {

class Query {
 public:
  explicit Query(const Parameters& parameters) : parameters_(parameters) {}

  std::optional<std::string> text(std::string_view name) const { return parameters_(name); }

  template <class Number>
  Number number(std::string_view name, Number least, Number most, Number usual) const {
    const std::optional<std::string> given = parameters_(name);
    if (!given) return usual;
    Number value{};
    const char* end = given->data() + given->size();
    const auto read = std::from_chars(given->data(), end, value);
    if (read.ec != std::errc{} || read.ptr != end || !(value >= least && value <= most))
      throw InputError(fmt::format("{} must be a number from {} to {}, got {}", name, least, most,
                                   shown(*given)));
    return value;
  }

  std::vector<std::string> list(std::string_view name) const {
    std::vector<std::string> words;
    const std::string given = parameters_(name).value_or("");
    for (std::size_t at = 0; at < given.size();) {
      const std::size_t comma = std::min(given.find(',', at), given.size());
      words.push_back(given.substr(at, comma - at));
      at = comma + 1;
    }
    return words;
  }

 private:
  const Parameters& parameters_;
};

[[noreturn]] void refuse(std::string_view name, const std::string& word, std::string_view known) {
  throw InputError(fmt::format("{} has no '{}'; it has {}", name, shown(word), known));
}

Projection projection_of(const Query& query) {
  const int width = query.number("w", kLeastSide, kMostSide, 960),
            height = query.number("h", kLeastSide, kMostSide, 540);
  const std::string name =
      query.text("projection").value_or(std::string(Stereographic::kTraits.name));
  std::vector<std::string_view> names;
  for (const Projection& usual : kUsualProjections) {
    const ProjectionTraits& traits = traits_of(usual);
    names.push_back(traits.name);
    if (name != traits.name) continue;
    const int most_deg = traits.below_widest ? 340 : static_cast<int>(traits.widest_deg);
    const Projection seen =
        most_deg == 0 ? usual
                      : with_field_of_view(
                            usual, query.number("fov", 1e-5, double(most_deg), 100.0) * kDegree);
    return with_sides(seen, std::max(width, kLeastSide * traits.in_width), height);
  }
  refuse("projection", name, fmt::format("{}", fmt::join(names, ", ")));
}

std::optional<ScreenLook> look_of(const Query& query) {
  if (!query.text("look")) return std::nullopt;
  const std::vector<std::string> words = query.list("look");
  if (words.size() != 3) throw InputError("look must be azimuth,altitude,roll in degrees");
  std::array<double, 3> angles{};
  for (std::size_t k = 0; k < 3; ++k) {
    const Parameters only = [&](std::string_view) { return words[k]; };
    angles[k] = Query(only).number("look", -3600.0, 3600.0, 0.0);
  }
  return ScreenLook{angles[0], angles[1], angles[2]};
}

std::optional<Effects> chosen_effects(const Query& query, const Effects& shows) {
  if (!query.text("effects") && !query.text("amplification")) return std::nullopt;
  Effects effects = shows;
  if (query.text("effects")) {
    for (const auto& [name, effect] : kEffectSwitches) effects.*effect = false;
    for (const std::string& word : query.list("effects")) {
      const auto known =
          std::ranges::find(kEffectSwitches, word, [](const auto& each) { return each.first; });
      if (known == kEffectSwitches.end())
        refuse("effects", word, "aberration, doppler_colour, intensity and lensing");
      effects.*known->second = true;
    }
  }
  if (const auto word = query.text("amplification")) {
    const auto known =
        std::ranges::find(kAmplifications, *word, [](const auto& each) { return each.first; });
    if (known == std::end(kAmplifications))
      refuse("amplification", *word, "none, stars and everything");
    effects.amplification = known->second;
  }
  return effects;
}

PerSky<bool> skies_of(const Query& query) {
  PerSky<bool> skies;
  for (const SkyRegion sky : kEverySky) skies[sky] = !query.text("skies");
  for (const std::string& word : query.list("skies")) {
    const auto named = std::find_if(kEverySky.begin(), kEverySky.end(),
                                    [&](SkyRegion sky) { return word == name_of(sky); });
    if (named == kEverySky.end()) refuse("skies", word, "I, III, IV and next");
    skies[*named] = true;
  }
  return skies;
}

}  // namespace

PictureRequest read_request(const Parameters& parameters, const Show& show) {
  const Query query(parameters);
  PictureRequest request;
  request.frame = std::min(query.number("frame", 0, kMostFrames, 0), frame_count(show) - 1);
  request.projection = projection_of(query);
  request.look = look_of(query);
  request.ev = query.number("ev", -40.0, 40.0, 0.0);
  request.display = query.text("display").value_or("");
  request.view = query.text("view").value_or("");
  request.effects = chosen_effects(query, show.effects);
  request.skies = skies_of(query);
  request.stars = query.number("stars", 0, 1, 1) != 0;
  if (const auto names = query.text("overlays"); names && !names->empty())
    request.overlays = parse_overlays(*names);
  const std::string detail = query.text("detail").value_or("still");
  if (detail != "moving" && detail != "still") refuse("detail", detail, "moving and still");
  request.moving = detail == "moving";
  return request;
}

}  // namespace domefall
