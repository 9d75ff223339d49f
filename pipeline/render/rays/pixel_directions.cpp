#include "pipeline/render/rays/pixel_directions.h"

#include <numbers>

#include "pipeline/simd/dispatch.h"
#include "pipeline/simd/vector_math.h"
#include "projections/inside_direction.h"

namespace domefall {
namespace {

// The views take x and y in pixels from the middle, as those of inside_direction.h do.

struct RectilinearView {
  double scale;  // tan(theta) per pixel

  CameraDirection direction(double x, double y) const {
    const double u = x * scale, v = y * scale, cosine = 1 / std::sqrt(1 + u * u + v * v);
    return {{u * cosine, v * cosine, cosine}};
  }
  // A pixel covers scale cos(theta) across the direction to the middle, which is more than the
  // scale cos^2(theta) along it.
  double pixel_angle(double x, double y) const {
    return scale / std::sqrt(1 + (x * x + y * y) * scale * scale);
  }
};

struct FisheyeView {
  double scale;  // radians per pixel

  CameraDirection direction(double x, double y) const {
    const double r = std::sqrt(x * x + y * y);
    const SineCosine theta = sin_cos(r * scale);
    const double k = r > 1e-6 ? theta.sine / r : scale;  // the limit of sin(theta)/r
    return {{x * k, y * k, theta.cosine}};
  }
  double pixel_angle(double, double) const { return scale; }
};

struct EquirectangularView {
  double scale;  // radians per pixel

  CameraDirection direction(double x, double y) const {
    // Rows are counted downwards, and latitudes upwards.
    const SineCosine longitude = sin_cos(x * scale), latitude = sin_cos(-y * scale);
    return {{longitude.sine * latitude.cosine, longitude.cosine * latitude.cosine, latitude.sine}};
  }
  double pixel_angle(double, double) const { return scale; }
};

// Positions says for which places of an image directions are wanted, and where to write them.
struct Positions {
  PixelPosition middle;
  const double *i, *j;
  int count;
  CameraDirection* n;
  double* angle;
};

template <class View>
[[gnu::always_inline]] inline void find_directions_loop(const View& view,
                                                        const Positions& positions) {
  const View v = view;
  const Positions p = positions;
  for (int k = 0; k < p.count; ++k) {
    const double x = p.i[k] - p.middle.i, y = p.j[k] - p.middle.j;
    p.n[k] = v.direction(x, y);
    p.angle[k] = v.pixel_angle(x, y);
  }
}
Dispatched<find_directions_loop<DomemasterView>> find_on_dome;
Dispatched<find_directions_loop<StereographicView>> find_on_flat;
Dispatched<find_directions_loop<RectilinearView>> find_on_rectilinear;
Dispatched<find_directions_loop<FisheyeView>> find_on_fisheye;
Dispatched<find_directions_loop<EquirectangularView>> find_on_sphere;

// A Finder finds directions in the image of whatever projection.
struct Finder {
  Positions at;

  void operator()(const Domemaster& d) const { find_on_dome(DomemasterView(d), at); }
  void operator()(const Stereographic& s) const { find_on_flat(StereographicView(s), at); }
  void operator()(const Rectilinear& r) const {
    find_on_rectilinear(RectilinearView{central_pixel_angle(r)}, at);
  }
  void operator()(const Fisheye& f) const {
    find_on_fisheye(FisheyeView{central_pixel_angle(f)}, at);
  }
  void operator()(const Equirectangular& e) const {
    find_on_sphere(EquirectangularView{central_pixel_angle(e)}, at);
  }
  // The renderer draws a cube face by face, so this function need not be fast.
  void operator()(const Cubemap& c) const {
    for (int k = 0; k < at.count; ++k) {
      at.n[k] = direction_at(c, {at.i[k], at.j[k]});
      at.angle[k] = pixel_angle(c, {at.i[k], at.j[k]});
    }
  }
};

}  // namespace

void find_directions(const Projection& projection, const double* i, const double* j, int count,
                     CameraDirection* n, double* angle) {
  PixelPosition middle{(columns(projection) + 1) / 2.0, (rows(projection) + 1) / 2.0};
  // The circle of a truncated dome need not have its middle in that of the image.
  if (std::holds_alternative<Fisheye>(projection)) middle = *pixel_of(projection, {{0, 0, 1}});
  std::visit(Finder{{middle, i, j, count, n, angle}}, projection);
}

}  // namespace domefall
