#include "pipeline/render/overlay/star_labels.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <tuple>

#include "pipeline/base/lettering.h"
#include "pipeline/render/overlay/bent_text.h"
#include "pipeline/render/overlay/coverage.h"
#include "pipeline/render/overlay/frame_marks.h"
#include "pipeline/render/overlay/stroke.h"
#include "pipeline/render/scene/body_covers.h"
#include "pipeline/render/scene/body_sight.h"
#include "pipeline/render/scene/point_spread.h"
#include "pipeline/render/scene/seen_magnitude.h"
#include "pipeline/render/scene/star_light.h"
#include "pipeline/render/scene/star_sight.h"
#include "pipeline/show/show.h"
#include "pipeline/sources/stars/star_catalogue.h"

namespace domefall {
namespace {

// The capitals of names are this part of the shorter side high, and at least kLeastLabel pixels.
constexpr double kLabelPart = 1. / 120, kLeastLabel = 7;
// These are the radius of the ring around an image and the distance from the image to its name, in
// heights of a capital.
constexpr double kRing = 0.8, kGap = 1.2;

// Takes all these places, as discs of a radius, if none of them is taken yet.  Says whether it did.
bool take(const std::vector<ImagePoint>& places, double radius, std::vector<ImagePoint>& taken) {
  for (const ImagePoint& p : places)
    for (const ImagePoint& q : taken)
      if (std::hypot(p.x - q.x, p.y - q.y) < 2 * radius) return false;
  taken.insert(taken.end(), places.begin(), places.end());
  return true;
}

// Returns places on the screen from a star's image to the end of its name, or nothing if the name is
// not wholly in the frame.
std::optional<std::vector<ImagePoint>> places_of_label(const TextSurface& surface, double length,
                                                       const Projection& projection) {
  const ScreenSides side = screen_sides(projection);
  std::vector<ImagePoint> places;
  for (double x = 0; x < length + 1; ++x) {
    const auto pixel = pixel_of(projection, surface.direction({std::min(x, length), 0}));
    if (!pixel || !is_in_image(projection, *pixel)) return std::nullopt;
    const ImagePoint at = image_point(*pixel);
    places.push_back({at.x * side.x, at.y * side.y});
  }
  return places;
}

NamedImage named_image(const std::string& name, int order, const CameraDirection& direction,
                       double magnitude) {
  return {name + (order > 0 ? "\u2032" : ""), order > 0, direction, magnitude};
}

double left_of(const LightLeft& left, const CameraDirection& from, double psi) {
  return left ? left(from, psi) : 1;
}

// Appends the first two images of each body, as for a star.
void append_bodies(const Show& show, const std::vector<Body>& bodies, const BodySight& sight,
                   const BodyCovers& covers, const LightLeft& left,
                   std::vector<NamedImage>& found) {
  if (!sight.sees()) return;
  for (const Body& body : bodies)
    for (int order = 0; order < 2; ++order)
      if (const auto image = sight.image(body, order)) {
        const BodySight::Seen seen = sight.seen(image->at);
        const double part = left_of(left, seen.direction, image->traced.way()) *
                            covers.left_before(seen.direction, sight.far(body, image->traced));
        const double magnitude = seen_magnitude(show.effects, body.magnitude, body.temperature,
                                                seen.brightening * part, seen.frequency_ratio);
        if (magnitude <= kFaintestNamedImage)
          found.push_back(named_image(body.name, order, seen.direction, magnitude));
      }
}

}  // namespace

LetterStyle label_style() { return {"Sans", TextAlign::kLeft}; }

// The map keeps the first name of each star, which is its proper name if it has one.
const std::vector<StarLabels::NamedStarOfSky>& StarLabels::stars_of(SkyRegion sky) {
  auto& named = stars_[sky];
  if (named) return *named;
  named.emplace();
  const auto& field = show_.sky[sky].stars;
  if (!field) return *named;
  const StarCatalogue catalogue = read_star_field(*field, kFaintestNamed, show_.star_epoch);
  const auto key = [](const SkyDirection& d) { return std::tuple(d.v.x, d.v.y, d.v.z); };
  std::map<std::tuple<double, double, double>, std::string> names;
  for (const NamedStar& name : catalogue.names) names.emplace(key(name.direction), name.name);
  for (const Star& star : catalogue.stars)
    if (const auto name = names.find(key(star.direction)); name != names.end())
      named->push_back({name->second, star.direction, star.v_magnitude, star.temperature});
  return *named;
}

std::vector<NamedImage> StarLabels::images(const FrameState& state, const LightLeft& left) {
  std::vector<NamedImage> found;
  const StarSight finder(state, show_.effects);
  const std::vector<Body> bodies = bodies_at(show_, state.settings);
  const BodySight sight(state, show_.effects, show_.least_star_radius);
  const BodyCovers covers(sight, bodies,
                          PointSpread(show_.point_spread, state.projection, 1).least());
  for (const SkyRegion sky : kExteriorSkies) {
    if (!finder.sees(sky)) continue;
    const FrameSettings::Sky& settings = state.settings.sky[sky];
    const double gain = settings.star_gain / default_star_gain(show_.point_spread);
    for (const NamedStarOfSky& star : stars_of(sky)) {
      const double drawn = gain * part_within_limit(settings, star.magnitude);
      if (!(drawn > 0)) break;  // the stars that follow are fainter
      for (int order = 0; order < std::min(finder.orders(), 2); ++order) {
        const StarSight::Image image = finder.image(sky, star.direction, order);
        const auto seen_v = [&](double part) {
          return seen_magnitude(show_.effects, star.magnitude, star.temperature,
                                part * drawn * image.brightening, image.frequency_ratio);
        };
        if (!(seen_v(1) <= kFaintestNamedImage)) continue;
        const double magnitude = seen_v(left_of(left, image.direction, HUGE_VAL) *
                                        covers.left_before(image.direction, HUGE_VAL));
        if (!(magnitude <= kFaintestNamedImage)) continue;
        found.push_back(named_image(star.name, order, image.direction, magnitude));
      }
    }
  }
  append_bodies(show_, bodies, sight, covers, left, found);
  std::ranges::stable_sort(found, {}, &NamedImage::magnitude);
  return found;
}

// The ring and the name lie on the surface of a text that has the image in its middle.
void StarLabels::draw(const FrameState& state, const FrameRef& frame, const LightLeft& left) {
  const Projection& projection = state.projection;
  // In the longer side of a pixel, of which pixel_angle() is the angle.
  const double letter = std::max(kLeastLabel, kLabelPart * shorter_side(projection));
  std::vector<ImagePoint> taken;  // by names, as discs along them
  Coverage primary(frame.width, frame.height), secondary(frame.width, frame.height);
  for (const NamedImage& image : images(state, left)) {
    const auto pixel = pixel_of(projection, image.direction);
    if (!pixel || !is_in_image(projection, *pixel)) continue;
    const LetteredText text = lettered(image.name, label_style());
    const TextSurface surface = TextSurface::at(state.camera_from_audience, image.direction,
                                                letter * pixel_angle(projection, *pixel));
    const auto along = places_of_label(surface, kGap + 2 * text.half_width, projection);
    if (!along || !take(*along, kRing * letter, taken)) continue;
    Coverage& coverage = image.secondary ? secondary : primary;
    add_text(text, surface, {kGap + text.half_width, 0}, projection, coverage);
    add_curve(
        [&](double part) {
          const double t = 2 * std::numbers::pi * part;
          return surface.direction({kRing * std::cos(t), kRing * std::sin(t)}).v;
        },
        true, mark_width(projection), projection, coverage);
  }
  constexpr double kPrimary = 0.9, kSecondary = 0.45;
  draw_over(primary, {{1, 1, 1}, kPrimary}, projection, frame);
  draw_over(secondary, {{1, 1, 1}, kSecondary}, projection, frame);
}

}  // namespace domefall
