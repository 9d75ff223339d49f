#include "pipeline/light/plane_images.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>

#include "pipeline/base/simd/vector_math.h"
#include "pipeline/light/charged_paths.h"
#include "pipeline/light/ray_orbits.h"
#include "pipeline/light/ray_times.h"
#include "pipeline/spacetime/schwarzschild.h"

namespace domefall {
namespace {

using std::numbers::pi;

// The rays of one observer, each given by ln tan(alpha/2), where alpha is the angle of null_ray.h.
// The label p of a ray is k^r/L, as in plane_images.h.
class LabelledRays {
 public:
  explicit LabelledRays(const PlaneView& view)
      : at_(view.at), outgoing_(is_outgoing(view.tetrad)), energy_(view.energy()) {
    if (const auto* hole = std::get_if<ChargedHole>(&view.space.kind()))
      charged_.emplace(*hole, view.at.r);
  }

  // Every ray from here on has E > 0.  With t = tan(alpha/2), the energy E = a cos^2(alpha/2) +
  // b sin^2(alpha/2) is (a + b t^2)/(1 + t^2), with 1 - s and 1 + s in rain and f and 1 in T.
  // Outside the horizon that is positive for every t, and inside where t^2 > -a/b.
  double least_log_tangent() const {
    constexpr double kAxis = -40;
    return energy_.cosine2 >= 0 ? kAxis : std::log(-energy_.cosine2 / energy_.sine2) / 2;
  }
  static double greatest_log_tangent() { return 40; }

  // Returns p = k^r/L = (a/t - b t)/(2 r), and its opposite in the outgoing frame.
  double label(double log_tangent) const {
    const double t = std::exp(log_tangent),
                 p = (energy_.cosine2 / t - energy_.sine2 * t) / (2 * at_.r);
    return outgoing_ ? -p : p;
  }
  // Inverts label() on the branch where E > 0.
  double log_tangent(double p) const {
    const double q = (outgoing_ ? -p : p) * at_.r;
    // The formula of label() is the quadratic b t^2 + 2 q t - a = 0, whose larger root is wanted.
    // The form for each sign of q has no difference of like numbers.
    const double root = std::sqrt(std::max(0.0, q * q + energy_.sine2 * energy_.cosine2));
    return std::log(q > 0 ? energy_.cosine2 / (q + root) : (root - q) / energy_.sine2);
  }

  // Finds w = 1/r of the rays after psi.  It is 0 on a sky, and infinite in the singularity or where
  // a ray has come to the past horizon of a charge.  If asked for, the times are those of RayTimes.
  void find(const double* log_tangent, const double* psi, int count, double* w,
            double* times = nullptr) {
    if (charged_)
      find_charged(log_tangent, psi, count, w, times);
    else
      find_plain(log_tangent, psi, count, w, times);
  }

  bool outgoing() const { return outgoing_; }

 private:
  void find_plain(const double* log_tangent, const double* psi, int count, double* w,
                  double* times) {
    for (int k = 0; k < count; ++k) {
      const double t = std::exp(log_tangent[k]), length = std::sqrt(1 + t * t);
      first_[static_cast<std::size_t>(k)] = t / length;
      second_[static_cast<std::size_t>(k)] = 1 / length;
    }
    orbits_.set(at_, outgoing_, {first_.data(), second_.data(), nullptr, nullptr}, count);
    orbits_.find(psi, places_);
    for (int k = 0; k < count; ++k) w[k] = 1 / places_.r[static_cast<std::size_t>(k)];
    if (times) RayTimes(orbits_).find(psi, places_, times);
  }

  void find_charged(const double* log_tangent, const double* psi, int count, double* w,
                    double* times) {
    for (int k = 0; k < count; ++k) {
      const double t = std::exp(log_tangent[k]), over = 1 / (2 * at_.r);
      first_[static_cast<std::size_t>(k)] = label(log_tangent[k]);
      second_[static_cast<std::size_t>(k)] =
          std::abs(energy_.cosine2 / t + energy_.sine2 * t) * over;
    }
    if (times)
      charged_->timed(first_.data(), second_.data(), psi, count, charged_places_);
    else
      charged_->find(first_.data(), second_.data(), psi, count, charged_places_);
    std::copy_n(charged_places_.w.begin(), count, w);
    if (times) std::copy_n(charged_places_.time.begin(), count, times);
  }

  Radius at_;
  bool outgoing_;
  ViewEnergy energy_;
  RayOrbits orbits_;
  RayPlaces places_;
  std::optional<ChargedPaths> charged_;
  ChargedPaths::Places charged_places_;
  // The sine and the cosine of alpha/2, or p and e near a charge.
  RayPlaces::Column first_{}, second_{};
};

// Finds p of the rays that are at `target` = 1/r after psi, by bisection in ln tan(alpha/2).
void solve(LabelledRays& rays, double target, const double* psi, int count, double* p) {
  RayPlaces::Column low{}, high{}, middle{}, w{};
  low.fill(rays.least_log_tangent());
  high.fill(LabelledRays::greatest_log_tangent());
  constexpr int kHalvings = 58;
  for (int step = 0; step < kHalvings; ++step) {
    for (int k = 0; k < count; ++k) middle[k] = (low[k] + high[k]) / 2;
    rays.find(middle.data(), psi, count, w.data());
    for (int k = 0; k < count; ++k) {
      // In the rain frame w falls as alpha grows, and in the outgoing frame it rises.
      const bool below = (w[k] > target) != rays.outgoing();
      (below ? low : high)[k] = middle[k];
    }
  }
  for (int k = 0; k < count; ++k) p[k] = rays.label((low[k] + high[k]) / 2);
}

// Light from the horizon set out an infinite time ago.  This finite time (M) stands for it in the
// table, because no pattern shows there.
constexpr double kLongAgo = -1e9;

// Returns the time that RayTimes would give to light that comes radially from r.  Light that falls
// keeps v = t + r*, and light that moves out keeps u = t - r*.  So the time is 0 for light that
// keeps the frame's own null coordinate.  For the other kind that coordinate differs between the
// two places by 2 r*.
double radial_time(const PlaneView& view, double r) {
  if ((r > view.at.r) != is_outgoing(view.tetrad)) return 0;
  const auto* hole = std::get_if<ChargedHole>(&view.space.kind());
  const double apart = hole ? hole->tortoise(r) - hole->tortoise(view.at.r)
                            : Schwarzschild::tortoise_from(view.at, r);
  return std::max(-2 * std::abs(apart), kLongAgo);
}

// Returns Lagrange's weights at t for the cubic through four nodes at -1, 0, 1 and 2.
std::array<double, 4> cubic(double t) {
  const double a = t + 1, b = t, c = t - 1, d = t - 2;
  return {-b * c * d / 6, a * c * d / 2, -a * b * d / 2, a * b * c / 6};
}
// Returns the derivatives of these weights by t.
std::array<double, 4> cubic_slope(double t) {
  const double a = t + 1, b = t, c = t - 1, d = t - 2;
  return {-(c * d + b * d + b * c) / 6, (c * d + a * d + a * c) / 2, -(b * d + a * d + a * b) / 2,
          (b * c + a * c + a * b) / 6};
}

struct Place {
  std::size_t first;  // of four nodes
  double t;           // from the second one, in steps
};
// Finds the four nodes around x, which is in steps from the first of `count` nodes.  Near an end
// they are the four outermost ones.
Place place_at(double x, std::size_t count) {
  const double last = static_cast<double>(count) - 4;
  const double first = std::clamp(std::floor(x) - 1, 0.0, last);
  return {static_cast<std::size_t>(first), x - first - 1};
}

template <class T>
double weighted_sum(const T* nodes, const std::array<double, 4>& weights) {
  double sum = 0;
  for (std::size_t k = 0; k < 4; ++k) sum += weights[k] * static_cast<double>(nodes[k]);
  return sum;
}

}  // namespace

ViewEnergy PlaneView::energy() const {
  if (const auto* hole = std::get_if<ChargedHole>(&space.kind()))
    return {1, hole->lapse_squared(at.r)};
  return {1 + Schwarzschild::free_fall_speed(at.r), Schwarzschild::below_light_speed(at)};
}

double PlaneView::lapse_squared() const {
  if (const auto* hole = std::get_if<ChargedHole>(&space.kind())) return hole->lapse_squared(at.r);
  return straight ? (at.r - 2) / at.r : 1 - 2 * (1 / at.r);
}

double PlaneView::tortoise() const {
  const auto* hole = std::get_if<ChargedHole>(&space.kind());
  return hole ? hole->tortoise(at.r) : Schwarzschild::tortoise(at);
}

PlaneImages::PlaneImages(const PlaneView& view, double inner, double outer, bool with_times)
    : straight_(view.straight),
      orders_(view.straight ? 1 : kOrders),
      observer_w_(1 / view.at.r),
      inner_w_(1 / inner),
      outer_w_(1 / outer),
      least_(static_cast<std::size_t>(orders_), -HUGE_VAL),
      greatest_(static_cast<std::size_t>(orders_), HUGE_VAL) {
  if (!straight_) tabulate(view, with_times);
}

void PlaneImages::tabulate(const PlaneView& view, bool with_times) {
  LabelledRays rays(view);
  constexpr int kNodes = kOrders * kPerHalfTurn + 1, kBlock = RayPlaces::kSize;
  low_.resize(kNodes);
  high_.resize(kNodes);
  w_.resize(static_cast<std::size_t>(kNodes) * (kParts + 1));
  // For small psi, w is observer_w_ + p psi.  So at psi = 0 the tabulated p psi/(1 + psi) is the
  // difference from observer_w_ to a rim, and w is linear in u between the rims.
  low_[0] = outer_w_ - observer_w_;
  high_[0] = inner_w_ - observer_w_;
  for (int part = 0; part <= kParts; ++part)
    w_[static_cast<std::size_t>(part)] =
        static_cast<float>(outer_w_ + (inner_w_ - outer_w_) * part / kParts);
  if (with_times) {
    times_.resize(w_.size());
    for (int part = 0; part <= kParts; ++part)
      times_[static_cast<std::size_t>(part)] =
          radial_time(view, 1 / static_cast<double>(w_[static_cast<std::size_t>(part)]));
  }
  std::vector<double> psi(kNodes), low(kNodes), high(kNodes);
  for (int k = 0; k < kNodes; ++k) psi[static_cast<std::size_t>(k)] = k * pi / kPerHalfTurn;
  for (int first = 1; first < kNodes; first += kBlock) {
    const int count = std::min(kBlock, kNodes - first);
    solve(rays, outer_w_, &psi[static_cast<std::size_t>(first)], count,
          &low[static_cast<std::size_t>(first)]);
    solve(rays, inner_w_, &psi[static_cast<std::size_t>(first)], count,
          &high[static_cast<std::size_t>(first)]);
  }
  // Between the rims of each node, w and the times are found at even steps of p.
  for (std::size_t k = 1; k < kNodes; ++k) {
    const double share = psi[k] / (1 + psi[k]);
    low_[k] = low[k] * share;
    high_[k] = high[k] * share;
    RayPlaces::Column tangent{}, turn{}, w{}, times{};
    for (std::size_t part = 0; part <= kParts; ++part) {
      tangent[part] =
          rays.log_tangent(low[k] + (high[k] - low[k]) * static_cast<double>(part) / kParts);
      turn[part] = psi[k];
    }
    rays.find(tangent.data(), turn.data(), kParts + 1, w.data(),
              with_times ? times.data() : nullptr);
    for (std::size_t part = 0; with_times && part <= kParts; ++part)
      times_[k * (kParts + 1) + part] = std::max(times[part], kLongAgo);
    // At the rims w is known.  The rays found there may miss it where w is steep in p.
    w[0] = outer_w_;
    w[kParts] = inner_w_;
    for (std::size_t part = 0; part <= kParts; ++part)
      w_[k * (kParts + 1) + part] = static_cast<float>(std::clamp(w[part], outer_w_, inner_w_));
  }
  bound_orders(low, high);
}

// The bounds of an order are the extremes of its nodes, with a margin above the error of
// interval().
void PlaneImages::bound_orders(const std::vector<double>& low, const std::vector<double>& high) {
  for (int order = 1; order < kOrders; ++order) {
    const auto first = static_cast<std::ptrdiff_t>(order) * kPerHalfTurn;
    const auto of = [&](const std::vector<double>& p) {
      return std::minmax_element(p.begin() + first, p.begin() + first + kPerHalfTurn + 1);
    };
    const auto [l, lm] = of(low);
    const auto [hm, h] = of(high);
    const double margin = 1e-6 * (1 + std::abs(*h));
    least_[static_cast<std::size_t>(order)] = *l - margin;
    greatest_[static_cast<std::size_t>(order)] = *h + margin;
  }
}

PlaneImages::Interval PlaneImages::interval(double psi) const {
  if (straight_) {
    // A straight line has w'' = -w, so that w = w_0 cos psi + p sin psi with the observer's w_0.
    const SineCosine t = sin_cos(psi);
    const double sine = t.sine, cosine = t.cosine;
    const auto p = [&](double w) { return (w - observer_w_ * cosine) / sine; };
    const auto slope = [&](double w) { return (observer_w_ - w * cosine) / (sine * sine); };
    return {p(outer_w_), p(inner_w_), slope(outer_w_), slope(inner_w_)};
  }
  constexpr double kPerRadian = kPerHalfTurn / pi;
  const Place at = place_at(psi * kPerRadian, low_.size());
  const auto weights = cubic(at.t), slopes = cubic_slope(at.t);
  // The scale takes p psi/(1 + psi), which the table holds, back to p.
  const double scale = (1 + psi) / psi, scale_slope = -1 / (psi * psi);
  const double low = weighted_sum(&low_[at.first], weights),
               high = weighted_sum(&high_[at.first], weights);
  return {low * scale, high * scale,
          weighted_sum(&low_[at.first], slopes) * kPerRadian * scale + low * scale_slope,
          weighted_sum(&high_[at.first], slopes) * kPerRadian * scale + high * scale_slope};
}

double PlaneImages::inverse_radius(double psi, double u) const {
  if (straight_) return outer_w_ + (inner_w_ - outer_w_) * u;
  constexpr std::size_t kStride = kParts + 1;
  const Place turn = place_at(psi * (kPerHalfTurn / pi), low_.size()),
              part = place_at(u * kParts, kStride);
  const auto across = cubic(part.t), along = cubic(turn.t);
  double w = 0;
  for (std::size_t k = 0; k < 4; ++k)
    w += along[k] * weighted_sum(&w_[(turn.first + k) * kStride + part.first], across);
  return std::clamp(w, outer_w_, inner_w_);
}

PlaneImages::Moment PlaneImages::moment(double psi, double u) const {
  if (straight_) return {inverse_radius(psi, u), inner_w_ - outer_w_, 0, 0};
  constexpr std::size_t kStride = kParts + 1;
  const Place turn = place_at(psi * (kPerHalfTurn / pi), low_.size()),
              part = place_at(u * kParts, kStride);
  const auto across = cubic(part.t), slopes = cubic_slope(part.t), along = cubic(turn.t);
  Moment sum{};
  for (std::size_t k = 0; k < 4; ++k) {
    const std::size_t first = (turn.first + k) * kStride + part.first;
    sum.w += along[k] * weighted_sum(&w_[first], across);
    sum.w_slope += along[k] * weighted_sum(&w_[first], slopes) * kParts;
    sum.time += along[k] * weighted_sum(&times_[first], across);
    sum.time_slope += along[k] * weighted_sum(&times_[first], slopes) * kParts;
  }
  sum.w = std::clamp(sum.w, outer_w_, inner_w_);
  return sum;
}

}  // namespace domefall
