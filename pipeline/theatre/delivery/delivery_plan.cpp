#include "pipeline/theatre/delivery/delivery_plan.h"

#include <fmt/format.h>

#include <algorithm>

#include "pipeline/base/errors.h"
#include "pipeline/base/talk.h"
#include "pipeline/render/frames/frame_run.h"
#include "pipeline/theatre/delivery/checksum_list.h"
#include "pipeline/theatre/delivery/folder_files.h"

namespace domefall {
namespace {

namespace fs = std::filesystem;

// Returns a file's name.  Throws InputError for a name that is hidden, or that lists and scripts
// could not hold without escapes.
std::string plain_file_name(const fs::path& file) {
  std::string name = file.filename().string();
  const bool plain = std::none_of(name.begin(), name.end(), [](char c) {
    constexpr char kFirstPlain = ' ', kDelete = 0x7f;
    return c == '\\' || (c >= 0 && c < kFirstPlain) || c == kDelete;
  });
  if (name.empty() || is_left_behind(name) || !plain)
    throw InputError(file.string() +
                     ": a delivered file may have no backslash or control character in its name, "
                     "nor a dot before it, nor the name of what systems leave in folders");
  return name;
}

DeliveredNames delivered_names(const DeliveryRun& run, const GradedFormat& format) {
  const int count = frame_count(run.show);
  const NamePattern pattern = run.name.empty()
                                  ? default_name_pattern(run.show.file.stem().string(), count)
                                  : parse_name_pattern(run.name);
  return {pattern, count, extension_of(format.kind)};
}

// Throws InputError unless each subtitle is gone a frame after the end of the frames at the latest.
void check_subtitles(const DeliveryRun& run, const Delivery& d) {
  const double length = duration_s(d), frame = length / d.names.count();
  for (std::size_t k = 0; k < d.subtitles.size(); ++k)
    if (const double end = d.subtitles[k].subtitles.end_s; end > length + frame)
      throw InputError(
          fmt::format("{}: the last subtitle ends at {:.3f} s, and the {} frames at {:.3f} s",
                      run.subtitles[k].string(), end, d.names.count(), length));
}

// A WAV file is delivered without what is beyond the last frame.  Others stay as they are.
void add_sounds(const DeliveryRun& run, Delivery& d) {
  for (SoundFile file : run.sound.files) {
    const std::uint64_t within = samples_within(file, d.names.count(), d.rate);
    const bool cut = file.wave && (file.wave->unfilled || within < file.frames);
    if (!file.wave && within < file.frames)
      say(file.file.string() + ": it is delivered as it is, since it is no WAV file");
    if (cut) file.frames = within;
    d.sounds.push_back({"audio/" + plain_file_name(file.file), file, cut});
  }
}

}  // namespace

GradedFormat delivered_format(const Show& show, std::optional<int> bits) {
  constexpr int kEight = 8;
  GradedFormat format = show.output.graded.value_or(GradedFormat{});
  if (!bits || *bits == bits_of(format)) return format;
  if (*bits != kEight)
    throw InputError(fmt::format(
        "--depth {}: the frames have 8 bits; `output: {{graded: png16}}` and `domefall grade` make "
        "them of 16",
        *bits));
  format.kind = format.kind == GradedKind::kTiff16 ? GradedKind::kTiff8 : GradedKind::kPng8;
  return format;
}

Delivery describe_delivery(const DeliveryRun& run, const GradedFrames& frames,
                           const GradedFormat& format) {
  Delivery d{.title = run.show.title,
             .show_file = run.show.file.filename().string(),
             .show_sha256 = sha256_of_file(run.show.file),
             .show_digest = frames.show_digest(),
             .software = kSoftware,
             .rate = frame_rate_of(run.show.frames_per_second),
             .projection = run.show.projection,
             .format = format,
             .display = frames.grader().display(),
             .view = frames.grader().view(),
             .colour = frames.grader().colour(),
             .names = delivered_names(run, format),
             .sounds = {},
             .subtitles = {},
             .leader_frames = run.leader ? leader_frames(run.show.frames_per_second) : 0,
             .alignment = std::string("alignment.") + extension_of(format.kind)};
  add_sounds(run, d);
  for (const fs::path& file : run.subtitles)
    d.subtitles.push_back({"subtitles/" + plain_file_name(file), read_subtitle_file(file)});
  check_subtitles(run, d);
  return d;
}

std::string leader_path(const Delivery& delivery, int k) {
  NamePattern pattern = delivery.names.pattern();
  pattern.before += "leader_";
  return "leader/" + name_of_number(pattern, k + 1) + "." + delivery.names.extension();
}

std::set<std::string> delivered_files(const Delivery& d) {
  std::set<std::string> files;
  for (int frame = 0; frame < d.names.count(); ++frame) files.insert(d.names.path(frame).string());
  for (int k = 0; k < d.leader_frames; ++k) files.insert(leader_path(d, k));
  const auto add_once = [&files](const std::string& path) {
    if (!files.insert(path).second)
      throw InputError(path + ": two files of the delivery would have this name");
  };
  for (const DeliveredSound& sound : d.sounds) add_once(sound.path);
  for (const DeliveredSubtitles& text : d.subtitles) add_once(text.path);
  add_once(d.alignment);
  for (const char* path : {kContactSheet, kPreview, kReadme, kMetadata, kVerifyScript})
    add_once(path);
  return files;
}

}  // namespace domefall
