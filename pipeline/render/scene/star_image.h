// One image of one star as a frame receives it, before anything is drawn.
#pragma once

namespace domefall {

struct StarImage {
  // Where its middle is: pixels counted from 0 at the middle of the top left one, to the right and
  // down.  May lie outside the picture by as much as a blob reaches.
  float x, y;
  // Illuminance (lux) times the pixel value of 1 cd/m^2: what the image's pixels sum up to, each
  // times its solid angle.  Working space.
  float rgb[3];
};

static_assert(sizeof(StarImage) == 20);  // millions of them in a frame

}  // namespace domefall
