// measure_frames() compares whole frames with frames of 256 view rays in every pixel, which gives
// the error and the cost of anti-aliasing.
#pragma once

#include <string>
#include <vector>

namespace domefall {

// A FrameErrorRow is one scene, rendered with one setting of the renderer's anti-aliasing.
struct FrameErrorRow {
  std::string scene, setting;
  int size;  // pixels along an edge of the frame
  // These are the root mean square and the largest of all differences from the reference, over the
  // three values of every pixel inside the dome.  Both frames are graded like a show's, by the
  // shipped view Dome, and are compared as they go to the projector, with values from 0 to 1.  One
  // step of 8 bits is 0.0039.  Scene-linear values are not compared, because a few pixels have a
  // blueshift without bound.  Any display shows them white, but they would outweigh all others.
  double rms, worst;
  double seconds;  // CPU, all threads together, of the quickest of several renderings into the same
                   // memory, without loading skies and grading
  double copies;   // the same over the CPU seconds of copying the frame's half floats
};

// Renders each scene with each setting, and once as the reference (kReferenceAntiAliasing).  The
// reference is itself a mean over 16 x 16 view rays.  Where an edge runs through a pixel, it errs
// by up to half a sixteenth of the step.  Stars are left out, because they are drawn as the same
// blobs with every setting.  If quick, there are two scenes of 256 pixels instead of eight of
// 1,024.  Throws InputError if the shipped sky or grading configuration cannot be read.
std::vector<FrameErrorRow> measure_frames(bool quick);

}  // namespace domefall
