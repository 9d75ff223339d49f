// What lies behind the letters of a title, so that they can be read on a bright sky: a plate behind
// the whole text, and a shadow around each letter.
#pragma once

#include <vector>

#include "pipeline/base/lettering.h"
#include "pipeline/render/overlay/bent_text.h"
#include "pipeline/render/overlay/coverage.h"

namespace domefall {

// A TitleGround says how dark each point of a text is.  It lives on the text and not in the image, so
// that it looks the same in every projection, at every size and anywhere on the dome.
class TitleGround {
 public:
  // `plate` and `shadow`, 0 to 1, are the parts of the light that these take away.
  TitleGround(const LetteredText& text, double plate, double shadow);

  // Returns the part of the light that is taken away at a point, 0 to 1.
  double darkness(const TextPoint& p) const;

  // Returns the part of each pixel's light that is taken away, row by row, for all rows and columns
  // where that is more than 0, and for others besides.  It is taken at the pixels' middles, since
  // the ground is soft.
  std::vector<CoveredRow> covered(const TextSurface& surface, const Projection& projection) const;

 private:
  double plate_at(const TextPoint& p) const;
  double shadow_at(const TextPoint& p) const;

  double half_width_, half_height_;  // of the text, in capitals
  double plate_, shadow_;
  // The shadow's darkness on a grid of points, row by row from the top.
  int columns_ = 0, rows_ = 0;
  std::vector<float> blurred_;
};

}  // namespace domefall
