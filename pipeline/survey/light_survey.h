// How bright a show is: small pictures of it, one for each second.
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
  // Luminance of the picture's pixels (a dome's circle), as pixel values: its mean and what 1 % exceed.
  double mean = 0, percentile99 = 0;
  // Part of the pixels, 0 to 1, that cannot be told from the grade's white in a channel; without a
  // grade, whose pixel values exceed 1.
  double white = 0;
};

struct LightSurvey {
  FrameLight brightest;  // by its mean
  // Outside fades: among the frames whose exposure is within 3 stops of the highest.
  FrameLight darkest;
  int frames = 0;  // looked at
};

// One frame for each second, at most 60 and at least 2 if the show has them, 48 pixels wide.  Means
// are those of a large picture to a few percent; stars are as bright, but larger.
// Grader: null without a grade.
LightSurvey survey_light(const Show& show, Renderer& renderer, const Grader* grader);

// The same picture about `width` pixels wide (16 at least).
Projection shrunk(const Projection& projection, int width);
// And the same frame, a vanishing one with it.
FrameState shrunk(FrameState state, int width);

}  // namespace domefall
