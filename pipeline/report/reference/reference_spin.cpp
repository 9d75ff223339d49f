#include "pipeline/report/reference/reference_spin.h"

#include <algorithm>

namespace domefall {
namespace {

constexpr std::size_t kOrder = 40;
using Series = std::array<Real50, kOrder + 1>;

struct Constants {
  Real50 a, h;  // a, a^2 + q^2
  Real50 e, l, k;
};

Constants constants_of(const SpinView& v) {
  const Real50 s = sin(Real50(v.delta / 2)), c = cos(Real50(v.delta / 2)), a = v.spin;
  const Real50 sine = sin(v.theta), cosine = cos(v.theta), h = a * a + v.charge * v.charge;
  const Real50 sigma = v.r * v.r + a * a * cosine * cosine, delta = v.r * (v.r - 2) + h;
  const Real50 y = sqrt(sigma) * sine * 2 * s * c * sin(v.eta);
  const Real50 e = (sigma * s * s + delta * c * c + a * y) / sigma;
  return {a, h, e, y + a * e * sine * sine, 4 * sigma * s * s * c * c};
}

Real50 product(const Series& a, const Series& b, std::size_t k) {
  Real50 sum = 0;
  for (std::size_t i = 0; i <= k; ++i) sum += a[i] * b[k - i];
  return sum;
}

struct SpinRay {
  Real50 w, speed;  // 1/r, and its derivative back in time
  std::array<Real50, 3> place, turning;
  Real50 angle;
};

// The Taylor series of a ray back in time.
struct SpinExpansion {
  Series w{}, angle{};
  std::array<Series, 3> n{};

  // The angle is that of light that falls or, for E < 0, of light that rises.
  SpinExpansion(const SpinRay& from, const Constants& of) {
    const Real50 g = of.a * (of.a * of.e - of.l), ae2 = of.a * of.a * of.e * of.e;
    const Real50 c = of.k + 2 * of.a * of.e * of.l - of.a * of.a * of.e * of.e;
    w[0] = from.w, w[1] = from.speed, angle[0] = from.angle;
    for (std::size_t i = 0; i < 3; ++i) n[i][0] = from.place[i], n[i][1] = from.turning[i];
    Series w2{}, z2{};
    for (std::size_t k = 0; k + 2 <= kOrder; ++k) {
      const Real50 over = Real50(1) / static_cast<unsigned>((k + 1) * (k + 2));
      w2[k] = product(w, w, k), z2[k] = product(n[2], n[2], k);
      w[k + 2] = over * ((2 * g * of.e - of.k) * w[k] + 3 * of.k * w2[k] +
                         2 * (g * g - of.h * of.k) * product(w2, w, k));
      for (std::size_t i = 0; i < 3; ++i)
        n[i][k + 2] = -over * ((i == 2 ? c - ae2 : c) * n[i][k] + 2 * ae2 * product(z2, n[i], k));
    }
    set_angle(of, g, w2);
  }

  // Returns how far the series are good to 1e-36, but no farther than one radian or so, within which no
  // ray reaches the sky and comes back.
  Real50 reach(const Constants& of) const {
    Real50 least = 1 / (sqrt(of.k) + abs(of.a * of.e) + Real50("1e-100"));
    for (std::size_t k = kOrder - 3; k + 2 <= kOrder; ++k) {
      Real50 most = abs(w[k]) + abs(angle[k]) + Real50("1e-300");
      for (const Series& s : n) most = std::max(most, Real50(abs(s[k])));
      least = std::min(least,
                       Real50(pow(Real50("1e-36") / most, Real50(1) / static_cast<unsigned>(k))));
    }
    return least;
  }

  SpinRay at(const Real50& t) const {
    SpinRay ray{value(w, t), slope(w, t), {}, {}, value(angle, t)};
    for (std::size_t i = 0; i < 3; ++i)
      ray.place[i] = value(n[i], t), ray.turning[i] = slope(n[i], t);
    return ray;
  }

 private:
  // A and, for E < 0, its like in the other angle are a numerator over a denominator, of which one form
  // has neither vanish.
  void set_angle(const Constants& of, const Real50& g, const Series& w2) {
    const Real50 sign = of.e > 0 ? 1 : -1;
    const bool differ = (of.e + g * w2[0] > 0) != (sign * w[1] > 0);
    Series rate{}, up{}, down{};
    for (std::size_t k = 0; k + 2 <= kOrder; ++k) {
      const Real50 p = g * w2[k] + (k == 0 ? of.e : Real50(0));
      const Real50 speed = sign * static_cast<unsigned>(k + 1) * w[k + 1];
      up[k] = differ ? Real50(of.k * w2[k]) : Real50(p + speed);
      down[k] = differ ? Real50(p - speed) : Real50(of.h * w2[k] - 2 * w[k] + (k == 0 ? 1 : 0));
      Real50 rest = up[k];
      for (std::size_t i = 0; i < k; ++i) rest -= rate[i] * down[k - i];
      rate[k] = rest / down[0];
      const Real50 all = of.a * ((k == 0 ? of.e : Real50(0)) - rate[k]);
      angle[k + 1] = all / static_cast<unsigned>(k + 1);
    }
  }

  static Real50 value(const Series& s, const Real50& t) {
    Real50 sum = 0;
    for (std::size_t k = kOrder - 1; k-- > 0;) sum = sum * t + s[k];
    return sum;
  }
  static Real50 slope(const Series& s, const Real50& t) {
    Real50 sum = 0;
    for (std::size_t k = kOrder - 1; k-- > 1;) sum = sum * t + static_cast<unsigned>(k) * s[k];
    return sum;
  }
};

// Returns r#, the half of what the angles of light that falls and of light that rises differ by.
Real50 twist(const Real50& a, const Real50& h, const Real50& r) {
  const Real50 d = sqrt(Real50(1 - h));
  return a / (2 * d) * log(Real50(abs((r - 1 - d) / (r - 1 + d))));
}

}  // namespace

SpinTruth reference_spin_ray(const SpinView& v) {
  const Constants of = constants_of(v);
  const Real50 sine = sin(v.theta), cosine = cos(v.theta),
               big = sqrt(Real50(v.r * v.r + of.a * of.a * cosine * cosine));
  const Real50 up = -big * sin(v.delta) * cos(v.eta);
  const Real50 c2 = (1 + cos(v.delta)) / 2, gap = v.r * (v.r - 2) + of.h;
  SpinRay ray{1 / v.r,
              (gap * c2 - big * big * (1 - c2)) / (v.r * v.r),
              {sine, 0, cosine},
              {cosine * up, -big * sin(v.delta) * sin(v.eta) - of.a * of.e * sine, -sine * up},
              0};
  if (of.e < 0) ray.angle = -2 * twist(of.a, of.h, v.r);
  const Real50 horizon = 1 / (1 + sqrt(Real50(1 - of.h)));
  while (ray.w > 0) {
    if (ray.w > horizon && ray.speed > 0) return {ReferenceSky::kNone};
    const SpinExpansion series(ray, of);
    const Real50 reach = series.reach(of);
    SpinRay next = series.at(reach);
    if (next.w > 0) {
      // Light of the past horizon comes ever nearer to it.
      if (reach < Real50("1e-25")) return {ReferenceSky::kNone};
      ray = next;
      continue;
    }
    Real50 t = reach;
    for (int i = 0; i < 100 && abs(next.w) > Real50("1e-45"); ++i) {
      t -= next.w / next.speed;
      next = series.at(t);
    }
    ray = next;
    break;
  }
  const Real50 c = cos(ray.angle), s = sin(ray.angle);
  const auto& n = ray.place;
  return {of.e > 0 ? ReferenceSky::kOwn : ReferenceSky::kOther,
          {n[0] * c - n[1] * s, n[0] * s + n[1] * c, n[2]}};
}

Real50 spin_edge(const SpinView& guess, const Real50& x) {
  Real50 r = x, delta = guess.delta;
  const auto quartic = [&](const Real50& at, const Real50& angle) {
    SpinView view = guess;
    view.delta = angle;
    const Constants of = constants_of(view);
    const Real50 p = (at * at + of.a * of.a) * of.e - of.a * of.l;
    return std::array<Real50, 2>{p * p - of.k * (at * (at - 2) + of.h),
                                 4 * at * of.e * p - 2 * (at - 1) * of.k};
  };
  const Real50 step("1e-25");
  for (int i = 0; i < 8; ++i) {
    const auto f = quartic(r, delta), by_r = quartic(r + step, delta),
               by_delta = quartic(r, delta + step);
    const Real50 a = (by_r[0] - f[0]) / step, b = (by_delta[0] - f[0]) / step;
    const Real50 c = (by_r[1] - f[1]) / step, d = (by_delta[1] - f[1]) / step;
    const Real50 det = a * d - b * c;
    r -= (d * f[0] - b * f[1]) / det;
    delta -= (a * f[1] - c * f[0]) / det;
  }
  return delta;
}

}  // namespace domefall
