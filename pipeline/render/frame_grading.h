// Grades the rendered frames of a run, row by row where this is possible, and by all threads.
#pragma once

#include <functional>
#include <optional>

#include "pipeline/grade/grader.h"
#include "pipeline/image/encode/row_source.h"
#include "pipeline/show/frame_state.h"

namespace domefall {

class FrameGrading {
 public:
  // The grade of the show must outlive this object.
  FrameGrading(const Grader& of_show, int threads) : of_show_(of_show), threads_(threads) {}

  // Calls `use` with the graded frame, whose rows are graded when they are asked for.  With the
  // dome's own light all rows are graded before the first is given, since the light of each falls
  // on all others.  Two threads must not call this at once.  Throws as Grader::with, and what `use`
  // throws.
  void grade(const HalfFrame& frame, const FrameState& state,
             const std::function<void(const RowPicture&)>& use);

  // Returns the error of the table by which the frame graded last was graded.  Returns nothing for
  // a frame that was graded by the formulas.
  std::optional<TableError> table_error(const HalfFrame& frame) const {
    return of_frame_->table_error(frame);
  }

 private:
  GradedFrame with_dome_light(const HalfFrame& frame) const;

  const Grader& of_show_;
  int threads_;
  std::optional<Grader> of_frame_;  // kept for the frames that follow
};

}  // namespace domefall
