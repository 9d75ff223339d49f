#include <algorithm>
#include <cmath>

#include "pipeline/light/kerr_path.h"

namespace domefall {
namespace {

using Long = long double;

// A polynomial b1 rho + b0, or that much of one.
struct Line {
  Long first, zero;
};

// Returns the d of d (rho^2 + e1 rho + e0) = rest, all modulo rho^2 + b1 rho + b0.
Line divided(const Line& rest, const KerrRoots& roots) {
  const Long b1 = roots.b1.v, b0 = roots.b0.v;
  const Long m = roots.e1.v - b1, n = roots.e0.v - b0;
  const Long own = n - m * b1, det = n * own + m * m * b0;
  return {(rest.first * n - rest.zero * m) / det, (rest.zero * own + rest.first * m * b0) / det};
}

// Returns the largest z = (r_1 + r_2)^2, a root of the resolvent cubic.
Long largest_resolvent(Long k, Long p, Long linear) {
  const auto f = [&](Long z) { return ((z + 2 * p) * z + linear) * z - 4 * k * k; };
  Long low = 0;
  Long high = 2 * std::max({std::abs(2 * p), std::sqrt(std::abs(linear)), std::cbrt(4 * k * k)});
  Long z = high;
  for (int i = 0; i < 200; ++i) {
    (f(z) > 0 ? high : low) = z;
    Long next = z - f(z) / ((3 * z + 4 * p) * z + linear);
    if (!(next >= low && next <= high)) next = (low + high) / 2;
    if (std::abs(next - z) <= 1e-14L * z) return next;
    z = next;
  }
  return z;
}

// The quartic rho^4 + 4x rho^3 + ..., with coefficients that do not cancel next to the edge.
struct Quartic {
  Long a3, a2, a1, a0;

  Long at(Long rho) const { return (((rho + a3) * rho + a2) * rho + a1) * rho + a0; }
  Long slope(Long rho) const { return ((4 * rho + 3 * a3) * rho + 2 * a2) * rho + a1; }
};

// Returns the zero between two places, of which the first has the sign of `low_sign`.
Long zero_of(const Quartic& f, Long low, Long high, Long guess, Long low_sign) {
  Long x = guess > low && guess < high ? guess : (low + high) / 2;
  for (int i = 0; i < 200; ++i) {
    const Long y = f.at(x);
    (y * low_sign > 0 ? low : high) = x;
    Long next = x - y / f.slope(x);
    if (!(next >= low && next <= high)) next = (low + high) / 2;
    if (std::abs(next - x) <= 2e-19L * std::abs(x)) return next;
    x = next;
  }
  return x;
}

// Sets the first pair where kappa is beyond the edge's, and the roots are real: they are on both sides
// of x or, should P be negative there, of P = 0.
void set_real_pair(KerrRoots& out, const KerrStart& start, const Quartic& f) {
  const Long x = start.edge.x, t = start.edge.root, d = start.at.hole.horizon_distance();
  const Long px = start.edge.kappa * t - start.side * start.kappa_less_edge;
  const Long between =
      f.a0 < 0 ? 0 : -px / (x + std::sqrt(std::max(Long{0}, start.mu.v - start.sigma)));
  const Long lowest = -t * t / (start.edge.above_one + d);  // r_+ - x
  Long highest = std::max(between + 1, std::abs(start.kappa.v) + 4);
  while (f.at(highest) < 0) highest *= 2;
  const Long spread = std::sqrt(std::max(Long{0}, f.a1 * f.a1 - 4 * f.a0 * f.a2));
  const bool near = spread < 0.5L * f.a2;
  const Long guess = near ? (spread - f.a1) / (2 * f.a2) : highest;
  const Long other = near ? -(spread + f.a1) / (2 * f.a2) : 0;
  const Long first = zero_of(f, between, highest, guess, -1);
  const Long second = zero_of(f, lowest, between, other, 1);
  out.b1.v = -(first + second);
  out.b0.v = first * second;
}

// Sets the first pair where it is complex, by Ferrari's way and Bairstow's.
void set_complex_pair(KerrRoots& out, const KerrStart& start, const Quartic& f) {
  const Long x = start.edge.x, k = start.kappa.v * start.kappa.v;
  const Long inner = start.sigma - start.mu.v, p = 2 * inner - k;
  out.alike = std::abs(start.kappa.v) < 1e-3L;
  if (out.alike) {
    out.b1.v = 2 * x;
    out.b0.v = x * x + inner;
    return;
  }
  // r^4 + p r^2 + 2k r + ..., first in r.
  const Long z = largest_resolvent(k, p, k * (k - 4 * inner + 4 * start.at.hole.squares()));
  const Long sum = std::sqrt(z), product = (p + z + 2 * k / sum) / 2;
  Long& b1 = out.b1.v;
  Long& b0 = out.b0.v;
  b1 = 2 * x - sum;
  b0 = x * x - sum * x + product;
  for (int i = 0; i < 4; ++i) {
    out.e1.v = 4 * x - b1;
    out.e0.v = f.a2 - b0 - b1 * out.e1.v;
    const Line rest{f.a1 - b1 * out.e0.v - b0 * out.e1.v, f.a0 - b0 * out.e0.v};
    const Line step = divided(rest, out);
    b1 += step.first;
    b0 += step.zero;
    if (std::abs(step.zero) < 1e-18L * std::abs(b0)) break;
  }
}

}  // namespace

KerrRoots kerr_roots(const KerrStart& start) {
  const CriticalRay& edge = start.edge;
  const Long x = edge.x, s = start.side, t = edge.root;
  const Long dk = start.kappa_less_edge == 0 ? -1e-30L : start.kappa_less_edge;
  const Long g = 2 * s * dk, h = dk * (2 * edge.kappa + dk);
  const Quartic f{4 * x, edge.curvature - g - h, -2 * x * g - 2 * edge.above_one * h,
                  -dk * (t + s) * (2 * edge.kappa * t + dk * (t - s))};
  KerrRoots out;
  if (dk > 0)
    set_real_pair(out, start, f);
  else
    set_complex_pair(out, start, f);
  if (out.alike) {
    out.e1 = out.b1, out.e0 = out.b0;
    return out;
  }
  const Long b1 = out.b1.v, b0 = out.b0.v;
  out.e1.v = 4 * x - b1;
  out.e0.v = start.kappa.v > 10 && b0 != 0 ? f.a0 / b0 : f.a2 - b0 - b1 * out.e1.v;
  // d(r'^2) = -2 P d(mu) - Delta d(kappa^2).
  const auto change = [&](Long Scaled::*by) {
    const Long dmu = -2 * (start.mu.*by), dk2 = -2 * start.kappa.v * (start.kappa.*by);
    const Long px = edge.kappa * t - s * dk;
    const Long d2 = dmu + dk2, d1 = 2 * x * dmu + 2 * edge.above_one * dk2;
    const Long d0 = dmu * px + dk2 * t * t;
    // modulo the first pair
    const Line step = divided({d1 - d2 * b1, d0 - d2 * b0}, out);
    out.b1.*by = step.first;
    out.b0.*by = step.zero;
    out.e1.*by = -step.first;
    out.e0.*by = d2 - step.zero - step.first * out.e1.v + b1 * step.first;
  };
  change(&Scaled::by_delta);
  change(&Scaled::by_eta);
  return out;
}

}  // namespace domefall
