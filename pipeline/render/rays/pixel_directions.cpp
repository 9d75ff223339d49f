#include "pipeline/render/rays/pixel_directions.h"

#include "pipeline/simd/dispatch.h"
#include "projections/inside_direction.h"

namespace domefall {
namespace {

struct Middle {
  double i, j;
};

template <class View>
[[gnu::always_inline]] inline void view(const View& of, Middle middle, const double* i,
                                        const double* j, int count, CameraDirection* n,
                                        double* angle) {
  const View v = of;
  for (int k = 0; k < count; ++k) {
    const double x = i[k] - middle.i, y = j[k] - middle.j;
    n[k] = v.direction(x, y);
    angle[k] = v.pixel_angle(x, y);
  }
}

[[gnu::always_inline]] inline void view_dome_loop(const DomemasterView& of, Middle middle,
                                                  const double* i, const double* j, int count,
                                                  CameraDirection* n, double* angle) {
  view(of, middle, i, j, count, n, angle);
}
Dispatched<view_dome_loop> view_dome;

[[gnu::always_inline]] inline void view_flat_loop(const StereographicView& of, Middle middle,
                                                  const double* i, const double* j, int count,
                                                  CameraDirection* n, double* angle) {
  view(of, middle, i, j, count, n, angle);
}
Dispatched<view_flat_loop> view_flat;

}  // namespace

void view_directions(const Projection& projection, const double* i, const double* j, int count,
                     CameraDirection* n, double* angle) {
  const Middle middle{(columns(projection) + 1) / 2.0, (rows(projection) + 1) / 2.0};
  if (const auto* dome = std::get_if<Domemaster>(&projection))
    view_dome(DomemasterView(*dome), middle, i, j, count, n, angle);
  else
    view_flat(StereographicView(std::get<Stereographic>(projection)), middle, i, j, count, n,
              angle);
}

}  // namespace domefall
