// How bright a show is, measured on small frames of it.
#pragma once

#include <optional>

#include "pipeline/grade/grader.h"
#include "pipeline/render/renderer.h"

namespace domefall {

struct FrameLight {
  int frame = 0;
  double time_s = 0;
  int segment = 0;
  double ev = 0;
  double fade = 1;  // the part of its light that a fade from or to black leaves
  // Luminance of the pixels inside the image (a dome's circle), in pixel values: its mean, and the
  // value that 1 % of them exceed.
  double mean = 0, percentile99 = 0;
  // Part of the pixels, 0 to 1, of which a channel lies within 1 % of the grade's white.  Without a
  // grade: of which a channel exceeds 1.
  double white = 0;
};

struct LightSurvey {
  FrameLight brightest;  // by its mean
  // Fades are left out: it is sought among the frames whose exposure is within 3 stops of the
  // highest.
  FrameLight darkest;
  int frames = 0;  // how many were measured
};

// What the renderer of survey_light needs: texels of 0.7 degrees, where a pixel of its frames has
// 4, and some thousand stars, since each of them covers several pixels.
inline constexpr SkyDetail kSurveyDetail{128, 512};

// Measures one frame for each second, but 2 at least and 60 at most, at a width of 48 pixels.
// `grader` is null for a show without a grade.  Means agree with those of large frames to a few
// percent, since stars are as bright at a small size, only larger.
LightSurvey survey_light(const Show& show, Renderer& renderer, const Grader* grader);

}  // namespace domefall
