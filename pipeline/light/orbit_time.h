// This file says how long light takes along an orbit, by the null coordinate that stays regular
// where it moves.  With E > 0 this is u = t - r* of light that moves out and v = t + r* of light
// that falls.  Both grow by
//
//     N = int dpsi/(e + |dw/dpsi|),   e = E/L,
//
// for which emission_time.h gives the reason.  From the singularity N is a sum of logarithms of
// Weierstrass's sigma functions and doubles with the angle as w does.  With w and y = |dw/dpsi| of
// the point before the doubling:
//
//     N <- 2 N + 4 ln f + 2 c/(w a),   a = w y + (3w - 1) e,   c = (1 - w) y + (3w - 1) e,
//     f = a (w - 1/2)/(w ((w - 1) y + (3w - 1) e)) = a c/(2 w^2 (4 e^2 - w (1 - w)^2))
//
// From a sky N is that of the point as far from the singularity, plus r/w there.  Nothing here
// branches, so that loops become SIMD code.
#pragma once

#include <cmath>

#include "pipeline/base/simd/vector_math.h"
#include "pipeline/light/ray_point.h"

namespace domefall {

// A TimedPoint is a point on its way from the singularity, by x, with its N.
struct TimedPoint {
  double x, time;
};

[[gnu::always_inline]] inline TimedPoint timed_at_twice(const TimedPoint& at, double inverse_b,
                                                        double eps) {
  // An infinite N, of light without energy next to the horizon, stops growing here.
  constexpr double kLargest = 1e40;
  const double e = inverse_b, x = at.x, w = x + 1.0 / 3, x2 = x * x;
  const double p = x2 * (2 * x + 1) + eps, y = std::sqrt(p);
  const double turn = 3 * x * e, a = w * y + turn, c = (1 - w) * y + turn;
  const double above = w * ((w - 1) * y + turn),
               below = 2 * w * w * (4 * e * e - w * (1 - w) * (1 - w));
  const double over = w >= 1 ? above : below, f = a * (w >= 1 ? w - 0.5 : c) / over;
  const double bounded = over > 0 ? f : kLargest;
  const double step = 4 * logarithm(bounded < kLargest ? bounded : kLargest) + 2 * c / (w * a);
  return {(x2 * x2 - (4 * x + 1) * eps) / (2 * p), 2 * at.time + step};
}

// Returns N from the singularity over the angle sigma.  The domain is that of
// point_from_singularity.  Beyond 40 radians the orbit is on the light circle.  Measured against
// quadrature for 0.01 <= e <= 1e4, the error is below 2e-13 (M).
[[gnu::always_inline]] inline double time_from_singularity(double inverse_b, double eps,
                                                           double sigma) {
  const DoublingStart start = doubling_start(inverse_b, eps, sigma);
  // 1/(e + y) with y = 4/z^3 - z/60 - ... is integrated term by term.
  const double z = start.z, z4 = z * z * z * z, q = inverse_b * z * z * z;
  const double first = z4 / 16 * (1 + z4 / 480 - q * (1.0 / 7 - q * (1.0 / 56 - q / 208)));
  TimedPoint at{start.x, first};
  at = timed_at_twice(timed_at_twice(at, inverse_b, eps), inverse_b, eps);
  at = timed_at_twice(timed_at_twice(at, inverse_b, eps), inverse_b, eps);
  at = timed_at_twice(timed_at_twice(at, inverse_b, eps), inverse_b, eps);
  at = timed_at_twice(at, inverse_b, eps);
  const double circling = sigma > 40 ? (sigma - 40) / inverse_b : 0;
  return start.is_short > 0 ? first : at.time + circling;
}

}  // namespace domefall
