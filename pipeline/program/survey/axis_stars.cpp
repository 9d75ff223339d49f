#include "pipeline/program/survey/axis_stars.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "pipeline/render/scene/exposure.h"
#include "pipeline/render/scene/frame_scene.h"
#include "pipeline/render/scene/sky_store.h"
#include "pipeline/render/stars/star_image_finder.h"
#include "pipeline/sources/colour/colour_space.h"
#include "pipeline/sources/stars/star_catalogue.h"

namespace domefall {
namespace {

constexpr std::size_t kMostWarnings = 50;
// All images of a star together are amplified by at most kMostPerSine over the sine of the star's
// angle from the axis.  Their blueshift makes them brighter by at most the factor kMostBlueshift.
// Both numbers are larger than any show was seen to need.
constexpr double kMostPerSine = 4, kMostBlueshift = 10;

double magnitudes(double factor) { return 2.5 * std::log10(factor); }

double largest_value(const Show& show, Channel channel, double own) {
  double most = own;
  for (const Segment& segment : show.timeline)
    if (const auto& curve = segment.curves[channel]) most = std::max(most, largest(*curve));
  return most;
}

double largest_gain(const Show& show, SkyRegion region) {
  return std::exp2(largest_value(show, Channel::kEv, show.exposure.ev)) *
         largest_value(show, star_gain_channel(region), show.sky[region].star_gain);
}

double light_of(const std::vector<StarImage>& images, const Projection& projection) {
  double sum = 0;
  for (const StarImage& image : images) {
    const bool inside = image.x > -1 && image.y > -1 &&
                        image.x < static_cast<float>(columns(projection)) &&
                        image.y < static_cast<float>(rows(projection));
    if (inside) sum += luminance({image.rgb[0], image.rgb[1], image.rgb[2]});
  }
  return sum;
}

}  // namespace

AxisStars::AxisStars(const Show& show) : show_(show) {
  if (show.spacetime.is_flat() || !show.effects.lensing ||
      show.effects.amplification == Amplification::kNone)
    return;
  for (const SkyRegion region : kExteriorSkies) read(region);
}

void AxisStars::read(SkyRegion region) {
  const auto& field = show_.sky[region].stars;
  const double gain = largest_gain(show_, region);
  if (!field || !(gain > 0)) return;
  // A star's own disc keeps its light from growing further where the sine is below half of its
  // radius.  Fainter stars than this limit cannot blind and need not be read.
  const double most = 2 * kMostPerSine / show_.least_star_radius * gain * kMostBlueshift;
  const double limit =
      std::min(kBlindingMagnitude + magnitudes(most),
               largest_value(show_, max_magnitude_channel(region), field->max_magnitude));
  StarCatalogue catalogue = read_star_field(*field, limit, show_.star_epoch);
  const SceneStars stars(catalogue.stars);
  std::vector<Class>& classes = stars_[region];
  for (std::size_t k = 0; k < stars.size(); ++k) {
    const SceneStar star = stars[k];
    // Beyond this sine the brightest that the star can be is fainter than kBlindingMagnitude.
    // It solves kMostPerSine/sine gain kMostBlueshift 10^(-0.4 m) = 10^(-0.4 kBlindingMagnitude).
    const double window = kMostPerSine * gain * kMostBlueshift *
                          std::pow(10, 0.4 * (kBlindingMagnitude - star.magnitude));
    // Each class has windows within a factor of 2, and the brightest come first.
    if (classes.empty() || window < classes.back().window / 2) classes.push_back({{}, window});
    classes.back().stars.push_back({star, window});
  }
  for (Class& each : classes)
    std::ranges::sort(each.stars, [](const Candidate& a, const Candidate& b) {
      return a.star.direction.v.z < b.star.direction.v.z;
    });
  names_[region] = std::move(catalogue.names);
}

void AxisStars::add(const FrameState& state) {
  std::erase_if(recent_, [&](std::size_t k) { return passages_[k].last_frame < state.frame - 1; });
  add(state, false);
  if (state.vanishing) add(*state.vanishing, true);
}

// Notes the stars near the axis in one view.  A star may stand near either end of the axis: behind
// the hole, or behind the observer.
void AxisStars::add(const FrameState& state, bool vanishes) {
  const ObserverState& o = state.observer;
  if (is_flat(o)) return;
  const PerSky<bool> seen = seen_skies(o);
  for (const SkyRegion region : kExteriorSkies) {
    if (!seen[region]) continue;
    // The first axis is R, which points away from the hole.
    const V3d behind = -column(sky_axes(o, region), 0);
    for (const Class& each : stars_[region])
      for (const double side : {1.0, -1.0}) {
        const V3d axis = behind * side;
        // Stars within the window have a z within the window of that of the axis, but for the third
        // power of the window, and they are sorted by z.
        auto star = std::partition_point(each.stars.begin(), each.stars.end(), [&](const auto& c) {
          return c.star.direction.v.z < axis.z - each.window;
        });
        for (; star != each.stars.end() && star->star.direction.v.z <= axis.z + each.window;
             ++star) {
          const double sine = star->star.direction.v.cross(axis).length();
          if (sine > star->window || star->star.direction.v.dot(axis) < 0) continue;
          const double least = std::max(show_.least_star_radius, star->star.angular_radius) / 2;
          note({region, &*star, state.frame, state.frame, vanishes,
                star->star.flux / std::max(sine, least) * exposure_scale(state.settings)});
        }
      }
  }
}

void AxisStars::note(const Passage& found) {
  for (const std::size_t k : recent_) {
    Passage& passage = passages_[k];
    if (passage.star != found.star || passage.vanishes != found.vanishes) continue;
    passage.last_frame = found.frame;
    if (found.light > passage.light) passage.frame = found.frame, passage.light = found.light;
    return;
  }
  recent_.push_back(passages_.size());
  passages_.push_back(found);
}

// Returns the magnitude of a star that would be as bright at 0 EV as all images of this one
// together.  Only this star is put into the scene.
double AxisStars::magnitude(const Show& show, const Passage& passage) const {
  const FrameState whole = frame_state(show_, passage.frame);
  const FrameState& state = passage.vanishes ? *whole.vanishing : whole;
  FramePlan plan = plan_frame(show, state);
  for (const SkyRegion region : kEverySky)
    plan.sky[region] = {false, region == passage.region && plan.sky[region].stars, false, nullptr};
  const Sky sky{Black{}, std::make_shared<const SceneStars>(std::vector{passage.star->star}), {}};
  PerSky<const Sky*> skies{};
  skies[passage.region] = &sky;
  const FrameScene scene(show, state, plan, lens_of(state.observer, plan.wanted(), show.effects),
                         skies, {state.sky_turn, 1});
  std::vector<StarImage> images;
  if (plan[passage.region].stars)
    StarImageFinder(scene, passage.region).append(passage.star->star, images);
  // During a dissolve a view shows only its part of the light.
  const double left =
      passage.vanishes ? whole.vanishing_part : 1 - (whole.vanishing ? whole.vanishing_part : 0);
  const double pixel_value = light_of(images, state.projection) * state.fade * left;
  // An image's light is its illuminance times the pixel value of 1 cd/m^2 (star_image.h).  Times
  // the luminance of pixel value 1 at 0 EV it is in lux again, with the exposure still in it.  A
  // star without any light is given 1e-30 of that of magnitude 0, which is magnitude 75.
  return -magnitudes(std::max(pixel_value * kReferenceLuminance / kMagnitudeZeroLux, 1e-30));
}

std::string AxisStars::name_of(const Passage& passage) const {
  constexpr double kSame = 1e-12;  // directions are rounded to floats
  for (const NamedStar& named : names_[passage.region])
    if ((named.direction.v - passage.star->star.direction.v).length2() < kSame) return named.name;
  return fmt::format("a star of V = {:.2g}", passage.star->star.magnitude);
}

std::vector<ShowWarning> AxisStars::warnings() const {
  std::vector<Passage> brightest = passages_;
  std::ranges::sort(brightest, std::ranges::greater(), &Passage::light);
  // More are looked at than may be told, because a passage that is bright by its estimate may turn
  // out not to blind.
  brightest.resize(std::min(brightest.size(), 2 * kMostWarnings));
  std::vector<ShowWarning> found;
  for (const Passage& passage : brightest) {
    const double bright = magnitude(show_, passage);
    if (bright > kBlindingMagnitude || found.size() == kMostWarnings) continue;
    Show dimmed = show_;
    std::string cure =
        "not even with stars.least_radius_deg: 1 would it be dim: lower the stars' "
        "gain, or place the hole elsewhere";
    // The smallest of these radii that dims the star enough is proposed.
    for (const double degrees : {0.01, 0.02, 0.05, 0.1, 0.2, 0.5, 1.0}) {
      dimmed.least_star_radius = degrees * std::numbers::pi / 180;
      if (dimmed.least_star_radius <= show_.least_star_radius ||
          !(magnitude(dimmed, passage) > kBlindingMagnitude))
        continue;
      cure = fmt::format("stars.least_radius_deg: {} dims it", degrees);
      break;
    }
    const FrameState state = frame_state(show_, passage.frame);
    found.push_back({state.show_time_s, passage.frame, state.segment,
                     fmt::format("{} stands straight behind the hole, and its ring blinds like a "
                                 "star of magnitude {:.3g}; {}",
                                 name_of(passage), bright, cure)});
  }
  std::ranges::sort(found, {}, &ShowWarning::frame);
  return found;
}

}  // namespace domefall
