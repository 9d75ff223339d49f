#include "pipeline/render/disc/disc_crossings.h"

#include <cmath>

#include "pipeline/simd/dispatch.h"
#include "pipeline/simd/vector_math.h"

namespace domefall {
namespace {

// A DiscSight holds what the loop over pixels needs of the observer and the disc.  `straight` is
// the energy E of straight light, and 0 where light is bent.
struct DiscSight {
  double r, s, one_minus_s, label_sign, energy_sign, straight;
  double normal_up, normal_across, cos_azimuth, sin_azimuth;
};

[[gnu::always_inline]] inline void locate_on_disc_loop(const DiscSight& sight, const double* angle,
                                                       int count, DiscPass::Crossings& crossings) {
  const DiscSight o = sight;
  for (int k = 0; k < count; ++k) {
    const double x = crossings.rays.x[k], y = crossings.rays.y[k], z = crossings.rays.z[k];
    const double across2 = y * y + z * z, across = std::sqrt(across2);
    const double sine = across > 1e-12 ? across : 1e-12;
    // The angle alpha counts from the hole in the rain frame and from the opposite direction in the
    // outgoing one.  So cos alpha is -x or x, and p has the opposite sign in the outgoing frame.
    // With half2 = sin^2(alpha/2), the energy 1 - s cos alpha becomes
    // (1 - s)(1 - half2) + (1 + s) half2, which does not cancel next to the horizon.
    const double cosine = -o.label_sign * x;
    const double half2 = cosine > 0 ? across2 / (2 * (1 + cosine)) : (1 - cosine) / 2;
    const double energy = o.one_minus_s * (1 - half2) + (1 + o.s) * half2;
    const double free = o.energy_sign * energy;
    const double kept = free > 0 ? free : 0;
    const double e = o.straight > 0 ? o.straight : kept;
    const double pixel = angle[k] * crossings.rays.scale[k];
    const double labelled = (cosine - o.s) / (o.r * sine);
    // These are the cosine and the sine of the azimuth about R from the normal's part across R to
    // the tangent in which the ray sweeps psi.
    const double along = (y * o.cos_azimuth + z * o.sin_azimuth) / sine,
                 beside = (z * o.cos_azimuth - y * o.sin_azimuth) / sine;
    const double side = o.normal_up > 0 ? -1 : 1;
    const double up = o.normal_up > 0 ? o.normal_up : -o.normal_up;
    const double toward = side * o.normal_across * along, aside = o.normal_across * beside;
    crossings.energy[k] = e;
    crossings.label[k] = o.label_sign * labelled;
    // The derivative of p = (cos alpha - s)/(r sin alpha) is dp/dalpha = -E/(r sin^2 alpha).  For
    // straight light s = 0, and 1 stands for E.
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

}  // namespace

void DiscPass::locate(const CameraDirection* n, const double* angle, int count,
                      Crossings& crossings) const {
  static const Dispatched<locate_on_disc_loop> loop;
  scene_.tracer.into_frame(n, count, crossings.rays);
  const bool straight = scene_.tracer.goes_straight();
  const DiscSight sight{r_,          straight ? 0 : s_, straight ? 1 : one_minus_s_,
                        label_sign_, energy_sign_,      straight ? std::sqrt((r_ - 2) / r_) : 0.0,
                        normal_up_,  normal_across_,    normal_cosine_,
                        normal_sine_};
  loop(sight, angle, count, crossings);
}

}  // namespace domefall
