// Follows view rays from the camera back to the sky: through the axes of the camera, aberration,
// lensing by the hole, and redshift.  This is the inner loop of Domefall.
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

// A ViewRay describes the light that reaches the observer from one direction.
struct ViewRay {
  SkyRegion sky = SkyRegion::kIV;  // where the light started
  // This is true if that sky has a table.  Otherwise only to_edge is set of all that follows.
  bool known = false;
  V3d sky_direction;           // equatorial J2000
  double frequency_ratio = 1;  // observed / emitted; 1 for the singularity, which has no redshift
  // The scales are angles on the sky per angle in the view, along the direction of the hole and
  // across it.
  double radial_scale = 0, tangential_scale = 0;
  // These two are set for the singularity's light if its emission times are tabulated.
  // emission_time is the time t of the emission (M), counted from the observer's v or u as in
  // EmissionTimeTable.  time_scale is its derivative by the angle in the view.
  double emission_time = 0, time_scale = 0;
  RayBundle bundle;  // for skies I and III
  // The angle in the view to the nearest edge of a sky (radians) is right to first order in it, and
  // infinite without an edge.
  double to_edge = HUGE_VAL;
};

// A ViewRayBatch holds the same quantities for many rays, column by column.
struct ViewRayBatch {
  static constexpr int kSize = 128;
  template <class T>
  using Column = std::array<T, kSize>;
  alignas(64) Column<double> sky_x, sky_y, sky_z;
  // The azimuth grows along this unit vector on the sky, which is at right angles to the direction
  // there.  It is 0 for straight light, whose footprints are round.
  alignas(64) Column<double> along_x, along_y, along_z;
  alignas(64) Column<double> frequency_ratio, radial_scale, tangential_scale, to_edge;
  alignas(64) Column<double> emission_time, time_scale;  // only where those times are tabulated
  Column<SkyRegion> sky;

  V3d sky_direction(int k) const { return {sky_x[k], sky_y[k], sky_z[k]}; }
  V3d along(int k) const { return {along_x[k], along_y[k], along_z[k]}; }
};

// A FrameRayBatch holds directions of view in the frame in which the paths of light are known.  It
// is the frame of the reference tetrad or, where light goes straight near a hole, that of the
// observer at rest.
struct FrameRayBatch {
  template <class T>
  using Column = ViewRayBatch::Column<T>;
  alignas(64) Column<double> x, y, z;    // unit vectors along R, Theta, Phi
  alignas(64) Column<double> scale;      // angles in that frame per angle in the view
  alignas(64) Column<double> frequency;  // as the observer measures it, over that in the frame
};

class ViewTracer {
 public:
  // The optics must outlive the tracer.  Without lensing they are not used: light then goes
  // straight in the frame of the observer at rest, which exists for r > 2.
  ViewTracer(const FrameState& state, const HoleOptics& optics, const Effects& effects = {});

  // Traces one direction step by step with the functions of the C library.  The tests hold the
  // batch against it.
  ViewRay trace(const CameraDirection& n) const;

  // Traces count <= ViewRayBatch::kSize directions by SIMD code.  The columns `sky` and `to_edge`
  // are always set, and the others where the sky has a table.  The measured difference from the
  // tracing of one direction is at most 1e-15 radians on the sky and a relative 1e-14, because
  // vector_math.h rounds differently from the C library.
  void trace(const CameraDirection* n, int count, ViewRayBatch& batch) const;

  // Brings directions into the frame of a FrameRayBatch and traces them no further.  This serves
  // what is nearer than the skies.
  void into_frame(const CameraDirection* n, int count, FrameRayBatch& batch) const;

  // Says whether light near the hole goes straight, which a show may ask for.
  bool goes_straight() const { return to_rest_.has_value(); }

  // Returns the observers for whom the frame is drawn.
  const Vantage& vantage() const { return vantage_; }

 private:
  ViewRay straight_ray(const CameraDirection& n) const;
  ViewRay lensed_ray(const CameraDirection& n) const;
  void lensed_rays(const CameraDirection* n, int count, ViewRayBatch& batch) const;
  void straight_rays(const CameraDirection* n, int count, ViewRayBatch& batch) const;
  // Returns the frequency of light from n for the observer who measures it, over that for the
  // observer whose directions are drawn.
  double measured_ratio(const CameraDirection& n) const;

  M33d tetrad_from_camera_, sky_from_tetrad_;
  Vantage vantage_;
  const HoleOptics& optics_;
  bool flat_, outgoing_;
  SkyRegion own_sky_;                      // of the tetrad
  double s_, one_minus_s_;                 // s = sqrt(2/r); 1 - s = (r - 2)/(r (1 + s))
  std::optional<Aberration> to_measured_;  // to Vantage::measured, if there is one
  std::optional<Aberration> to_rest_;      // from the tetrad, if light goes straight near a hole
  double gravitational_ratio_ = 1;
};

}  // namespace domefall
