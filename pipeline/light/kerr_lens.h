// The lens of a hole that spins, by a chart of each sky that is seen (kerr_chart.h).
#pragma once

#include <memory>

#include "pipeline/light/kerr_chart.h"
#include "pipeline/light/lens.h"
#include "trajectories/observer_state.h"

namespace domefall {

// The charts of one place, which observers share who have the same.
struct KerrCharts {
  KerrPlace at;
  int stride;                                    // of charts and plane
  std::shared_ptr<const KerrChart> own, beyond;  // of region I, and of III between the horizons
  std::shared_ptr<KerrPlaneKeeper> plane;

  bool are_of(const KerrPlace& place, int their_stride) const {
    return at.hole == place.hole && at.r == place.r && at.theta == place.theta &&
           stride == their_stride;
  }
};

// Returns where an observer is.
KerrPlace kerr_place(const SpinningHole& hole, const ObserverState& observer);

class KerrLens : public Lens {
 public:
  // `axes` are those of ObserverState::sky_from_tetrad.  A sky without a chart is not known.
  KerrLens(std::shared_ptr<const KerrCharts> charts, const M33d& sky_from_tetrad);

  void rays(const DirectionBatch& n, int count, ViewRayBatch& batch) const override;
  // This is the exact ray.
  ViewRay ray(const V3d& direction) const override;
  std::vector<SkyBorder> borders() const override;
  std::vector<ViewCurve> einstein_rings() const override;
  std::optional<ViewCurve> ergosphere() const override;
  std::unique_ptr<const SkyPoints> points(
      SkyRegion sky, const std::optional<PointTolerance>& tolerance) const override;
  V3d primary_image(const V3d& source) const override;
  std::shared_ptr<const KerrPlane> kerr_plane(const KerrRings& rings) const override {
    return charts_->plane->plane(charts_->at, rings, charts_->stride);
  }
  std::optional<GasView> gas_view() const override;
  bool lists_bodies() const override { return true; }
  std::vector<BodyImage> body_images(double null_time, const BodyMotion& motion,
                                     double radius) const override;
  std::optional<BodyImage> body_image(double null_time, const BodyMotion& motion, int order,
                                      double radius) const override;
  RingedSphere sphere(double null_time, const BodyMotion& motion, const BodyImage& image,
                      std::span<const BodyImage> earlier, double radius, const RingPlane& rings,
                      const std::function<double(const V3d&)>& spacing) const override;

 private:
  struct Seen;
  Seen seen(const V3d& direction) const;
  const KerrChart* chart(SkyRegion sky) const;

  std::shared_ptr<const KerrCharts> charts_;
  M33d axes_;             // of the equator's x, y and the hole's axis, on the skies
  double sine_, cosine_;  // of theta
};

}  // namespace domefall
