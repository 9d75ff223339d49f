#include "pipeline/render/rays/footprint_batch.h"

#include "pipeline/base/simd/dispatch.h"

namespace domefall {
namespace {

[[gnu::always_inline]] inline void set_loop(const ViewRayBatch& batch, const double* angle,
                                            int count, const FootprintColumns& footprints) {
  const ViewRayBatch& b = batch;
  const FootprintColumns out = footprints;
  for (int k = 0; k < count; ++k) {
    const double sx = b.sky_x[k], sy = b.sky_y[k], sz = b.sky_z[k];
    const double x = b.along_x[k], y = b.along_y[k], z = b.along_z[k];
    // The other axis of the ellipse lies along the vector product of `along` and the direction.
    const double across_x = y * sz - z * sy, across_y = z * sx - x * sz, across_z = x * sy - y * sx;
    const double s = b.scale_along[k], t = b.scale_across[k];
    const bool longer = s >= t;
    const double wide = angle[k] * (longer ? s : t), narrow = angle[k] * (longer ? t : s);
    out.x[k] = static_cast<float>(sx);
    out.y[k] = static_cast<float>(sy);
    out.z[k] = static_cast<float>(sz);
    out.wide[k] = static_cast<float>(wide);
    out.narrow[k] = static_cast<float>(narrow);
    out.ax[k] = static_cast<float>((longer ? x : across_x) * wide);
    out.ay[k] = static_cast<float>((longer ? y : across_y) * wide);
    out.az[k] = static_cast<float>((longer ? z : across_z) * wide);
  }
}
Dispatched<set_loop> set;

}  // namespace

void set_footprints(const ViewRayBatch& batch, const double* angle, int count,
                    const FootprintColumns& footprints) {
  set(batch, angle, count, footprints);
}

}  // namespace domefall
