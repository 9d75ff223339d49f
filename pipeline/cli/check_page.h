// What domefall check says of a show, as a page to read and as JSON.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "pipeline/cli/render_time.h"
#include "pipeline/survey/light_survey.h"
#include "pipeline/survey/show_jumps.h"
#include "pipeline/survey/show_survey.h"

namespace domefall {

struct CheckReport {
  const Show& show;
  std::string display, view;  // empty without a grade
  ShowSurvey survey;
  std::vector<SegmentJoint> joints;
  std::vector<ShowWarning> warnings;
  LightSurvey light;
  std::optional<RenderTime> time;  // none where it was not measured
};

std::string check_page(const CheckReport& report);

// One object; numbers that are infinite are null.
std::string check_json(const CheckReport& report);

// "41 s", "12 min", "3.5 h", "20 days", "1.6 ms"; seconds may be negative.
std::string duration_text(double seconds);

}  // namespace domefall
