#include "pipeline/program/survey/show_warnings.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include "pipeline/render/overlay/bent_text.h"
#include "pipeline/render/overlay/coverage.h"
#include "pipeline/render/overlay/frame_titles.h"
#include "pipeline/render/scene/body_sight.h"
#include "pipeline/show/curve.h"
#include "pipeline/show/frame_state.h"
#include "pipeline/show/nearest_word.h"
#include "pipeline/show/observer_track.h"
#include "pipeline/show/title_text.h"
#include "pipeline/sources/disc/disc_light.h"
#include "trajectories/trajectory.h"

namespace domefall {
namespace {

// A body that is a smaller part of its distance from the hole is met by an observer who seeks it.
constexpr double kLarge = 0.02;

constexpr double kLeastCapital = 2;  // pixels; no letter below is legible

// Returns the first frame that shows any of the title's light.  Titles are drawn at the frames'
// instants.  The search begins a frame early, because the nearest frame may stand before the title,
// and its time may be rounded to either side.
std::optional<int> first_frame_with(const Show& show, const Title& title) {
  const auto time_of = [&](int frame) { return frame / show.frames_per_second; };
  const int count = frame_count(show);
  for (int frame = std::max(0, nearest_frame(show, title.begin_s) - 1);
       frame < count && time_of(frame) < title.end_s; ++frame)
    if (time_of(frame) >= title.begin_s &&
        light_left(title.fades, title.begin_s, title.end_s, time_of(frame)) > 0)
      return frame;
  return std::nullopt;
}

bool has_ink(const LetteredText& letters) {
  return std::ranges::any_of(letters.outlines,
                             [](const TextOutline& outline) { return !outline.curves.empty(); });
}

// Adds the warnings of one title.  A title outside the picture is not warned of for the height of
// its capitals too, which it does not have there.
void add_warnings(const Show& show, const Title& title, std::vector<ShowWarning>& warnings) {
  const std::optional<int> shown_at = first_frame_with(show, title);
  // A title that is seen in no frame is judged by the frame nearest to its beginning.
  const int frame = shown_at.value_or(nearest_frame(show, title.begin_s));
  const FrameState state = frame_state(show, frame);
  const auto lettered = title_letters(text_at(show, title, state), title.style);
  const LetteredText& letters = *lettered;
  const TextSurface surface(state.camera_from_audience, title.azimuth, title.elevation,
                            title.height);
  const auto warn = [&](const std::string& what) {
    warnings.push_back(
        {title.begin_s, frame, state.segment, "the title '" + shown(title.text) + "' " + what});
  };
  if (!shown_at)
    warn(
        fmt::format("is seen in no frame, since none falls into its {:.3g} s; a longer duration_s "
                    "would show it",
                    title.end_s - title.begin_s));
  if (title.text.empty()) return;  // a figure alone
  if (!has_ink(letters)) {
    warn("writes nothing, since none of its characters has any ink");
    return;
  }
  if (!letters.font_found)
    warn("asks for the font '" + shown(title.style.font) +
         "', which this machine does not have, so that another one stands in for it");
  if (letters.missing > 0)
    warn(fmt::format("has {} letter{} that no font of this machine has, drawn as boxes",
                     letters.missing, letters.missing == 1 ? "" : "s"));
  if (title.place || title.body) return;  // it goes where what it names is seen
  const auto middle = pixel_of(state.projection, surface.direction({0, 0}));
  if (!middle || !is_in_image(state.projection, *middle))
    warn("has its middle outside the picture");
  else if (const double least = kLeastCapital * pixel_angle(state.projection, *middle);
           title.height < least)
    warn(
        fmt::format("has capitals lower than {} pixels at the show's size, which nobody can read; "
                    "they have {} with a height_deg of {:.3g}",
                    kLeastCapital, kLeastCapital, least * 180 / std::numbers::pi));
  if (surface.angle_about_pole(letters.half_width) > std::numbers::pi)
    warn(
        "is longer than its circle of the dome, so that it runs into itself; a smaller height_deg "
        "or more lines would fit");
}

bool is_lit(const Show& show, const FrameState& state, SkyRegion sky) {
  const FrameSettings::Sky& now = state.settings.sky[sky];
  const bool black = std::holds_alternative<BlackSky>(background_of(show, state.segment, sky)) ||
                     !(now.background_gain > 0);
  return !black || (show.sky[sky].stars && now.star_gain > 0);
}

// Adds a warning where the sky is lit.
void add_flash(const Show& show, const FrameState& state, SkyRegion sky, const char* passage,
               std::vector<ShowWarning>& warnings) {
  if (!is_lit(show, state, sky)) return;
  const std::string whose =
      sky == SkyRegion::kNext ? "of the next universe" : fmt::format("of region {}", name_of(sky));
  warnings.push_back(
      {state.show_time_s, state.frame, state.segment,
       fmt::format("the observer {}, where all that the sky {} will ever send arrives at once, "
                   "bluer without bound; fade that sky out around here, or it flashes as the "
                   "frames happen to fall",
                   passage, whose)});
}

}  // namespace

std::vector<ShowWarning> horizon_warnings(const Show& show) {
  std::vector<ShowWarning> warnings;
  if (!show.spacetime.leads_on()) return warnings;
  const bool two_horizons = show.spacetime.horizon() > show.spacetime.inner_horizon();
  const auto observer_in = [&](int frame) {
    const double t = frame / show.frames_per_second;
    const int segment = segment_at(show, t);
    return observer_at(show, segment, part_at(show, segment, t));
  };
  ObserverState before = observer_in(0);
  for (int frame = 1; frame < frame_count(show); ++frame) {
    const ObserverState last = before, now = observer_in(frame);
    before = now;
    // The whole inside may lie between two frames.
    const bool was_inside = is_within_inner_horizon(last.region),
               is_inside = is_within_inner_horizon(now.region),
               passes = !was_inside && !is_inside && now.universe > last.universe,
               falls = is_outside(last.region) && (passes || !is_outside(now.region)),
               enters = passes || (!was_inside && is_inside),
               leaves = passes || (was_inside && !is_inside);
    if (!falls && !enters && !leaves) continue;
    const FrameState state = frame_state(show, frame);
    if (falls && last.universe > 0)
      add_flash(show, state, own_sky(last.tetrad, last.universe - 1), "falls through the horizon",
                warnings);
    if (enters && two_horizons)
      add_flash(show, state, own_sky(mirror_of(last.tetrad), last.universe),
                "falls through the inner horizon", warnings);
    if (leaves) add_flash(show, state, own_sky(last), "rises through the inner horizon", warnings);
  }
  return warnings;
}

std::vector<ShowWarning> place_warnings(const Show& show) {
  const auto* hole = std::get_if<SpinningHole>(&show.spacetime.kind());
  if (!hole) return {};
  const ObserverState o = observer_at(show, 0, 0);
  const V3d seen = -column(o.sky_from_tetrad, 0);
  const double apart = std::atan2(seen.cross(show.hole_at.v).length(), seen.dot(show.hole_at.v));
  constexpr double kSeen = 1e-6;
  if (apart < kSeen) return {};
  constexpr double kDeg = 180 / std::numbers::pi;
  const auto latitude = [&](const V3d& place) {
    return 90 - kDeg * std::atan2(place.cross(axis_of(*hole)).length(), place.dot(axis_of(*hole)));
  };
  return {{0, 0, kWholeShow,
           fmt::format("at the start the hole stands {:.3g} degrees from black_hole.at: the first "
                       "segment begins at latitude {:.3g} of the hole, from which it is not seen "
                       "there, but from {:.3g}",
                       apart * kDeg, latitude(-seen) + 0.0, latitude(-show.hole_at.v) + 0.0)}};
}

NearBodies::NearBodies(const Show& show) : show_(show) {
  for (const Body& body : show.bodies) {
    const double by_light = BodySight::star_of(body).angular_radius * kBodyMagnitudeDistance;
    const double radius = body.radius > 0 ? body.radius : by_light;
    const auto [low, high] = reach(body.trajectory);
    if (radius > kLarge * low) bodies_.push_back({&body, radius, low, high, {}, 0});
  }
}

void NearBodies::add(const FrameState& state) {
  if (bodies_.empty()) return;
  const BodySight sight(state, show_.effects, show_.least_star_radius);
  if (!sight.sees()) return;
  const double r = state.observer.r;
  // Who rides a point means to see no more of it than its light from around the hole.
  const bool rides = segment_of(show_, state.segment).type == "body";
  for (LargeBody& large : bodies_) {
    // The lens makes a body appear at most about twice as near.
    if (rides && large.body->radius == 0) continue;
    if (std::max(large.low - r, r - large.high) > 2 * large.radius) continue;
    if (!sight.is_too_near(*large.body)) continue;
    if (!large.first) large.first = {state.show_time_s, state.frame, state.segment, {}};
    large.last_frame = state.frame;
  }
}

std::vector<ShowWarning> NearBodies::warnings() const {
  std::vector<ShowWarning> found;
  for (const LargeBody& large : bodies_) {
    if (!large.first) continue;
    ShowWarning warning = *large.first;
    warning.text = fmt::format(
        "bodies.{} is not drawn, to frame {}: the observer is within its radius of {:.3g} M",
        large.body->name, large.last_frame, large.radius);
    found.push_back(warning);
  }
  return found;
}

void NearGas::add(const FrameState& state) {
  if (!show_.disc || !(show_.disc->height > 0)) return;
  const Disc& disc = *show_.disc;
  const double r = state.observer.r;
  if (!(r > disc.inner && r < disc.outer)) return;
  // The shortest way out is across the plane, to the nearer side.
  constexpr double kLeft = 0.1;
  const double off = column(state.observer.sky_from_tetrad, 0).dot(disc.normal.v);
  const double part = std::erfc(std::abs(off) / disc.height_at(r) / std::numbers::sqrt2) / 2;
  const double depth = std::min(depth_across(disc, r, r), 1e6) * part;
  const double opacity = state.settings.disc_opacity;
  if (!(1 - opacity + opacity * std::exp(-depth) < kLeft)) return;
  if (stretches_.empty() || stretches_.back().last_frame + 1 < state.frame)
    stretches_.push_back({{state.show_time_s, state.frame, state.segment, {}}, state.frame});
  stretches_.back().last_frame = state.frame;
}

std::vector<ShowWarning> NearGas::warnings() const {
  std::vector<ShowWarning> found;
  for (const Stretch& stretch : stretches_) {
    ShowWarning warning = stretch.first;
    warning.text = fmt::format(
        "the observer is inside opaque gas of the disc, to frame {}: less than a tenth of other "
        "light comes through it",
        stretch.last_frame);
    found.push_back(warning);
  }
  return found;
}

std::vector<ShowWarning> title_warnings(const Show& show) {
  std::vector<ShowWarning> warnings;
  if (!show.draws_titles) return warnings;
  for (const Title& title : show.titles) add_warnings(show, title, warnings);
  for (const Segment& segment : show.timeline)
    for (const Title& title : segment.titles) add_warnings(show, title, warnings);
  return warnings;
}

}  // namespace domefall
