#include "pipeline/render/stars/lens_curve.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace domefall {
namespace {

using std::numbers::pi;

// Where the slope of Hermite's cubic errs most, 1/2 - 1/sqrt 12; its value errs there by 4/9 of
// what it does in the middle.
constexpr double kTested = 0.21132486540518712;
constexpr double kOfTheMiddle = 4.0 / 9;

// What bounds a product of three factors on an interval by their values at three of its points.
// Each is monotone, but where it turns, which costs it an eighth of the square of a step that the
// factor makes in a fraction of a per cent.
constexpr double kBetween = 1.001;
constexpr double kUnbounded = 1e37;  // and all that is larger; a float

// The exact image of a source whose light has swept phi.
struct Exact {
  double psi, slope;  // as LensCurve::View
  double sine, energy;
  double from_edge;  // radians, to full relative accuracy

  double light() const { return slope * sine / (energy * energy * energy * energy); }
};

Exact exact(const SkyTable& table, double phi) {
  const double x = table.distance(phi);
  const NullRay ray = table.ray_at_distance(x);
  const double from_edge = 4 * std::atan(x / 2);
  return {4 * std::atan(table.x_max() / 2) - from_edge, 1 / table.slope(x),
          2 * ray.sin_half * ray.cos_half, one_plus_z(ray), from_edge};
}

// Over the interval that has these three on it.
double most_light(const Exact& a, const Exact& b, const Exact& c) {
  const auto most = [](double p, double q, double r) { return std::max({p, q, r}); };
  const double sine = std::min(1.0, most(a.sine, b.sine, c.sine) + std::abs(a.psi - c.psi) / 2);
  const double energy = std::min({a.energy, b.energy, c.energy});
  return sine * most(a.slope, b.slope, c.slope) / (energy * energy * energy * energy) * kBetween;
}

double light_of(const LensCurve::View& view, const PsiFrame& frame) {
  const double s = std::sin(view.psi / 2), c = std::cos(view.psi / 2);
  return Exact{view.psi, view.slope, 2 * s * c,
               std::abs(frame.sine2 * s * s + frame.cosine2 * c * c), 0}
      .light();
}

}  // namespace

// From there to the edge the slope falls, and energy and angle lie between those of the two ends.
double most_light_from(const SkyTable& table, int order) {
  const Exact from = exact(table, order * pi);
  const NullRay edge = table.ray_at_distance(0);
  const Exact to{4 * std::atan(table.x_max() / 2), 0, 2 * edge.sin_half * edge.cos_half,
                 one_plus_z(edge), 0};
  return most_light(from, from, to);
}

PsiFrame psi_frame(const SkyTable& table) {
  const NullRay ray = table.ray_at_distance(table.x_max());
  const double s = std::sqrt(2 / ray.at.r), less = ray.at.above_horizon / (ray.at.r * (1 + s));
  // Beyond the first edge psi is pi - alpha, else alpha; alpha counts from -R in rain.
  if (table.edge().sign > 0) return {less, 1 + s, 1};
  return {1 + s, less, ray.outgoing ? 1.0 : -1.0};
}

LensCurve::View LensCurve::operator()(double v) const {
  const Lookup curve = lookup();
  const Lookup::Index at = curve(v);
  const double* c = at.coefficients;
  return curve.view(v, at.share, c[0], c[1], c[2], c[3]);
}

LensCurve::LensCurve(const SkyTable& table, int pair, int intervals, const Wanted& wanted)
    : coefficients_(4 * static_cast<std::size_t>(intervals)),
      bound_(static_cast<std::size_t>(intervals)),
      intervals_(intervals) {
  const double middle = (2 * pair + 1) * pi, width = 2.0 / intervals;
  const PsiFrame frame = psi_frame(table);
  const auto at = [&](double v) { return exact(table, middle - 4 * std::atan(v)); };
  // d psi/d v times the width: phi falls with v, psi grows with phi.
  const auto by_interval = [&](const Exact& e, double v) {
    return -e.slope * 4 / (1 + v * v) * width;
  };
  Exact low = at(-1);
  for (int i = 0; i < intervals; ++i) {
    const double v = -1 + i * width, next = -1 + (i + 1) * width;
    const Exact high = at(next), tested = at(v + kTested * width);
    const double d0 = by_interval(low, v), d1 = by_interval(high, next);
    const double rise = low.from_edge - high.from_edge;
    double* c = &coefficients_[4 * static_cast<std::size_t>(i)];
    c[0] = low.psi, c[1] = d0, c[2] = 3 * rise - 2 * d0 - d1, c[3] = d0 + d1 - 2 * rise;
    const View found = (*this)(v + kTested * width);
    const double light = tested.light(), most = most_light(low, tested, high);
    const bool good = std::abs(found.psi - tested.psi) < kOfTheMiddle * wanted.position &&
                      std::abs(light_of(found, frame) - light) < wanted.flux * light;
    bound_[static_cast<std::size_t>(i)] =
        static_cast<float>(good ? std::min(most, kUnbounded) : -1);
    double& largest = largest_[v + width / 2 > 0 ? 0 : 1];
    largest = std::max(largest, most);
    low = high;
  }
}

}  // namespace domefall
