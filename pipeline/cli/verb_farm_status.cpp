#include <fmt/format.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <chrono>
#include <cstdio>
#include <memory>
#include <thread>

#include "pipeline/cli/farm_page.h"
#include "pipeline/cli/interruption.h"
#include "pipeline/cli/verbs.h"

namespace domefall {
namespace {

struct StatusOptions {
  FarmRequest request;
  bool json = false, watch = false;
};

// Returns a page, or JSON.  An object takes one line where others will follow it.
std::string status_text(const StatusOptions& o, const FarmFrames& frames,
                        const FarmStatus& status) {
  constexpr int kIndent = 2, kOneLine = -1;
  if (o.json) return farm_json(frames, status, o.watch ? kOneLine : kIndent) + "\n";
  return farm_page(frames, status);
}

// Says the status anew every two seconds until all is done.  On a terminal it replaces the text
// before, and elsewhere it follows that.  A signal is the way in which this is meant to end.
void watch_folder(const StatusOptions& o) {
  constexpr std::chrono::milliseconds kPause(2000), kStep(50);
  const bool terminal = isatty(STDOUT_FILENO) != 0;
  for (;;) {
    // The show may have been changed meanwhile, and the plan has a new round now and then.
    const FarmFrames frames(o.request);
    const FarmStatus status = farm_status(frames, reading_threads(o.request));
    if (terminal && !o.json) fmt::print("\x1b[H\x1b[J");
    fmt::print("{}", status_text(o, frames, status));
    std::fflush(stdout);
    if (is_complete(status) || std::ferror(stdout)) return;
    for (std::chrono::milliseconds waited(0); waited < kPause; waited += kStep) {
      stop_if_interrupted();
      std::this_thread::sleep_for(kStep);
    }
  }
}

void show_status(const StatusOptions& o) {
  catch_interruptions();
  if (!o.watch) {
    const FarmFrames frames(o.request);
    fmt::print("{}", status_text(o, frames, farm_status(frames, reading_threads(o.request))));
    return;
  }
  try {
    watch_folder(o);
  } catch (Interrupted& stop) {
    stop.expected = true;
    throw;
  }
}

}  // namespace

void add_farm_status(CLI::App& farm) {
  auto* verb = farm.add_subcommand(
      "status", "How far a show's frames are, by their names, beginnings and manifests");
  auto o = std::make_shared<StatusOptions>();
  add_farm_options(*verb, o->request);
  verb->add_flag("--json", o->json, "print it as JSON; with --watch one object a line");
  verb->add_flag("--watch", o->watch, "say it again every two seconds until all frames are done");
  verb->callback([o] { show_status(*o); });
}

}  // namespace domefall
