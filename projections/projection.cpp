#include "projections/projection.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "projections/inside_direction.h"

namespace domefall {
namespace {

using std::numbers::pi;

struct Centred {
  double x, y;  // pixels from the middle of the image
};

Centred centred(const Projection& p, PixelPosition pixel) {
  return {pixel.i - (columns(p) + 1) / 2.0, pixel.j - (rows(p) + 1) / 2.0};
}

// sin(theta)/theta, its limit at 0 included.
double sinc(double theta) { return theta < 1e-8 ? 1.0 : std::sin(theta) / theta; }

// The paper's 2 tan(alpha/2)/C: tan(theta/2) per pixel.
double half_tangent_per_pixel(const Stereographic& s) {
  return 2 * std::tan(s.fov / 4) / s.columns;
}

CameraDirection direction(const Domemaster& d, Centred at) {
  const double scale = pi / d.size;
  const double theta = std::hypot(at.x, at.y) * scale;
  const double k = sinc(theta) * scale;
  return {{at.x * k, at.y * k, std::cos(theta)}};
}

// N = -Z + 2 W/|W|^2 with W = Z + w, written so that nothing cancels near the middle.
CameraDirection direction(const Stereographic& s, Centred at) {
  const double scale = half_tangent_per_pixel(s);
  const double x = at.x * scale, y = at.y * scale;
  const double w2 = x * x + y * y;
  return {{2 * x / (1 + w2), 2 * y / (1 + w2), (1 - w2) / (1 + w2)}};
}

CameraDirection inside_direction(const Domemaster& d, Centred at) {
  return DomemasterView(d).direction(at.x, at.y);
}

CameraDirection inside_direction(const Stereographic& s, Centred at) { return direction(s, at); }

// Pixels per unit of (X.N, Y.N); infinite towards -Z.
double magnification(const Domemaster& d, const CameraDirection& n) {
  const double sine = std::hypot(n.v.x, n.v.y);
  if (sine == 0) return n.v.z > 0 ? d.size / pi : HUGE_VAL;
  return d.size / pi * std::atan2(sine, n.v.z) / sine;
}

double magnification(const Stereographic& s, const CameraDirection& n) {
  // 1 + cos(theta), from the sine where the sum would cancel.
  const double sine2 = n.v.x * n.v.x + n.v.y * n.v.y;
  const double one_plus_cos = n.v.z >= 0 ? 1 + n.v.z : sine2 / (1 - n.v.z);
  return 1 / (half_tangent_per_pixel(s) * one_plus_cos);
}

}  // namespace

StereographicView::StereographicView(const Stereographic& s) : scale(half_tangent_per_pixel(s)) {}

int columns(const Projection& p) {
  if (const auto* d = std::get_if<Domemaster>(&p)) return d->size;
  return std::get<Stereographic>(p).columns;
}

int rows(const Projection& p) {
  if (const auto* d = std::get_if<Domemaster>(&p)) return d->size;
  return std::get<Stereographic>(p).rows;
}

Projection refined(const Projection& p, int factor) {
  if (const auto* d = std::get_if<Domemaster>(&p)) return Domemaster{d->size * factor};
  const auto& s = std::get<Stereographic>(p);
  return Stereographic{s.columns * factor, s.rows * factor, s.fov};
}

CameraDirection direction_at(const Projection& p, PixelPosition pixel) {
  return std::visit([&](const auto& q) { return direction(q, centred(p, pixel)); }, p);
}

std::optional<PixelPosition> pixel_of(const Projection& p, CameraDirection n) {
  const double m = std::visit([&](const auto& q) { return magnification(q, n); }, p);
  if (!std::isfinite(m)) return std::nullopt;
  return PixelPosition{(columns(p) + 1) / 2.0 + m * n.v.x, (rows(p) + 1) / 2.0 + m * n.v.y};
}

bool is_inside(const Projection& p, PixelPosition pixel) {
  if (!std::holds_alternative<Domemaster>(p)) return true;
  const Centred at = centred(p, pixel);
  const double radius = columns(p) / 2.0;
  return at.x * at.x + at.y * at.y <= radius * radius;
}

ColumnRange inside_columns(const Projection& p, int row) {
  const int width = columns(p);
  if (!std::holds_alternative<Domemaster>(p)) return {0, width - 1};
  const double y = row - (width - 1) / 2.0, radius = width / 2.0;
  const double half = std::sqrt(std::max(0.0, radius * radius - y * y));
  ColumnRange range{std::max(0, static_cast<int>((width - 1) / 2.0 - half) - 1), 0};
  while (range.first < width && !is_inside(p, {range.first + 1.0, row + 1.0})) ++range.first;
  range.last = width - 1 - range.first;  // the dome is symmetric
  return range;
}

void inside_directions(const Projection& p, int row, ColumnRange range, CameraDirection* out) {
  std::visit(
      [&](const auto& q) {
        for (int i = range.first; i <= range.last; ++i)
          *out++ = inside_direction(q, centred(p, {i + 1.0, row + 1.0}));
      },
      p);
}

void directions_along(const Projection& p, PixelPosition first, double step, int count,
                      CameraDirection* out) {
  std::visit(
      [&](const auto& q) {
        for (int k = 0; k < count; ++k)
          out[k] = inside_direction(q, centred(p, {first.i + k * step, first.j}));
      },
      p);
}

double pixel_solid_angle(const Projection& p, PixelPosition pixel) {
  const Centred at = centred(p, pixel);
  if (const auto* d = std::get_if<Domemaster>(&p)) {
    const double scale = pi / d->size;
    return scale * scale * sinc(std::hypot(at.x, at.y) * scale);
  }
  const double k = half_tangent_per_pixel(std::get<Stereographic>(p));
  const double w2 = (at.x * at.x + at.y * at.y) * k * k;
  const double side = 2 * k / (1 + w2);
  return side * side;
}

double central_pixel_angle(const Projection& p) {
  if (const auto* d = std::get_if<Domemaster>(&p)) return pi / d->size;
  return 2 * half_tangent_per_pixel(std::get<Stereographic>(p));
}

double pixel_angle(const Projection& p, PixelPosition pixel) {
  if (std::holds_alternative<Domemaster>(p)) return central_pixel_angle(p);
  return std::sqrt(pixel_solid_angle(p, pixel));  // conformal: the same in every direction
}

std::string_view projection_name(const Projection& p) {
  return std::holds_alternative<Domemaster>(p) ? "domemaster" : "stereographic";
}

}  // namespace domefall
