// The key of a frame: a digest of all that its pixels depend on, and of nothing else, so that a
// change of one segment leaves the frames of the others good.
#pragma once

#include <string>

#include "pipeline/show/frame_state.h"

namespace domefall {

// A number without its last 12 bits (a relative 2e-13): sines and powers differ in the last ones
// between processors, and a frame that another node made must be known for good on this one.
double steady(double value);

class FrameKeys {
 public:
  // Reads the show's assets once; the show must outlive it.  Throws InputError if one is unreadable.  `grade`: what names the
  // grading of frames (Grader::transform_id); empty where frames are not graded.
  explicit FrameKeys(const Show& show, std::string grade = {});

  // Of what all frames share: skies, stars, exposure, title; the timeline apart.
  const std::string& show() const { return common_; }
  // Of the scene-linear frame.
  std::string scene(const FrameState& state) const;
  // Of the graded frame made from it.
  std::string graded(const std::string& scene_key) const;

 private:
  // Of what is seen at one instant.
  std::string instant(const FrameState& state) const;

  const Show& show_;
  std::string common_;                // digest of the settings that all frames share
  std::string sky_three_, sky_four_;  // only frames that can see them depend on them
  bool rings_ = false;                // region IV shows time
  std::string grade_;
};

}  // namespace domefall
