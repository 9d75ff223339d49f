#include "pipeline/render/blobs/metric_shape.h"

namespace domefall {
BlobShape blob_shape(const Projection& p, const PixelMetric& metric, const CameraDirection& n,
                     double sigma) {
  const double precision = 1 / (sigma * sigma), variance = sigma * sigma;
  const double determinant = metric.xx * metric.yy - metric.xy * metric.xy;
  // The square of an angle is d M d with the metric M, so P without the blur is M/sigma^2.  Its
  // inverse is the covariance, to which the square of the pixel adds 1/12 along both axes.
  const double bare_x = variance * metric.yy / determinant;
  const double bare_y = variance * metric.xx / determinant;
  const double mixed = -variance * metric.xy / determinant;
  const double x = bare_x + 1.0 / 12, y = bare_y + 1.0 / 12;
  const double blurred = x * y - mixed * mixed;
  const double xx = y / blurred, yy = x / blurred;
  return {xx,
          -mixed / blurred,
          yy,
          x,
          y,
          (xx * xx + yy * yy) / 5760,
          2 * std::numbers::pi * std::sqrt(blurred * determinant),
          metric.xx * precision,
          metric.xy * precision,
          metric.yy * precision,
          scale_change_per_radian(p, n) * sigma};
}

}  // namespace domefall
