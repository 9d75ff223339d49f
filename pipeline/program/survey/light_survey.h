// A light survey says how bright a show is, measured on small frames of it.
#pragma once

#include <vector>

#include "pipeline/grade/grader.h"
#include "pipeline/program/survey/show_warnings.h"
#include "pipeline/render/reduced_frame.h"

namespace domefall {

struct FrameLight {
  int frame = 0;
  double time_s = 0;
  int segment = 0;
  double ev = 0;
  double fade = 1;  // the part of its light that a fade from or to black leaves
  // These are luminances of the pixels inside the image (a dome's circle), in pixel values: their
  // mean, and the value that 1 % of them exceed.
  double mean = 0, percentile99 = 0;
  // This part of the pixels, 0 to 1, has a channel within 1 % of the grade's white.  Without a
  // grade it is the part of which a channel exceeds 1.
  double white = 0;
  // These are the parts of all light that the fields of a grid over the picture have.
  std::vector<double> fields{};
};

struct LightSurvey {
  FrameLight brightest;  // by its mean
  // The darkest frame is sought among those whose exposure is within 3 stops of the highest, which
  // leaves out fades.
  FrameLight darkest;
  std::vector<FrameLight> frames;  // that were measured, in order
};

// Measures one frame for each second of the show, but at least 2 and at most 60, at a width of 48
// pixels.  `grader` is null for a show without a grade.  Means agree with those of large frames to
// a few percent, since stars at a small size are as bright and only larger.
LightSurvey survey_light(const Show& show, Renderer& renderer, const Grader* grader);

// From one frame to the next the mean light may change by this part of itself.
inline constexpr double kLargestLightStep = 0.2;

// From this time on a picture is black or unchanged for long.  Black is a picture of which 99 % are
// below this pixel value, and unchanged one of whose light at most this part stands elsewhere.
inline constexpr double kLongBlack = 2, kLongUnchanged = 20;  // seconds
inline constexpr double kBlackLight = 0.01, kUnchangedLight = 0.25;

// Returns a warning for each stretch of the survey's frames that is black for long and not in a
// fade, or unchanged for long; and one for each place within a segment where the light jumps, as it
// does where the plane of a disc is crossed.  To jumps exposures and fades do not count.  A jump is
// sought between those of the survey's frames that differ most, 16 pairs at most, by halves; so a
// flash between two of equal light is not found.
std::vector<ShowWarning> light_warnings(const Show& show, Renderer& renderer,
                                        const LightSurvey& survey);

}  // namespace domefall
