#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cstdio>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <variant>
#include <vector>

#include "pipeline/image/frame_list.h"
#include "pipeline/program/cli/camera_formats.h"
#include "pipeline/program/cli/json_number.h"
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
  if (const auto* number = std::get_if<StateNumber>(&cell)) return json_number(number->value);
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
      "# azimuth_deg: swept in the planes of its orbits since the start of the show\n"
      "# null_time in M: v = t + r* where the tetrad is rain, u = t - r* where it is outgoing\n"
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

// Prints an array with a state in each line.
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
    state["world_from_camera"] = json_of(world_from_camera(view.observer, view.projection));
    state["world_from_audience"] = json_of(world_from_audience(view));
    std::fputs((before + state.dump()).c_str(), stdout);
    before = ",\n";
  }
  std::puts("\n]");
}

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
  verb->add_option("--plot", o->plot,
                   "also draw the whole show as one page (SVG): radius, orbit, Penrose diagram")
      ->type_name(kFileType);
  verb->add_option("--format", o->format,
                   "csv (the default); json, an array of objects with all digits; or the camera "
                   "alone as a USD stage or for Nuke: usda, chan")
      ->type_name("csv|json|usda|chan")
      ->check(CLI::IsMember({"csv", "json", "usda", "chan"}));
  verb->add_flag("--json", o->json, "as --format json");
  verb->callback([o] { print_states(*o); });
}

}  // namespace domefall
