// Grades rendered frames for a run: row by row where that can be, and by all threads.
#pragma once

#include <functional>
#include <optional>

#include "pipeline/grade/grader.h"
#include "pipeline/image/encode/row_source.h"
#include "pipeline/show/frame_state.h"

namespace domefall {

class FrameGrading {
 public:
  // The grade of the show must outlive this.
  FrameGrading(const Grader& of_show, int threads) : of_show_(of_show), threads_(threads) {}

  // Calls `use` with the graded frame, whose rows are graded as they are asked for.  With the dome's
  // own light all are graded before the first, since the light of each falls on all others.  Not
  // for two threads at once.  Throws as Grader::with, and what `use` throws.
  void grade(const HalfFrame& frame, const FrameState& state,
             const std::function<void(const RowPicture&)>& use);

  // That of the frame graded last; nothing for one that was graded by the formulas.
  std::optional<TableError> table_error(const HalfFrame& frame) const {
    return of_frame_->table_error(frame);
  }

 private:
  GradedFrame with_dome_light(const HalfFrame& frame) const;

  const Grader& of_show_;
  int threads_;
  std::optional<Grader> of_frame_;  // kept for the frames after it
};

// A number of threads as --threads gives it, where 0 stands for one per processor.
int all_threads(int given);

}  // namespace domefall
