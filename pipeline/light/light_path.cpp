#include "pipeline/light/light_path.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "pipeline/base/simd/vector_math.h"
#include "pipeline/light/plane_clock.h"

namespace domefall {
namespace {

// The longest steps, in radians (less where 1/w is within the light circle) and as a part of w, and
// where a path ends.
constexpr double kMostStep = 0.05, kMostChange = 0.08;
constexpr double kMostTurn = 3.5 * std::numbers::pi;

// The law of the orbit.
class Orbit {
 public:
  explicit Orbit(const PlaneView& view) : straight_(view.straight) {
    if (const auto* hole = std::get_if<ChargedHole>(&view.space.kind()))
      charge_squared_ = hole->charge * hole->charge;
  }

  // w and its slope after a step, by the method of Runge and Kutta.
  void step(double h, double& w, double& slope) const {
    const double k1 = bend(w), v1 = slope;
    const double k2 = bend(w + h / 2 * v1), v2 = slope + h / 2 * k1;
    const double k3 = bend(w + h / 2 * v2), v3 = slope + h / 2 * k2;
    const double k4 = bend(w + h * v3), v4 = slope + h * k3;
    w += h / 6 * (v1 + 2 * v2 + 2 * v3 + v4);
    slope += h / 6 * (k1 + 2 * k2 + 2 * k3 + k4);
  }

 private:
  double bend(double w) const {
    return straight_ ? -w : w * (3 * w - 1 - 2 * charge_squared_ * w * w);
  }

  bool straight_;
  double charge_squared_ = 0;
};

}  // namespace

LightPath light_path(const PlaneView& view, double alpha, double outer) {
  const SineCosine half = sin_cos(alpha / 2);
  const double w0 = 1 / view.at.r, f0 = view.lapse_squared();
  const bool outgoing = is_outgoing(view.tetrad) && !view.straight;
  const ViewEnergy law = view.energy();
  LightPath path;
  double w = w0, slope;
  if (view.straight) {
    const double cosine = half.cosine * half.cosine - half.sine * half.sine;
    slope = w0 * cosine / (2 * half.sine * half.cosine);
    path.energy = std::sqrt(f0);
  } else {
    const double a = law.cosine2 * half.cosine / half.sine, b = law.sine2 * half.sine / half.cosine;
    slope = (outgoing ? b - a : a - b) * w0 / 2;
    path.energy = (is_mirrored(view.tetrad) ? -1 : 1) *
                  (law.cosine2 * half.cosine * half.cosine + law.sine2 * half.sine * half.sine);
  }
  path.momentum =
      path.energy / std::sqrt(std::max(slope * slope + (view.straight ? 1 : f0) * w0 * w0, 1e-300));
  // Light from the other side of the hole does not come from region I.
  if (!(path.energy > 0)) return path;
  const double least = 1 / outer, horizon = 1 / view.space.horizon(),
               e = path.energy / path.momentum;
  const Orbit orbit(view);
  const PlaneClock clock(view, 0);
  double psi = 0, time = 0, tortoise = clock.tortoise(view.at.r);
  path.rate = path.momentum;
  path.about = {0, 0, -path.momentum};
  path.places.push_back({psi, w, slope, V3d(1, 0, 0), V3d(0, 1, 0), time});
  while (psi < kMostTurn) {
    if (slope < 0 ? w < least : !view.straight && w > horizon) break;
    const double h = std::min(kMostStep / std::max(1.0, 3 * w),
                              kMostChange * w / std::max(std::abs(slope), 1e-9 * w));
    double middle_w = w, middle = slope, next_w = w, next = slope;
    orbit.step(h / 2, middle_w, middle);
    orbit.step(h, next_w, next);
    psi += h;
    if (!view.straight) {
      // Light that moves out keeps u but for the integral, and light that falls keeps v.
      const auto rate = [&](double s) { return 1 / (e + std::abs(s)); };
      time -= h / 6 * (rate(slope) + 4 * rate(middle) + rate(next));
      const double there = clock.tortoise(1 / next_w);
      if ((next_w > w) != outgoing) time -= 2 * std::abs(there - tortoise);
      tortoise = there;
    }
    w = next_w, slope = next;
    if (!(w > 0)) w = 1e-9 * least;
    const SineCosine turned = sin_cos(psi);
    path.places.push_back({psi, w, slope, V3d(turned.cosine, turned.sine, 0),
                           V3d(-turned.sine, turned.cosine, 0), time});
  }
  if (path.places.size() == 1) path.places.clear();
  return path;
}

}  // namespace domefall
