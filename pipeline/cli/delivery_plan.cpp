#include "pipeline/cli/delivery_plan.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "pipeline/cli/frame_run.h"
#include "pipeline/deliver/checksum_list.h"
#include "pipeline/image/errors.h"

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
  if (name.empty() || name.starts_with('.') || !plain)
    throw InputError(file.string() +
                     ": a delivered file may have no backslash or control character in its name, "
                     "nor a dot before it");
  return name;
}

DeliveredNames delivered_names(const DeliveryRun& run, const GradedFormat& format) {
  const int count = frame_count(run.show);
  const NamePattern pattern = run.name.empty()
                                  ? default_name_pattern(run.show.file.stem().string(), count)
                                  : parse_name_pattern(run.name);
  return {pattern, count, extension_of(format.kind)};
}

// Throws InputError unless each sound lasts as long as the frames, to within one frame, and each
// subtitle is gone a frame after their end at the latest.  Sounds must also agree in rate and bits.
void check_lengths(const DeliveryRun& run, const Delivery& d) {
  const double length = duration_s(d), frame = length / d.names.count();
  for (std::size_t k = 0; k < d.sounds.size(); ++k) {
    const SoundFile &sound = d.sounds[k].sound, &first = d.sounds.front().sound;
    if (std::abs(sound.seconds() - length) > frame)
      throw InputError(fmt::format(
          "{}: the sound lasts {:.3f} s and the {} frames last {:.3f} s; they may differ by one "
          "frame",
          run.sounds[k].string(), sound.seconds(), d.names.count(), length));
    if (sound.rate != first.rate || sound.bits != first.bits)
      throw InputError(fmt::format("{}: the sound has {} Hz and {} bits, and {} has {} and {}",
                                   run.sounds[k].string(), sound.rate, sound.bits,
                                   run.sounds.front().string(), first.rate, first.bits));
  }
  for (std::size_t k = 0; k < d.subtitles.size(); ++k)
    if (const double end = d.subtitles[k].subtitles.end_s; end > length + frame)
      throw InputError(
          fmt::format("{}: the last subtitle ends at {:.3f} s, and the {} frames at {:.3f} s",
                      run.subtitles[k].string(), end, d.names.count(), length));
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
  for (const fs::path& file : run.sounds)
    d.sounds.push_back({"audio/" + plain_file_name(file), read_sound_file(file)});
  for (const fs::path& file : run.subtitles)
    d.subtitles.push_back({"subtitles/" + plain_file_name(file), read_subtitle_file(file)});
  check_lengths(run, d);
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
