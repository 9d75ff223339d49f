#include "projections/projection.h"

#include "projections/projection_defaults.h"

namespace domefall {

int columns(const Projection& p) {
  return std::visit([](const auto& q) { return width_of(q); }, p);
}

int rows(const Projection& p) {
  return std::visit([](const auto& q) { return height_of(q); }, p);
}

Projection refined(const Projection& p, int factor) {
  return with_sides(p, columns(p) * factor, rows(p) * factor);
}

bool has_free_shape(const Projection& p) {
  return std::visit([]<class P>(const P&) { return kHasSides<P>; }, p);
}

Projection with_sides(Projection p, int columns, int rows) {
  return std::visit(
      [&]<class P>(P& q) -> Projection {
        if constexpr (!kHasSides<P>)
          return q.with_sides(columns, rows);
        else {
          q.columns = columns;
          q.rows =
              P::kTraits.is_dome ? std::min(rows, most_rows(columns, pixel_aspect_of(q))) : rows;
          return q;
        }
      },
      p);
}

Projection with_width(const Projection& p, int width) {
  const double height = static_cast<double>(width) * rows(p) / columns(p);
  return with_sides(p, width, std::max(1, static_cast<int>(std::lround(height))));
}

std::optional<double> field_of_view(const Projection& p) {
  return std::visit(
      [](const auto& q) -> std::optional<double> {
        if constexpr (requires { q.fov; }) return q.fov;
        return std::nullopt;
      },
      p);
}

Projection with_field_of_view(Projection p, double fov) {
  std::visit(
      [fov](auto& q) {
        if constexpr (requires { q.fov; }) q.fov = fov;
      },
      p);
  return p;
}

std::optional<double> cut_back(const Projection& p) {
  return std::visit(
      [](const auto& q) -> std::optional<double> {
        if constexpr (requires { q.cut_back; }) return q.cut_back;
        return std::nullopt;
      },
      p);
}

Projection with_cut_back(Projection p, double part) {
  std::visit(
      [part](auto& q) {
        if constexpr (requires { q.cut_back; }) q.cut_back = part;
      },
      p);
  return p;
}

double pixel_aspect(const Projection& p) {
  return std::visit([](const auto& q) { return pixel_aspect_of(q); }, p);
}

bool may_have_pixel_aspect(const Projection& p) {
  return std::visit([]<class P>(const P&) { return kHasPixelAspect<P>; }, p);
}

Projection with_pixel_aspect(Projection p, double aspect) {
  std::visit(
      [aspect](auto& q) {
        if constexpr (requires { q.pixel_aspect; }) q.pixel_aspect = aspect;
      },
      p);
  return p;
}

Projection with_square_pixels(const Projection& p) {
  const double aspect = pixel_aspect(p);
  if (aspect == 1) return p;
  const double high = std::max(1.0, std::round(rows(p) / aspect));
  return with_sides(with_pixel_aspect(p, 1), columns(p), static_cast<int>(high));
}

int most_rows(int columns, double pixel_aspect) {
  // Of a product that is whole, rounding may leave a little less.
  return std::max(1, static_cast<int>(columns * pixel_aspect + 1e-6));
}

ScreenSides screen_sides(const Projection& p) {
  const double aspect = pixel_aspect(p);
  return {std::min(aspect, 1.0), 1 / std::max(aspect, 1.0)};
}

double shorter_side(const Projection& p) {
  const ScreenSides side = screen_sides(p);
  return std::min(columns(p) * side.x, rows(p) * side.y);
}

bool keeps_circles(const Projection& p) {
  return traits_of(p).keeps_circles && pixel_aspect(p) == 1;
}

PixelParts parts_nearly_square(const Projection& p) {
  const double aspect = pixel_aspect(p);
  const auto parts = [](double ratio) {
    return std::max(1, static_cast<int>(std::ceil(ratio / std::numbers::sqrt2)));
  };
  return {parts(aspect), parts(1 / aspect)};
}

Projection divided(const Projection& p, const PixelParts& parts) {
  const Projection finer = with_pixel_aspect(p, pixel_aspect(p) * parts.down / parts.across);
  return with_sides(finer, columns(p) * parts.across, rows(p) * parts.down);
}

std::vector<double> further_parameters(const Projection& p) {
  std::vector<double> parameters;
  std::visit([&](const auto& q) { add_parameters(q, parameters); }, p);
  return parameters;
}

double farthest_angle(const Projection& p) {
  if (!has_zenith(p)) return std::acos(direction_at(p, {0.5, 0.5}).v.z);
  if (!traits_of(p).is_dome) return std::numbers::pi;
  return field_of_view(p).value_or(traits_of(p).shown_deg * (std::numbers::pi / 180)) / 2;
}

PixelPosition origin_of(const Projection& p) {
  return std::visit([](const auto& q) { return origin_of(q); }, p);
}

CameraDirection direction_at(const Projection& p, PixelPosition pixel) {
  return std::visit([&](const auto& q) { return q.direction(centred(q, pixel)); }, p);
}

std::optional<PixelPosition> pixel_of(const Projection& p, CameraDirection n) {
  return std::visit(
      [&](const auto& q) -> std::optional<PixelPosition> {
        const std::optional<Centred> at = q.place(n);
        return at ? std::optional(uncentred(q, *at)) : std::nullopt;
      },
      p);
}

bool is_inside(const Projection& p, PixelPosition pixel) {
  return std::visit([&](const auto& q) { return shows_at(q, centred(q, pixel)); }, p);
}

ColumnRange inside_columns(const Projection& p, int row) {
  return std::visit([row](const auto& q) { return inside_columns_of(q, row); }, p);
}

double pixel_solid_angle(const Projection& p, PixelPosition pixel) {
  return std::visit([&](const auto& q) { return solid_angle_of(q, centred(q, pixel)); }, p);
}

PixelMetric pixel_metric(const Projection& p, PixelPosition pixel) {
  return std::visit([&](const auto& q) { return metric_of(q, centred(q, pixel)); }, p);
}

double largest_pixel_angle(const Projection& p) {
  return std::visit([](const auto& q) { return largest_pixel_angle_of(q); }, p);
}

double pixel_angle(const Projection& p, PixelPosition pixel) {
  return std::visit([&](const auto& q) { return pixel_angle_of(q, centred(q, pixel)); }, p);
}

double scale_change_per_radian(const Projection& p, const CameraDirection& n) {
  return std::visit([&](const auto& q) { return scale_change_of(q, n); }, p);
}

bool has_slanted_areas(const Projection& p, int row) {
  return std::visit([row](const auto& q) { return slants_of(q, row); }, p);
}

// Far beyond the circle the projection is stretched so much that bounds in pixels would not tell.
std::optional<CapBox> cap_box(const Projection& p, const CameraDirection& n, double angle) {
  if (angle_to_middle(n) - angle > farthest_angle(p) + largest_pixel_angle(p)) return std::nullopt;
  return std::visit([&](const auto& q) { return cap_box_of(q, n, angle); }, p);
}

CapSpans spans_of(const Projection& p, const CapPlace& cap, int row, const ColumnRange& inside) {
  return std::visit([&](const auto& q) { return cap_spans_of(q, cap, row, inside); }, p);
}

std::vector<CubemapFace> cubemap_faces(const Projection& p) {
  const auto* cube = std::get_if<Cubemap>(&p);
  if (!cube) return {};
  std::vector<CubemapFace> faces;
  for (const Cubemap::Axes& f : Cubemap::axes()) {
    const auto k = static_cast<int>(faces.size());
    faces.push_back({k % Cubemap::kFacesInARow * cube->face,
                     k / Cubemap::kFacesInARow * cube->face,
                     cube->face_projection(),
                     {f.right, f.down, f.forward}});
  }
  return faces;
}

}  // namespace domefall
