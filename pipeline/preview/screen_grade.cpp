#include "pipeline/preview/screen_grade.h"

#include "pipeline/show/assets.h"
#include "pipeline/survey/reduced_frame.h"

namespace domefall {

GradeSettings for_a_screen(GradeSettings settings) {
  if (settings.display.empty() && settings.config == shipped_asset(kDomeConfig))
    settings.display = "sRGB - Display";
  return settings;
}

// A small dome takes little time, and has the mean light of a large one but for what is clipped to
// white.
void change_as_in_dome(const Grader& grader, Renderer& renderer, const FrameState& dome,
                       GradedFrame& picture) {
  constexpr int kDomeWidth = 512;
  const GradedFrame small = grader.grade(renderer.render(reduced(dome, kDomeWidth)));
  DomeCodes codes;
  codes.add_rows(small, 0, small.height);
  grader.dome_light()->map_for(codes).change(
      picture.row(0), static_cast<std::ptrdiff_t>(picture.width) * picture.height);
}

}  // namespace domefall
