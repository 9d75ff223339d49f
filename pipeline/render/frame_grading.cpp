#include "pipeline/render/frame_grading.h"

#include <algorithm>
#include <future>
#include <thread>
#include <vector>

namespace domefall {
namespace {

// Calls step(part, first, end) for `parts` parts of the rows, side by side.
template <class Step>
void in_parts(int rows, int parts, const Step& step) {
  std::vector<std::future<void>> others(static_cast<std::size_t>(parts));
  for (int part = 0; part < parts; ++part)
    others[static_cast<std::size_t>(part)] = std::async(std::launch::async, [=, &step] {
      // Parts differ by one row at most, and together they have all rows.
      step(part, rows * part / parts, rows * (part + 1) / parts);
    });
  // get() also throws what its part has thrown.
  for (auto& other : others) other.get();
}

}  // namespace

void FrameGrading::grade(const HalfFrame& frame, const FrameState& state,
                         const std::function<void(const RowPicture&)>& use) {
  // The grader of the frame before is used again if its CDL is the same.
  of_frame_ = of_frame_.value_or(of_show_).with(state.cdl);
  if (!of_show_.dome_light())
    return use({frame.width, frame.height, [&](int first, int end, unsigned short* rgb) {
                  of_frame_->grade_rows(frame, first, end, rgb);
                }});
  // The rows are ready before the first is asked for, and are only copied then.
  const GradedFrame whole = with_dome_light(frame);
  use({whole.width, whole.height, [&](int first, int end, unsigned short* rgb) {
         std::copy(whole.row(first), whole.row(end), rgb);
       }});
}

// Each part measures the areas of the codes in its own rows.  Their sums say how much light the
// dome sends onto itself, and the map that follows from them then changes all rows.
GradedFrame FrameGrading::with_dome_light(const HalfFrame& frame) const {
  GradedFrame whole(frame.width, frame.height);
  std::vector<DomeCodes> parts(static_cast<std::size_t>(threads_));
  in_parts(whole.height, threads_, [&](int part, int first, int end) {
    of_frame_->grade_rows(frame, first, end, whole.row(first));
    parts[static_cast<std::size_t>(part)].add_rows(whole, first, end);
  });
  for (std::size_t k = 1; k < parts.size(); ++k) parts[0].add(parts[k]);
  const CodeMap map = of_show_.dome_light()->map_for(parts[0]);
  in_parts(whole.height, threads_,
           [&](int, int first, int end) { map.change_rows(whole, first, end); });
  return whole;
}

int all_threads(int given) {
  // The system may not know the number of its processors, which then counts as 0.
  return given > 0 ? given : std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
}

}  // namespace domefall
