#include "pipeline/program/survey/sky_survey.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>
#include <numbers>

#include "pipeline/image/read_image.h"
#include "pipeline/sources/sky/sky_file.h"
#include "pipeline/sources/stars/star_catalogue.h"

namespace domefall {
namespace {

// The whole sky has 4 pi steradians of (180/pi)^2 square degrees.
constexpr double kSquareDegrees = 360 * 360 / std::numbers::pi;

// A ShownSky is a background of a region, with the segments that have it.
struct ShownSky {
  SkyRegion region;
  const SkyBackground* background;
  std::vector<int> segments;
  double max_magnitude;  // the deepest that any of them reaches
};

bool segment_sees(const Show& show, const SegmentSurvey& segment, SkyRegion region) {
  if (region == SkyRegion::kIV) return show.spacetime.is<Schwarzschild>();
  return segment.skies[region];
}

// Returns the deepest limit between a segment's first and last instant.  A curve does not exceed
// its keys between them, so only keys and ends are looked at.
double deepest_limit(const Show& show, int segment, SkyRegion region) {
  const Segment& s = segment_of(show, segment);
  const double own = show.sky[region].stars.value_or(StarField{}).max_magnitude;
  const auto& curve = s.curves[max_magnitude_channel(region)];
  if (!curve) return own;
  const double begin = segment_times(show)[static_cast<std::size_t>(segment)],
               end = begin + s.duration_s;
  double deepest = std::max(value_at(*curve, begin), value_at(*curve, end));
  for (const CurveKey& key : curve->keys)
    if (begin <= key.at_s && key.at_s <= end) deepest = std::max(deepest, key.value);
  return deepest;
}

// Returns each background once for each region whose sky it is, with all segments that see it
// there.
std::vector<ShownSky> shown_skies(const Show& show, const ShowSurvey& survey) {
  std::vector<ShownSky> shown;
  for (const SkyRegion region : kEverySky)
    for (std::size_t k = 0; k < survey.segments.size(); ++k) {
      if (!segment_sees(show, survey.segments[k], region)) continue;
      const int segment = static_cast<int>(k);
      const SkyBackground& background = background_of(show, segment, region);
      const double limit = deepest_limit(show, segment, region);
      const auto same = std::find_if(shown.begin(), shown.end(), [&](const ShownSky& s) {
        return s.region == region && *s.background == background;
      });
      if (same == shown.end()) {
        shown.push_back({region, &background, {segment}, limit});
      } else {
        same->segments.push_back(segment);
        same->max_magnitude = std::max(same->max_magnitude, limit);
      }
    }
  return shown;
}

// A Magnitudes object gives the V of a catalogue's stars, ascending.  It reads a file only once.
class Magnitudes {
 public:
  Magnitudes(const Show& show, const std::vector<ShownSky>& shown) {
    // Several skies may use one catalogue to different limits, of which the deepest is read.
    for (const ShownSky& sky : shown)
      if (const auto& stars = show.sky[sky.region].stars)
        limits_[stars->catalogue] = std::max(
            limits_.try_emplace(stars->catalogue, -HUGE_VAL).first->second, sky.max_magnitude);
  }

  const std::vector<float>& of(const std::filesystem::path& catalogue) {
    const auto [known, is_new] = read_.try_emplace(catalogue);
    if (is_new) known->second = star_magnitudes(catalogue, limits_.at(catalogue));
    return known->second;
  }

 private:
  std::map<std::filesystem::path, double> limits_;
  std::map<std::filesystem::path, std::vector<float>> read_;
};

// Returns the files of a sky.  A star is counted twice if it is drawn and is fainter than the limit
// that the map's file states.
SkySources sources_of(const Show& show, const ShownSky& sky, Magnitudes& magnitudes) {
  SkySources found;
  found.region = sky.region;
  found.segments = sky.segments;
  found.panorama = std::get_if<PanoramaSky>(sky.background);
  if (found.panorama) {
    found.map = found.panorama->image.filename().string();
    if (is_sky_file(found.panorama->image))
      found.map_fainter_than = SkyFile(found.panorama->image).origin().fainter_than;
    else
      found.taken = picture_taken(found.panorama->image);
  }
  const auto& stars = show.sky[sky.region].stars;
  if (!stars) return found;
  found.catalogue = stars->catalogue.filename().string();
  found.planets_year = stars->planets_year;
  const std::vector<float>& all = magnitudes.of(stars->catalogue);
  const auto end = std::upper_bound(all.begin(), all.end(), sky.max_magnitude);
  found.stars = static_cast<std::size_t>(end - all.begin());
  if (found.stars == 0) return found;
  found.faintest = *(end - 1);
  if (!found.map_fainter_than) return found;
  // A star of magnitude v is as bright as 10^(0.4 (10 - v)) stars of V = 10.
  for (auto v = std::upper_bound(all.begin(), end, *found.map_fainter_than); v != end; ++v)
    found.twice += std::pow(10, 0.4 * (10 - double{*v})) / kSquareDegrees;
  return found;
}

// Says whether another sky is one of region I, seen from the other side.  Then what is said of region
// I, whose limit is at least as deep, is true of it.
bool is_as_in_region_one(const Show& show, const ShownSky& sky,
                         const std::vector<ShownSky>& shown) {
  if (sky.region == SkyRegion::kI || sky.region == SkyRegion::kIV ||
      show.sky[SkyRegion::kI].stars != show.sky[sky.region].stars)
    return false;
  return std::any_of(shown.begin(), shown.end(), [&](const ShownSky& other) {
    return other.region == SkyRegion::kI && *other.background == *sky.background &&
           other.max_magnitude >= sky.max_magnitude;
  });
}

}  // namespace

std::vector<SkySources> survey_skies(const Show& show, const ShowSurvey& survey) {
  const std::vector<ShownSky> shown = shown_skies(show, survey);
  Magnitudes magnitudes(show, shown);
  std::vector<SkySources> found;
  for (const ShownSky& sky : shown) {
    if (is_as_in_region_one(show, sky, shown)) continue;
    if (sky.region == SkyRegion::kIV && !std::holds_alternative<PanoramaSky>(*sky.background))
      continue;
    found.push_back(sources_of(show, sky, magnitudes));
    found.back().throughout = 1 == std::count_if(shown.begin(), shown.end(), [&](const auto& s) {
                                return s.region == sky.region;
                              });
  }
  return found;
}

// Segments count from 1 for users.
std::string segments_text(const SkySources& s) {
  if (s.throughout) return "";
  std::vector<int> numbers = s.segments;
  for (int& number : numbers) ++number;
  return fmt::format(", in segment{} {}", numbers.size() == 1 ? "" : "s", fmt::join(numbers, ", "));
}

std::string counted_twice_text(const SkySources& s) {
  return fmt::format(
      "the stars of {} from V = {:g} to {:.4g} are seen twice{}: as stars, and in {}, which holds "
      "the light of stars fainter than {:g}; give max_magnitude: {:g}, or another map",
      s.catalogue, *s.map_fainter_than, s.faintest, segments_text(s), s.map, *s.map_fainter_than,
      *s.map_fainter_than);
}

}  // namespace domefall
