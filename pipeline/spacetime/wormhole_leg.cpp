#include "pipeline/spacetime/wormhole_leg.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace domefall {
namespace {

using std::numbers::pi;

// Returns x - x_t, so that it keeps its digits next to the turn, by G(x) - G(x - way) = growth.
double way_from_turn(double x, double turn, double growth) {
  const double plain = x - turn;
  if (plain > x / 4) return plain;
  double way = growth / std::atan(x);
  for (int k = 0; k < 8; ++k) way -= (flare_growth(x - way, way) - growth) / std::atan(x - way);
  return way;
}

// These are sinh and cosh by one exponential, right to rounding also for small u.
struct Hyperbola {
  double sine, cosine;
};
Hyperbola hyperbola(double u) {
  const double above = std::expm1(u), back = above / (1 + above);  // 1 - exp(-u)
  return {(above + back) / 2, 1 + (above - back) / 2};
}

}  // namespace

WormholeLeg::WormholeLeg(const Wormhole& wormhole, double b, double one_minus_b)
    : ellis_(wormhole.profile == Wormhole::Profile::kEllis),
      turns_(one_minus_b < 0),
      m_(wormhole.lensing_mass()),
      unit_(pi / 2 * m_),
      b_(b),
      below_(turns_ ? one_minus_b : std::max(one_minus_b, 1e-300)) {
  if (ellis_)
    scale_ = std::sqrt(std::abs(below_)) * std::sqrt(1 + b);
  else if (turns_)
    scale_ = unit_ * flare_inverse(-below_ / m_);
  else  // r - b vanishes at the imaginary y near pi sqrt(m (1 - b)/2), or the flare is singular
    scale_ = 0.9 * unit_ * std::min(1.0, std::sqrt(2 * below_ / m_));
}

WormholeLeg::Place WormholeLeg::at(double u) const {
  if (ellis_) {
    const Hyperbola h = hyperbola(u);
    const double y = scale_ * (turns_ ? h.cosine : h.sine), r = std::hypot(1, y);
    const double rises = scale_ * (turns_ ? h.sine : h.cosine) / r;
    return {y, r, rises * rises, r};
  }
  if (turns_) {
    const Hyperbola half = hyperbola(u / 2);
    const double grown = 2 * half.sine * half.sine, turn = scale_ / unit_;
    const double risen = m_ * flare_growth(turn, turn * grown);  // r - b
    const double r = b_ + risen, rise = risen * (r + b_) / (r * r);
    return {scale_ * (1 + grown), r, rise, 2 * scale_ * half.sine * half.cosine / std::sqrt(rise)};
  }
  const Hyperbola h = hyperbola(u);
  const double y = scale_ * h.sine, risen = m_ * flare(y / unit_), r = 1 + risen;
  const double rise = (below_ + risen) * (r + b_) / (r * r);
  return {y, r, rise, scale_ * h.cosine / std::sqrt(rise)};
}

double WormholeLeg::parameter(double y, double r_less_b) const {
  if (!turns_) return std::asinh(y / scale_);
  if (ellis_) return std::asinh(std::sqrt(r_less_b) * std::sqrt(r_less_b + 2 * b_) / scale_);
  const double turn = scale_ / unit_, way = way_from_turn(y / unit_, turn, r_less_b / m_);
  return 2 * std::asinh(std::sqrt(way / (2 * turn)));
}

double WormholeLeg::calm() const {
  const double widest = ellis_ ? 1 : std::max(1.0, unit_);
  return turns_ ? std::acosh(1 + widest / scale_) : std::asinh(widest / scale_);
}

double WormholeLeg::cylinder_rate() const { return 1 / std::sqrt(below_ * (1 + b_)); }

}  // namespace domefall
