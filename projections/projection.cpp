#include "projections/projection.h"

#include <algorithm>
#include <cmath>

#include "projections/sphere_formulas.h"

namespace domefall {
namespace {

int width(const Domemaster& d) { return d.size; }
int width(const Equirectangular& e) { return e.columns; }
int width(const Cubemap& c) { return kFacesInARow * c.face; }
template <class Sized>
int width(const Sized& p) {
  return p.columns;
}

int height(const Domemaster& d) { return d.size; }
int height(const Equirectangular& e) { return e.columns / 2; }
int height(const Cubemap& c) { return 2 * c.face; }
template <class Sized>
int height(const Sized& p) {
  return p.rows;
}

// Returns the row that looks along Z.  On a fisheye it lies below the middle by half of what more
// is cut at the bottom than at the top.
double middle_row(const Projection& p) {
  const double middle = (rows(p) + 1) / 2.0;
  const auto* fisheye = std::get_if<Fisheye>(&p);
  return fisheye ? middle + (fisheye->columns - fisheye->rows) * (0.5 - fisheye->cut_back) : middle;
}

Centred centred(const Projection& p, PixelPosition pixel) {
  return {pixel.i - (columns(p) + 1) / 2.0, pixel.j - middle_row(p)};
}

bool has_circle(const Projection& p) {
  return std::holds_alternative<Domemaster>(p) || std::holds_alternative<Fisheye>(p);
}

CameraDirection inside_direction(const Domemaster& d, Centred at) {
  return DomemasterView(d).direction(at.x, at.y);
}
template <class Other>
CameraDirection inside_direction(const Other& p, Centred at) {
  return direction(p, at);
}

struct Refined {
  int by;
  Projection operator()(Domemaster d) const { return Domemaster{d.size * by}; }
  Projection operator()(Equirectangular e) const { return Equirectangular{e.columns * by}; }
  Projection operator()(Cubemap c) const { return Cubemap{c.face * by}; }
  template <class Sized>
  Projection operator()(Sized p) const {
    p.columns *= by;
    p.rows *= by;
    return p;
  }
};

}  // namespace

StereographicView::StereographicView(const Stereographic& s) : scale(half_tangent_per_pixel(s)) {}

int columns(const Projection& p) {
  return std::visit([](const auto& q) { return width(q); }, p);
}

int rows(const Projection& p) {
  return std::visit([](const auto& q) { return height(q); }, p);
}

Projection refined(const Projection& p, int factor) { return std::visit(Refined{factor}, p); }

bool has_zenith(const Projection& p) {
  return !std::holds_alternative<Stereographic>(p) && !std::holds_alternative<Rectilinear>(p);
}

std::optional<double> field_of_view(const Projection& p) {
  if (const auto* s = std::get_if<Stereographic>(&p)) return s->fov;
  if (const auto* r = std::get_if<Rectilinear>(&p)) return r->fov;
  if (const auto* f = std::get_if<Fisheye>(&p)) return f->fov;
  return std::nullopt;
}

Projection with_field_of_view(Projection p, double fov) {
  if (auto* s = std::get_if<Stereographic>(&p)) s->fov = fov;
  if (auto* r = std::get_if<Rectilinear>(&p)) r->fov = fov;
  if (auto* f = std::get_if<Fisheye>(&p)) f->fov = fov;
  return p;
}

CameraDirection direction_at(const Projection& p, PixelPosition pixel) {
  return std::visit([&](const auto& q) { return direction(q, centred(p, pixel)); }, p);
}

std::optional<PixelPosition> pixel_of(const Projection& p, CameraDirection n) {
  const auto at = std::visit([&](const auto& q) { return place(q, n); }, p);
  if (!at) return std::nullopt;
  return PixelPosition{(columns(p) + 1) / 2.0 + at->x, middle_row(p) + at->y};
}

bool is_inside(const Projection& p, PixelPosition pixel) {
  if (!has_circle(p)) return true;
  const Centred at = centred(p, pixel);
  const double radius = columns(p) / 2.0;
  return at.x * at.x + at.y * at.y <= radius * radius;
}

ColumnRange inside_columns(const Projection& p, int row) {
  const int width = columns(p);
  if (!has_circle(p)) return {0, width - 1};
  const double y = row + 1 - middle_row(p), radius = width / 2.0;
  const double half = std::sqrt(std::max(0.0, radius * radius - y * y));
  ColumnRange range{std::max(0, static_cast<int>((width - 1) / 2.0 - half) - 1), 0};
  while (range.first < width && !is_inside(p, {range.first + 1.0, row + 1.0})) ++range.first;
  range.last = width - 1 - range.first;  // a circle is symmetric
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
  return std::visit([&](const auto& q) { return solid_angle(q, centred(p, pixel)); }, p);
}

PixelMetric pixel_metric(const Projection& p, PixelPosition pixel) {
  return std::visit([&](const auto& q) { return metric(q, centred(p, pixel)); }, p);
}

double central_pixel_angle(const Projection& p) {
  struct Central {
    double operator()(const Domemaster& d) const { return radians_per_pixel(d); }
    double operator()(const Stereographic& s) const { return 2 * half_tangent_per_pixel(s); }
    double operator()(const Rectilinear& r) const { return tangent_per_pixel(r); }
    double operator()(const Fisheye& f) const { return radians_per_pixel(f); }
    double operator()(const Equirectangular& e) const { return radians_per_pixel(e); }
    double operator()(const Cubemap& c) const { return (*this)(face_projection(c)); }
  };
  return std::visit(Central(), p);
}

double pixel_angle(const Projection& p, PixelPosition pixel) {
  struct Largest {
    Centred at;
    double operator()(const Stereographic& s) const { return scales(s, at).tangential; }
    double operator()(const Rectilinear& r) const { return scales(r, at).tangential; }
    double operator()(const Cubemap& c) const {
      return Largest{on_face(c, face_at(c, at), at)}(face_projection(c));
    }
    double operator()(const Domemaster& d) const { return radians_per_pixel(d); }
    double operator()(const Fisheye& f) const { return radians_per_pixel(f); }
    double operator()(const Equirectangular& e) const { return radians_per_pixel(e); }
  };
  return std::visit(Largest{centred(p, pixel)}, p);
}

std::string_view projection_name(const Projection& p) { return kProjectionNames[p.index()]; }

}  // namespace domefall
