#pragma once

#include "pipeline/base/simd/vector_math.h"
#include "projections/projection_parts.h"

namespace domefall {

// An Equirectangular image is the whole sphere by longitude and latitude, as virtual reality has
// it, with columns/2 rows.  The left and the right edge are one meridian, the back's.  Longitude
// grows from the front to the right.
struct Equirectangular {
  static constexpr ProjectionTraits kTraits{
      .name = "equirectangular",
      .has_zenith = true,
      .has_seam = true,
      .shown_deg = 360,
      .one_number = "the width; a whole sphere is half as high as wide",
      .taker = "the width of a whole sphere",
      .even = true,
      .description = "the whole sphere by longitude and latitude (equirectangular)",
      .orientation = "the front is in the middle, the zenith at the top edge"};
  int columns = 4096;  // pixels, > 0, even

  int width() const { return columns; }
  int height() const { return columns / 2; }
  Equirectangular with_sides(int width, int) const { return {2 * std::max(1, width / 2)}; }

  double scale() const { return 2 * std::numbers::pi / columns; }  // radians per pixel
  double per_radian() const { return columns / (2 * std::numbers::pi); }
  double largest_pixel_angle() const { return scale(); }
  CameraDirection direction(Centred at) const {
    const double longitude = at.x * scale(), latitude = -at.y * scale();
    const double across = std::cos(latitude);
    return {{std::sin(longitude) * across, std::cos(longitude) * across, std::sin(latitude)}};
  }
  std::optional<Centred> place(const CameraDirection& n) const {
    return Centred{per_radian() * std::atan2(n.v.x, n.v.y),
                   -per_radian() * std::atan2(n.v.z, std::hypot(n.v.x, n.v.y))};
  }
  PixelMetric metric(Centred at) const {
    const double across = scale() * std::cos(at.y * scale());
    return {across * across, 0, scale() * scale()};
  }
  double solid_angle(Centred at) const { return scale() * scale() * std::cos(at.y * scale()); }
  double pixel_angle(Centred) const { return scale(); }
  // Circles of latitude are bent by tan(latitude), which is also how quickly their pixels narrow.
  double scale_change(const CameraDirection& n) const {
    return tangent_or_endless(std::hypot(n.v.x, n.v.y), std::abs(n.v.z));
  }
  CapBox cap_box(const CameraDirection& n, double angle) const;
  CapSpans cap_spans(const CapPlace& cap, PixelPosition origin, int row,
                     const ColumnRange& inside) const;
  // Near a pole a row's width grows in proportion to the distance from the pole.  In the k-th row
  // the centre of the area therefore lies 1/(12 (k + 1/2)) rows from the middle.
  bool has_slanted_areas(int row) const {
    constexpr int kRows = 2;
    return row < kRows || row >= height() - kRows;
  }

  struct View {
    double scale;

    CameraDirection direction(double x, double y) const {
      // Rows are counted downwards, and latitudes upwards.
      const SineCosine longitude = sin_cos(x * scale), latitude = sin_cos(-y * scale);
      return {
          {longitude.sine * latitude.cosine, longitude.cosine * latitude.cosine, latitude.sine}};
    }
    double pixel_angle(double, double) const { return scale; }
    double area(const CameraDirection& n, double, double) const {
      return std::sqrt(n.v.x * n.v.x + n.v.y * n.v.y);
    }
  };
  View view() const { return {scale()}; }
};

// The meridians that touch a circle of radius `angle` are asin(sin(angle)/cos(latitude)) from its
// middle.
inline CapBox Equirectangular::cap_box(const CameraDirection& n, double angle) const {
  const double ratio = std::sin(std::min(angle, std::numbers::pi / 2)) / std::hypot(n.v.x, n.v.y);
  const double down = angle * per_radian() + 1;
  const double across = ratio < 1 ? std::asin(ratio) * per_radian() + 1 : columns;
  return {across, across, down, down, std::max(across, down)};
}

// On a row a cap covers all points of the row's latitude within its angle of its middle.  Their
// distance c is given by the haversine formula,
//     sin^2(c/2) = sin^2((latitude - middle)/2) + cos(latitude) cos(middle) sin^2(longitude/2).
inline CapSpans Equirectangular::cap_spans(const CapPlace& cap, PixelPosition, int row,
                                           const ColumnRange& inside) const {
  using std::numbers::pi;
  CapSpans spans;
  const double width = columns;
  const auto latitude = [&](double y) { return (height() - 1 - 2 * y) / (2 * per_radian()); };
  // A pixel may be covered in part if its corner is, so half the diagonal of a pixel is added.
  const double reach = std::min(cap.angle + 0.71 / per_radian(), pi);
  const double here = latitude(row), middle = latitude(cap.y);
  const double up = std::sin((here - middle) / 2), most = std::sin(reach / 2);
  const double around = std::cos(here) * std::cos(middle), left = most * most - up * up;
  if (left < 0) return spans;
  const double half =
      (left < around ? 2 * std::asin(std::sqrt(left / around)) : pi) * per_radian() + 1;
  if (2 * half >= width) {
    spans.add(0, width - 1, inside);
    return spans;
  }
  // The middle is within the image, so that one copy on each side suffices.
  for (const double shift : {-width, 0.0, width})
    spans.add(cap.x + shift - half, cap.x + shift + half, inside);
  return spans;
}

}  // namespace domefall
