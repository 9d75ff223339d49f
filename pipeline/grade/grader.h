// SkyStore-linear frames to display-encoded ones, by OpenColorIO.
#pragma once

#include <memory>
#include <string>

#include "pipeline/grade/grade_settings.h"
#include "pipeline/image/frame_buffer.h"

namespace domefall {

// ACEScg -> the show's ASC CDL in ACEScct, left out altogether where it changes nothing -> display
// and view of an OpenColorIO configuration -> 16 bits, clamped and rounded.  A pixel depends on
// nothing but its own input; copies share one processor and may be used by any number of threads.
//
// Measured, one thread of a 2-core machine, a domemaster of 4096 pixels: 0.6 s by the shipped view
// Dome (27 million pixels a second), 1.5 s by ACES SDR, 0.4 s by Star log, 0.3 s by Un-tone-mapped.
class Grader {
 public:
  // Throws InputError for a configuration that cannot be used or is not named, and for an unknown
  // display or view with the list of those known.
  explicit Grader(const GradeSettings& settings);

  // Rows y0 <= y < y1 to out[y1 - y0][width][3].  Any split into rows gives the same values.
  void grade_rows(const HalfFrame& in, int y0, int y1, unsigned short* out) const;
  // The whole frame, on the calling thread.
  GradedFrame grade(const HalfFrame& in) const;

  // A name for what it does to a pixel: of all transforms and of the contents of the files they read.
  const std::string& transform_id() const { return transform_id_; }

  // As settled by the settings and the configuration's defaults.
  const std::string& display() const { return display_; }
  const std::string& view() const { return view_; }

 private:
  struct Processor;
  std::shared_ptr<const Processor> processor_;
  std::string display_, view_, transform_id_;
};

}  // namespace domefall
