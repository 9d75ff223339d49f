#include <CLI/CLI.hpp>
#include <memory>
#include <string>

#include "pipeline/program/cli/option_types.h"
#include "pipeline/program/cli/output_file.h"
#include "pipeline/program/cli/verbs.h"
#include "pipeline/render/frames/frame_folder.h"
#include "pipeline/show/file/read_show.h"
#include "pipeline/theatre/timeline/timeline_files.h"

namespace domefall {
namespace {

struct TimelineOptions {
  std::string show, format = "otio", from, out = "/dev/stdout";
};

std::string text_of(const Show& show, const TimelineOptions& o) {
  if (o.format == "edl") return marker_list(show);
  if (o.format == "vtt") return subtitles(show, SubtitleKind::kWebVtt);
  if (o.format == "srt") return subtitles(show, SubtitleKind::kSubRip);
  return otio_text(show, FrameFolder(frames_folder(show, o.from), show));
}

void write_timeline(const TimelineOptions& o) {
  const Show show = read_show(o.show);
  refuse_overwriting(o.out, o.show);
  write_output(o.out, text_of(show, o));
}

}  // namespace

void add_timeline(CLI::App& app) {
  auto* verb = app.add_subcommand("timeline", "Segments, markers or titles for editing programs");
  auto o = std::make_shared<TimelineOptions>();
  add_show(*verb, o->show)->required();
  verb->add_option("--format", o->format,
                   "otio: OpenTimelineIO; edl: markers for Resolve; vtt or srt: titles")
      ->check(CLI::IsMember({"otio", "edl", "vtt", "srt"}))
      ->capture_default_str();
  add_folder(*verb, "--from", o->from, "folder of the rendered frames; default out/NAME");
  add_file(*verb, "--out", o->out, "file to write; default the standard output");
  verb->callback([o] { write_timeline(*o); });
}

}  // namespace domefall
