#include "pipeline/program/preview/screen_view.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <nlohmann/json.hpp>
#include <numbers>

#include "pipeline/render/reduced_frame.h"
#include "pipeline/show/assets.h"
#include "pipeline/show/attitude.h"
#include "pipeline/show/observer_track.h"
#include "trajectories/degree.h"
#include "trajectories/equatorial.h"

namespace domefall {
namespace {

constexpr double kHalfSquare = std::numbers::sqrt2 / 2;

// These return the axes of a flat camera that looks 45 degrees up the front of a dome and, the
// other way around, those of a dome whose seats look there.
M33d from_the_seats(const M33d& dome_axes) {
  const V3d front = column(dome_axes, 1), zenith = column(dome_axes, 2);
  return from_columns(column(dome_axes, 0), (front - zenith) * kHalfSquare,
                      (front + zenith) * kHalfSquare);
}

M33d dome_around(const M33d& flat_axes) {
  const V3d down = column(flat_axes, 1), ahead = column(flat_axes, 2);
  return from_columns(column(flat_axes, 0), (ahead + down) * kHalfSquare,
                      (ahead - down) * kHalfSquare);
}

bool turns_by_angles(const Segment& segment) {
  return std::holds_alternative<EulerAngles>(segment.camera.attitude) ||
         std::ranges::any_of(segment.attitudes, [](const AttitudeKey& key) {
           return std::holds_alternative<EulerAngles>(key.attitude);
         });
}

// Returns the axes for the new projection, as columns in the tetrad.
M33d axes_in(const Show& show, const Projection& projection, const FrameState& state) {
  const M33d own = state.observer.tetrad_from_camera, audience = own * state.camera_from_audience;
  if (has_zenith(projection))
    return traits_of(projection).is_dome && has_zenith(show.projection) ? own : audience;
  if (!has_zenith(show.projection)) return own;
  if (turns_by_angles(segment_of(show, state.segment))) return from_the_seats(own);
  return camera_axes_at(show, state.segment, state.show_time_s, projection, state.observer);
}

double dome_tilt(const Show& show, const FrameState& state) {
  const Segment& segment = segment_of(show, state.segment);
  return value_at(segment, Channel::kDomeTilt, state.show_time_s, segment.camera.dome_tilt);
}

std::optional<Attitude> held_attitude(const Segment& segment, double t) {
  const auto& keys = segment.attitudes;
  if (keys.empty()) return segment.camera.attitude;
  const auto next = std::ranges::upper_bound(keys, t, {}, &AttitudeKey::at_s);
  if (next == keys.begin()) return keys.front().attitude;
  const AttitudeKey& last = *(next - 1);
  if (next == keys.end() || next->ease == Ease::kHold || last.at_s == t) return last.attitude;
  return std::nullopt;
}

std::optional<std::string> words_of(const Attitude& attitude) {
  if (std::holds_alternative<LookAtHole>(attitude)) return "hole";
  if (std::holds_alternative<LookOutward>(attitude)) return "outward";
  if (std::holds_alternative<LookAlongMotion>(attitude)) return "motion";
  if (const auto* sky = std::get_if<LookAtSky>(&attitude)) {
    const Equatorial at = equatorial(sky->target);
    return fmt::format("{{ra_deg: {:.7g}, dec_deg: {:.7g}}}", at.ra_deg, at.dec_deg);
  }
  if (const auto* body = std::get_if<LookAtBody>(&attitude))
    return "{body: " + nlohmann::json(body->body->name).dump() + "}";
  return std::nullopt;
}

std::optional<std::string> target_as_yaml(const Show& show, const FrameState& state) {
  const Segment& segment = segment_of(show, state.segment);
  const double t = state.show_time_s;
  const auto attitude = held_attitude(segment, t);
  const auto words = attitude ? words_of(*attitude) : std::nullopt;
  if (!words) return std::nullopt;
  std::string keys = "{look_at: " + *words;
  const auto add = [&](Channel channel, double constant, bool always) {
    const double degrees = value_at(segment, channel, t, constant) / kDegree;
    if (always || degrees != 0) keys += fmt::format(", {}: {:.6g}", key_of(channel), degrees);
  };
  if (has_zenith(show.projection)) add(Channel::kElevation, segment.camera.elevation, true);
  add(Channel::kRoll, segment.camera.roll, false);
  if (has_zenith(show.projection)) add(Channel::kDomeTilt, segment.camera.dome_tilt, false);
  return keys + "}";
}

void set_axes(const M33d& axes, FrameState& state) {
  state.camera_from_audience =
      axes.transposed() * state.observer.tetrad_from_camera * state.camera_from_audience;
  state.observer.tetrad_from_camera = axes;
}

// Calls change(state) also for the state that vanishes in a dissolve.
template <class Change>
void for_both(FrameState& state, const Change& change) {
  if (state.vanishing) {
    auto vanishing = std::make_shared<FrameState>(*state.vanishing);
    for_both(*vanishing, change);
    state.vanishing = vanishing;
  }
  change(state);
}

}  // namespace

void see_in(const Show& show, const Projection& projection, FrameState& state) {
  for_both(state, [&](FrameState& one) {
    set_axes(axes_in(show, projection, one), one);
    one.projection = projection;
  });
}

void turn_to(const ScreenLook& look, FrameState& state) {
  const double azimuth = look.azimuth_deg * kDegree, altitude = look.altitude_deg * kDegree,
               roll = look.roll_deg * kDegree;
  const V3d ahead(std::sin(azimuth) * std::cos(altitude), std::cos(azimuth) * std::cos(altitude),
                  std::sin(altitude));
  const V3d level(std::cos(azimuth), -std::sin(azimuth), 0), steep = ahead.cross(level);
  const V3d right = level * std::cos(roll) + steep * std::sin(roll);
  const M33d flat = from_columns(right, ahead.cross(right), ahead);
  for_both(state, [&](FrameState& one) {
    const M33d camera = has_zenith(one.projection) ? dome_around(flat) : flat;
    set_axes(one.observer.tetrad_from_camera * one.camera_from_audience * camera, one);
  });
}

std::string camera_as_yaml(const Show& show, const FrameState& state, bool turned) {
  if (const auto target = turned ? std::nullopt : target_as_yaml(show, state)) return *target;
  M33d axes = base_from_camera(state.observer);
  double tilt = 0;
  if (has_zenith(show.projection)) {
    if (!has_zenith(state.projection)) axes = dome_around(axes);
    tilt = dome_tilt(show, state);
    axes = untilted(axes, tilt);
  } else if (has_zenith(state.projection)) {
    axes = from_the_seats(axes);
  }
  const EulerAngles angle = euler_angles_of(axes);
  return fmt::format("{{euler_deg: [{:.6g}, {:.6g}, {:.6g}]{}}}", angle.phi / kDegree,
                     angle.vartheta / kDegree, angle.psi / kDegree,
                     tilt != 0 ? fmt::format(", dome_tilt_deg: {:.6g}", tilt / kDegree) : "");
}

GradeSettings for_a_screen(GradeSettings settings) {
  if (settings.display.empty() && settings.config == shipped_asset(kDomeConfig))
    settings.display = "sRGB - Display";
  return settings;
}

// A small dome takes little time, and has the mean light of a large one but for what is clipped to
// white.
void change_as_in_dome(const Grader& grader, Renderer& renderer, const FrameState& dome,
                       GradedFrame& picture) {
  constexpr int kDomeWidth = 512;
  const GradedFrame small = grader.grade(renderer.render(reduced(dome, kDomeWidth)));
  DomeCodes codes;
  codes.add_rows(small, 0, small.height);
  grader.dome_light()->map_for(codes).change(
      picture.row(0), static_cast<std::ptrdiff_t>(picture.width) * picture.height);
}

}  // namespace domefall
