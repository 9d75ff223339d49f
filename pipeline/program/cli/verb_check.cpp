#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <optional>

#include "pipeline/base/errors.h"
#include "pipeline/grade/grader.h"
#include "pipeline/program/cli/check_page.h"
#include "pipeline/program/cli/option_types.h"
#include "pipeline/program/cli/verbs.h"
#include "pipeline/program/survey/axis_stars.h"
#include "pipeline/program/survey/body_motion.h"
#include "pipeline/program/survey/show_warnings.h"
#include "pipeline/render/frames/frame_folder.h"
#include "pipeline/show/file/read_show.h"

namespace domefall {
namespace {

// Loads all that the frames will read, since a file may be damaged though none of the measured
// frames shows it.
void load_skies(const Show& show, const ShowSurvey& survey, Renderer& renderer) {
  for (const SkyRegion sky : kExteriorSkies)
    if (survey.skies[sky]) renderer.load_sky(sky);
  if (show.spacetime.is<Schwarzschild>()) renderer.load_sky(SkyRegion::kIV);
}

// Returns the time to render.  Returns nothing where that is not worth measuring, or where no
// temporary file can be written, which is no fault of the show.
std::optional<RenderTime> time_to_render(const Show& show, const Grader* grader) {
  if (!is_worth_measuring(show)) return std::nullopt;
  try {
    Renderer renderer(show);
    return estimate_render_time(show, renderer, grader);
  } catch (const InputError&) {
  } catch (const TemporaryError&) {
  } catch (const std::filesystem::filesystem_error&) {
  }
  return std::nullopt;
}

void check(const std::string& file, const std::string& out, bool json) {
  const Show show = read_show(file);
  std::optional<Grader> grader;
  if (show.output.graded) grader.emplace(show.grade);
  const Grader* grade = grader ? &*grader : nullptr;
  Renderer renderer(show, 0, {}, kSurveyDetail);
  AxisStars axis(show);
  NearBodies bodies(show);
  NearGas gas(show);
  const ShowSurvey found = survey(show, [&](const FrameState& state) {
    axis.add(state);
    bodies.add(state);
    gas.add(state);
  });
  CheckReport report{show,
                     {},
                     {},
                     found,
                     segment_joints(show),
                     jump_warnings(show),
                     {},
                     {},
                     {},
                     disk_room(frames_folder(show, out))};
  load_skies(show, found, renderer);
  for (const SkySources& sky : survey_skies(show, found)) {
    report.skies.push_back({sky, {}});
    if (sky.panorama) report.skies.back().black = renderer.sky_black(sky.region, *sky.panorama);
    if (sky.twice > kMuchTwice)
      report.warnings.push_back({0, 0, kWholeShow, counted_twice_text(sky)});
  }
  for (const ShowWarning& warning : axis.warnings()) report.warnings.push_back(warning);
  for (const ShowWarning& warning : bodies.warnings()) report.warnings.push_back(warning);
  for (const ShowWarning& warning : gas.warnings()) report.warnings.push_back(warning);
  for (const ShowWarning& warning : horizon_warnings(show)) report.warnings.push_back(warning);
  for (const ShowWarning& warning : place_warnings(show)) report.warnings.push_back(warning);
  for (const ShowWarning& warning : body_warnings(show)) report.warnings.push_back(warning);
  for (const ShowWarning& warning : title_warnings(show)) report.warnings.push_back(warning);
  report.light = survey_light(show, renderer, grade);
  for (const ShowWarning& warning : light_warnings(show, renderer, report.light))
    report.warnings.push_back(warning);
  std::ranges::stable_sort(report.warnings, {}, &ShowWarning::time_s);
  if (grade) report.display = grade->display(), report.view = grade->view();
  report.time = time_to_render(show, grade);
  if (const std::string lack = lack_of_room(report); !lack.empty())
    report.warnings.push_back({0, 0, kWholeShow, lack});
  const std::string text = json ? check_json(report) : check_page(report);
  std::fwrite(text.data(), 1, text.size(), stdout);
}

}  // namespace

void add_check(CLI::App& app) {
  auto* verb = app.add_subcommand("check", "Validate a show and say what it does, on one page");
  auto show = std::make_shared<std::string>();
  auto out = std::make_shared<std::string>();
  auto json = std::make_shared<bool>(false);
  add_show(*verb, *show)->required();
  add_folder(*verb, "--out", *out, "folder that the frames are to go to; default out/NAME");
  verb->add_flag("--json", *json, "the same facts as JSON, for other programs");
  verb->callback([show, out, json] { check(*show, *out, *json); });
}

}  // namespace domefall
