#include "pipeline/render/stars/star_loops.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "pipeline/base/simd/dispatch.h"
#include "pipeline/base/simd/vector_math.h"
#include "projections/angle_over_sine.h"

namespace domefall {
namespace {

using std::numbers::pi;

// An Input points to columns of SceneStars.
struct Input {
  const float *x, *y, *z, *magnitude, *flux, *temperature;
};

// The loops copy what is passed by reference.  The compiler then knows that no store of the loop
// alters the values.
[[gnu::always_inline]] inline void stars_into_tetrad_loop(const StarFrame& frame,
                                                          const Input& input, int count,
                                                          StarSources& s) {
  const M33d matrix = frame.axes;
  const double gain = frame.gain, limit = frame.limit, inverse_fade = frame.inverse_fade;
  const Input in = input;
  for (int k = 0; k < count; ++k) {
    const V3d v = renormalized(
        apply_transposed(matrix, V3d(double{in.x[k]}, double{in.y[k]}, double{in.z[k]})));
    const double part = (limit - in.magnitude[k]) * inverse_fade;
    const double whole = part < 1 ? part : 1;
    s.x[k] = v.x;
    s.y[k] = v.y;
    s.z[k] = v.z;
    s.flux[k] = in.flux[k] * (gain * (whole > 0 ? whole : 0));
    s.temperature[k] = in.temperature[k];
  }
}
Dispatched<stars_into_tetrad_loop> stars_into_tetrad;

// Stores the k-th view.  Its light comes from `direction` in the frame of the tetrad with this
// frequency ratio and amplification.
inline void store_view(const Aberration& boost, const M33d& camera, const V3d& direction,
                       double frequency_ratio, double amplification, const StarSources& sources,
                       int k, StarViews& views) {
  const ReceivedLight light =
      received(boost, camera, direction, frequency_ratio, sources.flux[k] * amplification);
  views.flux[k] = light.flux;
  views.temperature[k] = sources.temperature[k] * light.frequency_ratio;
  views.x[k] = light.direction.x;
  views.y[k] = light.direction.y;
  views.z[k] = light.direction.z;
}

[[gnu::always_inline]] inline void receive_all_loop(const StarFrame& frame,
                                                    const PointImageBatch& images,
                                                    const StarSources& sources, int count,
                                                    StarViews& views) {
  const Aberration boost = frame.from_tetrad;
  const M33d camera = frame.tetrad_from_camera;
  for (int k = 0; k < count; ++k)
    store_view(boost, camera, V3d(images.x[k], images.y[k], images.z[k]), images.frequency_ratio[k],
               images.amplification[k], sources, k, views);
}
Dispatched<receive_all_loop> receive_all;

[[gnu::always_inline]] inline void onto_dome_loop(double scale, double middle, int count,
                                                  StarViews& views) {
  for (int k = 0; k < count; ++k) {
    const double m = scale * angle_over_sine(views.z[k]);
    views.i[k] = middle + m * views.x[k];
    views.j[k] = middle + m * views.y[k];
  }
}
Dispatched<onto_dome_loop> onto_dome;

[[gnu::always_inline]] inline void onto_plane_loop(double scale, double middle_i, double middle_j,
                                                   int count, StarViews& views) {
  for (int k = 0; k < count; ++k) {
    const double x = views.x[k], y = views.y[k], z = views.z[k];
    // The place is at tan(theta/2) = sin(theta)/(1 + cos(theta)) times the scale.  Where the sum
    // 1 + cos(theta) would cancel, it is sin^2(theta)/(1 - cos(theta)).
    const double behind = (x * x + y * y) / (1 + std::abs(z));
    const double m = scale / (z < 0 ? behind : 1 + z);
    views.i[k] = middle_i + m * x;
    views.j[k] = middle_j + m * y;
  }
}
Dispatched<onto_plane_loop> onto_plane;

// Sets `seen` to 1 for views that are far enough in front and within half_i and half_j of the
// middle.
[[gnu::always_inline]] inline void flag_loop(const StarViews& views, double least_z,
                                             double middle_i, double middle_j, double half_i,
                                             double half_j, int count, int* __restrict seen) {
  for (int k = 0; k < count; ++k) {
    const bool across = std::abs(views.i[k] - middle_i) <= half_i;
    const bool down = std::abs(views.j[k] - middle_j) <= half_j;
    const bool ahead = views.z[k] >= least_z;
    seen[k] = int{ahead} & int{across} & int{down};
  }
}
Dispatched<flag_loop> flag;

// Projects views one by one.  A view without a place in the image is put infinitely far away, so
// that it is not listed.
void onto_any(const Projection& projection, double least_z, int count, StarViews& views) {
  for (int k = 0; k < count; ++k) {
    const CameraDirection n{{views.x[k], views.y[k], views.z[k]}};
    const auto pixel = n.v.z >= least_z ? pixel_of(projection, n) : std::nullopt;
    views.i[k] = pixel ? pixel->i - 1 : -HUGE_VAL;
    views.j[k] = pixel ? pixel->j - 1 : -HUGE_VAL;
    if (!pixel) views.z[k] = -2;  // behind everything
  }
}

double pixels_per_radian(const Projection& p) { return 1 / largest_pixel_angle(p); }

}  // namespace

void find_sources(const StarFrame& frame, const SceneStars& stars, std::size_t first, int count,
                  StarSources& sources) {
  stars_into_tetrad(frame,
                    {stars.x() + first, stars.y() + first, stars.z() + first,
                     stars.magnitude() + first, stars.flux() + first, stars.temperature() + first},
                    count, sources);
}

void receive_images(const StarFrame& frame, const PointImageBatch& images,
                    const StarSources& sources, int count, StarViews& views) {
  receive_all(frame, images, sources, count, views);
}

StarPlane::StarPlane(const Projection& projection, double reach)
    : projection_(projection),
      scale_(pixels_per_radian(projection)),
      middle_i_((columns(projection) - 1) / 2.0),
      middle_j_((rows(projection) - 1) / 2.0) {
  half_i_ = half_j_ = HUGE_VAL;
  if (is_domemaster(projection)) {
    // The middle of a blob that reaches over the rim is no farther beyond it than `reach`.
    least_z_ = -std::sin(std::min(reach, pi / 2));
    fast_dome_ = least_z_ >= kLeastCosine;
  } else if (keeps_circles(projection)) {
    // The middle of a blob that touches the frame is no farther from it than `reach`.  The margin
    // is that angle in pixels, at the scale that the projection has as far beyond a corner.  The
    // scale is the derivative of 2 tan(theta/2), which grows like 1/cos^2(theta/2).
    scale_ *= 2;
    const double corner = 2 * std::atan(std::hypot(middle_i_ + 1, middle_j_ + 1) / scale_);
    const double farthest = std::min(corner + reach, 0.999 * pi), c = std::cos(farthest / 2);
    const double margin = reach * pixels_per_radian(projection) / (c * c) + 1;
    half_i_ = middle_i_ + margin;
    half_j_ = middle_j_ + margin;
  } else {
    least_z_ = std::cos(std::min(farthest_angle(projection) + reach, pi));
  }
}

int StarPlane::place(StarViews& views, int count, int* listed) const {
  if (fast_dome_)
    onto_dome(scale_, middle_i_, count, views);
  else if (keeps_circles(projection_))
    onto_plane(scale_, middle_i_, middle_j_, count, views);
  else
    onto_any(projection_, least_z_, count, views);
  StarColumn<int> seen;
  flag(views, least_z_, middle_i_, middle_j_, half_i_, half_j_, count, seen.data());
  int number = 0;
  for (int k = 0; k < count; ++k) {
    listed[number] = k;
    number += seen[static_cast<std::size_t>(k)];
  }
  return number;
}

}  // namespace domefall
