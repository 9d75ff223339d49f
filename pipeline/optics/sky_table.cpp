#include "pipeline/optics/sky_table.h"

#include <cmath>
#include <numbers>

#include "pipeline/optics/exact_azimuth.h"
#include "pipeline/optics/silhouette.h"

namespace domefall {
namespace {

using std::numbers::pi;

constexpr int kDegree = 15;          // of a Chebyshev panel
constexpr double kPanelOctaves = 2;  // its width
constexpr int kMaxOctaves = 63;      // 16 nodes each: at most 1,009 nodes
// Where the logarithmic law takes over, in units of the smallest angle of the scene.
constexpr double kInnermost = 1e-11;

struct Derivatives {
  double value, first, second;
};

// Chebyshev interpolation over [low, high], with derivatives.
class Panel {
 public:
  template <class F>
  Panel(double low, double high, F f) : middle_((low + high) / 2), half_((high - low) / 2) {
    std::array<double, kDegree + 1> sample;
    for (int k = 0; k <= kDegree; ++k)
      sample[k] = f(middle_ + half_ * std::cos(pi * (k + 0.5) / (kDegree + 1)));
    for (int j = 0; j <= kDegree; ++j) {
      double sum = 0;
      for (int k = 0; k <= kDegree; ++k)
        sum += sample[k] * std::cos(pi * j * (k + 0.5) / (kDegree + 1));
      value_[j] = sum * (j == 0 ? 1 : 2) / (kDegree + 1);
    }
    first_ = differentiated(value_);
    second_ = differentiated(first_);
  }

  double low() const { return middle_ - half_; }

  Derivatives at(double y) const {
    const double t = (y - middle_) / half_;
    return {clenshaw(value_, t), clenshaw(first_, t) / half_,
            clenshaw(second_, t) / (half_ * half_)};
  }

 private:
  using Series = std::array<double, kDegree + 1>;

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
  Series value_{}, first_{}, second_{};
};

// phi continued oddly through the end of the sky (delta = pi or 0), so that the last interval may
// reach beyond it.
double continued_azimuth(const Radius& at, Edge edge, double sign, double reach, double x) {
  const double offset = 4 * std::atan(x / 2);
  const double inside = offset <= reach ? offset : 2 * reach - offset;
  const double phi = exact_azimuth(ray_off_edge(at, edge, sign * inside));
  return offset <= reach ? phi : -phi;
}

// The quintic on [0, 1] with these values, slopes and curvatures at 0 and 1.
std::array<double, 6> quintic(const Derivatives& a, const Derivatives& b) {
  const double rise = b.value - a.value - a.first - a.second / 2;
  const double bend = b.first - a.first - a.second;
  const double curl = b.second - a.second;
  return {a.value,
          a.first,
          a.second / 2,
          10 * rise - 4 * bend + curl / 2,
          -15 * rise + 7 * bend - curl,
          6 * rise - 3 * bend + curl / 2};
}

}  // namespace

SkyTable::SkyTable(const Radius& at, Edge edge) : sign_(edge == Edge::kSilhouette ? 1 : -1) {
  const double tangent =
      edge == Edge::kSilhouette ? tan_half_silhouette(at) : tan_half_region_three(at);
  edge_angle_ = 2 * std::atan(tangent);
  cos_edge_ = 1 / std::sqrt(1 + tangent * tangent);
  sin_edge_ = tangent * cos_edge_;
  // pi - edge is 2 acot(tangent): no difference of close numbers when the edge is near pi.
  const double reach = edge == Edge::kSilhouette ? 2 * std::atan2(1.0, tangent) : edge_angle_;
  x_max_ = 2 * std::tan(reach / 4);
  const std::int64_t end_key = key(x_max_) + 1;
  // Deep inside, the two edges close in on each other and the law sets in only between them.
  const double apart = 2 * at.r / (std::sqrt(27.0) * (1 + std::sqrt(2 / at.r)));
  const double innermost = kInnermost * std::min({1.0, edge_angle_, apart});
  const int octaves =
      std::min(kMaxOctaves, static_cast<int>(std::ceil(std::log2(x_max_ / innermost))));
  first_key_ = end_key - (static_cast<std::int64_t>(octaves) << kPerOctaveBits);
  x_min_ = key_start(first_key_);

  const double top = std::log(key_start(end_key)), width = kPanelOctaves * std::numbers::ln2;
  const auto exact = [&](double y) {
    return continued_azimuth(at, edge, sign_, reach, std::exp(y));
  };
  Panel panel(top - width, top, exact);
  // Derivatives with respect to ln x, turned into those with respect to x.
  const auto at_key = [&](std::int64_t k) {
    const double x = key_start(k), y = std::log(x);
    while (y < panel.low() - 1e-9) panel = Panel(panel.low() - width, panel.low(), exact);
    const Derivatives d = panel.at(y);
    return Derivatives{d.value, d.first / x, (d.second - d.first) / (x * x)};
  };
  intervals_.resize(static_cast<std::size_t>(end_key - first_key_));
  Derivatives high = at_key(end_key);
  for (std::int64_t k = end_key - 1; k >= first_key_; --k) {
    const Derivatives low = at_key(k);
    const double start = key_start(k), h = key_start(k + 1) - start;
    intervals_[static_cast<std::size_t>(k - first_key_)] = {
        start, 1 / h,
        quintic({low.value, low.first * h, low.second * h * h},
                {high.value, high.first * h, high.second * h * h})};
    high = low;
  }
  first_value_ = high.value;
}

double SkyTable::slope(double x) const {
  const double stretch = (1 + x * x / 4) / 2;  // dx/ddelta
  if (x < x_min_) return stretch / x;
  const Interval& q = interval(x);
  const double u = (x - q.start) * q.inverse_width;
  const double d = q.c[1] + u * (2 * q.c[2] + u * (3 * q.c[3] + u * (4 * q.c[4] + u * 5 * q.c[5])));
  return std::abs(d * q.inverse_width) * stretch;
}

double SkyTable::distance(double phi) const {
  if (phi <= 0) return x_max_;
  if (phi > first_value_) return x_min_ * std::exp(first_value_ - phi);
  // phi falls with x: the last interval that starts at or above it.
  const auto after = std::partition_point(intervals_.begin(), intervals_.end(),
                                          [phi](const Interval& q) { return q.c[0] >= phi; });
  const Interval& q = *(after - 1);
  double low = 0, high = 1, u = 0.5;
  for (int step = 0; step < 60; ++step) {
    const double value =
        q.c[0] + u * (q.c[1] + u * (q.c[2] + u * (q.c[3] + u * (q.c[4] + u * q.c[5])))) - phi;
    const double d =
        q.c[1] + u * (2 * q.c[2] + u * (3 * q.c[3] + u * (4 * q.c[4] + u * 5 * q.c[5])));
    (value > 0 ? low : high) = u;
    double next = u - value / d;
    if (!(next >= low && next <= high)) next = (low + high) / 2;
    if (std::abs(next - u) < 1e-16) break;
    u = next;
  }
  return std::min(q.start + u / q.inverse_width, x_max_);
}

double SkyTable::delta_at(double x) const { return edge_angle_ + sign_ * 4 * std::atan(x / 2); }

double SkyTable::distance_at(double delta) const {
  return 2 * std::tan(sign_ * (delta - edge_angle_) / 4);
}

}  // namespace domefall
