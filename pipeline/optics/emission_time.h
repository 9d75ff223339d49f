// When light from the past singularity (region IV) started: the Schwarzschild t at which it left
// r = 0, where t is a place along the singularity.  [Riazuelo] sec. sec_Kruskal on region IV:
// "a series of rings of variable t".
//
// t itself is infinite on the horizons, so times count from the observer's own null coordinate: v =
// t + r* of an observer in free fall (rain), u = t - r* in the outgoing frame, r* = r + 2 ln|r/2 -
// 1|; each is regular where its frame is.  At r = 0 both are t.
//
// With E > 0, b = L/E, w = 1/r and k = |k^r|/E = b sqrt(P) (exact_azimuth.h), light that moves out
// gains  du = b^2 |dw|/(k (1 + k)), light that falls gains the same dv, and
//     b^2/(k (1 + k)) = b (b/k - b/(1 + k)),
// so that a path's time is b (phi - K), phi the swept azimuth, in closed form, and K = int b dw/(1
// + k), whose integrand is bounded: next to an edge all of the divergence is phi's.  E < 0: t -> -t
// is a symmetry, so t_emission - t_observer is odd in E.
#pragma once

#include "pipeline/optics/null_ray.h"

namespace domefall {

// r* = r + 2 ln|r/2 - 1|, units of M; -infinity at r = 2.
double tortoise(const Radius& at);

// t at emission minus the observer's v (rain) or u (outgoing frame), units of M, of a ray from the
// past singularity.  Finite but for a ray that circles for ever: -infinity, as the rings crowd
// there (in region II next to region III: +infinity).  On the horizon itself the ray with E = 0
// lies in it and would have t infinite; r - 2 = -1e-20 stands for that.  Measured against rays
// followed step by step, 0.3 <= r <= 8, 0.1 <= b <= 1000: within 1e-9 max(1, |t|); dt = b dphi
// between neighbouring rays holds over 1e-6 <= r <= 1e8.
double exact_emission_time(const NullRay& ray);

}  // namespace domefall
