#include <fmt/format.h>
#include <spawn.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <array>
#include <atomic>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <memory>
#include <numbers>
#include <thread>

#include "pipeline/base/interruption.h"
#include "pipeline/base/talk.h"
#include "pipeline/base/temporary_file.h"
#include "pipeline/grade/grader.h"
#include "pipeline/image/graded_file.h"
#include "pipeline/program/cli/frame_choice.h"
#include "pipeline/program/cli/number_in.h"
#include "pipeline/program/cli/option_types.h"
#include "pipeline/program/cli/output_file.h"
#include "pipeline/program/cli/verbs.h"
#include "pipeline/program/preview/preview_server.h"
#include "pipeline/program/preview/screen_view.h"
#include "pipeline/render/frame_key.h"
#include "pipeline/render/frames/frame_run.h"
#include "pipeline/render/renderer.h"
#include "pipeline/show/file/frame_size.h"
#include "pipeline/show/file/read_show.h"

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
  Show show = read_show(o.show, {}, o.overlays);
  const int number = chosen_frame(o.choice, show);
  OutputFile out(o.out);
  const Projection flat =
      resized(Stereographic{16, 16, o.fov_deg * std::numbers::pi / 180}, o.size);
  const FrameState dome = frame_state(show, number);
  FrameState state = dome;
  see_in(show, flat, state);
  show.grade = for_a_screen(show.grade);
  show.exposure.shutter = 0;  // whose instants would follow the dome's camera
  const Grader of_show(show.grade), grader = of_show.with(state.cdl);
  Renderer renderer(show, o.threads);
  GradedFrame picture = grader.grade(renderer.render(state));
  if (grader.dome_light()) change_as_in_dome(grader, renderer, dome, picture);
  const FrameKeys keys(show, grader.transform_id());
  write_graded(
      out.path(), picture,
      graded_info(show, state.projection, number, grader, keys.graded(keys.scene(state), state)),
      format);
  out.finish();
}

// Starts the desktop's own opener, and does not wait for it.  The opener ends when the browser has
// the file, and whatever it says is not for the terminal.
void open_on_desktop(std::string file) {
  std::string program = "xdg-open";
  std::array<char*, 3> arguments{program.data(), file.data(), nullptr};
  posix_spawn_file_actions_t quiet;
  posix_spawn_file_actions_init(&quiet);
  for (const int stream : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO})
    posix_spawn_file_actions_addopen(&quiet, stream, "/dev/null", 02, 0);
  pid_t process = 0;
  posix_spawnp(&process, program.c_str(), &quiet, nullptr, arguments.data(), environ);
  posix_spawn_file_actions_destroy(&quiet);
}

// Opens an address in the browser of this desktop, and does nothing where there is no desktop.  The
// address may hold a secret: programs are given a page that leads to it, in a folder that only this
// user may enter.  The page is there for as long as what is returned.  Throws as ScratchFolder and
// write_output().
std::unique_ptr<ScratchFolder> open_browser(const std::string& url) {
  const auto is_set = [](const char* name) {
    const char* value = std::getenv(name);
    return value != nullptr && *value != '\0';
  };
  if (!is_set("DISPLAY") && !is_set("WAYLAND_DISPLAY")) return nullptr;
  auto folder = std::make_unique<ScratchFolder>();
  const std::filesystem::path page = std::filesystem::absolute(*folder / "preview.html");
  write_output(page, fmt::format("<!doctype html><title>Domefall</title>"
                                 "<meta http-equiv=\"refresh\" content=\"0; url={0}\">"
                                 "<a href=\"{0}\">the live preview</a>\n",
                                 url));
  using std::filesystem::perms;
  std::filesystem::permissions(page, perms::owner_read | perms::owner_write);
  open_on_desktop(page);
  return folder;
}

// Returns the name by which others may know this machine, or HOST if the system does not tell.
std::string host_name() {
  std::array<char, 256> name{};
  if (gethostname(name.data(), name.size() - 1) != 0) return "HOST";
  return name.data();
}

// Serves the viewer until a signal ends it.
void serve(const PreviewOptions& o) {
  PreviewServer server(o.show, o.port, o.threads);
  fmt::print("{}\n", server.url());
  fmt::print("from another machine: ssh -L {}:127.0.0.1:{} {}, then the same address there\n",
             server.port(), server.port(), host_name());
  std::fflush(stdout);
  catch_interruptions();
  // The port is there already, and a browser that asks too early waits.  A program that is started
  // now inherits no connection.
  std::unique_ptr<ScratchFolder> opened;
  try {
    if (!o.no_open) opened = open_browser(server.url());
  } catch (const std::exception& error) {  // a full disk, say; the address is there all the same
    say(fmt::format("no browser was opened: {}", error.what()));
  }
  std::atomic<bool> served = false;
  std::thread serving([&] {
    server.serve();
    served = true;
  });
  while (!was_interrupted()) std::this_thread::sleep_for(std::chrono::milliseconds(100));
  server.stop();
  opened.reset();
  // An answer that is being made may have a large catalogue to load first.
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
      add_file(*verb, "--out", o->out, "one picture to write, and no viewer: .png, .tif or .jpg");
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
  add_threads(*verb, o->threads);
  verb->callback([o] { preview(*o); });
}

}  // namespace domefall
