#include "projections/pixel_directions.h"

#include "pipeline/base/simd/dispatch.h"

namespace domefall {
namespace {

// Positions are places of an image.
struct Positions {
  PixelPosition origin;
  double high;  // of a pixel, in widths
  const double *i, *j;
  int count;

  Centred at(int k) const { return {i[k] - origin.i, (j[k] - origin.j) * high}; }
};

template <class View>
[[gnu::always_inline]] inline void find_directions_loop(const View& view,
                                                        const Positions& positions,
                                                        CameraDirection* n, double* angle) {
  const View v = view;
  const Positions p = positions;
  for (int k = 0; k < p.count; ++k) {
    const Centred at = p.at(k);
    n[k] = v.direction(at.x, at.y);
    angle[k] = v.pixel_angle(at.x, at.y);
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
  for (int k = 0; k < p.count; ++k) {
    const Centred at = p.at(k);
    area[k] = static_cast<float>(v.area(n[k], at.x, at.y));
  }
}
template <class View>
constexpr Dispatched<find_areas_loop<View>> kFindAreas;

}  // namespace

void find_directions(const Projection& projection, const double* i, const double* j, int count,
                     CameraDirection* n, double* angle) {
  std::visit(
      [&](const auto& p) {
        if constexpr (requires { p.view(); }) {
          const double aspect = pixel_aspect(projection);
          const Positions at{origin_of(projection), 1 / aspect, i, j, count};
          kFindDirections<decltype(p.view())>(p.view(), at, n, angle);
          // A view knows the angle of a square pixel alone.
          for (int k = 0; aspect != 1 && k < count; ++k)
            angle[k] = domefall::pixel_angle(projection, {i[k], j[k]});
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
          const Positions at{origin_of(projection), 1 / pixel_aspect(projection), i, j, count};
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
