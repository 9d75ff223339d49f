// The light of a disc in bands of pixel rows, and what it hides of the light behind it.
//
// A view ray is followed back through the plane of the disc, which it meets at psi_0, psi_0 + pi,
// psi_0 + 2 pi, ... of the angle psi that it sweeps: the direct image, the one from beneath, the
// photon rings.  How much of a pixel each image covers follows from the pixel's distance to the
// image's two rims (DiscImages), so that no image is too thin to be seen.  Where psi_0 changes much
// within a pixel, next to the plane itself for who is close to it, the pixel is divided in psi.
#pragma once

#include <optional>

#include "pipeline/disc/disc_light.h"
#include "pipeline/disc/disc_pattern.h"
#include "pipeline/render/disc/disc_images.h"
#include "pipeline/render/scene/frame_scene.h"

namespace domefall {

// The least rows of a band.
inline constexpr int kDiscBandRows = 8;

class DiscPass {
 public:
  // The scene, which has a disc, must outlive this.
  explicit DiscPass(const FrameScene& scene);

  // Lays the disc over the rows [first, end) of the image, the first of which is rgb[3 columns].
  void draw_rows(int first, int end, float* rgb) const;
  // The same, each pixel looked at by itself: slower, and what draw_rows() is held against.
  void draw_rows_singly(int first, int end, float* rgb) const;

  // The part of the light from a place on the ray that the disc before it lets through: psi radians
  // along the ray that is seen in that direction.  It fades within a pixel of the disc's rims.
  double left_before(const CameraDirection& n, double psi) const;

  struct Pixels;

 private:
  class Strip;
  class Row;
  void draw(Row& line, int first, int end, float* rgb) const;
  void locate(const CameraDirection* n, const double* angle, int count, Pixels& pixels) const;

  const FrameScene& scene_;
  DiscImages images_;
  double r_, s_, one_minus_s_;
  double label_sign_;   // of p = k^r/L against its form in the rain frame
  double energy_sign_;  // of E, as the frame counts it, where light comes from region I
  // From the observer's null time, v or u, to t where light set out.
  struct Clock {
    explicit Clock(const ObserverState& observer);
    double time_at(double r, double delay) const;

    bool outgoing;
    double null_time, observer_v;
  };
  Clock clock_;
  std::optional<DiscPattern> pattern_;
  V3d node_, quarter_;  // where azimuths of the pattern begin, and a quarter of a turn on
  // The disc's normal: its part along R, that across it, and the angle of that from Theta.
  double normal_up_, normal_across_, normal_cosine_, normal_sine_;
};

}  // namespace domefall
