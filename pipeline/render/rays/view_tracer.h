// From a direction of view to the place on the sky whose light comes from there: camera,
// aberration, lensing, redshift.  The inner loop of Domefall.
#pragma once

#include <optional>

#include "pipeline/optics/aberration.h"
#include "pipeline/optics/hole_optics.h"
#include "pipeline/render/rays/amplification.h"
#include "pipeline/show/frame_state.h"
#include "pipeline/show/vantage.h"
#include "projections/projection.h"
#include "trajectories/sky_region.h"

namespace domefall {

// Everything known of one direction of view.
struct ViewRay {
  SkyRegion sky = SkyRegion::kIV;
  bool known = false;          // whether there is a table of that sky: if not, nothing below is set
  V3d sky_direction;           // equatorial J2000
  double frequency_ratio = 1;  // observed / emitted; 1 for the singularity, which has no redshift
  // Angles on the sky per angle of view, along and across the direction of the hole.
  double radial_scale = 0, tangential_scale = 0;
  // Of the singularity's light, if its times are tabulated: t at emission from the observer's v or u
  // (EmissionTimeTable), M, and how fast it changes with the angle of view.
  double emission_time = 0, time_scale = 0;
  RayBundle bundle;  // of skies I and III
  // Angle of view to the nearest edge of a sky, radians; infinite without one.
  double to_edge = HUGE_VAL;
};

// The same of many directions, by quantity.
struct ViewRayBatch {
  static constexpr int kSize = 128;
  template <class T>
  using Column = std::array<T, kSize>;
  alignas(64) Column<double> sky_x, sky_y, sky_z;
  // On the sky, at right angles to its direction: where the azimuth grows.  0 for straight light.
  alignas(64) Column<double> along_x, along_y, along_z;
  alignas(64) Column<double> frequency_ratio, radial_scale, tangential_scale, to_edge;
  alignas(64) Column<double> emission_time, time_scale;  // only where those times are tabulated
  Column<SkyRegion> sky;

  V3d sky_direction(int k) const { return {sky_x[k], sky_y[k], sky_z[k]}; }
  V3d along(int k) const { return {along_x[k], along_y[k], along_z[k]}; }
};

class ViewTracer {
 public:
  // The optics must outlive it.  Without lensing they are not looked at: light goes straight in the
  // frame of the observer at rest, r > 2.
  ViewTracer(const FrameState& state, const HoleOptics& optics, const Effects& effects = {});

  // One direction, step by step; also where no table is.  The oracle of the batch.
  ViewRay trace(const CameraDirection& n) const;

  // count <= ViewRayBatch::kSize directions as SIMD code; columns are set where the sky has a table.  Measured: within 1e-15 radians on the sky
  // and a relative 1e-14 of trace() (the functions of vector_math.h against the C library's).
  void trace(const CameraDirection* n, int count, ViewRayBatch& batch) const;

  // Which observers the frame is drawn for.
  const Vantage& vantage() const { return vantage_; }

 private:
  ViewRay straight_ray(const CameraDirection& n) const;
  ViewRay lensed_ray(const CameraDirection& n) const;
  void lensed_rays(const CameraDirection* n, int count, ViewRayBatch& batch) const;
  void straight_rays(const CameraDirection* n, int count, ViewRayBatch& batch) const;
  // Frequency of light from n as it is to be seen, over that in the picture's frame.
  double measured_ratio(const CameraDirection& n) const;

  M33d tetrad_from_camera_, sky_from_tetrad_;
  Vantage vantage_;
  const HoleOptics& optics_;
  bool flat_, outgoing_;
  SkyRegion home_, far_;
  double s_, one_minus_s_;                 // sqrt(2/r), and 1 minus it from the altitude
  std::optional<Aberration> to_measured_;  // see Vantage
  std::optional<Aberration> to_rest_;      // from the tetrad, if light goes straight near a hole
  double gravitational_ratio_ = 1;
};

}  // namespace domefall
