#include "pipeline/light/plane_rays.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "pipeline/base/simd/dispatch.h"
#include "pipeline/base/simd/vector_math.h"
#include "pipeline/spacetime/schwarzschild.h"

namespace domefall {
namespace {

using std::numbers::pi;

// A PlaneSight holds what the loop over rays needs of the observer and the plane.  `straight` is the
// energy E of straight light, and 0 where light is bent.
struct PlaneSight {
  double r;
  ViewEnergy law;
  StaticTime still;
  double label_sign, energy_sign, straight;
  double normal_up, normal_across, cos_azimuth, sin_azimuth;
};

[[gnu::always_inline]] inline void locate_on_plane_loop(const PlaneSight& sight,
                                                        const DirectionBatch& n,
                                                        const double* width, int count,
                                                        PlaneCrossings& crossings) {
  const PlaneSight o = sight;
  for (int k = 0; k < count; ++k) {
    const double x = n.x[k], y = n.y[k], z = n.z[k];
    const double across2 = y * y + z * z, across = std::sqrt(across2);
    const double sine = across > 1e-12 ? across : 1e-12;
    // The angle alpha counts from the hole in the rain frame and from the opposite direction in the
    // outgoing one.  So cos alpha is -x or x, and p has the opposite sign in the outgoing frame.
    // With half2 = sin^2(alpha/2), the law of the energy, which is along_t - along_r cos alpha,
    // does not cancel next to the horizon.
    const double cosine = -o.label_sign * x;
    const double half2 = cosine > 0 ? across2 / (2 * (1 + cosine)) : (1 - cosine) / 2;
    const double energy = o.law.cosine2 * (1 - half2) + o.law.sine2 * half2;
    const double free = o.energy_sign * energy;
    const double kept = free > 0 ? free : 0;
    const double e = o.straight > 0 ? o.straight : kept;
    const double pixel = width[k];
    const double labelled = (o.still.along_t * cosine - o.still.along_r) / (o.r * sine);
    // These are the cosine and the sine of the azimuth about R from the normal's part across R to
    // the tangent in which the ray sweeps psi.
    const double along = (y * o.cos_azimuth + z * o.sin_azimuth) / sine,
                 beside = (z * o.cos_azimuth - y * o.sin_azimuth) / sine;
    const double side = o.normal_up > 0 ? -1 : 1;
    const double up = o.normal_up > 0 ? o.normal_up : -o.normal_up;
    const double toward = side * o.normal_across * along, aside = o.normal_across * beside;
    crossings.energy[k] = e;
    crossings.label[k] = o.label_sign * labelled;
    // The derivative of p = (along_t cos alpha - along_r)/(r sin alpha) is dp/dalpha =
    // -E/(r sin^2 alpha).  For straight light along_r = 0, and 1 stands for E.
    const double rate = o.straight > 0 ? 1 : energy > 0 ? energy : -energy;
    crossings.label_per[k] = rate / (o.r * sine * sine) * pixel;
    // After psi the ray is at cos(psi) r^ + sin(psi) e^, which lies in the plane of the normal n
    // where tan psi = -(n.r^)/(n.e^).
    const double turn = arc_tangent2(up, toward);
    crossings.turn[k] = turn > 0 ? turn : 3.14159265358979323846;
    crossings.azimuth_cosine[k] = side * along;
    crossings.azimuth_sine[k] = side * beside;
    crossings.azimuth_per[k] = pixel / sine;
    // By tan psi_0 = up/toward, psi_0 changes by up/(up^2 + toward^2) for each unit of `toward`.
    // The smallest `toward` within the pixel makes this an upper bound.
    const double wide = pixel / sine, steep = (aside > 0 ? aside : -aside) * wide;
    const double far = (toward > 0 ? toward : -toward) - steep / 2, off = far > 0 ? far : 0;
    const double square = up * up + off * off;
    crossings.turn_per[k] = up * steep / (square > 1e-30 ? square : 1e-30);
  }
}
Dispatched<locate_on_plane_loop> locate_on_plane;

}  // namespace

PlaneRays::PlaneRays(const PlaneView& view, double null_time, const PlaneRings& rings)
    : images_(view, rings.inner, rings.outer, rings.with_times),
      straight_(view.straight),
      r_(view.at.r),
      energy_(view.energy()),
      still_(straight_ ? StaticTime{} : view.space.static_time(r_)),
      lapse_squared_(view.lapse_squared()),
      // Straight light is labelled in the frame of the observer at rest, where alpha counts from the
      // hole and p = cos alpha/(r sin alpha).
      label_sign_(is_outgoing(view.tetrad) && !straight_ ? -1 : 1),
      energy_sign_(is_mirrored(view.tetrad) ? -1 : 1),
      clock_(view, null_time),
      normal_up_(std::abs(rings.normal.x) < kInPlane ? 0 : rings.normal.x),
      normal_across_(std::sqrt(rings.normal.y * rings.normal.y + rings.normal.z * rings.normal.z)),
      normal_cosine_(normal_across_ > 0 ? rings.normal.y / normal_across_ : 1),
      normal_sine_(normal_across_ > 0 ? rings.normal.z / normal_across_ : 0),
      side_(normal_up_ > 0 ? -1 : 1) {}

void PlaneRays::locate(const DirectionBatch& n, const double* width, int count,
                       PlaneCrossings& crossings) const {
  const PlaneSight sight{r_,          energy_,        still_,
                         label_sign_, energy_sign_,   straight_ ? std::sqrt(lapse_squared_) : 0.0,
                         normal_up_,  normal_across_, normal_cosine_,
                         normal_sine_};
  locate_on_plane(sight, n, width, count, crossings);
}

// psi_0 = atan2(up, across cos(azimuth)) grows as |azimuth| grows from 0 to pi.
double PlaneRays::turn_at(double azimuth) const {
  const double turn = arc_tangent2(up(), normal_across_ * sin_cos(azimuth).cosine);
  return turn > 0 ? turn : pi;
}

// By turn_at, cos(azimuth) = up cos psi_0/(across sin psi_0).
double PlaneRays::azimuth_at(double turn) const {
  const SineCosine t = sin_cos(turn);
  const double x = up() * t.cosine, length = normal_across_ * t.sine;
  return arc_tangent2(std::sqrt(std::max(0.0, (length - x) * (length + x))), x);
}

// The orbit equation w'^2 = 1/b^2 - f w^2, taken at the observer, where w' = p, gives 1/b^2 = p^2 +
// f w_0^2.  For straight light f is 1.
double PlaneRays::momentum(double label, double energy) const {
  const double w0 = 1 / r_;
  const double inverse_b2 = label * label + w0 * w0 * (straight_ ? 1 : lapse_squared_);
  return energy / std::sqrt(std::max(inverse_b2, 1e-300));
}

// The tangent e^ lies at this azimuth about R from the normal's part across R, as in
// locate_on_plane_loop.  The place is cos(turn) r^ + sin(turn) e^.
V3d PlaneRays::place(double turn, double azimuth_cosine, double azimuth_sine) const {
  const SineCosine turned = sin_cos(turn);
  const double along = side_ * azimuth_cosine, beside = side_ * azimuth_sine;
  return {turned.cosine, turned.sine * (along * normal_cosine_ - beside * normal_sine_),
          turned.sine * (along * normal_sine_ + beside * normal_cosine_)};
}

}  // namespace domefall
