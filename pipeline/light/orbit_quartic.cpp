#include "pipeline/light/orbit_quartic.h"

#include <algorithm>
#include <cmath>

namespace domefall {
namespace {

using Long = long double;
using Complex = std::complex<Long>;

// ---- Carlson's R_F ----

// Returns R_F(u^2, v^2, w^2) for u > 0 and v, w that are real and >= 0, or complex conjugates of
// positive real part.  The first step of duplication is done in products of the roots: there the
// squares of v and w, which may be close to the negative axis, would cancel.
Long carlson(const Complex& u, const Complex& v, const Complex& w) {
  Complex x = (u + v) * (u + w) / Long{4}, y = (u + v) * (v + w) / Long{4},
          z = (u + w) * (v + w) / Long{4};
  Complex a, b, c;  // relative differences from the mean
  for (int k = 0; k < 200; ++k) {
    const Complex mean = (x + y + z) / Long{3};
    a = Long{1} - x / mean;
    b = Long{1} - y / mean;
    c = -(a + b);
    if (std::max({std::norm(a), std::norm(b), std::norm(c)}) < 4e-6L) break;
    const Complex rx = std::sqrt(x), ry = std::sqrt(y), rz = std::sqrt(z);
    const Complex all = rx * ry + ry * rz + rz * rx;
    x = (x + all) / Long{4};
    y = (y + all) / Long{4};
    z = (z + all) / Long{4};
  }
  const Complex e2 = a * b - c * c, e3 = a * b * c;
  const Complex sum = Long{1} - e2 / Long{10} + e3 / Long{14} + e2 * e2 / Long{24} -
                      Long{3} / 44 * e2 * e3 - Long{5} / 208 * e2 * e2 * e2 +
                      Long{3} / 104 * e3 * e3 + e2 * e2 * e3 / Long{16};
  return (sum / std::sqrt((x + y + z) / Long{3})).real();
}

// ---- roots ----

// Returns the root of f, which rises from below 0 at `low` to 0 or above at `high`, by Newton's
// method from the end `from`, kept between the two.  f returns its value and slope.
template <class F>
Long rising_root(const F& f, Long low, Long high, Long from) {
  Long x = from;
  for (int k = 0; k < 200; ++k) {
    const auto value = f(x);
    (value.first < 0 ? low : high) = x;
    const Long step = value.second > 0 ? value.first / value.second : high - low;
    Long next = x - step;
    if (!(next >= low && next <= high)) next = (low + high) / 2;
    if (std::abs(next - x) < 1e-19L * std::abs(x)) return next;
    x = next;
  }
  return x;
}

// Returns v > 0 with v^2 + 2 v^3 + q^2 v^4 = 1/b^2: w = -v is the root of P below 0.
Long root_below_zero(Long q, Long inverse_b) {
  const Long c = inverse_b * inverse_b;
  Long above = std::min(inverse_b, std::cbrt(c / 2));
  if (q > 0) above = std::min(above, std::sqrt(inverse_b / q));
  return rising_root(
      [=](Long v) {
        return std::pair{v * v * (1 + v * (2 + q * q * v)) - c, v * (2 + v * (6 + 4 * q * q * v))};
      },
      0, above, above);
}

// Returns q^2 w_4 for b < kappa, where w_4 is the largest root: y^2 (y^2 - 2y + q^2) = q^6/b^2.
// Without a charge it is 2.
Long core_root(Long q, Long inverse_b) {
  const Long q2 = q * q, root = q2 * q * inverse_b, above = 1 + std::sqrt(1 + root);
  return rising_root(
      [=](Long y) {
        return std::pair{y * y * (y * (y - 2) + q2) - root * root, y * (y * (4 * y - 6) + 2 * q2)};
      },
      0, above, above);
}

// Returns the lower root of P between w = 0 and the circle of light, for b > kappa.
Long outer_turn(Long q, Long circle, Long inverse_b) {
  const Long c = inverse_b * inverse_b, q2 = q * q;
  return rising_root(
      [=](Long w) {
        return std::pair{w * w * (1 - w * (2 - q2 * w)) - c, w * (2 - w * (6 - 4 * q2 * w))};
      },
      inverse_b, circle, inverse_b);
}

}  // namespace

LightCircle light_circle_of(Long charge) {
  LightCircle out{charge, 9 - 8 * charge * charge >= 0};
  if (!out.exists) return out;
  const Long root = std::sqrt(9 - 8 * charge * charge), r = (3 + root) / 2;
  out.w = 1 / r;
  out.second = root / r;
  out.third = 2 * (r - 2);
  return out;
}

OrbitQuartic::OrbitQuartic(const LightCircle& circle, Long inverse_b, Long eps, Long w,
                           Long above_circle, Long p_observer)
    : w_(w), x_(w) {
  const Long a = circle.second, b = circle.third, q = circle.charge;
  if (circle.exists && std::abs(eps) * b * b < 0.06L * a * a * a &&
      std::abs(eps) * q * q < 0.06L * a * a) {
    origin_ = circle.w;
    x_ = above_circle;
    factorise_at_circle(circle, eps);
  } else if (eps > 0) {
    factorise_passing(q, inverse_b);
  } else {
    factorise_turning(circle, inverse_b);
  }
  observer_ = at_observer(p_observer);
}

// P = (x^2 + p x + s)(n + m x - q^2 x^2).
void OrbitQuartic::factorise_at_circle(const LightCircle& circle, Long eps) {
  const Long q2 = circle.charge * circle.charge;
  Long p = 0, s = eps / circle.second, m = 0, n = 0;
  for (int k = 0; k < 100; ++k) {
    const Long before_p = p, before_s = s;
    m = circle.third + q2 * p;
    n = circle.second + q2 * s - p * m;
    s = eps / n;
    p = -s * m / n;
    if (std::abs(s - before_s) <= 1e-19L * std::abs(s) &&
        std::abs(p - before_p) <= 1e-19L * std::abs(p))
      break;
  }
  const Long far = std::sqrt(m * m + 4 * q2 * n);
  const Long lowest = m >= 0 ? -2 * n / (m + far) : (m - far) / (2 * q2);
  const Long core = m >= 0 ? (m + far) / 2 : 2 * n * q2 / (far - m);
  const Factor above_lowest{-lowest, 1}, below_core{core, -q2};
  if (eps >= 0) {
    conjugate_ = true;
    const Complex root(-p / 2, std::sqrt(std::max(Long{0}, s - p * p / 4)));
    factors_ = {Factor{-root, 1}, {-std::conj(root), 1}, above_lowest, below_core};
    return;
  }
  const Long half = std::sqrt(p * p / 4 - s);
  const Long lower = p > 0 ? -(p / 2 + half) : s / (half - p / 2);
  const Long upper = p > 0 ? s / lower : half - p / 2;
  factors_ = {Factor{upper, -1}, below_core, above_lowest, {lower, -1}};
}

// Here the pair's product s and sum -p follow from the other two roots and the coefficients of P.
void OrbitQuartic::factorise_passing(Long q, Long inverse_b) {
  const Long v = root_below_zero(q, inverse_b), core = core_root(q, inverse_b), n = v * core;
  const Long s = inverse_b * inverse_b / n, p = -2 * s / (n + q * q * s);
  conjugate_ = true;
  const Complex root(-p / 2, std::sqrt(std::max(Long{0}, s - p * p / 4)));
  factors_ = {Factor{-root, 1}, {-std::conj(root), 1}, {v, 1}, {core, -q * q}};
}

// Here those of the lowest roots do, and give the pair beyond the turn.
void OrbitQuartic::factorise_turning(const LightCircle& circle, Long inverse_b) {
  const Long q = circle.charge, q2 = q * q;
  const Long v = root_below_zero(q, inverse_b), turn = outer_turn(q, circle.w, inverse_b);
  const Long s = -v * turn, n = inverse_b * inverse_b / s, p = -2 * s / (n + q2 * s);
  const Long m = 2 + q2 * p, square = m * m + 4 * q2 * n, root = std::sqrt(std::abs(square));
  const Factor above_lowest{v, 1}, below_turn{turn, -1};
  if (square < 0) {
    conjugate_ = true;
    const Complex upper(m / (2 * q), root / (2 * q));
    factors_ = {Factor{-upper, q}, {-std::conj(upper), q}, above_lowest, below_turn};
    return;
  }
  const Long core = (m + root) / 2;
  factors_ = {Factor{-n / core, -1}, {core, -q2}, above_lowest, below_turn};
}

OrbitQuartic::Roots OrbitQuartic::at(Long x) const {
  Roots out;
  for (std::size_t k = 0; k < 4; ++k)
    out[k] = std::sqrt(factors_[k].constant + factors_[k].slope * x);
  if (conjugate_) out[1] = std::conj(out[0]);
  return out;
}

// Close to the turning point, the plain difference has lost its digits.  There the factor is what
// P(w), which is known from k^r, leaves of the others.
OrbitQuartic::Roots OrbitQuartic::at_observer(Long p_observer) const {
  Roots out = at(x_);
  const Long size = std::abs(factors_[3].constant),
             plain = (factors_[3].constant + factors_[3].slope * x_).real();
  if (plain < 0.25L * size) out[3] = std::sqrt(p_observer) / (out[0] * out[1] * out[2]).real();
  return out;
}

OrbitQuartic::Roots OrbitQuartic::at_turn() const {
  Roots out = at(-factors_[3].constant.real() / factors_[3].slope);
  out[3] = 0;
  return out;
}

Long OrbitQuartic::integral(const Roots& high, const Roots& low, Long width) const {
  if (width <= 0) return 0;
  const auto u = [&](int i, int j, int k, int l) {
    return (high[i] * high[j] * low[k] * low[l] + low[i] * low[j] * high[k] * high[l]) / width;
  };
  const Complex u12 = u(0, 1, 2, 3), u13 = u(0, 2, 1, 3), u14 = u(0, 3, 1, 2);
  return 2 *
         carlson(conjugate_ ? Complex(u12.real()) : u12, u13, conjugate_ ? std::conj(u13) : u14);
}

Long OrbitQuartic::direct() const { return integral(observer_, at(-origin_), w_); }

Long OrbitQuartic::turned() const {
  const Roots turn = at_turn(), sky = at(-origin_);
  const Long slope = -factors_[3].slope;
  const auto width = [&](const Roots& roots) { return std::norm(roots[3]) / slope; };
  return integral(turn, observer_, width(observer_)) + integral(turn, sky, width(sky));
}

}  // namespace domefall
