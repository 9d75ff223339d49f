// Where light goes straight, the sky stands as it is: in flat space, and near a hole in the frame of
// the observer at rest, if a show leaves lensing out.
#pragma once

#include "pipeline/light/lens.h"
#include "trajectories/observer_state.h"

namespace domefall {

class StraightLens : public Lens {
 public:
  // `frame` is the celerity of the observer at rest, and `shift` the frequency ratio of all light in
  // that observer's frame.
  StraightLens(const ObserverState& observer, const Celerity<ReferenceTetrad>& frame, double shift)
      : space_(observer.spacetime),
        r_(observer.r),
        tetrad_(observer.tetrad),
        sky_(own_sky(observer)),
        axes_(sky_axes(observer, sky_)),
        mirrored_(axes_ != observer.sky_from_tetrad),
        frame_(frame),
        shift_(shift) {}

  Celerity<ReferenceTetrad> frame() const override { return frame_; }
  void rays(const DirectionBatch& directions, int count, ViewRayBatch& rays) const override;
  ViewRay ray(const V3d& direction) const override;
  std::unique_ptr<const SkyPoints> points(SkyRegion,
                                          const std::optional<PointTolerance>&) const override;

  V3d primary_image(const V3d& source) const override { return source; }
  std::optional<GasView> gas_view() const override {
    return GasView{{space_, r_, tetrad_, true}, std::nullopt};
  }
  std::unique_ptr<const PlaneRays> plane(const PlaneRings& rings, double null_time) const override;

 private:
  Spacetime space_;
  double r_;
  Tetrad tetrad_;
  SkyRegion sky_;
  M33d axes_;  // of that sky
  bool mirrored_;
  Celerity<ReferenceTetrad> frame_;
  double shift_;
};

}  // namespace domefall
