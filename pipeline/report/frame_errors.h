// What anti-aliasing brings and costs: whole frames against frames of 256 looks in every pixel.
#pragma once

#include <string>
#include <vector>

namespace domefall {

// One scene, rendered with one setting of the renderer's anti-aliasing.
struct FrameErrorRow {
  std::string scene, setting;
  int size;  // pixels along an edge of the frame
  // Differences from the reference, of all pixels inside the dome and their three values: root of
  // the mean square, and the largest.  Both frames are graded as a show's are (the shipped view
  // Dome) and compared as they go to the projector, values from 0 to 1: one step of 8 bits is
  // 0.0039.  Not scene-linear, since there the few pixels whose blueshift has no bound, and which
  // any display shows white, would be all that counts.
  double rms, worst;
  double seconds;  // CPU, all threads together, of the quickest of several renderings into the same
                   // memory; loading skies and grading are left out
  double copies;   // the same over the CPU seconds of copying the frame's half floats
};

// Renders each scene with each setting and once as the reference (kReferenceAntiAliasing), which is
// a mean of looks itself: where an edge runs through a pixel, it errs by up to 1/32 of the step.
// Stars are left out: they are no looks but discs, drawn alike with every setting, and their own
// error is bounded by flux (star_blobs.h).
// quick: two scenes of 256 pixels; else eight of 1,024.
// Throws InputError if the shipped sky or grading configuration cannot be read.
std::vector<FrameErrorRow> measure_frames(bool quick);

}  // namespace domefall
