// The lens of a static, spherical space, by the tables of HoleOptics.
#pragma once

#include "pipeline/light/hole_optics.h"
#include "pipeline/light/lens.h"

namespace domefall {

class SphericalLens : public Lens {
 public:
  // A sky without a table is not known.  The axes are sky_axes().
  SphericalLens(std::shared_ptr<const HoleOptics> optics, const PerSky<M33d>& axes);

  // The measured difference from single rays is at most 1e-15 radians on the sky and a relative
  // 1e-14, because vector_math.h rounds differently from the C library.
  void rays(const DirectionBatch& n, int count, ViewRayBatch& batch) const override;
  ViewRay ray(const V3d& direction) const override;
  std::vector<SkyBorder> borders() const override;
  std::vector<ViewCurve> einstein_rings() const override;
  std::unique_ptr<const SkyPoints> points(
      SkyRegion sky, const std::optional<PointTolerance>& tolerance) const override;
  V3d primary_image(const V3d& source) const override;
  std::vector<V3d> far_ends(SkyRegion sky) const override;
  std::vector<SkySample> divided(SkyRegion sky, int along, int around) const override;
  // About the axis, azimuths of the singularity's light start like a cube root, and those of light
  // that turned at the core like a root.
  std::vector<V3d> special_directions() const override;

 protected:
  const HoleOptics& optics() const { return *optics_; }
  // Returns alpha of the edge of the tetrad's own sky.
  double own_edge() const { return optics_->parts.front().zone.edge.half.angle(); }

 private:
  ViewCircle circle_at(const HalfAngle& alpha) const;
  void divide(const SkyTable& table, const M33d& axes, int along, int around,
              std::vector<SkySample>& samples) const;

  std::shared_ptr<const HoleOptics> optics_;
  PerSky<M33d> axes_;  // those of region IV are those of I
  bool far_mirrored_;  // whether those of region III are others
};

}  // namespace domefall
