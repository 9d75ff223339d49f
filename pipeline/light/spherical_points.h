// The images of points of a sky through a spherical lens, by the sky's table and curves that are made
// of it.
#pragma once

#include <algorithm>
#include <optional>

#include "pipeline/light/lens_curve.h"
#include "pipeline/light/sky_points.h"

namespace domefall {

class SphericalPoints : public SkyPoints {
 public:
  // The table must outlive this object.  Without a tolerance no curves are made.
  SphericalPoints(const SkyTable& table, const std::optional<PointTolerance>& tolerance);

  int orders() const override { return std::max(24, orders_in_batches()); }
  bool has_axis() const override { return true; }
  SkyImage image(const V3d& source, int order, double blur) const override;
  std::vector<SkyImage> arc(const V3d& source, int order, double radius,
                            const std::function<double(const V3d&)>& spacing) const override;

  // Each curve is for a pair of orders.
  int orders_in_batches() const override { return 2 * static_cast<int>(curves_.size()); }
  double most_light(int order) const override;
  void locate(PointBatch& points, int count) const override;
  void bounds(int order, const PointBatch& points, const int* chosen, int count,
              float* out) const override;
  void images(int order, const PointBatch& points, int count,
              PointImageBatch& images) const override;

 private:
  const SkyTable& table_;
  PsiFrame psi_;
  std::vector<LensCurve> curves_;
};

}  // namespace domefall
