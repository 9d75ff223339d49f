// A StarImage is one image of one star as a frame receives it, before it is drawn.
#pragma once

namespace domefall {

struct StarImage {
  // The position of the middle counts in pixels to the right and down from the middle of the top
  // left pixel.  It may lie outside the frame by as much as a blob reaches.
  float x, y;
  // The light in the working space is the illuminance (lux) times the pixel value of 1 cd/m^2.  It
  // is also the sum over the image's pixels of their values times their solid angles.
  float rgb[3];
};

static_assert(sizeof(StarImage) == 20);  // a frame may hold millions of them

}  // namespace domefall
