#include "projections/pixel_directions.h"

#include "pipeline/base/simd/dispatch.h"

namespace domefall {
namespace {

// Positions are places of an image.
struct Positions {
  PixelPosition origin;
  const double *i, *j;
  int count;
};

template <class View>
[[gnu::always_inline]] inline void find_directions_loop(const View& view,
                                                        const Positions& positions,
                                                        CameraDirection* n, double* angle) {
  const View v = view;
  const Positions p = positions;
  for (int k = 0; k < p.count; ++k) {
    const double x = p.i[k] - p.origin.i, y = p.j[k] - p.origin.j;
    n[k] = v.direction(x, y);
    angle[k] = v.pixel_angle(x, y);
  }
}
template <class View>
constexpr Dispatched<find_directions_loop<View>> kFindDirections;

template <class View>
[[gnu::always_inline]] inline void find_areas_loop(const View& view, const Positions& positions,
                                                   const CameraDirection* n,
                                                   float* __restrict area) {
  const View v = view;
  const Positions p = positions;
  for (int k = 0; k < p.count; ++k)
    area[k] = static_cast<float>(v.area(n[k], p.i[k] - p.origin.i, p.j[k] - p.origin.j));
}
template <class View>
constexpr Dispatched<find_areas_loop<View>> kFindAreas;

}  // namespace

void find_directions(const Projection& projection, const double* i, const double* j, int count,
                     CameraDirection* n, double* angle) {
  std::visit(
      [&](const auto& p) {
        if constexpr (requires { p.view(); }) {
          const Positions at{origin_of(projection), i, j, count};
          kFindDirections<decltype(p.view())>(p.view(), at, n, angle);
        } else {
          for (int k = 0; k < count; ++k) {
            n[k] = direction_at(projection, {i[k], j[k]});
            angle[k] = pixel_angle(projection, {i[k], j[k]});
          }
        }
      },
      projection);
}

void find_areas(const Projection& projection, const CameraDirection* n, const double* i,
                const double* j, int count, float* area) {
  std::visit(
      [&](const auto& p) {
        if constexpr (requires { p.view(); }) {
          const Positions at{origin_of(projection), i, j, count};
          kFindAreas<decltype(p.view())>(p.view(), at, n, area);
        } else {
          // In squares of the largest pixel's angle, since a solid angle may be too small for a
          // float, and at least so much that their sum is not 0.
          const double unit = p.largest_pixel_angle() * p.largest_pixel_angle();
          for (int k = 0; k < count; ++k)
            area[k] = std::max(
                1e-9f, static_cast<float>(pixel_solid_angle(projection, {i[k], j[k]}) / unit));
        }
      },
      projection);
}

}  // namespace domefall
