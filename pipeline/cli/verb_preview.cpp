#include <CLI/CLI.hpp>
#include <algorithm>
#include <memory>
#include <numbers>

#include "pipeline/cli/frame_range.h"
#include "pipeline/cli/frame_run.h"
#include "pipeline/cli/frame_size.h"
#include "pipeline/cli/number_in.h"
#include "pipeline/cli/output_file.h"
#include "pipeline/cli/overlay_option.h"
#include "pipeline/cli/verbs.h"
#include "pipeline/grade/grader.h"
#include "pipeline/image/errors.h"
#include "pipeline/image/graded_file.h"
#include "pipeline/render/frame_key.h"
#include "pipeline/render/renderer.h"
#include "pipeline/show/assets.h"
#include "pipeline/show/camera_track.h"
#include "pipeline/show/read_show.h"
#include "pipeline/survey/reduced_frame.h"

namespace domefall {
namespace {

struct Options {
  std::string show, out, overlays, size = "1280x720";
  FrameChoice choice;
  int threads = 0;
  double fov_deg = 100;
};

// The axes of a flat camera that looks 45 degrees up the front of a dome.
M33d from_the_seats(const M33d& dome_axes) {
  const V3d front = column(dome_axes, 1), zenith = column(dome_axes, 2);
  const double half = std::numbers::sqrt2 / 2;
  return from_columns(column(dome_axes, 0), (front - zenith) * half, (front + zenith) * half);
}

// Gives a frame the flat projection.  The view of a dome is that of someone in the seats, straight
// at the camera's target or, where the camera is given by angles, 45 degrees up the front of the
// dome.
void flatten(const Show& show, FrameState& state, const Projection& flat) {
  if (state.vanishing) {
    auto vanishing = std::make_shared<FrameState>(*state.vanishing);
    flatten(show, *vanishing, flat);
    state.vanishing = vanishing;
  }
  const Segment& segment = segment_of(show, state.segment);
  const bool dome = std::holds_alternative<Domemaster>(show.projection);
  const bool by_angles =
      std::holds_alternative<EulerAngles>(segment.camera.attitude) ||
      std::any_of(segment.attitudes.begin(), segment.attitudes.end(), [](const AttitudeKey& key) {
        return std::holds_alternative<EulerAngles>(key.attitude);
      });
  const M33d dome_axes = state.observer.tetrad_from_camera;
  state.projection = flat;
  state.observer.tetrad_from_camera =
      dome && by_angles
          ? from_the_seats(dome_axes)
          : camera_axes_at(show, state.segment, state.show_time_s, flat, state.observer);
  // Titles stay where they are on the dome.
  state.camera_from_audience =
      state.observer.tetrad_from_camera.transposed() * dome_axes * state.camera_from_audience;
}

// Does to a flat picture of a dome what its own light does, which that of the whole dome decides.
// A small dome has the light of a large one but for what is white in it.
void change_as_in_dome(const DomeLight& light, const Grader& grader, Renderer& renderer,
                       const FrameState& dome, GradedFrame& picture) {
  constexpr int kDomeWidth = 512;
  const GradedFrame small = grader.grade(renderer.render(reduced(dome, kDomeWidth)));
  DomeCodes codes;
  codes.add_rows(small, 0, small.height);
  light.map_for(codes).change(picture.row(0),
                              static_cast<std::ptrdiff_t>(picture.width) * picture.height);
}

void preview(const Options& o) {
  const GradedFormat format = format_by_name(o.out);
  Show show = read_show(o.show);
  overlay(show, o.overlays);
  const int number = chosen_frame(o.choice, show);
  OutputFile out(o.out);
  const Projection flat =
      resized(Stereographic{16, 16, o.fov_deg * std::numbers::pi / 180}, o.size);
  const FrameState dome = frame_state(show, number);
  FrameState state = dome;
  flatten(show, state, flat);
  // The default display is for domes, and a preview for screens.  The displays of a show's own
  // configuration are not known.
  if (show.grade.display.empty() && show.grade.config == shipped_asset(kDomeConfig))
    show.grade.display = "sRGB - Display";
  const Grader of_show(show.grade), grader = of_show.with(state.cdl);
  Renderer renderer(show, o.threads);
  GradedFrame picture = grader.grade(renderer.render(state));
  if (const DomeLight* light = grader.dome_light())
    change_as_in_dome(*light, grader, renderer, dome, picture);
  const FrameKeys keys(show, grader.transform_id());
  GradedInfo info;
  info.key = keys.graded(keys.scene(state), state);
  info.title = show.title;
  info.frame = number;
  info.display = grader.display();
  info.view = grader.view();
  info.colour = grader.colour();
  info.software = kSoftware;
  info.projection = projection_name(state.projection);
  write_graded(out.path(), picture, info, format);
  out.finish();
}

}  // namespace

void add_preview(CLI::App& app) {
  auto* verb =
      app.add_subcommand("preview", "One frame as a flat picture (stereographic), for a screen");
  auto o = std::make_shared<Options>();
  verb->add_option("show", o->show, "show file (YAML)")->required();
  add_frame_choice(*verb, o->choice);
  verb->add_option("--out", o->out, "picture to write: .png, .tif or .jpg")->required();
  verb->add_option("--size", o->size, "WIDTHxHEIGHT")->capture_default_str();
  verb->add_option("--fov", o->fov_deg, "horizontal opening angle, degrees")
      ->check(number_in(0.001, 340))
      ->capture_default_str();
  add_overlay_option(*verb, o->overlays);
  verb->add_option("--threads", o->threads, "0: one per processor")->check(number_in(0, 1024));
  verb->callback([o] { preview(*o); });
}

}  // namespace domefall
