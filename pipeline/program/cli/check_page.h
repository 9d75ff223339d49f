// This file says what `domefall check` finds out about a show, as a page to read or as JSON with
// the same facts.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "pipeline/base/disk_room.h"
#include "pipeline/program/survey/light_survey.h"
#include "pipeline/program/survey/show_jumps.h"
#include "pipeline/program/survey/show_survey.h"
#include "pipeline/program/survey/show_warnings.h"
#include "pipeline/program/survey/sky_survey.h"
#include "pipeline/render/render_time.h"

namespace domefall {

struct CheckedSky {
  SkySources sources;
  std::optional<double> black;  // of its map, cd/m^2
};

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

// DiskSize says how many bytes the frames take on the disk.  They are estimated from a few frames
// where those have been rendered, and otherwise counted without any compression.
struct DiskSize {
  int frames = 0;
  double linear = 0, graded = 0;  // bytes of one frame; 0 for files that are not kept
  bool measured = false;

  double total() const { return frames * (linear + graded); }
};
DiskSize disk_size(const CheckReport& report);

// Returns what to say of frames that will not fit on the disk, or an empty text if they will.
std::string lack_of_room(const CheckReport& report);

// Returns some 40 lines about the show, its segments and joints, its extremes, light and warnings.
std::string check_page(const CheckReport& report);

// Returns one JSON object on one line.  Numbers have twelve digits, and an infinite one is null.
std::string check_json(const CheckReport& report);

// Returns three digits in the unit that suits, such as "41 s", "12 min", "3.5 h", "20 days" or "1.6
// ms".  The seconds may be negative.
std::string duration_text(double seconds);

}  // namespace domefall
