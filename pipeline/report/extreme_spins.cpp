#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "pipeline/light/kerr_ray.h"
#include "pipeline/report/extreme_cases.h"
#include "pipeline/report/ray_samples.h"

namespace domefall {
namespace {

constexpr double kHalfTurn = std::numbers::pi;

// A SpinWorst collects the largest errors of exact rays: of the place on the sky, and by how much the
// observer would see that moved.
class SpinWorst {
 public:
  void add(const KerrPlace& at, const KerrDirection& direction) {
    SpinRequest ray{at, direction};
    const SpinTruth truth = spin_truth(ray);
    const TracedKerr traced = trace_kerr(at, direction);
    const bool own = truth.sky == ReferenceSky::kOwn;
    ++rays_;
    if (truth.sky == ReferenceSky::kNone) {
      if (traced.origin != KerrOrigin::kPastHorizon) worst_ = HUGE_VAL;
      return;
    }
    if (traced.origin != (own ? KerrOrigin::kOwn : KerrOrigin::kParallel)) {
      worst_ = HUGE_VAL;
      return;
    }
    const V3d place(static_cast<double>(truth.place[0]), static_cast<double>(truth.place[1]),
                    static_cast<double>(truth.place[2]));
    const double off = (traced.sky - place).length();
    const double moves = std::max({traced.by_delta.length(), traced.across.length(), 1e-300});
    const bool finite = std::isfinite(off) && std::isfinite(traced.amplification) &&
                        std::isfinite(traced.by_delta.length() + traced.across.length());
    worst_ = std::max(worst_, finite ? off : HUGE_VAL);
    seen_ = std::max(seen_, off / moves);
  }
  ExtremeResult result(const std::string& more) const {
    return {worst_, fmt::format("{} rays; as angles of view {:.1e}. ", rays_, seen_) + more};
  }

 private:
  double worst_ = 0, seen_ = 0;
  int rays_ = 0;
};

// Adds rays from all over the view, and from the near side of each edge down to a part of 1e-12.
void add_view(SpinWorst& worst, const KerrHole& hole, long double r, long double theta) {
  constexpr double kLeast = 1e-12;
  const KerrPlace at{hole, r, theta};
  for (const double eta : {0.7, -1.1, kHalfTurn / 2}) {
    const CriticalRay edge = critical_ray(at, eta, KerrEdge::kSilhouette);
    const auto from = static_cast<double>(edge.delta);
    for (const double part : {1e-3, 0.5})
      worst.add(at, {from + part * (kHalfTurn - from), eta, {}, 0});
    for (const double part : {1e-6, kLeast})
      worst.add(at, {0, eta, KerrEdge::kSilhouette, part * (kHalfTurn - from)});
    if (at.delta() >= 0) continue;
    const auto disc = static_cast<double>(critical_ray(at, eta, KerrEdge::kRegionThree).delta);
    for (const double part : {0.9, 1e-6, kLeast})
      worst.add(at, {0, eta, KerrEdge::kRegionThree, -part * disc});
  }
}

ExtremeResult nearly_extremal() {
  SpinWorst worst;
  for (const long double r : {1.0005L, 2.0L, 100.0L}) add_view(worst, {0.999999L}, r, 1.57L);
  return worst.result(
      "Beside the flat side the sky is wound up by up to 1e4 radians, between the horizons 1e7");
}

ExtremeResult almost_no_spin() {
  SpinWorst worst;
  for (const long double r : {1.0L, 10.0L}) add_view(worst, {1e-9L}, r, 1);
  add_view(worst, {1e-15L}, 10, 1);
  return worst.result("As without a spin");
}

ExtremeResult far_from_a_spin() {
  SpinWorst worst;
  add_view(worst, {0.9L, 0.3L}, 1e6L, 0);
  add_view(worst, {0.9L, 0.3L}, 1e9L, 1);
  return worst.result("The silhouette has a radius of 5e-6 and 5e-9 rad");
}

ExtremeResult beside_its_horizon() {
  SpinWorst worst;
  const KerrHole hole{0.9L};
  for (const long double above : {1e-10L, 0.0L})
    add_view(worst, hole, hole.horizon() + above, 1.2L);
  const KerrPlace inside{hole, hole.horizon() - 1e-10L, 1.2L};
  for (const long double delta : {1.0L, 2.0L, 3.0L}) worst.add(inside, {delta, 0.7L, {}, 0});
  worst.add(inside, {1e-11L, 0.7L, {}, 0});
  return worst.result("Sky III is a disc of 1e-10 rad inside, and turns as it appears");
}

ExtremeResult above_its_inner_horizon() {
  SpinWorst worst;
  const KerrHole hole{0.9L};
  add_view(worst, hole, hole.inner_horizon() + 1e-6L, 1.2L);
  return worst.result("Light of I and III circles there by up to millions of radians");
}

ExtremeResult beside_its_axis() {
  SpinWorst worst;
  add_view(worst, {0.9L}, 10, 0);
  add_view(worst, {0.9L}, 10, 1e-9L);
  add_view(worst, {0.9L}, 1.2L, std::numbers::pi_v<long double> - 1e-9L);
  return worst.result("As away from the axis");
}

ExtremeResult principal_null_rays() {
  SpinWorst worst;
  for (const long double r : {1.0L, 1.2L, 10.0L, 1e6L})
    for (const long double delta :
         {0.0L, 1e-12L, std::numbers::pi_v<long double> - 1e-12L, std::numbers::pi_v<long double>})
      worst.add({{0.9L}, r, 1.2L}, {delta, 0.7L, {}, 0});
  return worst.result("The light of K = 0, at delta = 0 and pi");
}

// Light of L = 0 goes through the axis, and its neighbours turn about it within no time.
ExtremeResult through_its_axis() {
  SpinWorst worst;
  for (const long double r : {1.2L, 1000.0L})
    for (const long double theta : {0.5L, 1.2L}) {
      const KerrPlace at{{0.9L}, r, theta};
      const long double a = 0.9L, big = r * r + at.sigma(), root = std::sqrt(big);
      for (const long double delta : {0.8L, 1.5L, 2.5L}) {
        // L = Y + aE sin^2(theta), of which E = (Sigma s^2 + Delta c^2 + aY)/Sigma
        const long double s = std::sin(delta / 2), c = std::cos(delta / 2), side = std::sin(theta);
        const long double free = (big * s * s + at.delta() * c * c) / big;
        const long double y = -a * free * side * side / (1 + a * a * side * side / big);
        const long double sine = y / (root * side * std::sin(delta));
        if (std::abs(sine) > 1) continue;
        for (const long double by : {0.0L, 1e-12L, -1e-9L})
          for (const bool up : {false, true}) {
            const long double eta = std::asin(sine);
            worst.add(at, {delta, (up ? eta : std::numbers::pi_v<long double> - eta) + by, {}, 0});
          }
      }
    }
  return worst.result("Nothing happens on the axis");
}

}  // namespace

std::vector<ExtremeCase> extreme_spins() {
  const std::string place = "error of the place on the sky, radians";
  return {{"NearlyExtremalSpin", "a = 0.999999, r = 1.0005 to 100", place, 1e-8, nearly_extremal},
          {"AlmostNoSpin", "a = 1e-9 and 1e-15", place, 1e-11, almost_no_spin},
          {"FarFromASpin", "r = 1e6 and 1e9", place, 1e-11, far_from_a_spin},
          {"BesideTheHorizonOfASpin", "r = r_+ and r_+ ± 1e-10", place, 1e-9, beside_its_horizon},
          {"AboveTheInnerHorizonOfASpin", "r = r_- + 1e-6", place, 1e-8, above_its_inner_horizon},
          {"BesideTheAxisOfASpin", "theta = 0, 1e-9 and pi - 1e-9", place, 1e-11, beside_its_axis},
          {"PrincipalNullRays", "delta = 0, 1e-12, pi - 1e-12 and pi", place, 1e-13,
           principal_null_rays},
          {"ThroughTheAxisOfASpin", "L = 0, and eta up to 1e-6 beside that", place, 1e-13,
           through_its_axis}};
}

}  // namespace domefall
