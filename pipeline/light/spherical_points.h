// The images of points of a sky through a spherical lens, by the sky's tables and curves that are
// made of them.
#pragma once

#include <algorithm>
#include <optional>
#include <vector>

#include "pipeline/light/lens_curve.h"
#include "pipeline/light/sky_points.h"

namespace domefall {

// A sky that is seen in two parts of the view has the images of both.  Its tables take turns with
// pairs of orders, so that the images of even orders of a table have even numbers.
class SphericalPoints : public SkyPoints {
 public:
  // The tables, of which there is one at least, must outlive this object.  Without a tolerance no
  // curves are made.
  SphericalPoints(std::vector<const SkyTable*> tables,
                  const std::optional<PointTolerance>& tolerance);

  int orders() const override {
    return std::max(24 * static_cast<int>(tables_.size()), orders_in_batches());
  }
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
  std::size_t table_of(int order) const {
    return static_cast<std::size_t>(order / 2) % tables_.size();
  }
  int order_in_table(int order) const {
    return order / 2 / static_cast<int>(tables_.size()) * 2 + order % 2;
  }

  std::vector<const SkyTable*> tables_;
  std::vector<PsiFrame> psi_;      // of each table
  std::vector<LensCurve> curves_;  // of each pair of orders
};

}  // namespace domefall
