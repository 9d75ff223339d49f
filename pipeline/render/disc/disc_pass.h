// A DiscPass draws the light of a disc without height into bands of pixel rows, and hides the light behind it.
//
// A view ray meets the plane of the disc several times (plane_rays.h).  How much of a pixel an image
// covers follows from the pixel's distance to the image's two rims (PlaneImages), so that no image is
// too thin to be seen.  For an observer close to the plane, psi_0 changes much within the pixels next
// to the plane.  These are divided in psi.
//
// About a hole that spins, kerr_plane.h says where rays meet the plane, which is the hole's equator.
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "pipeline/light/kerr_plane.h"
#include "pipeline/light/plane_rays.h"
#include "pipeline/render/disc/gas_rays.h"
#include "pipeline/render/scene/frame_scene.h"
#include "pipeline/sources/disc/disc_light.h"

namespace domefall {

// A band has at least as many rows as this.
inline constexpr int kDiscBandRows = 8;

class DiscPass {
 public:
  // The scene must have a disc, and must outlive this pass.
  explicit DiscPass(const FrameScene& scene);

  // Lays the disc over the rows [first, end) of the image.  `rgb` points to the row `first`, and
  // each row has 3 values for each column.  Where `left` is not null, it has one for each column,
  // which is set to the part of the light from behind that the disc lets through; pixels without
  // any disc are left as they are.
  void draw_rows(int first, int end, float* rgb, float* left = nullptr) const;
  // Does the same with each pixel computed by itself.  This is slower, and tests compare
  // draw_rows() with it.
  void draw_rows_singly(int first, int end, float* rgb) const;

  // Sets for each pixel of a row that the disc covers the part of the light from behind which each
  // order of its images takes, so that their sum is 1 - left of draw_rows().  There is one row of
  // values for each order.
  void fill_orders(int row, std::span<float* const> orders) const;

  // Returns the part of the light from a place on a ray that the disc in front of it lets through.
  // The ray is seen in direction n, and the place lies psi radians along it.  Across a rim of the
  // disc the part changes smoothly over a pixel, which is `width` radians wide.
  double left_before(const CameraDirection& n, double psi, double width) const;

  // A Place is where a view ray meets the disc.
  struct Place {
    int order;               // of the image: 0 for the direct one
    double r, azimuth;       // of the gas, M and radians about the normal from the disc's node
    double frequency_ratio;  // observed / emitted
    double covered;          // the part of a pixel that the image covers, 0 to 1
  };
  // Returns the places on the ray in direction n, for a pixel of `width` radians, the nearest to the
  // observer first.  What lies behind an opaque image that covers the pixel is left out.
  std::vector<Place> places(const CameraDirection& n, double width) const;

  // These are the crossings of the view rays of a batch of pixels.
  struct Crossings : PlaneCrossings {
    FrameRayBatch rays;
  };

 private:
  class Strip;
  class SphereStrip;
  class KerrStrip;
  class Row;
  std::unique_ptr<Strip> make_strip() const;
  void draw(Row& line, int first, int end, float* rgb, float* left) const;
  void locate(const CameraDirection* n, const double* angle, int count, Crossings& crossings) const;
  // Gas is at r, and its light is seen at `frequency_ratio` times the frequency that it has there.  It
  // absorbs this part of the light along the ray.
  struct Gas {
    double r, frequency_ratio, absorbed;
  };
  // Returns the gas that a ray meets after `turn`, whose label is the part u of the image's interval.
  Gas gas_at(const Crossings& crossings, int k, double turn, double label, double u,
             double azimuth_sine) const;
  bool goes_outward(double turn, double label, double u) const;

  const FrameScene& scene_;
  // One of these is there.
  std::unique_ptr<const PlaneRays> plane_;
  std::shared_ptr<const KerrPlane> kerr_plane_;
  std::optional<GasRays> gas_;  // of a disc with a height
  const DiscPattern* pattern_ = nullptr;
  V3d node_, quarter_;  // where azimuths of the pattern begin, and a quarter of a turn on
};

}  // namespace domefall
