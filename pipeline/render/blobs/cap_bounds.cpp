#include "pipeline/render/blobs/cap_bounds.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "pipeline/simd/vector_math.h"

namespace domefall {
namespace {

using std::numbers::pi;

constexpr double kAll = 1e9;  // more pixels than any image has

// A CapBox says how far, in pixels, the box around a cap reaches from the middle of the cap.
struct CapBox {
  double left, right, up, down;
};

CapBox square_box(double half) { return {half, half, half, half}; }

// Finds the edges of a cap on a flat image, in units of tan(theta).  Column X of the image is the
// plane x = X z.  The sine of its angle to n is |n.x - X n.z|/sqrt(1 + X^2), so that the plane
// touches the cone of half angle `reach` about n where
//     (n.x - X n.z)^2 = sin^2(reach) (1 + X^2).
// The two solutions of this quadratic equation are the least and the most X.
void find_edges(double along, double z, double reach, double& least, double& most) {
  const double s2 = std::sin(reach) * std::sin(reach);
  const double a = z * z - s2, b = along * z,
               root = std::sqrt(s2 * std::max(0.0, a + along * along));
  least = (b - root) / a;
  most = (b + root) / a;
}

CapBox rectilinear_box(const Projection& p, const CameraDirection& n, double reach) {
  const double theta = std::acos(std::clamp(n.v.z, -1.0, 1.0));
  if (theta + reach > pi / 2 - 1e-3) return square_box(kAll);
  const double per_tangent = 1 / central_pixel_angle(p);
  double left = 0, right = 0, top = 0, bottom = 0;
  find_edges(n.v.x, n.v.z, reach, left, right);
  find_edges(n.v.y, n.v.z, reach, top, bottom);
  const double x = n.v.x / n.v.z, y = n.v.y / n.v.z;
  return {(x - left) * per_tangent + 1, (right - x) * per_tangent + 1, (y - top) * per_tangent + 1,
          (bottom - y) * per_tangent + 1};
}

// Returns the most pixels by which an angle `reach` may lead away from a direction, on an image
// about Z.  It returns kAll where the cap might surround the middle or reach infinity.
double farthest_pixels(const Projection& p, const CameraDirection& n, double reach) {
  const double theta = std::atan2(std::hypot(n.v.x, n.v.y), n.v.z), far = theta + reach;
  const double centre = 1 / central_pixel_angle(p);
  if (std::holds_alternative<Stereographic>(p)) {
    const double c = std::cos(std::min(far, pi) / 2);
    return c > 1e-4 ? reach * centre / (c * c) : kAll;
  }
  // On an equidistant fisheye the pixels per radian along the tangent are theta/sin(theta) times
  // those in the middle.
  if (far < pi / 2) return reach * centre * far / std::sin(far);
  // Farther out the cap lies between two meridians, and between theta - reach and theta + reach.
  // Its farthest point is nearer than the sum of a radial step and the chord across to such a
  // meridian.
  const double ratio = std::sin(std::min(reach, pi / 2)) / std::sin(theta);
  if (far >= pi || reach >= theta || ratio >= 1) return kAll;
  return (reach + far * 2 * std::sin(std::asin(ratio) / 2)) * centre;
}

CapBox cap_box(const Projection& p, const CameraDirection& n, double reach) {
  if (std::holds_alternative<Rectilinear>(p)) return rectilinear_box(p, n, reach);
  if (!std::holds_alternative<Equirectangular>(p))
    return square_box(farthest_pixels(p, n, reach) + 1);
  // The meridians that touch a circle of radius `reach` are asin(sin(reach)/cos(latitude)) from its
  // middle.
  const double ratio = std::sin(std::min(reach, pi / 2)) / std::hypot(n.v.x, n.v.y);
  const double per_radian = columns(p) / (2 * pi), down = reach * per_radian + 1;
  const double across = ratio < 1 ? std::asin(ratio) * per_radian + 1 : columns(p);
  return {across, across, down, down};
}

// Says whether a blob lies outside the circle about Z that holds the whole image.  Far beyond the
// circle the projection is stretched so much that bounds in pixels would not tell.
bool is_beyond_circle(const Projection& p, const CameraDirection& n, double reach) {
  double circle = pi;
  if (const auto* fisheye = std::get_if<Fisheye>(&p)) circle = fisheye->fov / 2;
  if (std::holds_alternative<Rectilinear>(p)) circle = std::acos(direction_at(p, {0.5, 0.5}).v.z);
  const double theta = std::atan2(std::hypot(n.v.x, n.v.y), n.v.z);
  return theta - reach > circle + central_pixel_angle(p);
}

// Adds the columns between two positions in a row that are within `inside`.
void add_columns(double from, double to, const ColumnRange& inside, CapSpans& spans) {
  const int first = static_cast<int>(std::max(std::floor(from), double(inside.first)));
  const int last = static_cast<int>(std::min(std::ceil(to), double(inside.last)));
  if (first <= last) spans.span[spans.count++] = {first, last};
}

// Returns half the number of columns that a blob covers on a row of an image of the whole sphere.
// These are all points of the row's latitude within `reach` of the blob's middle.  Their distance c
// is given by the haversine formula,
//     sin^2(c/2) = sin^2((latitude - middle)/2) + cos(latitude) cos(middle) sin^2(longitude/2).
double half_width_at(double latitude, double middle, double reach, double per_radian) {
  const double up = std::sin((latitude - middle) / 2), most = std::sin(reach / 2);
  const double around = std::cos(latitude) * std::cos(middle);
  const double left = most * most - up * up;
  if (left < 0) return -1;
  return left < around ? 2 * std::asin(std::sqrt(left / around)) * per_radian : pi * per_radian;
}

CapSpans spans_on_sphere(const CapBlob& b, const Projection& p, double reach, int row,
                         const ColumnRange& inside) {
  CapSpans spans;
  const double width = columns(p), per_radian = width / (2 * pi);
  const auto latitude = [&](double y) { return (rows(p) - 1 - 2 * y) / (2 * per_radian); };
  // A pixel may be covered in part if its corner is, so half the diagonal of a pixel is added.
  const double rim = 0.71 / per_radian;
  const double half =
      half_width_at(latitude(row), latitude(b.y), std::min(reach + rim, pi), per_radian) + 1;
  if (half < 1) return spans;
  if (2 * half >= width) {
    add_columns(0, width - 1, inside, spans);
    return spans;
  }
  // The middle is within the image, so that one copy on each side suffices.
  for (const double shift : {-width, 0.0, width})
    add_columns(b.x + shift - half, b.x + shift + half, inside, spans);
  return spans;
}

// Far out on a fisheye a blob is long and bent, and covers little of the square around it.  It
// covers only pixels that are about as far from the middle of the circle as the blob's own middle.
CapSpans spans_on_ring(const CapBlob& b, const Projection& p, double reach, int row, double left,
                       double right, const ColumnRange& inside) {
  constexpr double kNarrow = 2;
  CapSpans spans;
  const PixelPosition middle = *pixel_of(p, {{0, 0, 1}});
  const double x = middle.i - 1, y = row - (middle.j - 1);
  const double from_middle = std::hypot(b.x - x, b.y - (middle.j - 1));
  const double half = reach / central_pixel_angle(p) + 1;
  const auto along_row = [y](double r) { return r > std::abs(y) ? std::sqrt(r * r - y * y) : 0; };
  const double outer = along_row(from_middle + half), inner = along_row(from_middle - half);
  // A gap of few columns is not worth two spans.
  if (inner < kNarrow) {
    add_columns(std::max(left, x - outer - 1), std::min(right, x + outer + 1), inside, spans);
    return spans;
  }
  add_columns(std::max(left, x - outer - 1), std::min(right, x - inner + 1), inside, spans);
  add_columns(std::max(left, x + inner - 1), std::min(right, x + outer + 1), inside, spans);
  return spans;
}

}  // namespace

double angular_reach(const CapBlob& b) {
  const double chord = std::sqrt(-2 * logarithm(double{b.cut})) * b.sigma;
  return 2 * std::asin(std::min(1.0, chord / 2));
}

bool bound_cap(const Projection& projection, const CameraDirection& n, CapBlob& blob) {
  const double width = columns(projection), height = rows(projection);
  const double reach = angular_reach(blob);
  if (is_beyond_circle(projection, n, reach)) return false;
  const CapBox box = cap_box(projection, n, reach);
  if (!(blob.x + box.right >= 0 && blob.y + box.down >= 0 && blob.x - box.left <= width - 1 &&
        blob.y - box.up <= height - 1))
    return false;
  const auto within = [](double v, double last) {
    return static_cast<int>(std::clamp(v, 0.0, last));
  };
  blob.reach = static_cast<float>(
      std::max({box.left, box.right, box.up, box.down}) *
      (std::holds_alternative<Rectilinear>(projection) ? std::numbers::sqrt2 : 1));
  blob.first_row = within(std::ceil(blob.y - box.up), height - 1);
  blob.last_row = within(std::floor(blob.y + box.down), height - 1);
  blob.first_column = within(std::ceil(blob.x - box.left), width - 1);
  blob.last_column = within(std::floor(blob.x + box.right), width - 1);
  return true;
}

CapSpans spans_of(const CapBlob& b, const Projection& p, double reach, int row,
                  const ColumnRange& inside) {
  if (std::holds_alternative<Equirectangular>(p)) return spans_on_sphere(b, p, reach, row, inside);
  CapSpans spans;
  const double dy = row - double{b.y}, half2 = double{b.reach} * b.reach - dy * dy;
  if (half2 < 0) return spans;
  const double left = std::max(b.x - std::sqrt(half2), double(b.first_column));
  const double right = std::min(b.x + std::sqrt(half2), double(b.last_column));
  if (std::holds_alternative<Fisheye>(p))
    return spans_on_ring(b, p, reach, row, left, right, inside);
  add_columns(left, right, inside, spans);
  return spans;
}

}  // namespace domefall
