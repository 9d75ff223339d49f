#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <memory>

#include "pipeline/base/errors.h"
#include "pipeline/base/utf8.h"
#include "pipeline/image/frame_list.h"
#include "pipeline/program/cli/option_types.h"
#include "pipeline/program/cli/output_file.h"
#include "pipeline/program/cli/verbs.h"
#include "pipeline/render/frames/frame_folder.h"
#include "pipeline/render/thread_limit.h"
#include "pipeline/show/file/read_show.h"
#include "pipeline/theatre/delivery/contact_sheet.h"
#include "pipeline/theatre/delivery/delivery_check.h"
#include "pipeline/theatre/delivery/delivery_run.h"
#include "pipeline/theatre/sound/sound.h"

namespace domefall {
namespace {

struct DeliverOptions {
  std::string show, from, out, size, name, check, overlays;
  std::vector<std::string> sounds, subtitles;
  int bits = 0, threads = 0;
  bool leader = false;
};

std::string describe_files(const char* what, const std::vector<std::string>& files) {
  std::string text;
  constexpr std::size_t kMost = 20;
  for (std::size_t k = 0; k < std::min(files.size(), kMost); ++k)
    text += fmt::format("\n  {}: {}", what, printable(files[k]));
  if (files.size() > kMost) text += fmt::format("\n  {}: {} more", what, files.size() - kMost);
  return text;
}

void check_folder(const std::string& folder, int threads) {
  const DeliveryFaults faults = check_delivery(folder, threads);
  const std::string left =
      describe_files("left by a system or a file manager, which is no fault", faults.left_behind);
  if (faults.none()) {
    fmt::print("{}: complete, and as it was delivered{}\n", printable(folder), left);
    return;
  }
  std::string text = folder + ": the delivery is not as it should be";
  for (const std::string& sentence : faults.whole) text += "\n  " + sentence;
  const auto add = [&text](const char* what, const std::vector<int>& numbers) {
    if (!numbers.empty()) text += fmt::format("\n  frames {}: {}", what, as_ranges(numbers));
  };
  add("missing", faults.missing_frames);
  add("changed or damaged", faults.damaged_frames);
  add("that are copies of others", faults.repeated_frames);
  add("of another number, show, size, depth or kind than metadata.json says", faults.other_frames);
  text += describe_files("missing", faults.missing_files);
  text += describe_files("changed", faults.changed_files);
  text += describe_files("not of this delivery", faults.extra_files);
  throw InputError(text + left);
}

void deliver(const DeliverOptions& o) {
  if (!o.check.empty()) return check_folder(o.check, all_threads(o.threads));
  if (o.show.empty() || o.out.empty())
    throw InputError("a show and --out are needed, or --check with a folder");
  const Show show = read_show(o.show, o.size, o.overlays);
  DeliveryRun run{.show = show,
                  .from = frames_folder(show, o.from),
                  .out = o.out,
                  .bits = {},
                  .name = o.name,
                  .sound = show_sound(show, o.sounds),
                  .subtitles = {o.subtitles.begin(), o.subtitles.end()},
                  .leader = o.leader,
                  .threads = all_threads(o.threads)};
  if (o.bits > 0) run.bits = o.bits;
  run_delivery(run);
}

struct SheetOptions {
  std::string show, from, out, size, frames;
  int threads = 0;
};

std::vector<int> shown_frames(const std::string& named, int count) {
  if (named.empty()) return frames_of_sheet(count);
  std::vector<int> frames = parse_frames(named, count);
  if (std::ssize(frames) > kMostOnSheet)
    throw InputError(fmt::format("--frames {}: a sheet has room for {} frames, got {}", named,
                                 kMostOnSheet, frames.size()));
  return frames;
}

void make_sheet(const SheetOptions& o) {
  GradedFormat format = format_by_name(o.out);
  if (format.kind == GradedKind::kPng16) format.kind = GradedKind::kPng8;
  if (format.kind == GradedKind::kTiff16) format.kind = GradedKind::kTiff8;
  const Show show = read_show(o.show, o.size, {});
  OutputFile out(o.out);
  const Grader grader(show.grade);
  const GradedFrames frames(show, grader, frames_folder(show, o.from));
  const std::vector<int> shown = shown_frames(o.frames, frame_count(show));
  const int threads = frames_at_once(show, all_threads(o.threads));
  frames.check(shown, threads, kOtherFramesHint, {});
  std::vector<std::string> labels;
  labels.reserve(shown.size());
  for (const int frame : shown) labels.push_back(fmt::to_string(frame));
  GradedInfo info = frames.info(0);
  info.key.clear();
  info.pixel_aspect = 1;
  write_graded(out.path(), sheet_of_frames(frames, show, shown, labels, threads), info, format);
  out.finish();
}

}  // namespace

void add_deliver(CLI::App& app) {
  auto* verb = app.add_subcommand("deliver",
                                  "Make the folder that festivals and domes ask for, or check one");
  auto o = std::make_shared<DeliverOptions>();
  auto* show = add_show(*verb, o->show);
  add_folder(*verb, "--from", o->from, "folder of the rendered frames; default out/NAME");
  auto* out = add_folder(*verb, "--out", o->out, "folder to make");
  verb->add_option("--size", o->size, "of the frames, where it is not the show's")
      ->type_name("SIZE");
  verb->add_option("--depth", o->bits,
                   "bits a colour: 8 (24-bit pictures) or 16; default as they are")
      ->check(CLI::IsMember({8, 16}));
  verb->add_option("--name", o->name, "such as my_show_#####; default the show's file name")
      ->type_name("NAME");
  add_file(*verb, "--audio", o->sounds, kAudioHelp);
  add_file(*verb, "--subtitles", o->subtitles, "SubRip files (.srt)");
  add_overlay_option(*verb, o->overlays);
  verb->add_flag("--leader", o->leader, "slate and countdown, in a folder of their own");
  add_threads(*verb, o->threads);
  add_folder(*verb, "--check", o->check, "instead: say what a delivered folder lacks")
      ->excludes(show)
      ->excludes(out);
  verb->callback([o] { deliver(*o); });
}

void add_sheet(CLI::App& app) {
  auto* verb = app.add_subcommand("sheet", "A contact sheet of finished frames");
  auto o = std::make_shared<SheetOptions>();
  add_show(*verb, o->show)->required();
  add_folder(*verb, "--from", o->from, "folder of the rendered frames; default out/NAME");
  add_file(*verb, "--out", o->out, "picture to write, .png, .tif or .jpg")->required();
  verb->add_option("--frames", o->frames, "up to 36: 7, 0-299x10, 100-135; default some of all")
      ->type_name("FRAMES");
  verb->add_option("--size", o->size, "of the frames, where it is not the show's")
      ->type_name("SIZE");
  add_threads(*verb, o->threads);
  verb->callback([o] { make_sheet(*o); });
}

}  // namespace domefall
