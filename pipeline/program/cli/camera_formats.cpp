#include "pipeline/program/cli/camera_formats.h"

#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>

#include "pipeline/show/camera_world.h"
#include "trajectories/degree.h"

namespace domefall {
namespace {

// Returns the angle that is nearest to another one of those that are whole turns away.
double unwound(double angle, double near) {
  constexpr double kTurn = 2 * std::numbers::pi;
  return angle + kTurn * std::round((near - angle) / kTurn);
}

// Returns rx, ry and rz of R = Ry Rx Rz, each within half a turn of the angles before.
V3d angles_of(const M33d& m, const V3d& before) {
  const double cosine = std::hypot(m[1][0], m[1][1]);
  // Straight up or down only the sum or the difference of ry and rz has a meaning.
  constexpr double kStraight = 1e-9;
  const bool straight = cosine < kStraight;
  const V3d angles(std::atan2(-m[1][2], cosine),
                   straight ? std::atan2(-m[2][0], m[0][0]) : std::atan2(m[0][2], m[2][2]),
                   straight ? 0 : std::atan2(m[1][0], m[1][1]));
  return {unwound(angles.x, before.x), unwound(angles.y, before.y), unwound(angles.z, before.z)};
}

std::optional<double> vertical_view(const Projection& p) {
  if (!std::holds_alternative<Rectilinear>(p)) return std::nullopt;
  return 2 * std::atan(std::tan(*field_of_view(p) / 2) * rows(p) / columns(p));
}

// USD multiplies rows by matrices, so that the rows are what M33d has as columns.
std::string usd_matrix(const M33d& m) {
  std::string text;
  for (int k = 0; k < 3; ++k)
    text += fmt::format("({:.17g}, {:.17g}, {:.17g}, 0), ", m[0][k], m[1][k], m[2][k]);
  return "( " + text + "(0, 0, 0, 1) )";
}

std::string usd_text(const std::string& text) {
  return nlohmann::json(text).dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
}

// Writes an attribute whose value in each frame is what value_of(state) returns.
template <class Value>
std::string animated(const std::string& attribute, const std::vector<FrameState>& states,
                     const Value& value_of) {
  std::string text = fmt::format("{}.timeSamples = {{\n", attribute);
  for (const FrameState& state : states)
    text += fmt::format("    {}: {},\n", state.frame, value_of(state));
  return text + "}\n";
}

std::string indented(const std::string& text, int blanks) {
  std::string all;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t end = text.find('\n', at) + 1;
    all += std::string(blanks, ' ') + text.substr(at, end - at);
    at = end;
  }
  return all;
}

const char* const kOrder = "uniform token[] xformOpOrder = [\"xformOp:transform\"]\n";

// Returns the film and the lens of a flat picture without distortion.  No lens of USD makes others.
std::string film(const Show& show, const std::vector<FrameState>& states) {
  constexpr double kWidth = 36;  // mm, as of film for still cameras
  const Projection& p = show.projection;
  if (!vertical_view(p)) return {};
  return fmt::format("float horizontalAperture = {}\nfloat verticalAperture = {:.9g}\n", kWidth,
                     kWidth * rows(p) / columns(p)) +
         animated("float focalLength", states, [&](const FrameState& state) {
           return fmt::format("{:.9g}",
                              kWidth / 2 / std::tan(*field_of_view(state.projection) / 2));
         });
}

std::string camera_prim(const Show& show, const std::vector<FrameState>& states) {
  std::string text = animated("matrix4d xformOp:transform", states, [](const FrameState& state) {
    return usd_matrix(world_from_audience(state).transposed() *
                      world_from_camera(state.observer, state.projection));
  });
  text += kOrder + film(show, states);
  text +=
      fmt::format("custom token domefall:projection = \"{}\"\n", projection_name(show.projection));
  text += animated("custom double domefall:fieldOfView", states, [](const FrameState& state) {
    const ProjectionTraits& traits = traits_of(state.projection);
    const auto view = field_of_view(state.projection);
    return fmt::format("{:.17g}", view ? *view / kDegree : traits.shown_deg);
  });
  text += animated("custom double domefall:r", states, [](const FrameState& state) {
    return fmt::format("{:.17g}", state.observer.r);
  });
  text += animated("custom token domefall:region", states, [](const FrameState& state) {
    return fmt::format("\"{}\"", region_name(state.observer.region));
  });
  return "def Camera \"Camera\"\n{\n" + indented(text, 4) + "}\n";
}

std::vector<FrameState> states_of(const Show& show, const std::vector<int>& frames) {
  std::vector<FrameState> states;
  states.reserve(frames.size());
  // While a segment dissolves into the next, the camera is that of the view that is seen better.
  for (const int frame : frames) states.push_back(dominant_view(frame_state(show, frame)));
  return states;
}

}  // namespace

std::string camera_chan(const Show& show, const std::vector<int>& frames) {
  std::string text;
  V3d before(0, 0, 0);
  for (const FrameState& state : states_of(show, frames)) {
    before = angles_of(world_from_camera(state.observer, state.projection), before);
    text += fmt::format("{} 0 0 0 {:.17g} {:.17g} {:.17g}", state.frame, before.x / kDegree,
                        before.y / kDegree, before.z / kDegree);
    if (const auto view = vertical_view(state.projection))
      text += fmt::format(" {:.17g}", *view / kDegree);
    text += '\n';
  }
  return text;
}

std::string camera_usda(const Show& show, const std::vector<int>& frames) {
  const std::vector<FrameState> states = states_of(show, frames);
  std::string audience =
      animated("matrix4d xformOp:transform", states,
               [](const FrameState& state) { return usd_matrix(world_from_audience(state)); });
  audience += kOrder;
  audience += '\n' + camera_prim(show, states);
  return fmt::format(
             "#usda 1.0\n(\n    doc = {}\n    defaultPrim = \"Domefall\"\n"
             "    startTimeCode = {}\n    endTimeCode = {}\n    timeCodesPerSecond = {:.17g}\n"
             "    framesPerSecond = {:.17g}\n    metersPerUnit = 1\n    upAxis = \"Y\"\n)\n\n"
             "def Xform \"Domefall\"\n{{\n    def Xform \"Audience\"\n    {{\n",
             usd_text(show.title), frames.front(), frames.back(), show.frames_per_second,
             show.frames_per_second) +
         indented(audience, 8) + "    }\n}\n";
}

}  // namespace domefall
