#include "pipeline/render/frame_grading.h"

#include <algorithm>
#include <vector>

#include "pipeline/base/in_parallel.h"

namespace domefall {
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
  const auto row_of = [&](int part) { return whole.height * part / threads_; };
  in_parallel(threads_, threads_, [&](int part) {
    of_frame_->grade_rows(frame, row_of(part), row_of(part + 1), whole.row(row_of(part)));
    parts[static_cast<std::size_t>(part)].add_rows(whole, row_of(part), row_of(part + 1));
  });
  for (std::size_t k = 1; k < parts.size(); ++k) parts[0].add(parts[k]);
  const CodeMap map = of_show_.dome_light()->map_for(parts[0]);
  in_parallel(threads_, threads_,
              [&](int part) { map.change_rows(whole, row_of(part), row_of(part + 1)); });
  return whole;
}

}  // namespace domefall
