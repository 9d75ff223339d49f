// Brings directions of view into the frame in which the paths of light are known, by SIMD code.
#include "pipeline/render/rays/view_tracer.h"
#include "pipeline/simd/dispatch.h"

namespace domefall {
namespace {

// A MovingCamera holds what the loop needs to know of the observer.  The loop copies it, as the
// loops of lensed_rays.cpp copy theirs.
struct MovingCamera {
  M33d tetrad_from_camera;
  Aberration aberration;
};

// A boost that multiplies frequencies by D divides small angles by D, so one number serves as scale
// and as frequency.
[[gnu::always_inline]] inline void into_frame_loop(const MovingCamera& camera,
                                                   const CameraDirection* n, int count,
                                                   FrameRayBatch& batch) {
  const MovingCamera c = camera;
  for (int k = 0; k < count; ++k) {
    const AberratedLight in = c.aberration.to_rest(apply(c.tetrad_from_camera, n[k].v));
    batch.x[k] = in.direction.x;
    batch.y[k] = in.direction.y;
    batch.z[k] = in.direction.z;
    batch.scale[k] = batch.frequency[k] = 1 / in.frequency_ratio;
  }
}
Dispatched<into_frame_loop> into_tetrad_frame;

}  // namespace

void ViewTracer::into_frame(const CameraDirection* n, int count, FrameRayBatch& batch) const {
  into_tetrad_frame({tetrad_from_camera_, Aberration(vantage_.celerity)}, n, count, batch);
  if (to_rest_)
    for (int k = 0; k < count; ++k) {
      const AberratedLight rest = to_rest_->to_rest(V3d(batch.x[k], batch.y[k], batch.z[k]));
      batch.x[k] = rest.direction.x;
      batch.y[k] = rest.direction.y;
      batch.z[k] = rest.direction.z;
      batch.scale[k] /= rest.frequency_ratio;
      batch.frequency[k] /= rest.frequency_ratio;
    }
  if (to_measured_)
    for (int k = 0; k < count; ++k) batch.frequency[k] *= measured_ratio(n[k]);
}

}  // namespace domefall
