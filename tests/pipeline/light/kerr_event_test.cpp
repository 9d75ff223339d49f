#include "pipeline/light/kerr_event.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <boost/numeric/odeint.hpp>
#include <cmath>
#include <iterator>
#include <numbers>
#include <random>
#include <vector>

#include "tests/pipeline/light/kerr_schild.h"
#include "tests/sanitized.h"

namespace domefall {
namespace {

using std::numbers::pi;

// A ray in Kerr and Schild's coordinates, with their time, v - r, and |E| times the Mino time.
using EventState = std::array<double, 8>;

struct SchildEvent {
  double r, null_time, mino;
  V3d place;
};

struct Ray {
  double a, r, theta, delta, eta;
};

// Returns the event at about that Mino time.
SchildEvent schild_event(const Ray& ray, double mino) {
  const double a = ray.a, r = ray.r;
  const KerrSchildStart start = kerr_schild_start(a, 0, r, ray.theta, ray.delta, ray.eta);
  const KerrSchild& hole = start.hole;
  EventState state{};
  std::ranges::copy(start.state, state.begin());
  const auto rates = [&](const EventState& at, EventState& change, double) {
    KerrSchildState place, rate;
    std::copy_n(at.begin(), 6, place.begin());
    hole(place, rate, 0);
    std::copy_n(rate.begin(), 6, change.begin());
    const double there = hole.radius(place);
    const V3d to(at[3], at[4], at[5]);
    const double about = hole.energy + hole.null(place, there).dot(to);
    change[6] = -(hole.energy + hole.strength(place, there) * about);
    const double cosine = at[2] / there;
    change[7] = std::abs(hole.energy) / (there * there + a * a * cosine * cosine);
  };
  boost::numeric::odeint::runge_kutta_fehlberg78<EventState> stepper;
  constexpr int kSteps = 400;
  for (int i = 0; i < kSteps; ++i) {
    EventState change;
    rates(state, change, 0);
    stepper.do_step(rates, state, 0, mino / kSteps / change[7]);
  }
  KerrSchildState place;
  std::copy_n(state.begin(), 6, place.begin());
  const double there = hole.radius(place), cosine = state[2] / there;
  // x + iy = (r + ia) exp(i phi) sin(theta)
  const double phi = std::atan2(state[1], state[0]) - std::atan2(a, there),
               over = std::sqrt(1 - cosine * cosine);
  return {there, state[6] + there - r, state[7],
          V3d(over * std::cos(phi), over * std::sin(phi), cosine)};
}

// Half of them are next to the equator, or nearly radial.
std::vector<Ray> random_rays(int count) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> part(0, 1);
  std::vector<Ray> rays;
  for (int k = 0; k < count; ++k) {
    const double a = part(random), horizon = 1 + std::sqrt(1 - a * a);
    const bool level = part(random) < 0.5, radial = part(random) < 0.5;
    rays.push_back({a, horizon * std::pow(10, 0.02 + 1.5 * part(random)),
                    level ? pi / 2 + 0.3 * std::pow(2 * part(random) - 1, 3) : pi * part(random),
                    radial ? std::pow(10, -3.5 * part(random)) : pi * part(random),
                    2 * pi * part(random)});
  }
  return rays;
}

std::vector<Ray> rays() {
  std::vector<Ray> rays;
  for (const double a : {0.0, 0.5, 0.9})
    for (const double r : {6.0, 20.0})
      for (const double delta : {0.05, 0.2, 0.7, 2.0})
        for (const double eta : {0.3, 1.7, 3.0, 4.4}) rays.push_back({a, r, 1.1, delta, eta});
  rays.push_back({0.9, 1.6, 1.1, 2.6, 1.0});
  rays.push_back({0.9, 1.2, 1.1, 2.9, 4.0});
  // Of hardly any kappa, whose roots may be real and lie within the inner horizon.
  for (const double theta : {1.4, pi / 2})
    for (const double delta : {1e-4, 2e-3, 7e-3, 0.015})
      for (const double eta : {1.5, 1.7}) rays.push_back({0.9, 20, theta, delta, eta});
  return rays;
}

TEST(KerrEvents, LieOnRaysByHamiltonsEquations) {
  std::vector<Ray> all = rays();
  std::ranges::copy(random_rays(tries(400, 20)), std::back_inserter(all));
  for (const Ray& ray : all)
    for (const double mino : {0.02, 0.1, 0.25}) {
      const KerrPlace at{{ray.a, 0}, ray.r, ray.theta};
      const auto about = kerr_event(at, {ray.delta, ray.eta}, mino);
      if (!about || about->at.r > 1e4 || std::abs(about->at.r / at.hole.horizon() - 1) < 0.01)
        continue;
      const SchildEvent exact = schild_event(ray, mino);
      // The steps may go on to where they lose the ray.
      if (!(std::abs(exact.mino / mino - 1) < 0.5) || exact.r < 1.01 * at.hole.horizon()) continue;
      const auto event = kerr_event(at, {ray.delta, ray.eta}, exact.mino);
      ASSERT_TRUE(event);
      SCOPED_TRACE(testing::Message() << ray.a << " " << ray.r << " " << ray.delta << " " << ray.eta
                                      << " " << mino << " r " << event->at.r);
      EXPECT_NEAR(event->at.r, exact.r, 1e-8 * exact.r);
      EXPECT_LT((event->at.place - exact.place).length(), 1e-8);
      EXPECT_NEAR(event->null_time, exact.null_time, 1e-7 * (1 + std::abs(exact.null_time)));
    }
}

// The light is null, of energy 1, and steps beside it stay on the cone and are those between rays.
TEST(KerrEvents, MoveAsNeighbouringRaysDo) {
  for (const Ray& ray : rays()) {
    if (ray.delta < 5e-3) continue;  // differences would be of larger angles
    constexpr double kMino = 0.1, kStep = 1e-5;
    const KerrPlace at{{ray.a, 0}, ray.r, ray.theta};
    const auto event = kerr_event(at, {ray.delta, ray.eta}, kMino);
    if (!event || event->at.r > 1e4) continue;
    SCOPED_TRACE(testing::Message() << ray.a << " " << ray.r << " " << ray.delta << " " << ray.eta
                                    << " r " << event->at.r);
    const TetradVector& k = event->light;
    EXPECT_NEAR(k.dot(k), 0, 1e-10 * k.t * k.t);
    const auto beside = [&](double by_delta, double by_eta, double by_mino) {
      const auto one = kerr_event(at, {ray.delta + by_delta, ray.eta + by_eta}, kMino + by_mino),
                 other = kerr_event(at, {ray.delta - by_delta, ray.eta - by_eta}, kMino - by_mino);
      const double r = (one->at.r - other->at.r) / (2 * kStep),
                   v = (one->null_time - other->null_time) / (2 * kStep);
      return tetrad_vector(at.hole, event->at, r, (one->at.place - other->at.place) / (2 * kStep),
                           v);
    };
    const auto expect_like = [&](const TetradVector& found, const TetradVector& true_one) {
      const double size = 1 + found.s.length() + std::abs(found.t);
      EXPECT_NEAR(found.t, true_one.t, 1e-6 * size);
      EXPECT_LT((found.s - true_one.s).length(), 1e-6 * size);
    };
    expect_like(k * -event->sigma, beside(0, 0, kStep));
    const TetradVector along = k * -event->sigma;
    expect_like(event->by_delta, beside(kStep, 0, 0) + along * event->mino_by_delta);
    expect_like(event->across,
                beside(0, kStep / std::sin(ray.delta), 0) + along * event->mino_across);
  }
}

}  // namespace
}  // namespace domefall
