#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cmath>
#include <cstdio>
#include <memory>
#include <nlohmann/json.hpp>
#include <numbers>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "pipeline/image/frame_list.h"
#include "pipeline/program/cli/option_types.h"
#include "pipeline/program/cli/output_file.h"
#include "pipeline/program/cli/verbs.h"
#include "pipeline/program/diagram/page.h"
#include "pipeline/show/camera_world.h"
#include "pipeline/show/file/read_show.h"
#include "pipeline/show/frame_state.h"
#include "pipeline/show/state_columns.h"
#include "trajectories/degree.h"

namespace domefall {
namespace {

std::string csv_text(const StateCell& cell) {
  if (const auto* number = std::get_if<StateNumber>(&cell))
    return fmt::format("{:.{}g}", number->value, number->digits);
  if (const auto* count = std::get_if<int>(&cell)) return fmt::to_string(*count);
  return std::get<const char*>(cell);
}

nlohmann::ordered_json json_of_cell(const StateCell& cell) {
  if (const auto* number = std::get_if<StateNumber>(&cell)) return number->value;
  if (const auto* count = std::get_if<int>(&cell)) return *count;
  return std::get<const char*>(cell);
}

void print_csv(const Show& show, const std::vector<int>& frames) {
  const std::string head = fmt::format(
      "# r and proper_time in M (proper_time in s without a hole); celerity (gamma v) against the "
      "tetrad along R,"
      " Theta, Phi;\n# ra_deg and dec_deg: the observer's place as seen from the hole; camera axes "
      "in the boosted"
      " (R, Theta, Phi)\n"
      "# azimuth_deg: swept in the planes of its orbits since the start of the show, or about the "
      "axis\n"
      "# of a hole that spins, on which it stays; latitude_deg: above that hole's equator, 0 "
      "elsewhere\n"
      "# null_time in M: v = t + r* where the tetrad is rain, u = t - r* where it is outgoing, "
      "t + l in a wormhole\n"
      "# universe: of those that follow each other through a charged hole, from 0\n"
      "# l: the place along a wormhole, 0 elsewhere; there M stands for the radius of the throat\n"
      "{}\n",
      fmt::join(kStateColumns, ","));
  std::fputs(head.c_str(), stdout);
  for (const int n : frames) {
    std::string line;
    for (const StateCell& cell : state_cells(frame_state(show, n)))
      line += (line.empty() ? "" : ",") + csv_text(cell);
    std::puts(line.c_str());
  }
}

nlohmann::ordered_json json_of(const M33d& m) {
  auto rows = nlohmann::ordered_json::array();
  for (int k = 0; k < 3; ++k) rows.push_back({m[k][0], m[k][1], m[k][2]});
  return rows;
}

void print_states_json(const Show& show, const std::vector<int>& frames) {
  std::string before = "[\n";
  for (const int n : frames) {
    const auto cells = state_cells(frame_state(show, n));
    nlohmann::ordered_json state;
    for (std::size_t k = 0; k < cells.size(); ++k) state[kStateColumns[k]] = json_of_cell(cells[k]);
    const FrameState view = dominant_view(frame_state(show, n));
    const auto fov = field_of_view(view.projection);
    state["projection"] = projection_name(view.projection);
    state["fov_deg"] = fov ? *fov / kDegree : traits_of(view.projection).shown_deg;
    state["width"] = columns(view.projection);
    state["height"] = rows(view.projection);
    state["pixel_aspect"] = pixel_aspect(view.projection);
    state["world_from_camera"] = json_of(world_from_camera(view.observer, view.projection));
    state["world_from_audience"] = json_of(world_from_audience(view));
    std::fputs((before + state.dump()).c_str(), stdout);
    before = ",\n";
  }
  std::puts("\n]");
}

// ---- the camera alone ----
//
// camera_world.h says in which world it is turned.

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
  if (!traits_of(p).keeps_lines) return std::nullopt;
  return 2 * std::atan(std::tan(*field_of_view(p) / 2) * rows(p) / columns(p) / pixel_aspect(p));
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
                     kWidth * rows(p) / columns(p) / pixel_aspect(p)) +
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
    return fmt::format("\"{}\"", region_name(state.observer.region, state.observer.universe));
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

// Returns a .chan file: a line for each frame with its number, the place of the camera, which is
// always the origin, the angles rx, ry and rz in degrees, of rotations about z, then x, then y, as
// Nuke has them, and for a rectilinear picture the vertical angle of view.
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

// Returns a USD stage as text.  /Domefall/Audience is turned as the audience is against the world,
// and its child Camera as the picture is against the audience.
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

// ---- the verb ----

struct StatesOptions {
  std::string show, frames, plot, format = "csv";
  bool json = false;
};

void print_states(const StatesOptions& o) {
  const Show show = read_show(o.show);
  const std::vector<int> frames = parse_frames(o.frames, frame_count(show));
  if (!o.plot.empty()) write_output(o.plot, show_page(show));
  if (o.json || o.format == "json") return print_states_json(show, frames);
  if (o.format == "csv") return print_csv(show, frames);
  std::fputs((o.format == "usda" ? camera_usda : camera_chan)(show, frames).c_str(), stdout);
}

}  // namespace

void add_states(CLI::App& app) {
  auto* verb =
      app.add_subcommand("states", "Per-frame observer states and cameras for other programs");
  auto o = std::make_shared<StatesOptions>();
  add_show(*verb, o->show)->required();
  verb->add_option("--frames", o->frames, "7, 0-299, 0-599x10; default all")->type_name("FRAMES");
  add_file(*verb, "--plot", o->plot,
           "also draw the whole show as one page (SVG): radius, orbit, Penrose diagram");
  verb->add_option("--format", o->format,
                   "csv (the default); json, an array of objects with all digits; or the camera "
                   "alone as a USD stage or for Nuke: usda, chan")
      ->type_name("csv|json|usda|chan")
      ->check(CLI::IsMember({"csv", "json", "usda", "chan"}));
  verb->add_flag("--json", o->json, "as --format json");
  verb->callback([o] { print_states(*o); });
}

}  // namespace domefall
