#include "pipeline/program/survey/body_motion.h"

#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <set>
#include <utility>

#include "pipeline/render/frame_bodies.h"
#include "pipeline/render/overlay/coverage.h"
#include "pipeline/render/scene/body_sight.h"
#include "pipeline/render/scene/frame_scene.h"
#include "pipeline/show/frame_state.h"
#include "pipeline/show/observer_track.h"
#include "pipeline/sources/colour/colour_space.h"

namespace domefall {
namespace {

// About a hole that spins each takes up to a second.
constexpr int kMostSightings = 5000, kMostSightingsAboutSpin = 16;
// Between keyframed targets a camera turns smoothly, and each of its states takes milliseconds.
constexpr int kWithinTurns = 10;

// A Sighting is what one frame sees of one body.
struct Sighting {
  bool visible = false;  // whether the direct image is in the picture and bright enough
  V3d direction{0, 0, 0};
  double pixel_angle = 0;
  // The component of its direction from the hole across the axis of the lens.
  V3d off_axis{0, 0, 0};
  bool is_behind = false;
};

struct Sightings {
  int segment = -1;  // -1 where no frame is
  std::vector<Sighting> bodies{};
};

Sighting sighting(const BodySight& sight, const FrameState& state, const Body& body) {
  Sighting found;
  const auto direct = sight.image(body, 0);
  if (!direct) return found;
  found.is_behind = direct->traced.psi > std::numbers::pi / 2;
  found.off_axis = direct->traced.across * std::sin(direct->traced.psi);
  const BodySight::Seen seen = sight.seen(direct->at);
  const auto pixel = pixel_of(state.projection, seen.direction);
  found.visible = pixel && is_in_image(state.projection, *pixel) &&
                  is_bright(body.magnitude, seen.brightening, state.settings);
  found.direction = seen.direction.v;
  if (found.visible) found.pixel_angle = pixel_angle(state.projection, *pixel);
  return found;
}

Sightings sightings(const Show& show, int frame) {
  if (frame < 0 || frame >= frame_count(show)) return {};
  const FrameState state = frame_state(show, frame);
  Sightings found{state.segment};
  const BodySight sight(state, show.effects, show.least_star_radius);
  if (!sight.sees()) return found;
  for (const Body& body : bodies_at(show, state.settings))
    found.bodies.push_back(sighting(sight, state, body));
  return found;
}

bool go_together(const Sightings& a, const Sightings& b) {
  return a.segment >= 0 && a.segment == b.segment && !a.bodies.empty() && !b.bodies.empty();
}

// Returns the motion in pixels between two frames, or 0 where either of them shows nothing, and where
// the image races around the Einstein ring, since it is a trail there.
double motion(const Sighting& a, const Sighting& b) {
  constexpr double kRacing = 8;
  if (!a.visible || !b.visible) return 0;
  if (a.is_behind && b.is_behind &&
      std::min(a.off_axis.length(), b.off_axis.length()) <
          kRacing * (b.off_axis - a.off_axis).length())
    return 0;
  return 2 * std::asin(std::min(1.0, (b.direction - a.direction).length() / 2)) / b.pixel_angle;
}

// ---- bodies that strobe ----

// A Race is a stretch of a segment in which a body moves too fast, or the part of it found so far.
struct Race {
  int segment, worst, last;  // the last two are frames
  double pixels;
};

std::vector<ShowWarning> race_warnings(const Show& show, const std::vector<int>& frames,
                                       const std::vector<Sightings>& before,
                                       const std::vector<Sightings>& now) {
  const double open = 1 - show.exposure.shutter;
  const double limit = kFastestBody * columns(show.projection);
  std::vector<ShowWarning> warnings;
  for (std::size_t body = 0; body < show.bodies.size(); ++body) {
    std::optional<Race> race;
    const auto end_race = [&] {
      if (!race) return;
      warnings.push_back(
          {race->worst / show.frames_per_second, race->worst, race->segment,
           fmt::format("bodies.{} moves by {:.0f} pixels from frame to frame, so that it seems to "
                       "jump, to frame {}; a slower clock would show how it moves, and "
                       "exposure.shutter_deg: 180 draws it as a streak",
                       show.bodies[body].name, race->pixels, race->last)});
      race.reset();
    };
    for (std::size_t k = 0; k < frames.size(); ++k) {
      if (!go_together(before[k], now[k])) continue;
      const double pixels = motion(before[k].bodies[body], now[k].bodies[body]);
      if (!(pixels * open > limit)) continue;
      if (race && race->segment != now[k].segment) end_race();
      if (!race) race = Race{now[k].segment, frames[k], frames[k], pixels};
      if (pixels > race->pixels) race->worst = frames[k], race->pixels = pixels;
      race->last = frames[k];
    }
    end_race();
  }
  return warnings;
}

// ---- bodies that flash ----

// The light of so many passages is looked at, which takes up to a tenth of a second for each.
constexpr int kMostPassages = 8;

// Returns how many frames after b the straight way from a to b passes the axis of the lens, if the
// body is behind the hole and passes so near that its images race.
std::optional<double> passage(const Sighting& a, const Sighting& b) {
  constexpr double kNear = 3;  // times the way from frame to frame
  const V3d way = b.off_axis - a.off_axis;
  if (!a.is_behind || !b.is_behind || !(way.length2() > 0)) return std::nullopt;
  const double frames = -b.off_axis.dot(way) / way.length2();
  if (!((b.off_axis + way * frames).length() < kNear * way.length())) return std::nullopt;
  return frames;
}

double light_of(const Show& show, std::size_t body, int frame) {
  const FrameState state = frame_state(show, frame);
  const FramePlan plan = plan_frame(show, state);
  const FrameScene scene(show, state, plan, lens_of(state.observer, plan.wanted(), show.effects),
                         {}, {}, nullptr, body_times(show, state, show.exposure.shutter));
  double sum = 0;
  for (const BodyImages& drawn : images_of_bodies(scene, {&scene.bodies[body], 1}, nullptr))
    for (const StarImage& image : drawn.light)
      sum += luminance({image.rgb[0], image.rgb[1], image.rgb[2]});
  return sum;
}

std::optional<ShowWarning> flash_warning(const Show& show, std::size_t body, int frame) {
  const int segment = frame_state(show, frame).segment;
  double beside = 0;
  for (const int neighbour : {frame - 1, frame + 1}) {
    if (neighbour < 0 || neighbour >= frame_count(show)) return std::nullopt;
    if (frame_state(show, neighbour).segment != segment) return std::nullopt;
    beside = std::max(beside, light_of(show, body, neighbour));
  }
  const double light = light_of(show, body, frame);
  if (!(light > kFlash * beside)) return std::nullopt;
  return ShowWarning{
      frame / show.frames_per_second, frame, segment,
      fmt::format("bodies.{} passes straight behind the hole within a frame, which has {} times "
                  "the light of those beside it; a slower clock lets its ring grow and fade",
                  show.bodies[body].name,
                  beside > 0 ? fmt::format("{:.2g}", light / beside) : "many")};
}

std::vector<ShowWarning> flash_warnings(const Show& show, const std::vector<int>& frames, int step,
                                        const std::vector<Sightings>& before,
                                        const std::vector<Sightings>& now) {
  std::set<std::pair<std::size_t, int>> passages;
  for (std::size_t k = 0; k < frames.size(); ++k)
    for (std::size_t body = 0; go_together(before[k], now[k]) && body < show.bodies.size();
         ++body) {
      auto later = passage(before[k].bodies[body], now[k].bodies[body]);
      if (!later || !(std::abs(*later) <= step)) continue;
      int frame = frames[k] + static_cast<int>(std::lround(*later));
      // From afar the straight way errs, so that it is followed once more from there.
      if (step > 1 && frame > 0 && frame < frame_count(show)) {
        const Sightings a = sightings(show, frame - 1), b = sightings(show, frame);
        if (!go_together(a, b)) continue;
        later = passage(a.bodies[body], b.bodies[body]);
        if (!later || !(std::abs(*later) <= step)) continue;
        frame += static_cast<int>(std::lround(*later));
      }
      passages.emplace(body, frame);
    }
  std::vector<ShowWarning> warnings;
  // The first flash of a body in a segment stands for all.
  std::set<std::pair<std::size_t, int>> told;
  int looked_at = 0;
  for (const auto& [body, frame] : passages) {
    const int segment = segment_at(show, frame / show.frames_per_second);
    if (told.contains({body, segment}) || ++looked_at > kMostPassages) continue;
    if (const auto warning = flash_warning(show, body, frame)) {
      warnings.push_back(*warning);
      told.emplace(body, segment);
    }
  }
  return warnings;
}

}  // namespace

std::vector<ShowWarning> body_warnings(const Show& show) {
  if (show.bodies.empty() || !show.effects.lensing) return {};
  const int sightings_at_most =
                show.spacetime.is<SpinningHole>() ? kMostSightingsAboutSpin : kMostSightings,
            most = std::max(1, sightings_at_most / static_cast<int>(show.bodies.size()));
  const bool turns = std::ranges::any_of(
      show.timeline, [](const Segment& segment) { return segment.attitudes.size() > 1; });
  const int count = frame_count(show),
            step = std::max(turns ? kWithinTurns : 1, (count + most - 1) / most);
  std::vector<int> frames;
  for (int n = 1; n < count; n += step) frames.push_back(n);
  std::vector<Sightings> before(frames.size()), now(frames.size());
  tbb::parallel_for(std::size_t{0}, frames.size(),
                    [&](std::size_t k) { now[k] = sightings(show, frames[k]); });
  tbb::parallel_for(std::size_t{0}, frames.size(), [&](std::size_t k) {
    before[k] = k > 0 && step == 1 ? now[k - 1] : sightings(show, frames[k] - 1);
  });
  std::vector<ShowWarning> warnings = race_warnings(show, frames, before, now);
  for (const ShowWarning& warning : flash_warnings(show, frames, step, before, now))
    warnings.push_back(warning);
  return warnings;
}

}  // namespace domefall
