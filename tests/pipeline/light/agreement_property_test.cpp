// Three ways to follow a ray, of which no two share a formula, over random observers and rays: the
// table that frames are made from, the exact integral, and Binet's equation integrated by an
// eighth-order method.  A million rays: RC_PARAMS="max_success=1000 seed=..." test_optics
#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <cmath>
#include <cstdlib>
#include <numbers>

#include "pipeline/light/traced_ray.h"
#include "tests/sanitized.h"

namespace domefall {
namespace {

using std::numbers::pi;

// Of 100 observers, so many rays each: of 150,000, 100,000 and more are far enough from an edge for
// all three ways.
constexpr int kRaysEach = tries(1500, 150);

// The same rays in every run, unless the environment asks for others.
const int kSeeded = setenv("RC_PARAMS", "seed=20151106 noshrink=1", 0);

struct Place {
  TraceObserver observer;
  double r;
};

// A number in [low, high], dense in its logarithm.
rc::Gen<double> logarithmic(double low, double high) {
  constexpr int kSteps = 1 << 24;
  return rc::gen::map(rc::gen::inRange(0, kSteps + 1), [low, high](int k) {
    return low * std::exp(std::log(high / low) * k / kSteps);
  });
}

rc::Gen<Place> places() {
  return rc::gen::mapcat(
      rc::gen::element(TraceObserver::kRain, TraceObserver::kStatic, TraceObserver::kOutgoing,
                       TraceObserver::kTwo, TraceObserver::kFour),
      [](TraceObserver observer) {
        const bool inside = observer == TraceObserver::kTwo || observer == TraceObserver::kFour;
        const bool outside = observer == TraceObserver::kStatic;
        // Far from the horizon, and near it on one side or both.
        const auto far = inside    ? logarithmic(1e-6, 1.9)
                         : outside ? logarithmic(2.1, 1e8)
                                   : logarithmic(1e-6, 1e8);
        const auto near =
            rc::gen::map(rc::gen::pair(logarithmic(1e-9, 0.1), rc::gen::arbitrary<bool>()),
                         [inside, outside](const std::pair<double, bool>& at) {
                           const bool above = outside || (!inside && at.second);
                           return above ? 2 + at.first : 2 - at.first;
                         });
        return rc::gen::map(rc::gen::oneOf(far, near), [observer](double r) {
          return Place{observer, r};
        });
      });
}

struct Aim {
  int kind;      // by angle, off the silhouette's edge, off region III's
  double part;   // of a half turn
  double small;  // distance from an edge
  bool beyond;
};

rc::Gen<Aim> aims() {
  return rc::gen::map(rc::gen::tuple(rc::gen::inRange(0, 3), rc::gen::inRange(0, 1 << 24),
                                     logarithmic(1e-12, 0.1), rc::gen::arbitrary<bool>()),
                      [](const std::tuple<int, int, double, bool>& t) {
                        return Aim{std::get<0>(t), std::get<1>(t) / double(1 << 24), std::get<2>(t),
                                   std::get<3>(t)};
                      });
}

RayRequest request_for(const Place& place, const Aim& aim) {
  RayRequest q;
  q.observer = place.observer;
  q.at = Radius(place.r);
  q.delta = pi * aim.part;
  const Edge edge = aim.kind == 1 ? Edge::kSilhouette : Edge::kRegionThree;
  if (aim.kind == 0 || !has_edge(place.observer, q.at, edge)) return q;
  const double at = edge_delta(place.observer, q.at, edge);
  const double offset = aim.beyond ? aim.small : -aim.small;
  if (at + offset <= 0 || at + offset >= pi) return q;
  q.edge = edge;
  q.offset = offset;
  return q;
}

std::string number(double value) {
  char text[30];
  std::snprintf(text, sizeof text, "%.3g", value);
  return text;
}

std::string shown(const RayRequest& q, double delta) {
  char line[200];
  std::snprintf(line, sizeof line, "observer %d, r = %.17g, delta = %.17g, edge %d, offset %.3g",
                static_cast<int>(q.observer), q.at.r, delta,
                q.edge ? static_cast<int>(*q.edge) : -1, q.offset);
  return line;
}

// How many rays there were something to compare of.
struct Compared {
  int by_table = 0, by_integrator = 0;
};

// Where the ray is on its way, by the closed form, by what renders and by the integrator, which
// errs in psi by the bound of its azimuth.
void expect_one_place(const RayRequest& q, double psi, double bound, const TraceOptions& options) {
  constexpr double kStep = 1e-6;
  const auto r_after = [&](double angle, TraceMethod method) {
    const auto place = trace_place(q, angle, method, options);
    return place ? place->r : 0;
  };
  const double exact = r_after(psi, TraceMethod::kExact);
  const double later = r_after(psi * (1 + kStep), TraceMethod::kExact);
  const double steep = std::abs(later / exact - 1) / (kStep * psi) + 1;  // |d ln r/d psi|
  const std::string at =
      shown(q, trace_ray(q, TraceMethod::kExact).delta) + ", psi = " + number(psi);
  const double table = std::abs(r_after(psi, TraceMethod::kTable) / exact - 1);
  if (!(table <= 1e-12 + 1e-14 * steep)) RC_FAIL("places differ by " + number(table) + ": " + at);
  const double walked = std::abs(r_after(psi, TraceMethod::kBinetRkf78) / exact - 1);
  if (!(walked <= 1e-12 + 4 * bound * steep))
    RC_FAIL("the integrator's place is off by " + number(walked) + ": " + at);
}

void expect_agreement(const RayRequest& q, Compared& compared) {
  const TracedRay exact = trace_ray(q, TraceMethod::kExact);
  if (!std::isfinite(exact.slope)) return;  // exactly radial or critical
  ++compared.by_table;
  const TracedRay table = trace_ray(q, TraceMethod::kTable);
  const std::string ray = shown(q, exact.delta);
  // The table: sky_table.h and white_hole_table.h, on the azimuth or on the observer's sky.
  const double error = std::abs(table.phi - exact.phi);
  if (!(error <= 1e-8 && error <= 1e-10 * std::max(1.0, std::abs(exact.slope))))
    RC_FAIL("the table is off by " + number(error) + ": " + ray);
  // The integrator: integrated_ray.h, whose factor of 4 (over the reference rays) some rays in a
  // million exceed by a hundredth; delta itself is only good to its last bits.
  constexpr double kTolerance = 1e-10, kRounding = 1e-14;
  TraceOptions options;
  options.tolerance = kTolerance;
  options.slope = false;
  const TracedRay walked = trace_ray(q, TraceMethod::kBinetRkf78, options);
  const double bound =
      8 * kTolerance * (exact.phi + std::abs(exact.slope)) + kRounding * std::abs(exact.slope);
  if (bound > 1e-3) return;  // too near an edge for it
  ++compared.by_integrator;
  if (!walked.decided || walked.origin != exact.origin) RC_FAIL("another origin: " + ray);
  if (!(std::abs(walked.phi - exact.phi) <= bound + 1e-13))
    RC_FAIL("the integrator is off by " + number(std::abs(walked.phi - exact.phi)) + ": " + ray);
  if (compared.by_integrator % 3 != 0) return;
  const double part = 0.05 + 0.9 * (compared.by_integrator % 64) / 64;
  expect_one_place(q, part * exact.phi, bound, options);
}

TEST(Agreement, OfTableIntegralAndIntegratorForAHundredThousandRandomRays) {
  Compared compared;
  EXPECT_TRUE(rc::check([&compared] {
    const Place place = *places();
    const auto fan = *rc::gen::container<std::vector<Aim>>(kRaysEach, aims());
    for (const Aim& aim : fan) expect_agreement(request_for(place, aim), compared);
  }));
  EXPECT_GE(compared.by_table, 99 * kRaysEach);
  EXPECT_GE(compared.by_integrator, 100 * kRaysEach * 2 / 3);
}

}  // namespace
}  // namespace domefall
