#include "pipeline/light/lens_curve.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace domefall {
namespace {

using std::numbers::pi;

// Intervals are tested where the slope of Hermite's cubic errs most.  The cubic's error is
// proportional to t^2 (1 - t)^2, whose slope has its extremum at t = 1/2 - 1/sqrt 12.  There t (1 -
// t) is 1/6, and the error is 4/9 of that in the middle, where t (1 - t) is 1/4.
constexpr double kTested = 0.21132486540518712;
constexpr double kErrorThere = 4.0 / 9;

// The light on an interval is bounded by the product of the largest values that its three factors
// have at the ends and at the tested point.  A factor with an extremum between these points exceeds
// them by at most f''/8 times the square of their distance, which is what kBetween leaves room for.
constexpr double kBetween = 1.001;
constexpr double kUnbounded = 1e37;  // replaces any larger bound; it is within a float

// An Exact is the image of a source whose light has swept phi, found by inverting the table.  Where
// no light sweeps so much, it has no light and lies on the edge.
struct Exact {
  double psi, slope;    // as LensCurve::View has them
  double sine, energy;  // sin(psi), and 1 + z of the free-fall observer
  double from_edge;     // angle from the sky's edge in radians, to full relative accuracy

  // Returns amplification * |sin phi_star| / (1 + z)^4.  The amplification is the ratio of the
  // solid angles, |sin psi d psi/(sin phi d phi)|.
  double light() const { return slope * sine / (energy * energy * energy * energy); }
};

Exact exact(const SkyTable& table, double phi) {
  const double x = table.distance(phi);
  const ZoneRay ray = table.ray_at_distance(x);
  const double from_edge = 4 * std::atan(x / 2);
  const double slope = phi < table.most_azimuth() ? 1 / table.slope(x) : 0;
  return {4 * std::atan(table.x_max() / 2) - from_edge, slope, ray.sine(), ray.one_plus_z,
          from_edge};
}

// Returns an upper bound of light() on the interval between a and c, in which b lies.  No sine
// exceeds the larger one of the two ends by more than half the width in psi, because every psi is
// at most that far from an end.
double most_light(const Exact& a, const Exact& b, const Exact& c) {
  const auto most = [](double p, double q, double r) { return std::max({p, q, r}); };
  const double sine = std::min(1.0, most(a.sine, b.sine, c.sine) + std::abs(a.psi - c.psi) / 2);
  const double energy = std::min({a.energy, b.energy, c.energy});
  return sine * most(a.slope, b.slope, c.slope) / (energy * energy * energy * energy) * kBetween;
}

double light_of(const LensCurve::View& view, const PsiFrame& frame) {
  const double s = std::sin(view.psi / 2), c = std::cos(view.psi / 2);
  const ViewEnergy& energy = frame.energy;
  return Exact{view.psi, view.slope, 2 * s * c,
               energy.one_plus_z(energy.sine2 * s * s + energy.cosine2 * c * c), 0}
      .light();
}

}  // namespace

// From this order to the edge the slope falls, and the energy and the angle lie between their
// values at the two ends.  At a level edge there is no bound.
double most_light_from(const SkyTable& table, int order) {
  if (std::isfinite(table.most_azimuth()))
    return order * pi < table.most_azimuth() ? kUnbounded : 0;
  const Exact from = exact(table, order * pi);
  const ZoneRay edge = table.ray_at_distance(0);
  const Exact to{4 * std::atan(table.x_max() / 2), 0, edge.sine(), edge.one_plus_z, 0};
  return most_light(from, from, to);
}

// Beyond an edge psi is pi - alpha, and before one it is alpha.
PsiFrame psi_frame(const SkyTable& table) {
  const SkyZone& zone = table.zone();
  const ViewEnergy& e = zone.energy;
  if (zone.edge.sign > 0) return {{e.cosine2, e.sine2, e.least}, zone.inward};
  return {e, -zone.inward};
}

LensCurve::View LensCurve::operator()(double v) const {
  const Lookup curve = lookup();
  const Lookup::Index at = curve(v);
  const double* c = at.coefficients;
  return curve.view(v, at.share, c[0], c[1], c[2], c[3]);
}

LensCurve::LensCurve(const SkyTable& table, int pair, int intervals,
                     const PointTolerance& tolerance)
    : coefficients_(4 * static_cast<std::size_t>(intervals)),
      bound_(static_cast<std::size_t>(intervals)),
      intervals_(intervals) {
  const double middle = (2 * pair + 1) * pi, width = 2.0 / intervals;
  const PsiFrame frame = psi_frame(table);
  const auto at = [&](double v) { return exact(table, middle - 4 * std::atan(v)); };
  // This is d psi/d v times the width.  The azimuth falls with v by d phi/d v = -4/(1 + v^2).
  const auto by_interval = [&](const Exact& e, double v) {
    return -e.slope * 4 / (1 + v * v) * width;
  };
  Exact low = at(-1);
  for (int i = 0; i < intervals; ++i) {
    const double v = -1 + i * width, next = -1 + (i + 1) * width;
    const Exact high = at(next), tested = at(v + kTested * width);
    const double d0 = by_interval(low, v), d1 = by_interval(high, next);
    const double rise = low.from_edge - high.from_edge;
    // These are the coefficients of Hermite's cubic with the slopes d0 and d1 at its ends.
    double* c = &coefficients_[4 * static_cast<std::size_t>(i)];
    c[0] = low.psi;
    c[1] = d0;
    c[2] = 3 * rise - 2 * d0 - d1;
    c[3] = d0 + d1 - 2 * rise;
    const View found = (*this)(v + kTested * width);
    const double light = tested.light();
    const bool lit = high.slope > 0, level = lit && !(low.slope > 0);
    const double most = !lit ? 0 : level ? kUnbounded : most_light(low, tested, high);
    const bool good =
        !lit || (!level && std::abs(found.psi - tested.psi) < kErrorThere * tolerance.position &&
                 std::abs(light_of(found, frame) - light) < tolerance.flux * light);
    bound_[static_cast<std::size_t>(i)] =
        static_cast<float>(good ? std::min(most, kUnbounded) : -1);
    double& largest = largest_[v + width / 2 > 0 ? 0 : 1];
    largest = std::max(largest, most);
    low = high;
  }
}

}  // namespace domefall
