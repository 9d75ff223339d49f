// StarLabels write the names of bright stars beside their lensed images.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "pipeline/render/overlay/coverage.h"
#include "pipeline/show/frame_state.h"

namespace domefall {

// Stars fainter than the first V have no name.  Images that are seen fainter than the second have
// none either.
inline constexpr double kFaintestNamed = 2.5, kFaintestNamedImage = 4;

// A NamedImage is an image of a star or a body that has a name.
struct NamedImage {
  std::string name;        // with a prime if it is the secondary image
  bool secondary = false;  // on the opposite side of the hole
  CameraDirection direction;
  // This is the V that is seen under the effects that the show keeps (seen_magnitude).  It includes
  // the ratio of the frame's gain of stars to the default gain of their law.
  double magnitude = 0;
};

// A LightLeft says which part, 0 to 1, of the light from a direction gets past the disc, if it has
// swept the angle psi since it set out, or comes from behind everything (HUGE_VAL).
using LightLeft = std::function<double(const CameraDirection& from, double psi)>;

class StarLabels {
 public:
  // The show must outlive the labels.
  explicit StarLabels(const Show& show) : show_(show) {}

  // Returns the images of the named stars of all skies that are seen, and those of bodies, the
  // brightest first.  They are where the renderer draws them, even if that is outside the frame.
  // At most the first two images of a star are found.  Where light goes straight, there is only
  // one.  A disc dims images, and hides them.  Reads the catalogues when they are first needed.
  // Throws as read_star_catalogue.
  std::vector<NamedImage> images(const FrameState& state, const LightLeft& left = {});

  // Draws a ring around each image, and its name beside it, upright for the audience.  Rings and
  // names of secondary images are dimmer.  An image has neither if its name would lie over another
  // name or be cut off.
  void draw(const FrameState& state, const FrameRef& frame, const LightLeft& left);

 private:
  struct NamedStarOfSky {
    std::string name;
    SkyDirection direction;
    double magnitude, temperature;
  };
  const std::vector<NamedStarOfSky>& stars_of(SkyRegion sky);

  const Show& show_;
  PerSky<std::optional<std::vector<NamedStarOfSky>>> stars_;
};

// Returns the style of names.  The key of a frame with names includes it.
LetterStyle label_style();

}  // namespace domefall
