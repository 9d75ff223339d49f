#include "trajectories/orbit_curve.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "trajectories/infinity.h"
#include "trajectories/square.h"

namespace domefall {
namespace {

constexpr double kNever = std::numeric_limits<double>::quiet_NaN();

// An L whose square no double holds turns nothing, and its azimuths would have no digits.
OrbitConstants without_underflow(OrbitConstants constants) {
  if (square(constants.angular_momentum) < std::numeric_limits<double>::min())
    constants.angular_momentum = 0;
  return constants;
}

}  // namespace

OrbitCurve OrbitCurve::scattered(const OrbitConstants& constants, double periastron, double w1,
                                 double excess) {
  OrbitCurve c;
  c.kind_ = Kind::kScattered, c.constants_ = constants;
  c.near_ = periastron, c.far_ = kInfinity, c.over_two_ = kInfinity;
  c.w_ = w1, c.excess_ = excess;
  return c;
}

OrbitCurve OrbitCurve::bound(const OrbitConstants& constants, double periastron, double apoastron,
                             double excess) {
  OrbitCurve c;
  c.kind_ = Kind::kBound, c.constants_ = constants;
  c.near_ = periastron, c.far_ = apoastron, c.over_two_ = apoastron - 2;
  c.excess_ = excess;
  return c;
}

OrbitCurve OrbitCurve::returning(const OrbitConstants& constants, double apoastron,
                                 double apoastron_over_two, double excess) {
  OrbitCurve c;
  c.kind_ = Kind::kReturning, c.constants_ = without_underflow(constants);
  c.far_ = apoastron, c.over_two_ = apoastron_over_two;
  c.w_ = (apoastron - 6) / (4 * apoastron), c.excess_ = excess;
  return c;
}

OrbitCurve OrbitCurve::unturned(const OrbitConstants& constants, bool escaping, double w_b,
                                double excess) {
  OrbitCurve c;
  c.kind_ = escaping ? Kind::kEscaping : Kind::kPlunging;
  c.constants_ = without_underflow(constants);
  c.w_ = constants.angular_momentum > 4 ? w_b : 0.25;
  c.near_ = 1 / c.w_, c.far_ = kInfinity, c.over_two_ = kInfinity;
  c.excess_ = excess;
  return c;
}

OrbitCurve::Point OrbitCurve::at(double s) const {
  switch (kind_) {
    case Kind::kScattered:
      return scattered_at(s);
    case Kind::kBound:
      return bound_at(s);
    case Kind::kReturning:
      return returning_at(s);
    default:
      return unturned_at(s);
  }
}

// Here w2 - w = w2 tanh^2 s.
OrbitCurve::Point OrbitCurve::scattered_at(double s) const {
  const double t = std::tanh(s), r = near_ * square(std::cosh(s)), w2 = 1 / near_;
  const double root =
      constants_.angular_momentum * std::sqrt(2 * w2 * (1 / r - w_) * (excess_ + w2 * square(t)));
  return {r, t * root, 2 * r / root};
}

// Here (w2 - w)(w - w1) = ((r_a - r_p) sin(s/2) cos(s/2))^2 / (r^2 r_p r_a).
OrbitCurve::Point OrbitCurve::bound_at(double s) const {
  const double sine = std::sin(s / 2), width = far_ - near_, risen = width * square(sine);
  const double r = near_ + risen;
  const double rate =
      r * std::sqrt(near_ * far_) /
      (constants_.angular_momentum * std::sqrt(2 * (excess_ + risen / (r * near_))));
  return {r, width * sine * std::cos(s / 2) / rate, rate};
}

// Here G = G(w_a) + L^2 (w - w_a)(2w + 4 w_a - 1) = G_least + 2 L^2 (w - w_m)^2 with
// w_m = (1 - 2 w_a)/4, which is w_a + (r_a - 6)/(4 r_a).  The first is a sum of positive terms for
// r_a <= 6, and the second beyond.
OrbitCurve::Point OrbitCurve::returning_at(double s) const {
  const double sine = std::sinh(s), cosine = std::cosh(s), wa = 1 / far_;
  const double r = far_ / square(cosine), l2 = square(constants_.angular_momentum);
  const double fallen = wa * square(sine);
  const double g = far_ <= 6 ? excess_ + l2 * fallen * (2 * fallen + (6 - far_) / far_)
                             : excess_ + 2 * l2 * square(fallen - w_);
  const double root = std::sqrt(wa * g);
  return {r, -sine * root, 2 * r / (cosine * root)};
}

// Here P = P(w_b) + 2 L^2 (w - w_b)^2 (w + 2 w_b - 1/2) or, for L <= 4,
// P = (E^2 - 1) + 2w (L^2 (w - 1/4)^2 + 1 - L^2/16).  Both are sums of positive terms for E >= 1.
OrbitCurve::Point OrbitCurve::unturned_at(double s) const {
  const double outward = kind_ == Kind::kEscaping ? 1 : -1, l = constants_.angular_momentum;
  const double r = near_ * std::exp(2 * outward * s), w = 1 / r;
  const double away = square(l * w_ * std::expm1(-2 * outward * s));
  const double p =
      l > 4 ? excess_ + 2 * away * (w + 2 * w_ - 0.5)
            : constants_.excess_energy + 2 * w * (away + std::max((4 - l) * (4 + l) / 16, excess_));
  const double root = std::sqrt(p);
  return {r, outward * root, 2 * r / root};
}

double OrbitCurve::parameter(double r, bool outward) const {
  if (!(r > 0) || r < innermost() || r > outermost()) return kNever;
  switch (kind_) {
    case Kind::kScattered: {
      const double s = std::asinh(std::sqrt((r - near_) / near_));
      return outward ? s : -s;
    }
    case Kind::kBound: {
      const double s = 2 * std::atan2(std::sqrt(r - near_), std::sqrt(far_ - r));
      return outward ? s : -s;
    }
    case Kind::kReturning: {
      const double s = std::asinh(std::sqrt((far_ - r) / r));
      return outward ? -s : s;
    }
    default:
      if (outward != (kind_ == Kind::kEscaping)) return kNever;
      return (outward ? 0.5 : -0.5) * std::log(r / near_);
  }
}

double OrbitCurve::innermost() const {
  return kind_ == Kind::kScattered || kind_ == Kind::kBound ? near_ : 0;
}

double OrbitCurve::outermost() const { return far_; }

double OrbitCurve::begin() const {
  if (kind_ == Kind::kEscaping) return 0.5 * std::log(kDeepest / near_);
  return kind_ == Kind::kPlunging ? -0.5 * std::log(kFarthest / near_) : -end();
}

double OrbitCurve::end() const {
  switch (kind_) {
    case Kind::kScattered:
      return 0.5 * std::log(4 * kFarthest / near_);
    case Kind::kBound:
      return std::numbers::pi;
    case Kind::kReturning:
      return 0.5 * std::log(4 * far_ / kDeepest);
    case Kind::kPlunging:
      return -0.5 * std::log(kDeepest / near_);
    default:
      return 0.5 * std::log(kFarthest / near_);
  }
}

}  // namespace domefall
