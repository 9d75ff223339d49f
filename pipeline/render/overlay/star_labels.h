// The names of bright stars beside their lensed images.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "pipeline/render/overlay/coverage.h"
#include "pipeline/render/overlay/frame_ref.h"
#include "pipeline/show/frame_state.h"

namespace domefall {

// Stars fainter than this V bear no name, nor do images that are seen fainter than the other limit.
inline constexpr double kFaintestNamed = 2.5, kFaintestNamedImage = 4;

// An image of a star that has a name.
struct NamedImage {
  std::string name;        // with a prime if it is the secondary image
  bool secondary = false;  // on the opposite side of the hole
  CameraDirection direction;
  // As it is seen under the effects that the show keeps, with the frame's gain of stars over the
  // default of their law.
  double magnitude = 0;
};

class StarLabels {
 public:
  // The show must outlive the labels.
  explicit StarLabels(const Show& show) : show_(show) {}

  // The images of named stars of all skies that are seen, the brightest first: where the renderer
  // draws them, whether they are in the picture or not.  Only the first two images of a star are
  // found, and where light goes straight its one.  Reads the catalogues when they are first needed;
  // throws as read_star_catalogue.
  std::vector<NamedImage> images(const FrameState& state);

  // Draws a ring around each image and its name beside it, upright for the audience; those of
  // secondary images are dimmer.  An image whose name would lie over another's, or be cut off, has
  // neither.
  void draw(const FrameState& state, const FrameRef& frame);

 private:
  struct NamedStarOfSky {
    std::string name;
    SkyDirection direction;
    double magnitude;
  };
  const std::vector<NamedStarOfSky>& stars_of(SkyRegion sky);

  const Show& show_;
  PerSky<std::optional<std::vector<NamedStarOfSky>>> stars_;
};

// The style of names, which the key of a frame with names holds.
LetterStyle label_style();

}  // namespace domefall
