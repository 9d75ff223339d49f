#include "trajectories/wormhole_path.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <boost/numeric/odeint.hpp>
#include <cmath>
#include <functional>
#include <numbers>
#include <stdexcept>
#include <string>
#include <vector>

#include "tests/trajectories/wide_quadrature.h"

namespace domefall {
namespace {

using Profile = Wormhole::Profile;
using testing::HasSubstr;

struct Fall {
  Wormhole wormhole;
  double from_l, speed, impact;
  bool inward;

  WormholeFall make() const { return {wormhole, from_l, speed, impact, inward}; }
};

std::vector<Fall> some_falls() {
  std::vector<Fall> falls;
  for (const Wormhole& w :
       {Wormhole{1, Profile::kEllis}, Wormhole{1, Profile::kDngr, 0, 0.8},
        Wormhole{1, Profile::kDngr, 0.01, 0.05}, Wormhole{1, Profile::kDngr, 6, 1.43}})
    for (const double from : {-40.0, -3.5, 0.6, 9.0})
      for (const double speed : {1e-3, 0.5, 1 - 1e-9})
        for (const double impact : {0.0, 0.3, 1 - 1e-7, 1 + 1e-7, 2.5})
          for (const bool inward : {true, false})
            if (impact <= w.radius(from)) falls.push_back({w, from, speed, impact, inward});
  return falls;
}

// Proper times at which a fall is at its beginning, its turn or throat, and beyond it.
std::vector<double> times_of(const Fall& fall) {
  const double scale =
      (1 + std::abs(fall.from_l)) / fall.speed * std::sqrt(1 - fall.speed * fall.speed);
  return {-3 * scale,  -0.2 * scale, 0,           0.1 * scale,
          0.9 * scale, 1.3 * scale,  2.9 * scale, 50 * scale};
}

TEST(WormholeFall, KeepsItsEnergyAndAngularMomentum) {
  double worst = 0;
  for (const Fall& fall : some_falls()) {
    const WormholeFall path = fall.make();
    const double celerity = fall.speed / std::sqrt((1 - fall.speed) * (1 + fall.speed));
    for (const double tau : times_of(fall)) {
      const OrbitPoint p = path.at(tau);
      worst = std::max({worst, std::abs(p.celerity.length() / celerity - 1),
                        std::abs(p.r * p.celerity.z - fall.impact * celerity) / celerity});
      EXPECT_EQ(p.r, fall.wormhole.radius(p.l));
      EXPECT_EQ(p.region, p.l < 0 ? Region::kIII : Region::kI);
      EXPECT_EQ(p.tetrad, Tetrad::kRain);
    }
  }
  EXPECT_LT(worst, 1e-14);
  RecordProperty("worst", std::to_string(worst * 1e15) + "e-15");
}

// A geodesic by Fehlberg's 7(8) steps, from one state to the proper time of another.
void follow(const Wormhole& w, std::array<double, 3>& state, double momentum, double from,
            double to) {
  const auto stepper = boost::numeric::odeint::make_controlled<
      boost::numeric::odeint::runge_kutta_fehlberg78<std::array<double, 3>>>(1e-15, 1e-15);
  const auto rates = [&](const std::array<double, 3>& s, std::array<double, 3>& d, double) {
    const double r = w.radius(s[0]);
    d = {s[1], momentum * momentum / (r * r * r) * w.slope(s[0]), momentum / (r * r)};
  };
  boost::numeric::odeint::integrate_adaptive(stepper, rates, state, from, to, (to - from) / 100);
}

TEST(WormholeFall, GoesWhereAnIntegratorGoes) {
  double worst = 0;
  for (const Fall& fall : some_falls()) {
    // Next to the path that circles for ever an integrator's errors grow a millionfold.
    if (!fall.inward || std::abs(fall.impact - 1) < 1e-3) continue;
    const WormholeFall path = fall.make();
    const double a = fall.wormhole.half_length();
    std::vector<double> stops{0};
    // dr/dl has a bend at each mouth, where the steps have to end.
    if (path.passes() && a > 0)
      for (const Leg leg : {Leg::kInward, Leg::kOutward})
        if (const auto tau = path.time_at(1, leg, 0)) stops.push_back(double(*tau));
    stops.push_back(times_of(fall)[6]);
    const OrbitPoint begin = path.at(0);
    std::array<double, 3> state{begin.l, begin.celerity.x, begin.azimuth};
    const double momentum = begin.r * begin.celerity.z;
    for (std::size_t k = 0; k + 1 < stops.size(); ++k) {
      follow(fall.wormhole, state, momentum, stops[k], stops[k + 1]);
      const OrbitPoint p = path.at(stops[k + 1]);
      const double error = std::max({std::abs(p.l - state[0]) / (1 + std::abs(p.l)),
                                     std::abs(p.celerity.x - state[1]) / begin.celerity.length(),
                                     std::abs(p.azimuth - state[2])});
      worst = std::max(worst, error);
      // What the integrator leaves of its steps of 1e-15 each.
      EXPECT_LT(error, 3e-12) << fall.from_l << " " << fall.speed << " " << fall.impact << " "
                              << fall.wormhole.length;
    }
  }
  RecordProperty("worst", std::to_string(worst * 1e12) + "e-12");
}

// ---- quadrature with 50 digits, which shares nothing with the code ----

// A leg of a path with impact parameter b, along y = |l| - a or |l| of ellis.
struct WideLeg {
  Wormhole wormhole;
  Digits b;

  bool is_ellis() const { return wormhole.profile == Profile::kEllis; }
  Digits mass() const { return Digits(wormhole.lensing_width) / Digits("1.4295268191803120134"); }
  Digits radius(const Digits& y) const {
    if (is_ellis()) return sqrt(Digits(1 + y * y));
    const Digits m = mass(), x = 2 * y / (boost::math::constants::pi<Digits>() * m);
    return 1 + m * (x * atan(x) - log(Digits(1 + x * x)) / 2);
  }
  // Where it turns, or 0.
  Digits first() const {
    if (b <= 1) return 0;
    if (is_ellis()) return sqrt(Digits(b * b - 1));
    Digits low = 0, high = b * 10 * (1 + mass());
    for (int k = 0; k < 200; ++k) (radius((low + high) / 2) < b ? low : high) = (low + high) / 2;
    return high;
  }
  struct Sums {
    double length, azimuth;
  };
  // From the turn, or from y = 0, to a place, beyond the cylinder.  The variable is ln(1 + (y -
  // y_0)/m), which a narrow throat needs.
  Sums to(const Digits& y) const {
    const Digits from = first(), m = is_ellis() ? Digits(1) : std::min(mass(), Digits(1));
    const auto rates = [&](const Digits& t) -> std::array<Digits, 2> {
      const Digits r = radius(from + m * expm1(t)), under = r * r - b * b;
      if (!(under > 0)) return {0, 0};
      const Digits rate = m * exp(t) / sqrt(under);
      return {Digits(rate * r), Digits(rate * b / r)};
    };
    constexpr int kPieces = 3;
    const auto sums = wide_integrals<2>(rates, 0, log1p(Digits((y - from) / m)), kPieces);
    return {sums[0], sums[1]};
  }
};

TEST(WormholeFall, GoesWhereQuadratureSays) {
  for (const Wormhole& w :
       {Wormhole{1, Profile::kEllis}, Wormhole{1, Profile::kDngr, 1e-6, 1e-6},
        Wormhole{1, Profile::kDngr, 1e-6, 2}, Wormhole{1, Profile::kDngr, 3, 1e-6},
        Wormhole{1, Profile::kDngr, 0, 0.05}, Wormhole{1, Profile::kDngr, 1e6, 1e6}})
    for (const double impact : {1e-3, 0.5, 1 - 1e-9, 1 + 1e-9, 3.0}) {
      SCOPED_TRACE(testing::Message() << "length " << w.length << ", width " << w.lensing_width
                                      << ", impact " << impact);
      const double a = w.half_length();
      const WideLeg leg{w, impact};
      const double from = a + 50 * (1 + w.lensing_width);
      const WormholeFall path(w, from, 0.6, impact, true);
      const WideLeg::Sums whole = leg.to(Digits(from) - a);
      // The cylinder itself is a straight line.
      const double straight = impact < 1 ? a / std::sqrt((1 - impact) * (1 + impact)) : 0;
      for (const double part : {1e-3, 0.9}) {
        const double l = a + (from - a) * part;
        if (!(w.radius(l) > impact * (1 + 1e-3))) continue;
        const WideLeg::Sums sums = leg.to(Digits(l) - a);
        const auto in = path.time_at_l(l), out = path.time_at_l(impact < 1 ? -l : l, *in + 1e-9);
        ASSERT_TRUE(in && out) << l;
        EXPECT_NEAR(double(*in) * 0.75, whole.length - sums.length, 1e-12 * whole.length) << l;
        EXPECT_NEAR(double(*out - *in) * 0.75, 2 * (sums.length + straight),
                    1e-12 * (whole.length + straight))
            << l;
        const OrbitPoint p = path.at(*in), q = path.at(*out);
        EXPECT_NEAR(p.azimuth, whole.azimuth - sums.azimuth,
                    1e-12 * whole.azimuth + 1e-15 * straight)
            << l;
        EXPECT_NEAR(q.azimuth - p.azimuth, 2 * (sums.azimuth + impact * straight),
                    1e-12 * (whole.azimuth + impact * straight))
            << l;
        EXPECT_NEAR(p.l / l, 1, 1e-12);
      }
    }
}

TEST(WormholeFall, ThrownGoesAsItsCelerity) {
  for (const Wormhole& w : {Wormhole{1, Profile::kEllis}, Wormhole{1, Profile::kDngr, 1e-6, 1e-6},
                            Wormhole{1, Profile::kDngr, 3, 0.5}})
    for (const double from : {-1e9, -4.0, -1e-3, 0.0, 0.2, 7.0, 1e9})
      for (const double along : {-1e6, -0.3, -1e-6, 0.0, 1e-6, 2.0})
        for (const double around : {0.0, 1e-6, 0.4, 1e3}) {
          // What would circle in the throat is refused.
          if (along == 0 && around == 0) continue;
          if (w.radius(from) * (around / std::hypot(along, around)) == 1) continue;
          SCOPED_TRACE(testing::Message() << from << " " << along << " " << around);
          const WormholeFall path = WormholeFall::thrown(w, from, along, around);
          const OrbitPoint p = path.at(0);
          const double size = std::hypot(along, around);
          EXPECT_NEAR(p.l, from, 1e-12 * (1 + std::abs(from)));
          EXPECT_NEAR(p.celerity.z, around, 1e-12 * size);
          // Where it turns, rounding of l is worth the root of that.
          EXPECT_NEAR(p.celerity.x, along, (std::abs(along) < 1e-3 * around ? 1e-7 : 1e-12) * size);
          for (const double tau : {-3.0, 0.1, 40.0}) {
            const OrbitPoint q = path.at(tau / size);
            EXPECT_NEAR(q.celerity.length() / size, 1, 1e-14);
            EXPECT_NEAR(q.r * q.celerity.z, w.radius(from) * around, 1e-12 * w.radius(from) * size);
          }
        }
}

TEST(WormholeFall, ComesBackWhenTimeIsReversed) {
  double worst = 0;
  for (const Fall& fall : some_falls()) {
    const WormholeFall path = fall.make();
    const double lasts = times_of(fall)[6];
    const OrbitPoint end = path.at(lasts);
    const double r = std::min(fall.impact, end.r);  // a turn's r may be rounded
    const bool outward_then = (end.l < 0) == (end.celerity.x < 0);
    const WormholeFall back(fall.wormhole, end.l, fall.speed, r, outward_then);
    const OrbitPoint home = back.at(lasts);
    const double error = std::max(std::abs(home.l - fall.from_l) / (1 + std::abs(fall.from_l)),
                                  std::abs(home.azimuth - end.azimuth));
    // Beside the throat's circle a rounding of the place is worth 1e7 of itself afterwards.
    const double bound = std::abs(fall.impact - 1) < 1e-3 ? 1e-11 : 1e-12;
    worst = std::max(worst, error);
    EXPECT_LT(error, bound) << fall.from_l << " " << fall.speed << " " << fall.impact << " "
                            << fall.inward << " " << fall.wormhole.length;
    EXPECT_NEAR(home.celerity.z, path.at(0).celerity.z, 1e-12 * home.celerity.length());
  }
  RecordProperty("worst", std::to_string(worst * 1e12) + "e-12");
}

TEST(WormholeFall, BeginsWhereItIsToldAndTellsItsTimes) {
  for (const Fall& fall : some_falls()) {
    const WormholeFall path = fall.make();
    const OrbitPoint begin = path.at(0);
    EXPECT_NEAR(begin.l, fall.from_l, 1e-13 * (1 + std::abs(fall.from_l)));
    EXPECT_EQ(begin.azimuth, 0);
    EXPECT_EQ(path.passes(), fall.impact < 1);
    EXPECT_EQ(path.reach().first, std::max(1.0, fall.impact));
    const bool towards = (begin.celerity.x > 0) != (fall.from_l > 0);
    if (begin.celerity.x != 0) {
      EXPECT_EQ(towards, fall.inward) << fall.from_l;
    }
    for (const Leg leg : {Leg::kInward, Leg::kOutward}) {
      const auto tau = path.time_at(3.7, leg);
      ASSERT_TRUE(tau);
      EXPECT_NEAR(path.at(*tau).r, 3.7, 1e-11);
      EXPECT_EQ(path.at(*tau).celerity.x * path.at(*tau).l < 0, leg == Leg::kInward);
    }
    EXPECT_FALSE(path.time_at(path.reach().first * 0.99, Leg::kInward));
    EXPECT_FALSE(path.time_at(3.7, Leg::kOutward, 1e300));
  }
}

TEST(WormholeFall, TellsWhenALengthIsPassed) {
  for (const Fall& fall : some_falls()) {
    const WormholeFall path = fall.make();
    for (const double l : {-20.0, -2.9, -0.001, 0.0, 1.5, 30.0}) {
      const auto tau = path.time_at_l(l);
      const bool there =
          path.passes() || (l * fall.from_l > 0 && fall.wormhole.radius(l) >= fall.impact);
      ASSERT_EQ(tau.has_value(), there) << l << " " << fall.from_l << " " << fall.impact;
      if (!tau) continue;
      EXPECT_NEAR(path.at(*tau).l, l, 1e-12 * (1 + std::abs(l))) << fall.impact;
      const auto again = path.time_at_l(l, double(*tau) + 1e-9 * (1 + std::abs(double(*tau))));
      EXPECT_EQ(again.has_value(), !path.passes());
      if (again) {
        EXPECT_NEAR(path.at(*again).l, l, 1e-12 * (1 + std::abs(l)));
      }
    }
  }
}

// Who falls along a radius moves evenly: nothing pulls.
TEST(WormholeFall, AlongARadiusIsEven) {
  const WormholeFall path({1, Profile::kDngr, 2, 0.3}, 8, 0.6, 0, true);
  for (const double tau : {-1e9, 0.0, 3.0, 10.5, 12.0, 1e15}) {
    const OrbitPoint p = path.at(tau);
    EXPECT_NEAR(p.l, 8 - 0.75 * tau, 1e-15 * (8 + std::abs(tau)));
    EXPECT_NEAR(p.celerity.x, -0.75, 2e-16);
    EXPECT_NEAR(double(p.null_time), p.l + 1.25 * tau, 1e-15 * (8 + std::abs(tau)));
  }
  EXPECT_EQ(path.at(12).region, Region::kIII);
}

// It comes from afar, and the throat is passed at the right instant.
TEST(WormholeFall, FromAfarKeepsTheDigitsOfTheThroat) {
  const WormholeFall path({1, Profile::kEllis}, 1e9, 0.5, 0.9, true);
  const auto in = path.time_at(1.1, Leg::kInward), out = path.time_at(1.1, Leg::kOutward);
  ASSERT_TRUE(in && out);
  EXPECT_NEAR(path.at(*in).l, std::sqrt(0.21), 1e-6);  // 1e9 holds 1e-7
  EXPECT_LT(path.at(1e200).l, -1e199);
}

TEST(WormholeFall, RefusesWhatItCannotBe) {
  const Wormhole w{1, Profile::kEllis};
  const auto message = [](const std::function<void()>& make) -> std::string {
    try {
      make();
    } catch (const std::domain_error& error) {
      return error.what();
    }
    return "";
  };
  EXPECT_THAT(message([&] { WormholeFall(w, 3, 1, 0, true); }), HasSubstr("speed"));
  EXPECT_THAT(message([&] { WormholeFall(w, 3, 0, 0, true); }), HasSubstr("speed"));
  EXPECT_THAT(message([&] { WormholeFall(w, 3, 0.5, 1, true); }), HasSubstr("circles"));
  EXPECT_THAT(message([&] { WormholeFall(w, 3, 0.5, 4, true); }), HasSubstr("3.16227766"));
  EXPECT_THAT(message([&] { WormholeFall(w, 3, 0.5, -1, true); }), HasSubstr("impact"));
  EXPECT_THAT(message([&] { WormholeFall(w, NAN, 0.5, 0, true); }), HasSubstr("from_l"));
  EXPECT_THAT(message([&] { WormholeFlight(w, {{0, 3}}); }), HasSubstr("2 keys"));
  EXPECT_THAT(message([&] { WormholeFlight(w, {{0, 3}, {0, 4}}); }), HasSubstr("key 2"));
  EXPECT_THAT(message([&] { WormholeFlight(w, {{0, 3}, {1e-200, 4}}); }), HasSubstr("too close"));
  EXPECT_THAT(message([&] { WormholeFlight(w, {{0, 3}, {1, NAN}}); }), HasSubstr("finite"));
  EXPECT_THAT(message([&] { WormholeFlight(w, {{0, 3}, {1, 2}}).at(1.1); }), HasSubstr("1.1"));
}

TEST(WormholeCircle, KeepsItsPlaceAndGoesAround) {
  const Wormhole w{1, Profile::kDngr, 1, 0.4};
  for (const double l : {-7.0, -0.2, 0.0, 3.0}) {
    const WormholeCircle circle{w, l, 0.6}, rest{w, l, 0};
    const double period = 2 * std::numbers::pi * circle.held_radius() / 0.75;
    EXPECT_NEAR(circle.at(period).azimuth, 2 * std::numbers::pi, 1e-14);
    EXPECT_EQ(circle.at(3).l, l);
    EXPECT_NEAR(circle.at(3).celerity.z, 0.75, 1e-15);
    EXPECT_NEAR(double(circle.at(4).null_time), 5 + l, 1e-14);
    EXPECT_EQ(rest.at(5).celerity, V3d(0, 0, 0));
    EXPECT_EQ(rest.at(5).region, l < 0 ? Region::kIII : Region::kI);
    EXPECT_TRUE(rest.is_at_rest({}) && !circle.is_at_rest({}));
  }
}

// From rest at 5 through the throat to rest at -4, and back with half a turn.
WormholeFlight there_and_back(const Wormhole& w) {
  return {w, {{0, 5, 0, 0, 0}, {20, -4, 1, 0, 0}, {45, 5, 3.1, 0, 0}}};
}

TEST(WormholeFlight, PassesTheThroatAndComesBack) {
  for (const Wormhole& w : {Wormhole{1, Profile::kEllis}, Wormhole{1, Profile::kDngr, 3, 0.5}}) {
    const WormholeFlight path = there_and_back(w);
    EXPECT_EQ(path.at(0).l, 5);
    EXPECT_EQ(path.at(20).region, Region::kIII);
    EXPECT_NEAR(path.at(20).l, -4, 1e-15);
    EXPECT_NEAR(path.at(45).azimuth, 3.1, 1e-15);
    for (const double tau : {0.0, 20.0, 45.0}) EXPECT_LT(path.at(tau).celerity.length(), 1e-14);
    EXPECT_EQ(path.reach(), std::pair(1.0, w.radius(5)));
    const auto in = path.time_at(2, Leg::kInward), out = path.time_at(2, Leg::kOutward),
               home = path.time_at(2, Leg::kOutward, 20);
    ASSERT_TRUE(in && out && home);
    EXPECT_GT(path.at(*in).l, 0);
    EXPECT_LT(path.at(*out).l, 0);
    EXPECT_GT(path.at(*home).l, 0);
    for (const auto& tau : {in, out, home}) EXPECT_NEAR(path.at(*tau).r, 2, 1e-12);
    EXPECT_LT(double(*out), 20);
    // It passes the throat twice, and comes back to where it began.
    const auto there = path.time_at_l(0), back = path.time_at_l(0, *there + 1);
    ASSERT_TRUE(there && back);
    EXPECT_LT(double(*there), 20);
    EXPECT_GT(double(*back), 20);
    EXPECT_NEAR(path.at(*back).l, 0, 1e-14);
    EXPECT_EQ(double(*path.time_at_l(5, 20)), 45);
    EXPECT_FALSE(path.time_at_l(-4.1));
  }
}

TEST(WormholeFlight, ItsStatesMoveAsItsPlacesDo) {
  for (const Wormhole& w : {Wormhole{1, Profile::kEllis}, Wormhole{1, Profile::kDngr, 3, 0.5}}) {
    const WormholeFlight path = there_and_back(w);
    const double h = 1e-4;
    for (double tau = 1; tau < 44; tau += 1.7) {
      const OrbitPoint p = path.at(tau), before = path.at(tau - h), after = path.at(tau + h);
      EXPECT_NEAR(p.celerity.x, (after.l - before.l) / (2 * h), 1e-8);
      EXPECT_NEAR(p.celerity.z, p.r * (after.azimuth - before.azimuth) / (2 * h), 1e-8);
      EXPECT_NEAR(double(after.null_time - before.null_time) / (2 * h),
                  std::sqrt(1 + p.celerity.length2()) + p.celerity.x, 1e-8);
    }
  }
}

// With l' = sinh(chi) of an even rapidity chi the flight is a cubic, and time is its integral.
TEST(WormholeFlight, CoastsAsAFallDoes) {
  const Wormhole w{1, Profile::kDngr, 1, 0.2};
  const WormholeFlight path(w, {{0, 6}, {8, -6}});
  const WormholeFall fall(w, 6, 1.5 / std::hypot(1, 1.5), 0, true);
  for (const double tau : {0.0, 2.0, 3.9, 8.0}) {
    EXPECT_NEAR(path.at(tau).l, fall.at(tau).l, 1e-14);
    EXPECT_NEAR(double(path.at(tau).null_time), double(fall.at(tau).null_time), 1e-13);
  }
}

}  // namespace
}  // namespace domefall
