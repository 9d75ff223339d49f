// A DiscPass draws the light of a disc into bands of pixel rows, and hides the light behind it.
//
// A view ray, followed back in time, sweeps the angle psi.  It meets the plane of the disc at
// psi_0, psi_0 + pi, psi_0 + 2 pi and so on, where it sees the direct image, the image from beneath
// and the photon rings.  How much of a pixel an image covers follows from the pixel's distance to
// the image's two rims (DiscImages), so that no image is too thin to be seen.  For an observer
// close to the plane, psi_0 changes much within the pixels next to the plane.  These are divided in
// psi.
#pragma once

#include <optional>

#include "pipeline/disc/disc_light.h"
#include "pipeline/disc/disc_pattern.h"
#include "pipeline/render/disc/disc_images.h"
#include "pipeline/render/scene/frame_scene.h"

namespace domefall {

// A band has at least as many rows as this.
inline constexpr int kDiscBandRows = 8;

class DiscPass {
 public:
  // The scene must have a disc, and must outlive this pass.
  explicit DiscPass(const FrameScene& scene);

  // Lays the disc over the rows [first, end) of the image.  `rgb` points to the row `first`, and
  // each row has 3 values for each column.
  void draw_rows(int first, int end, float* rgb) const;
  // Does the same with each pixel computed by itself.  This is slower, and tests compare
  // draw_rows() with it.
  void draw_rows_singly(int first, int end, float* rgb) const;

  // Returns the part of the light from a place on a ray that the disc in front of it lets through.
  // The ray is seen in direction n, and the place lies psi radians along it.  Across a rim of the
  // disc the part changes smoothly over a pixel.
  double left_before(const CameraDirection& n, double psi) const;

  struct Crossings;

 private:
  class Strip;
  class Row;
  void draw(Row& line, int first, int end, float* rgb) const;
  void locate(const CameraDirection* n, const double* angle, int count, Crossings& crossings) const;

  const FrameScene& scene_;
  DiscImages images_;
  double r_, s_, one_minus_s_;
  double label_sign_;   // the sign of p = k^r/L against its form in the rain frame
  double energy_sign_;  // the sign that the frame gives E of light from region I
  // A Clock takes the observer's null time, v or u, to the time t at which light set out.
  struct Clock {
    explicit Clock(const ObserverState& observer);
    double time_at(double r, double delay) const;

    bool outgoing;
    double null_time, observer_v;
  };
  Clock clock_;
  std::optional<DiscPattern> pattern_;
  V3d node_, quarter_;  // where azimuths of the pattern begin, and a quarter of a turn on
  // The disc's normal is given by its part along R, by the length of its part across R, and by the
  // cosine and the sine of the angle from Theta to that part.
  double normal_up_, normal_across_, normal_cosine_, normal_sine_;
};

}  // namespace domefall
