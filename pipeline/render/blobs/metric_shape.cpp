#include "pipeline/render/blobs/metric_shape.h"

namespace domefall {
namespace {

constexpr double kEndless = 1e30;

// Returns the tangent of a direction's angle to an axis, from the direction's components along the
// axis and across it.
double tangent(double along, double across) { return along > 0 ? across / along : kEndless; }

// ScaleChange computes the bound for each projection.  theta is the angle to the middle, +Z.
struct ScaleChange {
  const CameraDirection& n;

  // A pixel covers cos(theta/2)^2 of what it covers in the middle.  The logarithmic derivative of
  // this is -tan(theta/2), and tan(theta/2) = sin(theta)/(1 + cos(theta)).
  double operator()(const Stereographic&) const { return tangent(1 + n.v.z, aside()); }
  // A pixel covers cos(theta)^2 of that along the direction to the middle.  The logarithmic
  // derivative of this is -2 tan(theta).
  double operator()(const Rectilinear&) const { return 2 * tangent(n.v.z, aside()); }
  // A face is a rectilinear image.  theta is largest in its corners, where tan(theta) = sqrt 2.
  double operator()(const Cubemap&) const { return 2 * std::numbers::sqrt2; }
  double operator()(const Domemaster&) const { return of_fisheye(); }
  // Circles of latitude are bent by tan(latitude), which is also how quickly their pixels narrow.
  double operator()(const Fisheye&) const { return of_fisheye(); }
  double operator()(const Equirectangular&) const { return tangent(aside(), std::abs(n.v.z)); }

 private:
  double aside() const { return std::hypot(n.v.x, n.v.y); }
  // Across the direction to the middle a pixel covers sin(theta)/theta of what it covers there.
  // The series of 1/theta - cot(theta), the logarithmic derivative, begins with theta/3.
  double of_fisheye() const {
    const double sine = aside(), theta = std::atan2(sine, n.v.z);
    if (theta < 0.01) return theta / 3;
    return sine > 0 ? 1 / theta - n.v.z / sine : kEndless;
  }
};

}  // namespace

double scale_change_per_radian(const Projection& p, const CameraDirection& n) {
  return std::visit(ScaleChange{n}, p);
}

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
