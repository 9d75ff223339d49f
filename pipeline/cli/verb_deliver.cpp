#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <memory>
#include <thread>

#include "pipeline/cli/delivery_run.h"
#include "pipeline/cli/frame_folder.h"
#include "pipeline/cli/frame_sheet.h"
#include "pipeline/cli/frame_survey.h"
#include "pipeline/cli/number_in.h"
#include "pipeline/cli/option_types.h"
#include "pipeline/cli/output_file.h"
#include "pipeline/cli/overlay_option.h"
#include "pipeline/cli/verbs.h"
#include "pipeline/deliver/contact_sheet.h"
#include "pipeline/deliver/delivery_check.h"
#include "pipeline/image/errors.h"
#include "pipeline/image/frame_list.h"
#include "pipeline/show/frame_size.h"
#include "pipeline/show/read_show.h"

namespace domefall {
namespace {

struct DeliverOptions {
  std::string show, from, out, size, name, check, overlays;
  std::vector<std::string> sounds, subtitles;
  int bits = 0, threads = 0;
  bool leader = false;
};

int threads_of(int asked) {
  return asked > 0 ? asked : std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
}

std::string describe_files(const char* what, const std::vector<std::string>& files) {
  std::string text;
  constexpr std::size_t kMost = 20;
  for (std::size_t k = 0; k < std::min(files.size(), kMost); ++k)
    text += fmt::format("\n  {}: {}", what, files[k]);
  if (files.size() > kMost) text += fmt::format("\n  {}: {} more", what, files.size() - kMost);
  return text;
}

void check_folder(const std::string& folder, int threads) {
  const DeliveryFaults faults = check_delivery(folder, threads);
  if (faults.none()) {
    fmt::print("{}: complete, and as it was delivered\n", folder);
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
  throw InputError(text);
}

void deliver(const DeliverOptions& o) {
  if (!o.check.empty()) return check_folder(o.check, threads_of(o.threads));
  if (o.show.empty() || o.out.empty())
    throw InputError("a show and --out are needed, or --check with a folder");
  Show show = read_show(o.show);
  overlay(show, o.overlays);
  show.projection = resized(show.projection, o.size);
  DeliveryRun run{show,     frames_folder(show, o.from), o.out, {}, o.name, {}, {},
                  o.leader, threads_of(o.threads)};
  if (o.bits > 0) run.bits = o.bits;
  run.sounds.assign(o.sounds.begin(), o.sounds.end());
  run.subtitles.assign(o.subtitles.begin(), o.subtitles.end());
  run_delivery(run);
}

struct SheetOptions {
  std::string show, from, out, size;
  int threads = 0;
};

void make_sheet(const SheetOptions& o) {
  GradedFormat format = format_by_name(o.out);
  if (format.kind == GradedKind::kPng16) format.kind = GradedKind::kPng8;
  if (format.kind == GradedKind::kTiff16) format.kind = GradedKind::kTiff8;
  Show show = read_show(o.show);
  show.projection = resized(show.projection, o.size);
  OutputFile out(o.out);
  const GradedFrames frames(show, frames_folder(show, o.from));
  const std::vector<int> shown = frames_of_sheet(frame_count(show));
  const int threads = frames_at_once(show, threads_of(o.threads));
  frames.check(shown, threads);
  std::vector<std::string> labels;
  labels.reserve(shown.size());
  for (const int frame : shown) labels.push_back(fmt::to_string(frame));
  GradedInfo info = frames.info(0);
  info.key.clear();
  write_graded(out.path(), sheet_of_frames(frames, show, shown, labels, threads), info, format);
  out.finish();
}

}  // namespace

void add_deliver(CLI::App& app) {
  auto* verb = app.add_subcommand("deliver",
                                  "Make the folder that festivals and domes ask for, or check one");
  auto o = std::make_shared<DeliverOptions>();
  auto* show = add_show(*verb, o->show);
  verb->add_option("--from", o->from, "folder of the rendered frames; default out/NAME")
      ->type_name(kFolderType);
  auto* out = verb->add_option("--out", o->out, "folder to make")->type_name(kFolderType);
  verb->add_option("--size", o->size, "of the frames, where it is not the show's")
      ->type_name("SIZE");
  verb->add_option("--depth", o->bits,
                   "bits a colour: 8 (24-bit pictures) or 16; default as they are")
      ->check(CLI::IsMember({8, 16}));
  verb->add_option("--name", o->name, "such as my_show_#####; default the show's file name")
      ->type_name("NAME");
  verb->add_option("--audio", o->sounds, "WAV files, as long as the frames")->type_name(kFileType);
  verb->add_option("--subtitles", o->subtitles, "SubRip files (.srt)")->type_name(kFileType);
  add_overlay_option(*verb, o->overlays);
  verb->add_flag("--leader", o->leader, "slate and countdown, in a folder of their own");
  verb->add_option("--threads", o->threads, "0: one per processor")->check(number_in(0, 1024));
  verb->add_option("--check", o->check, "instead: say what a delivered folder lacks")
      ->type_name(kFolderType)
      ->excludes(show)
      ->excludes(out);
  verb->callback([o] { deliver(*o); });
}

void add_sheet(CLI::App& app) {
  auto* verb = app.add_subcommand("sheet", "A contact sheet of finished frames");
  auto o = std::make_shared<SheetOptions>();
  add_show(*verb, o->show)->required();
  verb->add_option("--from", o->from, "folder of the rendered frames; default out/NAME")
      ->type_name(kFolderType);
  verb->add_option("--out", o->out, "picture to write, .png, .tif or .jpg")
      ->type_name(kFileType)
      ->required();
  verb->add_option("--size", o->size, "of the frames, where it is not the show's")
      ->type_name("SIZE");
  verb->add_option("--threads", o->threads, "0: one per processor")->check(number_in(0, 1024));
  verb->callback([o] { make_sheet(*o); });
}

}  // namespace domefall
