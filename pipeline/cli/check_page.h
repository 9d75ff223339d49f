// What domefall check says of a show: a page to read, or the same facts as JSON.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "pipeline/survey/light_survey.h"
#include "pipeline/survey/render_time.h"
#include "pipeline/survey/show_jumps.h"
#include "pipeline/survey/show_survey.h"
#include "pipeline/survey/show_warning.h"
#include "pipeline/survey/sky_survey.h"

namespace domefall {

struct CheckedSky {
  SkySources sources;
  std::optional<double> black;  // of its map, cd/m^2
};

// The disk that a folder of frames is on, or would be on.
struct DiskRoom {
  std::filesystem::path folder;
  double free = 0, taken = 0;  // bytes; taken by what is in the folder already
};
// Nothing where the system does not tell.
std::optional<DiskRoom> disk_room(const std::filesystem::path& folder);

struct CheckReport {
  const Show& show;
  std::string display, view;  // empty without a grade
  ShowSurvey survey;
  std::vector<SegmentJoint> joints;
  std::vector<ShowWarning> warnings;
  LightSurvey light;
  std::optional<RenderTime> time;  // none where it was not measured
  std::vector<CheckedSky> skies;   // those that are visited
  std::optional<DiskRoom> room;    // for the frames, where the system tells
};

// What the frames take on the disk, in bytes: as estimated from a few of them, or else without any
// compression.
struct DiskSize {
  int frames = 0;
  double linear = 0, graded = 0;  // of one frame; 0 without a grade
  bool measured = false;

  double total() const { return frames * (linear + graded); }
};
DiskSize disk_size(const CheckReport& report);

// What to say of frames that will not fit on the disk; empty if they will.
std::string lack_of_room(const CheckReport& report);

// About 40 lines: the show, its segments and joints, its extremes, its light, its warnings.
std::string check_page(const CheckReport& report);

// One JSON object on one line.  Numbers have twelve digits, and an infinite one is null.
std::string check_json(const CheckReport& report);

// Three digits in the unit that suits: "850 kB", "12.3 GB".
std::string bytes_text(double bytes);

// Three digits in the unit that suits: "41 s", "12 min", "3.5 h", "20 days", "1.6 ms".  The seconds
// may be negative.
std::string duration_text(double seconds);

}  // namespace domefall
