// This file finds the images of stars that fall on a pixel.
#pragma once

#include <string>
#include <vector>

#include "pipeline/show/frame_state.h"
#include "projections/projection.h"

namespace domefall {

struct StarAtPixel {
  std::vector<std::string> names;  // of the catalogue; perhaps none
  SkyRegion sky;                   // that the star belongs to
  double ra_deg, dec_deg;          // of the star, J2000
  double v;                        // of the star
  double seen_v;                   // of the image, under the effects that the show keeps
  int order;                       // of the image
  PixelPosition at;                // of its middle
};

inline constexpr double kFaintestSeen = 25;

// Returns the images of the stars that the frame draws, the brightest first.  The middle of each is
// so near to the pixel that the smallest blob of the frame (PointSpread) reaches it.  Images that
// are seen fainter than kFaintestSeen are left out.  Reads the show's catalogues.  Throws as
// read_star_catalogue.
std::vector<StarAtPixel> stars_at_pixel(const Show& show, const FrameState& state,
                                        PixelPosition pixel);

}  // namespace domefall
