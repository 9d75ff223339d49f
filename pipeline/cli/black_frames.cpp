#include "pipeline/cli/black_frames.h"

#include <algorithm>

#include "pipeline/farm/brightest_value.h"
#include "pipeline/render/renderer.h"
#include "pipeline/survey/light_survey.h"
#include "pipeline/survey/reduced_frame.h"

namespace domefall {
namespace {

constexpr int kSmallWidth = 96;
constexpr double kSurelyBrighter = 10;

// Returns the greatest code as a part of white.
double brightest_of(const GradedFrame& frame) {
  constexpr double kWhite = 65535;
  return *std::max_element(frame.pixels.begin(), frame.pixels.end()) / kWhite;
}

}  // namespace

std::vector<int> unexpectedly_black(const Show& show, const FolderFindings& found,
                                    const Grader* grader, int threads) {
  std::vector<int> unexpected;
  const std::vector<int> black = joined_frames({&found.black_linear, &found.black_graded});
  if (black.empty()) return unexpected;
  Renderer renderer(show, threads, {}, kSurveyDetail);
  for (const int frame : black) {
    const FrameState state = reduced(frame_state(show, frame), kSmallWidth);
    const HalfFrame small = renderer.render(state);
    const bool light = brightest_value(small) > kSurelyBrighter * kBrightestOfBlack;
    const bool linear = std::ranges::binary_search(found.black_linear, frame),
               graded = grader && std::ranges::binary_search(found.black_graded, frame);
    if ((linear && light) || (graded && brightest_of(grader->with(state.cdl).grade(small)) >
                                            kSurelyBrighter * kBrightestOfBlackCodes))
      unexpected.push_back(frame);
  }
  return unexpected;
}

}  // namespace domefall
