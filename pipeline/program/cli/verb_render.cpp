#include <CLI/CLI.hpp>

#include "pipeline/image/frame_list.h"
#include "pipeline/program/cli/option_types.h"
#include "pipeline/program/cli/verbs.h"
#include "pipeline/render/frames/frame_folder.h"
#include "pipeline/render/frames/frame_run.h"
#include "pipeline/show/file/read_show.h"

namespace domefall {
namespace {

struct RenderOptions {
  std::string show, frames, size, out, overlays, progress;
  int threads = 0;
  bool explain = false, replace = false, dry = false, lens_map = false;
};

// Does the work of render and of grade, which go over the same frames and put them in the same
// places.
void run(const RenderOptions& o, bool render) {
  const Show show = read_show(o.show, o.size, o.overlays);
  FrameRun frames{show,
                  parse_frames(o.frames, frame_count(show)),
                  frames_folder(show, o.out),
                  o.threads,
                  o.explain,
                  render,
                  o.replace,
                  o.dry};
  if (!o.progress.empty()) frames.progress = progress_form(o.progress);
  o.lens_map ? run_lens_maps(frames) : run_frames(frames);
}

void add_frame_options(CLI::App& verb, const std::shared_ptr<RenderOptions>& o) {
  add_show(verb, o->show)->required();
  verb.add_option("--frames", o->frames,
                  "7, 0-299, 0-599x10 (every tenth), or several joined by commas; default all")
      ->type_name("FRAMES");
  verb.add_option("--size", o->size,
                  "1k, 2k, 4k, 8k or pixels for a dome, WIDTHxHEIGHT for a flat picture")
      ->type_name("SIZE");
  add_folder(verb, "--out", o->out, "folder for linear/ and graded/ frames; default out/NAME")
      ->check(refuse_empty);
  add_overlay_option(verb, o->overlays);
  verb.add_flag("--replace", o->replace, "replace frames of another size, show or kind");
}

}  // namespace

void add_render(CLI::App& app) {
  auto* verb =
      app.add_subcommand("render", "Render frames: scene-linear EXR and graded PNG, TIFF or JPEG");
  auto o = std::make_shared<RenderOptions>();
  add_frame_options(*verb, o);
  add_threads(*verb, o->threads);
  auto* explain =
      verb->add_flag("--explain", o->explain, "print each frame's plan and what its stages cost");
  verb->add_flag("--lens-map", o->lens_map,
                 "instead write EXR files in lens/ that say where each pixel's light started, by "
                 "which other programs lens pictures")
      ->excludes(explain)
      ->excludes(verb->get_option("--overlay"));
  verb->add_option("--progress", o->progress,
                   "print a line for each frame as people or queue managers read it: plain, json, "
                   "openjd (Open Job Description) or afanasy (CGRU)")
      ->check(CLI::IsMember({"plain", "json", "openjd", "afanasy"}))
      ->excludes("--lens-map");
  verb->add_flag("--dry-run", o->dry, "only print which frames would be made");
  verb->callback([o] { run(*o, true); });
}

void add_grade(CLI::App& app) {
  auto* verb = app.add_subcommand("grade", "Grade frames again that are already rendered");
  auto o = std::make_shared<RenderOptions>();
  add_frame_options(*verb, o);
  verb->callback([o] { run(*o, false); });
}

}  // namespace domefall
