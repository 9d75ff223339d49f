// This file has what a delivery says of itself, to people in README.txt and to programs in
// metadata.json.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "pipeline/base/frame_rate.h"
#include "pipeline/image/encode/display_colour.h"
#include "pipeline/image/graded_file.h"
#include "pipeline/theatre/delivery/frame_names.h"
#include "pipeline/theatre/delivery/subtitle_file.h"
#include "pipeline/theatre/delivery/test_pictures.h"
#include "pipeline/theatre/sound/sound.h"
#include "projections/projection.h"

namespace domefall {

// These names of files are the same in every delivery.
inline constexpr const char *kReadme = "README.txt", *kMetadata = "metadata.json",
                            *kChecksums = "checksums.sha256", *kVerifyScript = "verify.sh",
                            *kContactSheet = "contact_sheet.png", *kPreview = "preview.png",
                            *kUnfinished = "INCOMPLETE.txt";

struct DeliveredSound {
  std::string path;  // below the delivery
  SoundFile sound;   // as it is delivered
  bool cut = false;  // or given a head that says how long it is; otherwise as it was given
};
struct DeliveredSubtitles {
  std::string path;
  SubtitleFile subtitles;
};

struct Delivery {
  std::string title;
  std::string show_file, show_sha256, show_digest;  // its name, and digests of it and of the show
  std::string software;
  FrameRate rate;
  Projection projection;
  GradedFormat format;
  std::string display, view;            // of the OpenColorIO configuration
  std::optional<DisplayColour> colour;  // where it is known
  DeliveredNames names;
  std::vector<DeliveredSound> sounds;
  std::vector<DeliveredSubtitles> subtitles;
  int leader_frames = 0;
  std::string alignment;  // the path of the alignment frame
  std::size_t files = 0;  // how many have a checksum, these texts included
};

int bits_of(const GradedFormat& format);
double duration_s(const Delivery& delivery);

// Returns a few lines for slate and alignment frame, the title first.
ShowLines show_lines(const Delivery& delivery);

std::string readme_text(const Delivery& delivery);
std::string metadata_text(const Delivery& delivery);

// Returns a script for any POSIX shell with sha256sum or shasum.  `files` is how many are on the
// list.
std::string verify_script(std::size_t files);

}  // namespace domefall
