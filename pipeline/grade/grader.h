// A Grader grades scene-linear frames for a display, by OpenColorIO.
#pragma once

#include <memory>
#include <optional>
#include <string>

#include "pipeline/grade/dome_light.h"
#include "pipeline/grade/grade_settings.h"
#include "pipeline/image/encode/display_colour.h"
#include "pipeline/image/frame_buffer.h"

namespace domefall {

class GradeTable;

// A TableError says what is known of a grade by table.
struct TableError {
  double error;  // the largest one measured, as a part of white
  double held;   // the part of the table's cells that were not left out for a larger one
};

// Returns a clause for people where $OCIO is set and the show names no configuration, and otherwise
// nothing.  Other programs take their configuration from it.  A frame depends on its show and its
// assets alone, so Domefall does not.
std::string ocio_note(const GradeSettings& settings);

// A Grader is the grade of a show, or of a frame whose CDL is another.  It takes ACEScg through the
// show's ASC CDL in ACEScct, unless that changes nothing, then through a display and view of an
// OpenColorIO configuration to 16 bits, clamped and rounded.  A pixel depends on its own input and
// the frame's size alone.  Copies share one processor, and any number of threads may use it.
//
// Frames of 2^21 pixels and more, from 2k domes on, are graded by a table of the view
// (grade_table.h), before which the CDL is a step of its own (apply_cdl).  The table is made when
// the first such frame comes, by the threads that grade it.  Where a CDL makes it err by more than
// half a step of 12 bits, the formulas are followed.
class Grader {
 public:
  // A configuration that is not the shipped one is first read in a process of its own (try_in_child),
  // which takes 4 ms, because OpenColorIO follows a space that refers to itself until its stack is
  // full.
  //
  // Throws InputError if the configuration is not named or cannot be used, if it turns light into
  // NaN or infinity, and if it does not have the display or the view, with a list of those that it
  // has.  Throws TemporaryError if it is missing.
  explicit Grader(const GradeSettings& settings);

  // Returns the same grade with another CDL, which shares the table.
  Grader with(const Cdl& cdl) const;

  // Returns the same grade, which treats frames of every size as it does those of width times
  // height.  It serves small pictures that stand for large frames.
  Grader as_for(int width, int height) const;

  // Returns what is done about a dome's own light once a frame is graded, or null if nothing is.
  const DomeLight* dome_light() const { return dome_light_.get(); }

  // Grades the rows y0 <= y < y1, without the dome's own light, into out[y1 - y0][width][3].  Any
  // split into rows gives the same values.
  void grade_rows(const HalfFrame& in, int y0, int y1, unsigned short* out) const;
  // Grades the whole frame on the calling thread, in the same way.
  GradedFrame grade(const HalfFrame& in) const;

  // Says how far a table's grade of such a frame is from the formulas, and returns nothing for one
  // that is graded by the formulas.
  std::optional<TableError> table_error(const HalfFrame& in) const;

  // Returns a digest of what the grade does to a pixel, but for the CDL, which frames may have of
  // their own.  It covers all transforms, the contents of the files they read, and what is done
  // about the dome's own light.
  const std::string& transform_id() const { return transform_id_; }

  // These return the settings' own, or the configuration's defaults.
  const std::string& display() const { return display_; }
  const std::string& view() const { return view_; }
  // Returns what the codes mean, where that can be said (display_colour).
  const std::optional<DisplayColour>& colour() const { return colour_; }

 private:
  // Returns the table by which such a frame is graded, or null for the formulas.
  const GradeTable* table_for(const HalfFrame& in) const;

  struct Processor;
  struct Source;
  std::shared_ptr<const Source> source_;
  Cdl cdl_;
  std::shared_ptr<const Processor> processor_;
  std::shared_ptr<const DomeLight> dome_light_;
  long pixels_ = 0;  // of the frames it treats all others as; 0 if it does not
  std::string display_, view_, transform_id_;
  std::optional<DisplayColour> colour_;
};

}  // namespace domefall
