// What is seen at one pixel of a frame, for people: where its light comes from, and the disc, the
// bodies, the stars and the titles there.
#pragma once

#include <string>
#include <vector>

#include "pipeline/light/lens.h"
#include "pipeline/render/scene/body_covers.h"
#include "pipeline/render/scene/body_sight.h"
#include "pipeline/show/frame_state.h"

namespace domefall {

// What is seen fainter than this V is left out.
inline constexpr double kFaintestSeen = 25;

struct DiscAtPixel {
  int order;               // of the image: 0 for the direct one
  double r, azimuth_deg;   // of the gas (M), and about the disc's axis from its node
  double frequency_ratio;  // observed / emitted
  double temperature;      // of the gas in its own frame, kelvin
  double covered;          // the part of the pixel that the image covers
};

struct StarAtPixel {
  std::vector<std::string> names;  // of the catalogue; perhaps none
  SkyRegion sky;                   // that the star belongs to
  double ra_deg, dec_deg;          // of the star, J2000
  double v, temperature;           // of the star, the latter in kelvin
  double seen_v;     // of the image, behind discs and bodies, under the show's effects
  int order;         // of the image
  PixelPosition at;  // of its middle
};

struct BodyAtPixel {
  std::string name;
  double r;                // of the body when the light left it, M
  double seen_v;           // of the image, likewise
  double frequency_ratio;  // observed / emitted
  int order;               // of the image
  PixelPosition at;        // of its middle
};

struct DiscScene;

class PixelProbe {
 public:
  // The show must outlive this object.
  PixelProbe(const Show& show, const FrameState& state, PixelPosition pixel);
  ~PixelProbe();
  PixelProbe(const PixelProbe&) = delete;
  PixelProbe& operator=(const PixelProbe&) = delete;

  // Returns the ray of the pixel's middle on its way to a sky, whatever lies before that.
  ViewRay ray() const;
  // Returns the images of the disc in the pixel, the nearest first.
  std::vector<DiscAtPixel> disc() const;
  // Returns the part of the light of a sky that the disc lets through, and that the spheres of bodies do.
  double left_of_sky() const;
  double left_by_bodies() const;
  // Returns the images of bodies and of stars that the frame draws, the brightest first.  The middle
  // of each, or of a piece that it is drawn in, is so near to the pixel that the smallest blob of the
  // frame (PointSpread) reaches it.  Images that are seen fainter than kFaintestSeen are left out, and
  // so are those that are behind a body there.
  // For stars the show's catalogues are read; throws as read_star_catalogue.
  std::vector<BodyAtPixel> bodies() const;
  std::vector<StarAtPixel> stars() const;
  // Returns the texts that cover a part of the pixel.  Throws as lettered().
  std::vector<std::string> titles() const;

 private:
  bool reaches(const CameraDirection& image) const;
  double left_before(const CameraDirection& image, double way, double far) const;

  const Show& show_;
  PixelPosition pixel_;
  CameraDirection towards_;
  double width_;  // of the pixel, radians
  std::unique_ptr<const DiscScene> scene_;
  const FrameState& state_;  // of the scene
  BodySight sight_;
  std::vector<Body> bodies_;
  BodyCovers covers_;
};

}  // namespace domefall
