#include "pipeline/light/kerr_path.h"

#include <algorithm>
#include <boost/math/quadrature/gauss.hpp>
#include <cmath>
#include <type_traits>

namespace domefall {
namespace {

using Complex = std::complex<double>;
using std::asinh;
using std::sqrt;

template <class T>
T as_number(const Scaled& s) {
  if constexpr (std::is_same_v<T, Dual>)
    return {static_cast<double>(s.v), static_cast<double>(s.by_delta),
            static_cast<double>(s.by_eta)};
  else
    return static_cast<double>(s.v);
}

// Products and roots of what is known to more digits than a double has.
Scaled operator*(const Scaled& a, const Scaled& b) {
  return {a.v * b.v, a.by_delta * b.v + a.v * b.by_delta, a.by_eta * b.v + a.v * b.by_eta};
}
Scaled operator*(long double a, const Scaled& b) { return {a * b.v, a * b.by_delta, a * b.by_eta}; }
Scaled operator+(const Scaled& a, const Scaled& b) {
  return {a.v + b.v, a.by_delta + b.by_delta, a.by_eta + b.by_eta};
}
Scaled chain(const Scaled& a, long double f, long double slope) {
  return {f, slope * a.by_delta, slope * a.by_eta};
}
Scaled inverse(const Scaled& a) { return chain(a, 1 / a.v, -1 / (a.v * a.v)); }
Scaled root(const Scaled& a) {
  const long double f = std::sqrt(a.v);
  return chain(a, f, 1 / (2 * f));
}

// Returns the distance to the line between two real numbers.
double far_from_way(Complex z, double low, double high) {
  return std::hypot(z.real() - std::clamp(z.real(), low, high), z.imag());
}

// Returns the two w = 1/r of rho^2 + b1 rho + b0 = 0, with rho = r - x.
std::pair<Complex, Complex> inverse_radii(long double x, long double b1, long double b0) {
  const auto product = static_cast<double>(x * x - b1 * x + b0);
  const auto half = static_cast<double>(x - b1 / 2);
  const Complex root = std::sqrt(Complex(static_cast<double>(b1 * b1 / 4 - b0)));
  const Complex large = half < 0 ? half - root : half + root;
  return {1.0 / large, large / product};
}

}  // namespace

template <class T>
KerrPath<T>::KerrPath(const KerrStart& start, const KerrRoots& roots)
    : to_sky_(start.origin != KerrOrigin::kPastHorizon),
      spin_(static_cast<double>(start.at.hole.spin)),
      squares_(static_cast<double>(start.at.hole.squares())),
      sigma_(static_cast<double>(start.sigma)),
      x_(static_cast<double>(start.edge.x)),
      kappa2_(as_number<T>(start.kappa * start.kappa)),
      mu_(as_number<T>(start.mu)) {
  const long double d = start.at.hole.horizon_distance(), h = start.edge.above_one;
  below_outer_ = static_cast<double>(start.edge.root * start.edge.root / (h + d));
  above_inner_ = static_cast<double>(h + d);
  // P at x, where P = kappa sqrt Delta on the critical ray
  p_ = as_number<T>({start.edge.kappa * start.edge.root - start.side * start.kappa_less_edge,
                     -start.mu.by_delta, -start.mu.by_eta});
  e1_ = as_number<T>(roots.e1);
  e0_ = as_number<T>(roots.e0);
  set_shape(start, roots);
}

template <class T>
void KerrPath<T>::set_shape(const KerrStart& start, const KerrRoots& roots) {
  const long double x = start.edge.x, disc = roots.discriminant();
  const auto seen = static_cast<double>(1 / start.at.r);
  const Scaled product = Scaled{x * x} + (-x) * roots.b1 + roots.b0;  // of the pair's two radii
  const auto [pair, other] = inverse_radii(x, roots.b1.v, roots.b0.v);
  const auto [third, fourth] = inverse_radii(x, roots.e1.v, roots.e0.v);
  const auto outer = static_cast<double>(1 / start.at.hole.horizon());
  direction_ = start.speed.v < 0 ? 1 : -1;
  const bool straight = disc < 0 || (to_sky_ && start.speed.v < 0);
  // Next to light without kappa real roots may lie inside the inner horizon, where no path of these turns.
  const bool passes = disc > 0 && !to_sky_ && start.kappa_less_edge <= 0;
  const double low = to_sky_ ? 0 : std::min(seen, outer), high = to_sky_ ? seen : outer;
  const double near = std::min(far_from_way(pair, low, high), far_from_way(other, low, high));
  const double apart = std::min({std::abs(pair - third), std::abs(pair - fourth)});
  const bool inside = start.at.delta() <= 0;
  const auto inner = static_cast<double>(1 / start.at.hole.inner_horizon());
  if (roots.alike || passes || (straight && (near > 0.4 * (high - low) || apart < 0.5 * near))) {
    shape_ = Shape::kPlain;
    first_ = -direction_ * seen;
    last_ = to_sky_ ? 0 : -direction_ * outer;
  } else {
    set_map(start, roots, product);
  }
  for (const Complex w : {third, fourth}) add_singular(w);
  if (shape_ == Shape::kPlain)
    for (const Complex w : {pair, other}) add_singular(w);
  of_mino_ = singular_.size();
  if (inside || !to_sky_) add_singular(inner);
  if (!to_sky_) add_singular(outer);
  of_angle_ = singular_.size();
  add_singular(0);
  if (shape_ != Shape::kPlain) set_ends(start);
}

// Takes the first pair of roots out.
template <class T>
void KerrPath<T>::set_map(const KerrStart& start, const KerrRoots& roots, const Scaled& product) {
  const long double x = start.edge.x, disc = roots.discriminant();
  const Scaled gap =
      chain(roots.b1 * roots.b1 + (-4) * roots.b0, std::abs(disc), disc > 0 ? 1 : -1);
  const Scaled spread = root(gap) * inverse(product);  // w2 - w1, or twice the imaginary part
  root_ = as_number<T>(root(product));
  if (disc > 0) {
    const bool outer = to_sky_;
    shape_ = outer ? Shape::kOuter : Shape::kInner;
    const Scaled rho = 0.5L * ((-1) * roots.b1 + (outer ? 1 : -1) * root(gap));
    gap_ = as_number<T>(spread);
    rho1_ = as_number<T>(rho);
    w1_ = as_number<T>(inverse(Scaled{x} + rho));
  } else {
    shape_ = Shape::kComplex;
    gap_ = as_number<T>(0.5L * spread);
    w1_ = as_number<T>((Scaled{2 * x} + (-1) * roots.b1) * inverse(2 * product));
    // w_c - w at the observer, without a difference of what is equal there.
    const long double rho = start.edge.rho;
    const Scaled ahead = Scaled{2 * x * rho} + (x - rho) * roots.b1 + (-2) * roots.b0;
    last_start_ = as_number<T>((ahead * inverse(2 * start.at.r * product)));
  }
}

// Adds the places y of a w at which an integrand is singular.
template <class T>
void KerrPath<T>::add_singular(Complex w) {
  if (!(std::abs(w) < 1e100)) return;  // at r = 0
  if (shape_ == Shape::kPlain) {
    singular_.push_back(-direction_ * w);
    return;
  }
  const double w1 = value(w1_), gap = value(gap_);
  const bool complex = shape_ == Shape::kComplex;
  const Complex sinh =
      complex ? (w1 - w) / gap : std::sqrt((shape_ == Shape::kOuter ? w1 - w : w - w1) / gap);
  const Complex y = (complex ? direction_ : 1.0) * std::asinh(sinh);
  singular_.insert(singular_.end(), {y, std::conj(y)});
  if (!complex) singular_.insert(singular_.end(), {-y, -std::conj(y)});
}

template <class T>
void KerrPath<T>::set_ends(const KerrStart& start) {
  const auto r = static_cast<double>(start.at.r);
  const double outer = 1 / static_cast<double>(start.at.hole.horizon());
  if (shape_ == Shape::kComplex) {
    first_ = direction_ * asinh(last_start_ / gap_);
    last_ = to_sky_ ? asinh(w1_ / gap_) : direction_ * asinh((w1_ - outer) / gap_);
    return;
  }
  // r'/r^2 = -+ sqrt(product) gap sinh(2y)/2 sqrt(S/r^2), which is smooth where r' = 0.
  const auto rho = static_cast<double>(start.edge.rho);
  const T s = (rho * rho + e1_ * rho + e0_) / (r * r);
  const T speed = as_number<T>(start.speed) / (r * r);
  const double sign = shape_ == Shape::kOuter ? -1 : 1;
  first_ = 0.5 * asinh(sign * 2 * speed / (root_ * gap_ * sqrt(s)));
  last_ = shape_ == Shape::kOuter ? (to_sky_ ? asinh(sqrt(w1_ / gap_)) : first_)
                                  : asinh(sqrt((outer - w1_) / gap_));
}

template <class T>
typename KerrPath<T>::Node KerrPath<T>::node(double y) const {
  Node out;
  if (shape_ == Shape::kPlain) {
    const double w = -direction_ * y, w2 = w * w;
    out.w = w;
    out.p = 1 + (sigma_ - mu_) * w2;
    out.delta = 1 - 2 * w + squares_ * w2;
    const T root = sqrt(out.p * out.p - kappa2_ * w2 * out.delta);
    out.speed = -direction_ * root;
    out.mino = 1 / root;
    return out;
  }
  T zeta;  // rho w
  T by_y;
  if (shape_ == Shape::kComplex) {
    const double sinh = std::sinh(direction_ * y), cosh = std::sqrt(1 + sinh * sinh);
    out.w = w1_ - gap_ * sinh;
    zeta = 1 - x_ * out.w;
    by_y = gap_ * (direction_ * cosh);
    out.mino = 1;
  } else {
    const double sinh = std::sinh(y), cosh = std::sqrt(1 + sinh * sinh);
    const double sign = shape_ == Shape::kOuter ? 1 : -1;
    out.w = w1_ - gap_ * (sign * sinh * sinh);
    zeta = rho1_ * out.w + gap_ * (sign * sinh * sinh) / w1_;
    by_y = gap_ * (sign * sinh * cosh);
    out.mino = 2;
  }
  const T s = sqrt(zeta * zeta + (e1_ * zeta + e0_ * out.w) * out.w);
  out.mino = out.mino / (root_ * s);
  out.speed = -by_y * root_ * s;
  out.p = zeta * (zeta + 2 * x_ * out.w) + p_ * (out.w * out.w);
  out.delta = (zeta + below_outer_ * out.w) * (zeta + above_inner_ * out.w);
  return out;
}

template <class T>
typename KerrPath<T>::Sum KerrPath<T>::rates(double y, double sign, bool all) const {
  const Node n = node(y);
  const T p = sign * n.p, w2 = n.w * n.w;
  const bool differ = (value(p) > 0) != (value(n.speed) > 0);
  // A, and A r^2
  const T a = differ ? kappa2_ * w2 / (p - n.speed) : (p + n.speed) / n.delta;
  Sum out;
  out.mino = n.mino;
  out.angle = n.mino * (spin_ * (sign - a));
  if (all) {
    const T r2 = differ ? kappa2_ / (p - n.speed) : a / w2;
    out.time = -n.mino * (r2 + spin_ * spin_ * a);
  }
  return out;
}

// Calls add(y, weight) at Gauss' nodes of panels so short that the integrands' singularities are well
// outside of the ellipses on which their polynomials converge.
template <class T>
template <class Add>
void KerrPath<T>::over_panels(double from, double to, std::size_t singular, const Add& add) const {
  using Gauss = boost::math::quadrature::gauss<double, 20>;
  constexpr double kEllipse = 2.4, kSpan = (kEllipse + 1 / kEllipse) / 2, kLongest = 1.5;
  const double sign = to < from ? -1 : 1, shortest = 1e-10 * std::abs(to - from);
  double at = from;
  while (sign * (to - at) > 0) {
    double end = to;
    const auto fits = [&] {
      const double length = std::abs(end - at);
      if (shape_ != Shape::kPlain && length > 2 * kLongest) return false;
      return std::all_of(
          singular_.begin(), singular_.begin() + static_cast<std::ptrdiff_t>(singular),
          [&](const Complex& z) {
            return std::hypot(z.real() - at, z.imag()) + std::hypot(z.real() - end, z.imag()) >=
                   kSpan * length;
          });
    };
    while (!fits() && std::abs(end - at) > shortest) end = at + (end - at) / 2;
    const double middle = (at + end) / 2, half = (end - at) / 2;
    for (std::size_t i = 0; i < Gauss::abscissa().size(); ++i) {
      const double step = half * Gauss::abscissa()[i], weight = half * Gauss::weights()[i];
      add(middle - step, weight);
      add(middle + step, weight);
    }
    at = end;
  }
}

template <class T>
typename KerrPath<T>::Sum KerrPath<T>::between(double from, double to, double sign) const {
  Sum sum;
  over_panels(from, to, singular_.size(), [&](double y, double weight) {
    const Sum rate = rates(y, sign, true);
    sum.mino = sum.mino + weight * rate.mino;
    sum.angle = sum.angle + weight * rate.angle;
    sum.time = sum.time + weight * rate.time;
  });
  return sum;
}

template <class T>
typename KerrPath<T>::Sum KerrPath<T>::up_to(double y, double sign) const {
  Sum sum = between(first(), y, sign);
  if constexpr (std::is_same_v<T, Dual>) {
    // The start moves, too.
    const Sum start = rates(first(), sign, true);
    const auto moved = [&](Dual& of, double rate) {
      of = of - Dual(0, rate * first_.d, rate * first_.e);
    };
    moved(sum.mino, start.mino.v);
    moved(sum.angle, start.angle.v);
    moved(sum.time, start.time.v);
  }
  return sum;
}

template <class T>
void KerrPath<T>::move_to(double target, double& y, double& mino) const {
  for (int i = 0; i < 60; ++i) {
    const double step = (target - mino) / place(y).by_y;
    const double next = std::clamp(y + step, first(), (y + 7 * last()) / 8);
    mino += mino_between(y, next);
    // The next step would be its square.
    const bool there = std::abs(next - y) <= 1e-11 * std::max(1.0, std::abs(next));
    y = next;
    if (there) break;
  }
}

template <class T>
double KerrPath<T>::mino_between(double from, double to) const {
  double sum = 0;
  over_panels(from, to, of_mino_,
              [&](double y, double weight) { sum += weight * value(node(y).mino); });
  return sum;
}

template <class T>
typename KerrPath<T>::Sum KerrPath<T>::whole() const {
  Sum sum;
  over_panels(first(), last(), of_angle_, [&](double y, double weight) {
    const Sum rate = rates(y, 1, false);
    sum.mino = sum.mino + weight * rate.mino;
    sum.angle = sum.angle + weight * rate.angle;
  });
  if constexpr (std::is_same_v<T, Dual>) {
    // The ends move, too.
    const Sum start = rates(first(), 1, false), end = rates(last(), 1, false);
    const auto moved = [&](Dual& of, double by_first, double by_last) {
      of = of + Dual(0, by_last * last_.d - by_first * first_.d,
                     by_last * last_.e - by_first * first_.e);
    };
    moved(sum.mino, start.mino.v, end.mino.v);
    moved(sum.angle, start.angle.v, end.angle.v);
  }
  return sum;
}

template <class T>
typename KerrPath<T>::Place KerrPath<T>::place(double y) const {
  const Node n = node(y);
  const double w = value(n.w);
  return {1 / w, value(n.speed) / (w * w), value(n.mino)};
}

template class KerrPath<double>;
template class KerrPath<Dual>;

}  // namespace domefall
