#include "projections/image_size.h"

#include <algorithm>
#include <cmath>

namespace domefall {
namespace {

struct WithWidth {
  int width;

  Projection operator()(const Domemaster&) const { return Domemaster{width}; }
  Projection operator()(const Equirectangular&) const {
    return Equirectangular{2 * std::max(1, width / 2)};
  }
  Projection operator()(const Cubemap&) const { return Cubemap{std::max(1, width / 3)}; }
  template <class Sized>
  Projection operator()(Sized p) const {
    const double height = static_cast<double>(width) * p.rows / p.columns;
    p.columns = width;
    p.rows = std::max(1, static_cast<int>(std::lround(height)));
    return p;
  }
};

}  // namespace

bool has_free_shape(const Projection& p) {
  return std::holds_alternative<Stereographic>(p) || std::holds_alternative<Rectilinear>(p) ||
         std::holds_alternative<Fisheye>(p);
}

Projection with_sides(Projection p, int columns, int rows) {
  if (auto* s = std::get_if<Stereographic>(&p)) s->columns = columns, s->rows = rows;
  if (auto* r = std::get_if<Rectilinear>(&p)) r->columns = columns, r->rows = rows;
  if (auto* f = std::get_if<Fisheye>(&p)) f->columns = columns, f->rows = std::min(rows, columns);
  return p;
}

Projection with_width(const Projection& p, int columns) {
  return std::visit(WithWidth{columns}, p);
}

}  // namespace domefall
