#include "pipeline/render/rays/pixel_directions.h"

#include "pipeline/simd/dispatch.h"
#include "projections/inside_direction.h"

namespace domefall {
namespace {

// The middle of the image, in pixels.
struct Middle {
  double i, j;
};

template <class View>
[[gnu::always_inline]] inline void find(const View& view, Middle middle, const double* i,
                                        const double* j, int count, CameraDirection* n,
                                        double* angle) {
  const View v = view;
  for (int k = 0; k < count; ++k) {
    const double x = i[k] - middle.i, y = j[k] - middle.j;
    n[k] = v.direction(x, y);
    angle[k] = v.pixel_angle(x, y);
  }
}

[[gnu::always_inline]] inline void find_on_dome_loop(const DomemasterView& view, Middle middle,
                                                     const double* i, const double* j, int count,
                                                     CameraDirection* n, double* angle) {
  find(view, middle, i, j, count, n, angle);
}
Dispatched<find_on_dome_loop> find_on_dome;

[[gnu::always_inline]] inline void find_on_flat_loop(const StereographicView& view, Middle middle,
                                                     const double* i, const double* j, int count,
                                                     CameraDirection* n, double* angle) {
  find(view, middle, i, j, count, n, angle);
}
Dispatched<find_on_flat_loop> find_on_flat;

}  // namespace

void find_directions(const Projection& projection, const double* i, const double* j, int count,
                     CameraDirection* n, double* angle) {
  const Middle middle{(columns(projection) + 1) / 2.0, (rows(projection) + 1) / 2.0};
  if (const auto* dome = std::get_if<Domemaster>(&projection))
    find_on_dome(DomemasterView(*dome), middle, i, j, count, n, angle);
  else
    find_on_flat(StereographicView(std::get<Stereographic>(projection)), middle, i, j, count, n,
                 angle);
}

}  // namespace domefall
