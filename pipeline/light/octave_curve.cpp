#include "pipeline/light/octave_curve.h"

#include <cmath>
#include <numbers>

#include "trajectories/square.h"

namespace domefall {
namespace {

constexpr int kDegree = 15;  // of a Chebyshev panel
// A panel's width is in octaves.  Near x_max the end of the function's range makes itself felt.
constexpr double kPanelOctaves = 2, kTopPanelOctaves = 1;
constexpr int kTopPanels = 4;

struct Derivatives {
  double value, first, second, third;
};

double cube(double x) { return x * x * x; }

using Series = std::array<double, kDegree + 1>;

// The table holds cos(pi j (k + 1/2) / (n + 1)), and row 1 holds the sample points.
const std::array<Series, kDegree + 1>& cosines() {
  static const auto table = [] {
    std::array<Series, kDegree + 1> t;
    for (int j = 0; j <= kDegree; ++j)
      for (int k = 0; k <= kDegree; ++k)
        t[j][k] = std::cos(std::numbers::pi * j * (k + 0.5) / (kDegree + 1));
    return t;
  }();
  return table;
}

// A Panel is Chebyshev interpolation over [low, high], with derivatives.
class Panel {
 public:
  template <class F>
  Panel(double low, double high, F f) : middle_((low + high) / 2), half_((high - low) / 2) {
    const auto& c = cosines();
    Series sample;
    for (int k = 0; k <= kDegree; ++k) sample[k] = f(middle_ + half_ * c[1][k]);
    for (int j = 0; j <= kDegree; ++j) {
      double sum = 0;
      for (int k = 0; k <= kDegree; ++k) sum += sample[k] * c[j][k];
      value_[j] = sum * (j == 0 ? 1 : 2) / (kDegree + 1);
    }
    first_ = differentiated(value_);
    second_ = differentiated(first_);
    third_ = differentiated(second_);
  }

  double low() const { return middle_ - half_; }

  Derivatives at(double y) const {
    const double t = (y - middle_) / half_;
    return {clenshaw(value_, t), clenshaw(first_, t) / half_, clenshaw(second_, t) / square(half_),
            clenshaw(third_, t) / cube(half_)};
  }

 private:
  static Series differentiated(const Series& c) {
    Series d{};
    for (int j = kDegree; j >= 1; --j) d[j - 1] = (j + 1 <= kDegree ? d[j + 1] : 0) + 2 * j * c[j];
    d[0] /= 2;
    return d;
  }

  static double clenshaw(const Series& c, double t) {
    double b1 = 0, b2 = 0;
    for (int j = kDegree; j >= 1; --j) {
      const double b = c[j] + 2 * t * b1 - b2;
      b2 = b1;
      b1 = b;
    }
    return c[0] + t * b1 - b2;
  }

  double middle_, half_;
  Series value_{}, first_{}, second_{}, third_{};
};

// Returns the polynomial of degree 7 on [0, 1] with these derivatives at 0 and 1.
std::array<double, 8> hermite_between(const Derivatives& a, const Derivatives& b) {
  const double c2 = a.second / 2, c3 = a.third / 6;
  const double r0 = b.value - a.value - a.first - c2 - c3;
  const double r1 = b.first - a.first - a.second - a.third / 2;
  const double r2 = b.second - a.second - a.third;
  const double r3 = b.third - a.third;
  return {a.value,
          a.first,
          c2,
          c3,
          35 * r0 - 15 * r1 + 2.5 * r2 - r3 / 6,
          -84 * r0 + 39 * r1 - 7 * r2 + r3 / 2,
          70 * r0 - 34 * r1 + 6.5 * r2 - r3 / 2,
          -20 * r0 + 10 * r1 - 2 * r2 + r3 / 6};
}

// Turns derivatives with respect to x into those with respect to x/h.
Derivatives stretched(const Derivatives& d, double h) {
  return {d.value, d.first * h, d.second * square(h), d.third * cube(h)};
}

// Turns derivatives with respect to ln x into those with respect to x.
Derivatives from_logarithm(const Derivatives& d, double x) {
  return {d.value, d.first / x, (d.second - d.first) / square(x),
          (d.third - 3 * d.second + 2 * d.first) / cube(x)};
}

}  // namespace

OctaveCurve::OctaveCurve(double x_min, double x_max, const std::function<double(double)>& f,
                         int bits)
    : shift_(52 - bits), first_key_(key(x_min, shift_)) {
  const std::int64_t end_key = key(x_max, shift_) + 1;
  x_min_ = key_start(first_key_);
  const auto in_log = [&](double y) { return f(std::exp(y)); };
  const auto panel_below = [&in_log](double top, int number) {
    const double octaves = number < kTopPanels ? kTopPanelOctaves : kPanelOctaves;
    return Panel(top - octaves * std::numbers::ln2, top, in_log);
  };
  int panels = 0;
  Panel panel = panel_below(std::log(key_start(end_key)), panels++);
  const auto at_key = [&](std::int64_t k) {
    const double x = key_start(k), y = std::log(x);
    while (y < panel.low() - 1e-9) panel = panel_below(panel.low(), panels++);
    return from_logarithm(panel.at(y), x);
  };
  intervals_.resize(static_cast<std::size_t>(end_key - first_key_));
  Derivatives high = at_key(end_key);
  for (std::int64_t k = end_key - 1; k >= first_key_; --k) {
    const Derivatives low = at_key(k);
    const double start = key_start(k), h = key_start(k + 1) - start;
    intervals_[static_cast<std::size_t>(k - first_key_)] = {
        hermite_between(stretched(low, h), stretched(high, h))};
    high = low;
  }
}

OctaveCurve::Jet OctaveCurve::at_unit(const Interval& q, double u) {
  double second = 0;
  for (int k = kTerms - 1; k >= 2; --k) second = second * u + k * (k - 1) * q.c[k];
  return {polynomial(q.c, u), polynomial_slope(q.c, u), second};
}

OctaveCurve::Jet OctaveCurve::at(double x) const {
  const Interval& q = interval(x);
  const double by_x = inverse_width(q);
  const Jet jet = at_unit(q, (x - start(q)) * by_x);
  return {jet.value, jet.first * by_x, jet.second * square(by_x)};
}

bool OctaveCurve::is_monotone(double x_end) const {
  constexpr int kSlopeDegree = kTerms - 2;
  const bool rising = intervals_.front().c[0] < intervals_.back().c[0];
  for (const Interval& q : intervals_) {
    if (start(q) + 1 / inverse_width(q) >= x_end) return true;
    // b_j is the sum over k <= j of C(j, k)/C(n, k) times the k-th coefficient.
    for (int j = 0; j <= kSlopeDegree; ++j) {
      double sum = 0, weight = 1;
      for (int k = 0; k <= j; ++k) {
        sum += weight * (k + 1) * q.c[k + 1];
        weight *= static_cast<double>(j - k) / (kSlopeDegree - k);
      }
      if (!(rising ? sum > 0 : sum < 0)) return false;
    }
  }
  return true;
}

double OctaveCurve::inverse(double wanted, double x_end) const {
  const bool rising = intervals_.front().c[0] < value(x_end);
  const auto before = [&](const Interval& q) {
    return start(q) <= x_end && (rising ? q.c[0] <= wanted : q.c[0] >= wanted);
  };
  // This finds the last interval that starts before the wanted value.
  const auto after = std::partition_point(intervals_.begin(), intervals_.end(), before);
  const Interval& q = after == intervals_.begin() ? *after : *(after - 1);
  double low = 0, high = std::min(1.0, (x_end - start(q)) * inverse_width(q)), u = high / 2;
  for (int step = 0; step < 100; ++step) {
    const Jet jet = at_unit(q, u);
    const double excess = jet.value - wanted;
    ((excess > 0) == rising ? high : low) = u;
    double next = u - excess / jet.first;
    if (!(next >= low && next <= high)) next = (low + high) / 2;
    if (std::abs(next - u) <= 1e-16) break;
    u = next;
  }
  return start(q) + u / inverse_width(q);
}

}  // namespace domefall
