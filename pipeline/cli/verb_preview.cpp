#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <atomic>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <memory>
#include <numbers>
#include <thread>

#include "pipeline/cli/browser.h"
#include "pipeline/cli/frame_choice.h"
#include "pipeline/cli/frame_run.h"
#include "pipeline/cli/interruption.h"
#include "pipeline/cli/number_in.h"
#include "pipeline/cli/option_types.h"
#include "pipeline/cli/output_file.h"
#include "pipeline/cli/overlay_option.h"
#include "pipeline/cli/verbs.h"
#include "pipeline/grade/grader.h"
#include "pipeline/image/graded_file.h"
#include "pipeline/preview/preview_server.h"
#include "pipeline/preview/screen_grade.h"
#include "pipeline/preview/screen_view.h"
#include "pipeline/render/frame_key.h"
#include "pipeline/render/renderer.h"
#include "pipeline/show/frame_size.h"
#include "pipeline/show/read_show.h"

namespace domefall {
namespace {

struct PreviewOptions {
  std::string show, out, overlays, size = "1280x720";
  FrameChoice choice;
  int threads = 0, port = 0;
  double fov_deg = 100;
  bool no_open = false;
};

void write_still(const PreviewOptions& o) {
  const GradedFormat format = format_by_name(o.out);
  Show show = read_show(o.show);
  overlay(show, o.overlays);
  const int number = chosen_frame(o.choice, show);
  OutputFile out(o.out);
  const Projection flat =
      resized(Stereographic{16, 16, o.fov_deg * std::numbers::pi / 180}, o.size);
  const FrameState dome = frame_state(show, number);
  FrameState state = dome;
  see_in(show, flat, state);
  show.grade = for_a_screen(show.grade);
  const Grader of_show(show.grade), grader = of_show.with(state.cdl);
  Renderer renderer(show, o.threads);
  GradedFrame picture = grader.grade(renderer.render(state));
  if (grader.dome_light()) change_as_in_dome(grader, renderer, dome, picture);
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

// Serves the viewer until a signal ends it.
void serve(const PreviewOptions& o) {
  PreviewServer server(o.show, o.port, o.threads);
  fmt::print("{}\n", server.url());
  fmt::print("from another machine: ssh -L {}:127.0.0.1:{} {}, then the same address there\n",
             server.port(), server.port(), host_name());
  std::fflush(stdout);
  catch_interruptions();
  std::atomic<bool> served = false;
  std::thread serving([&] {
    server.serve();
    served = true;
  });
  if (!o.no_open) open_browser(server.url());
  while (!was_interrupted()) std::this_thread::sleep_for(std::chrono::milliseconds(100));
  server.stop();
  // The server does not stop before its connections end, and whoever sends a byte now and then
  // could keep one for ever.
  constexpr int kGrace = 20;  // tenths of a second
  for (int k = 0; k < kGrace && !served; ++k)
    std::this_thread::sleep_for(std::chrono::milliseconds(100));
  if (!served) std::_Exit(code_after(*was_interrupted()));
  serving.join();
  throw Interrupted{*was_interrupted(), true};
}

void preview(const PreviewOptions& o) {
  if (!o.out.empty()) return write_still(o);
  serve(o);
}

}  // namespace

void add_preview(CLI::App& app) {
  auto* verb = app.add_subcommand(
      "preview", "A viewer in the browser, beside the editor; or one frame as a flat picture");
  auto o = std::make_shared<PreviewOptions>();
  add_show(*verb, o->show)->required();
  add_frame_choice(*verb, o->choice);
  auto* out =
      verb->add_option("--out", o->out, "one picture to write, and no viewer: .png, .tif or .jpg")
          ->type_name(kFileType);
  verb->add_option("--size", o->size, "WIDTHxHEIGHT of that picture")
      ->type_name("SIZE")
      ->needs(out)
      ->capture_default_str();
  verb->add_option("--fov", o->fov_deg, "its horizontal opening angle, degrees")
      ->needs(out)
      ->check(number_in(0.001, 340))
      ->capture_default_str();
  add_overlay_option(*verb, o->overlays);
  for (const char* name : {"--frame", "--at", "--overlay"}) verb->get_option(name)->needs(out);
  verb->add_flag("--no-open", o->no_open, "only print the viewer's address");
  verb->add_option("--port", o->port, "of the viewer on 127.0.0.1; 0: any that is free")
      ->check(number_in(0, 65535));
  verb->add_option("--threads", o->threads, "0: one per processor")->check(number_in(0, 1024));
  verb->callback([o] { preview(*o); });
}

}  // namespace domefall
