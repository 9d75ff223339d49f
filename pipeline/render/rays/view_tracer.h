// Follows view rays from the camera back to the sky: through the axes of the camera, aberration,
// the lensing by the hole and the redshift.  This is the inner loop of Domefall.
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

// The light that reaches the observer from one direction.
struct ViewRay {
  SkyRegion sky = SkyRegion::kIV;  // where it started
  // Whether that sky has a table.  If not, of what follows only to_edge is set.
  bool known = false;
  V3d sky_direction;           // equatorial J2000
  double frequency_ratio = 1;  // observed / emitted; 1 for the singularity, which has no redshift
  // Angles on the sky per angle in the view, along and across the direction of the hole.
  double radial_scale = 0, tangential_scale = 0;
  // For the singularity's light, if its emission times are tabulated: the time t of emission (M)
  // from the observer's v or u, as EmissionTimeTable has it, and its derivative by the angle in the
  // view.
  double emission_time = 0, time_scale = 0;
  RayBundle bundle;  // for skies I and III
  // The angle in the view to the nearest edge of a sky, radians; infinite without one.
  double to_edge = HUGE_VAL;
};

// The same quantities of many rays, column by column.
struct ViewRayBatch {
  static constexpr int kSize = 128;
  template <class T>
  using Column = std::array<T, kSize>;
  alignas(64) Column<double> sky_x, sky_y, sky_z;
  // The unit vector on the sky, at right angles to the direction there, along which the azimuth
  // grows; 0 for straight light, whose footprints are round.
  alignas(64) Column<double> along_x, along_y, along_z;
  alignas(64) Column<double> frequency_ratio, radial_scale, tangential_scale, to_edge;
  alignas(64) Column<double> emission_time, time_scale;  // only where those times are tabulated
  Column<SkyRegion> sky;

  V3d sky_direction(int k) const { return {sky_x[k], sky_y[k], sky_z[k]}; }
  V3d along(int k) const { return {along_x[k], along_y[k], along_z[k]}; }
};

// Directions of view in the frame in which light's ways are known: the reference tetrad's, or,
// where light goes straight near a hole, that of the observer at rest.
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

  // Traces one direction step by step, by the C library's functions.  It is the oracle of the
  // batch.
  ViewRay trace(const CameraDirection& n) const;

  // Traces count <= ViewRayBatch::kSize directions by SIMD code.  Columns `sky` and `to_edge` are
  // always set, the others where the sky has a table.  Measured against the tracing of one
  // direction: within 1e-15 radians on the sky and a relative 1e-14, because vector_math.h rounds
  // differently.
  void trace(const CameraDirection* n, int count, ViewRayBatch& batch) const;

  // The same directions only brought into that frame, for what is nearer than the skies.
  void into_frame(const CameraDirection* n, int count, FrameRayBatch& batch) const;

  // Whether light near the hole goes straight, as a show may have it.
  bool goes_straight() const { return to_rest_.has_value(); }

  // The observers for whom the frame is drawn.
  const Vantage& vantage() const { return vantage_; }

 private:
  ViewRay straight_ray(const CameraDirection& n) const;
  ViewRay lensed_ray(const CameraDirection& n) const;
  void lensed_rays(const CameraDirection* n, int count, ViewRayBatch& batch) const;
  void straight_rays(const CameraDirection* n, int count, ViewRayBatch& batch) const;
  // The frequency of light from n for the observer who measures it, over that for the one whose
  // directions are drawn.
  double measured_ratio(const CameraDirection& n) const;

  M33d tetrad_from_camera_, sky_from_tetrad_;
  Vantage vantage_;
  const HoleOptics& optics_;
  bool flat_, outgoing_;
  SkyRegion home_, far_;
  double s_, one_minus_s_;                 // s = sqrt(2/r); 1 - s = (r - 2)/(r (1 + s))
  std::optional<Aberration> to_measured_;  // to Vantage::measured, if there is one
  std::optional<Aberration> to_rest_;      // from the tetrad, if light goes straight near a hole
  double gravitational_ratio_ = 1;
};

}  // namespace domefall
