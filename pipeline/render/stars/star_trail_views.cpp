// This part of the class StarTrail makes the views of many pieces at once.
#include <array>
#include <cmath>

#include "pipeline/base/simd/dispatch.h"
#include "pipeline/base/simd/vector_math.h"
#include "pipeline/render/stars/star_trail.h"

namespace domefall {
namespace {

// TrailCubics hold a cubic in x for each number of a node, in Newton's form:
//     a[0] + (x - at[0]) (a[1] + (x - at[1]) (a[2] + (x - at[2]) a[3])).
struct TrailCubics {
  std::array<double, 3> at;
  std::array<double, 4> forward, across, frequency_ratio, strength;
};

inline double trail_cubic(const std::array<double, 4>& a, double d0, double d1, double d2) {
  return a[0] + d0 * (a[1] + d1 * (a[2] + d2 * a[3]));
}

// TrailSteps say which pieces of a part are wanted.  The middle of piece n is x + (n + 1/2) step.
struct TrailSteps {
  double x, step;
  int first, count;
};

// A TrailObserver holds the boost and the camera of the observer who sees the pieces.
struct TrailObserver {
  Aberration boost;
  M33d camera;
};

struct SinhCosh {
  double sine, cosine;
};

inline SinhCosh sinh_and_cosh(double x) {
  const double e = exponential(x), inverse = 1 / e;
  return {0.5 * (e - inverse), 0.5 * (e + inverse)};
}

// Returns (1 - |u|)^sharpness as an exponential, and 0 outside the window.  The logarithm needs a
// positive number there too.
inline double weight_at(const AxisPassage::Way& way, double sinh) {
  const double rest = 1 - std::abs(way.u_least + way.u_per_sinh * sinh);
  const double within = rest > 1e-300 ? rest : 1e-300;
  const double weight = exponential(way.sharpness * logarithm(within));
  return rest > 0 ? weight : 0;
}

// The integral of the weight follows the rule of AxisPassage::mean_inverse_distance().
[[gnu::always_inline]] inline void store_loop(const TrailCubics& cubics,
                                              const AxisPassage::Way& passage,
                                              const TrailSteps& steps,
                                              const TrailObserver& observer, StarViews& views,
                                              int at) {
  constexpr double kOuterNode = 0.7745966692414834;
  const TrailCubics c = cubics;
  const AxisPassage::Way way = passage;
  const Aberration boost = observer.boost;
  const M33d camera = observer.camera;
  const double step = steps.step, first_x = steps.x + 0.5 * step, outer = kOuterNode * 0.5 * step,
               scale = way.factor * step;
  const SinhCosh apart = sinh_and_cosh(outer);
  double *x = views.x.data() + at, *y = views.y.data() + at, *z = views.z.data() + at,
         *flux = views.flux.data() + at, *temperature = views.temperature.data() + at;
  const int first = steps.first, count = steps.count;
  for (int k = 0; k < count; ++k) {
    const double middle = first_x + step * (first + k);
    const double d0 = middle - c.at[0], d1 = middle - c.at[1], d2 = middle - c.at[2];
    const SinhCosh h = sinh_and_cosh(middle);
    // By the addition theorem, sinh(middle -+ outer) is the difference and the sum of these two.
    // The difference loses an ulp of the larger term, which is nothing beside the 1 in the weight
    // 1 - |u|.
    const double near = h.sine * apart.cosine, far = h.cosine * apart.sine;
    const double mean =
        scale * (5.0 / 18 * (weight_at(way, near - far) + weight_at(way, near + far)) +
                 8.0 / 18 * weight_at(way, h.sine));
    // The unit vector across(x) is (outward + along sinh(x))/cosh(x).
    const double across = trail_cubic(c.across, d0, d1, d2) / h.cosine;
    const V3d direction(trail_cubic(c.forward, d0, d1, d2),
                        across * (way.outward.y + way.along.y * h.sine),
                        across * (way.outward.z + way.along.z * h.sine));
    const ReceivedLight light =
        received(boost, camera, renormalized(direction), trail_cubic(c.frequency_ratio, d0, d1, d2),
                 trail_cubic(c.strength, d0, d1, d2) * mean);
    x[k] = light.direction.x;
    y[k] = light.direction.y;
    z[k] = light.direction.z;
    flux[k] = light.flux;
    temperature[k] = light.frequency_ratio;
  }
}
Dispatched<store_loop> store_pieces;

}  // namespace

void StarTrail::store(std::size_t k, int pieces, int first, int count, const Aberration& boost,
                      const M33d& camera, StarViews& views, int at) const {
  const std::size_t nodes = count_around();
  const Node* node = &nodes_[first_around(k)];
  TrailCubics cubics{};
  for (std::size_t n = 0; n < nodes; ++n) {
    if (n < 3) cubics.at[n] = node[n].x;
    cubics.forward[n] = node[n].direction.x;
    cubics.across[n] = node[n].across;
    cubics.frequency_ratio[n] = node[n].frequency_ratio;
    cubics.strength[n] = node[n].strength;
  }
  // The numbers of the nodes become Newton's divided differences in place.
  for (auto* a : {&cubics.forward, &cubics.across, &cubics.frequency_ratio, &cubics.strength})
    for (std::size_t order = 1; order < nodes; ++order)
      for (std::size_t n = nodes - 1; n >= order; --n)
        (*a)[n] = ((*a)[n] - (*a)[n - 1]) / (node[n].x - node[n - order].x);
  const double step = (nodes_[k + 1].x - nodes_[k].x) / pieces;
  store_pieces(cubics, passage_.way(), {nodes_[k].x, step, first, count}, {boost, camera}, views,
               at);
}

}  // namespace domefall
