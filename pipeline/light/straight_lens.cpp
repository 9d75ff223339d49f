#include "pipeline/light/straight_lens.h"

#include <algorithm>

#include "pipeline/base/simd/dispatch.h"

namespace domefall {
namespace {

[[gnu::always_inline]] inline void go_straight_loop(M33d matrix, double shift,
                                                    const DirectionBatch& __restrict n, int count,
                                                    ViewRayBatch& __restrict rays) {
  for (int k = 0; k < count; ++k) {
    const V3d sky = apply(matrix, V3d(n.x[k], n.y[k], n.z[k]));
    rays.sky_x[k] = sky.x;
    rays.sky_y[k] = sky.y;
    rays.sky_z[k] = sky.z;
    rays.frequency_ratio[k] = shift;
    rays.along_x[k] = rays.along_y[k] = rays.along_z[k] = 0;
    rays.scale_along[k] = rays.scale_across[k] = 1;
    rays.to_edge[k] = HUGE_VAL;
    rays.emission_time[k] = rays.time_scale[k] = 0;
  }
}
Dispatched<go_straight_loop> straight_rays;

class StraightPoints : public SkyPoints {
 public:
  explicit StraightPoints(double shift) : shift_(shift) {}

  SkyImage image(const V3d& source, int, double) const override { return {{source}, shift_, 1}; }
  double most_light(int) const override { return shift_ * shift_ * shift_ * shift_; }
  void images(int, const PointBatch& points, int count, PointImageBatch& images) const override {
    std::copy_n(points.x.begin(), count, images.x.begin());
    std::copy_n(points.y.begin(), count, images.y.begin());
    std::copy_n(points.z.begin(), count, images.z.begin());
    std::fill_n(images.frequency_ratio.begin(), count, shift_);
    std::fill_n(images.amplification.begin(), count, 1.0);
  }

 private:
  double shift_;
};

}  // namespace

std::unique_ptr<const SkyPoints> StraightLens::points(SkyRegion sky,
                                                      const std::optional<PointTolerance>&) const {
  return sky == sky_ ? std::make_unique<StraightPoints>(shift_) : nullptr;
}

std::unique_ptr<const PlaneRays> StraightLens::plane(const PlaneRings& rings,
                                                     double null_time) const {
  return std::make_unique<PlaneRays>(PlaneView{space_, r_, tetrad_, true}, null_time, rings);
}

void StraightLens::rays(const DirectionBatch& directions, int count, ViewRayBatch& rays) const {
  straight_rays(axes_, shift_, directions, count, rays);
  std::fill_n(rays.sky.begin(), count, sky_);
}

ViewRay StraightLens::ray(const V3d& direction) const {
  ViewRay ray;
  ray.sky = sky_;
  ray.known = true;
  ray.sky_direction = apply(axes_, direction);
  ray.frequency_ratio = shift_;
  ray.scale_along = ray.scale_across = 1;
  ray.axis =
      direction.cross(std::abs(direction.x) < 0.6 ? V3d(1, 0, 0) : V3d(0, 1, 0)).normalized();
  ray.along = apply(axes_, ray.axis);
  ray.mirrored = mirrored_;
  return ray;
}

}  // namespace domefall
