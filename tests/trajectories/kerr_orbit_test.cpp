// Motion about a hole that spins.
#include "trajectories/kerr_orbit.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <fstream>
#include <map>
#include <numbers>
#include <random>
#include <sstream>
#include <string>

#include "tests/sanitized.h"
#include "tests/source_tree.h"
#include "trajectories/bound_orbit.h"
#include "trajectories/geodesic.h"
#include "trajectories/infall.h"

namespace domefall {
namespace {

using std::numbers::pi;

// The cells of a row by the names of their columns.
class ObserverRow {
 public:
  ObserverRow(const std::string& names, const std::string& line) {
    std::istringstream name_cells(names), cells(line);
    for (std::string name, cell; std::getline(name_cells, name, ',');) {
      cell.clear();
      std::getline(cells, cell, ',');
      cells_[name] = cell;
    }
  }
  const std::string& text(const char* column) const { return cells_.at(column); }
  double number(const char* column) const { return std::stod(text(column)); }
  long double wide(const char* column) const { return std::stold(text(column)); }

 private:
  std::map<std::string, std::string> cells_;
};

std::vector<ObserverRow> reference_observers() {
  std::ifstream file(source_file("tests/reference/kerr_observers.csv"));
  std::vector<ObserverRow> rows;
  std::string names;
  for (std::string line; std::getline(file, line);) {
    if (line.starts_with('#')) continue;
    if (names.empty())
      names = line;
    else
      rows.emplace_back(names, line);
  }
  return rows;
}

TEST(KerrMotion, HasTheFourVelocitiesOfTheReference) {
  int seen = 0;
  for (const ObserverRow& rows : reference_observers()) {
    const KerrHole hole{rows.wide("spin"), rows.wide("charge")};
    const double r = rows.number("r"), theta = rows.number("theta");
    const std::string& kind = rows.text("kind");
    std::optional<KerrMotion> motion;
    if (kind == "geodesic") {
      motion =
          kerr_motion(hole, r, theta, rows.number("energy"), rows.number("L"), rows.number("Q"),
                      rows.number("sign_r") > 0 ? 1 : -1, rows.number("sign_theta") > 0 ? 1 : -1);
    } else if (kind == "circular") {
      const auto circle = kerr_circle(hole, r, rows.number("sense") > 0);
      ASSERT_TRUE(circle);
      motion = kerr_circling(hole, r, theta, circle->angle / circle->time);
      EXPECT_NEAR(motion->energy, rows.number("energy"), 1e-12 * motion->energy);
    } else {
      motion = kerr_circling(hole, r, theta, kind == "zamo" ? dragged_velocity(hole, r, theta) : 0);
    }
    if (!(r > static_cast<double>(hole.inner_horizon()))) continue;
    ASSERT_TRUE(motion) << kind << " " << r;
    ++seen;
    const double scale = 1 + motion->celerity.length();
    EXPECT_NEAR(motion->celerity.x, rows.number("uR"), 1e-11 * scale) << kind << " " << r;
    EXPECT_NEAR(motion->celerity.y, rows.number("uTheta"), 1e-11 * scale) << kind << " " << r;
    EXPECT_NEAR(motion->celerity.z, rows.number("uPhi"), 1e-11 * scale) << kind << " " << r;
    // The constants come back from the velocity.
    if (kind != "geodesic") continue;
    const KerrMotion back = kerr_motion(hole, r, theta, motion->celerity);
    const double size = r * r * scale;
    EXPECT_NEAR(back.energy, motion->energy, 1e-13 * size);
    EXPECT_NEAR(back.momentum, motion->momentum, 1e-13 * size);
    EXPECT_NEAR(back.carter, motion->carter, 1e-12 * size * scale);
  }
  EXPECT_GT(seen, 50);
}

// An orbit with its hole.
struct Orbit {
  KerrHole hole;
  double r, theta;
  KerrMotion motion;
};

// Falls, throws and bound orbits near holes of all spins, also charged ones.
std::vector<Orbit> orbits(int count) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> part(0, 1);
  std::vector<Orbit> found;
  while (static_cast<int>(found.size()) < count) {
    const double spin = std::array{1e-9, 0.3, 0.9, 0.998, 0.999999}[random() % 5];
    const double charge = random() % 3 == 0 ? 0.9 * std::sqrt(1 - spin * spin) : 0;
    const KerrHole hole{spin, charge};
    const double r = static_cast<double>(hole.horizon()) * std::exp(0.1 + 3 * part(random));
    const double theta = random() % 4 == 0 ? pi / 2 : std::acos(1 - 2 * part(random));
    const auto rest = kerr_circling(hole, r, theta, dragged_velocity(hole, r, theta));
    const Celerity<RestFrame> own(part(random) - 0.5, part(random) - 0.5, 1.5 * part(random) - 0.5);
    found.push_back(
        {hole, r, theta, kerr_motion(hole, r, theta, celerity_against(rest->celerity, own))});
  }
  return found;
}

// What the velocity at a point makes of r, theta, azimuth and null time.
struct Rates {
  double r, theta, azimuth, null_time;
};
Rates rates_of(const Orbit& o, const OrbitPoint& p) {
  const auto a = static_cast<double>(o.hole.spin), c = std::cos(p.theta), s = std::sin(p.theta);
  const double sigma = p.r * p.r + a * a * c * c, root = std::sqrt(sigma);
  const double time = gamma_of(p.celerity), out = time + p.celerity.x,
               in = (time - p.celerity.x) / 2;
  return {out * static_cast<double>(o.hole.delta(p.r)) / (2 * sigma) - in, p.celerity.y / root,
          a * out / sigma + p.celerity.z / (s * root),
          (p.r * p.r + a * a) * out / sigma + a * s * p.celerity.z / root};
}

TEST(KerrOrbit, MovesAsItsVelocitySays) {
  int compared = 0;
  for (const Orbit& o : orbits(tries(60, 10))) {
    const KerrOrbit orbit(o.hole, o.r, o.theta, o.motion);
    const double first = std::max(orbit.birth() * 0.9, -200.0),
                 last = std::min(orbit.death() * 0.9, 400.0);
    for (const double part : {0.05, 0.3, 0.5, 0.77, 0.95}) {
      const double tau = first + (last - first) * part;
      const OrbitPoint p = orbit.at(tau);
      if (std::sin(p.theta) < 0.05) continue;
      const Rates rates = rates_of(o, p);
      const double step =
          1e-3 / (1 + std::abs(rates.r) / p.r + std::abs(rates.azimuth) + std::abs(rates.theta));
      const auto difference = [&](const auto& of) {
        const auto across = [&](double h) {
          return (of(orbit.at(tau + h)) - of(orbit.at(tau - h))) / (2 * h);
        };
        return (4 * across(step) - across(2 * step)) / 3;
      };
      const double error = 1e-9 * (1 + p.r + std::abs(tau));
      EXPECT_NEAR(difference([](const OrbitPoint& q) { return q.r; }), rates.r,
                  error * (1 + std::abs(rates.r)));
      EXPECT_NEAR(difference([](const OrbitPoint& q) { return q.theta; }), rates.theta, error);
      EXPECT_NEAR(difference([](const OrbitPoint& q) { return q.azimuth; }), rates.azimuth,
                  error * (1 + std::abs(rates.azimuth)));
      EXPECT_NEAR(difference([](const OrbitPoint& q) { return double(q.null_time); }),
                  rates.null_time, error * (1 + std::abs(rates.null_time)));
      const KerrMotion now = kerr_motion(o.hole, p.r, p.theta, p.celerity);
      const double scale = 1 + p.celerity.length();
      EXPECT_NEAR(now.energy, o.motion.energy, 1e-11 * scale * scale);
      EXPECT_NEAR(now.momentum, o.motion.momentum, 1e-11 * scale * scale * (1 + p.r));
      EXPECT_NEAR(now.carter, o.motion.carter, 1e-11 * scale * scale * (1 + p.r * p.r));
      ++compared;
    }
  }
  EXPECT_GT(compared, tries(200, 25));
}

TEST(KerrOrbit, BeginsWhereItWasPut) {
  for (const Orbit& o : orbits(tries(60, 10))) {
    const KerrOrbit orbit(o.hole, o.r, o.theta, o.motion);
    const OrbitPoint p = orbit.at(0);
    EXPECT_NEAR(p.r, o.r, 1e-14 * o.r);
    EXPECT_NEAR(p.theta, o.theta, 1e-14);
    EXPECT_NEAR(p.azimuth, 0, 1e-14);
    EXPECT_LT((p.celerity - o.motion.celerity).length(), 1e-12 * (1 + p.celerity.length()));
    // A place of the way is found again.
    const double tau = std::min(orbit.death() * 0.5, 30.0);
    const OrbitPoint later = orbit.at(tau);
    for (const Leg leg : {Leg::kInward, Leg::kOutward}) {
      const auto passed = orbit.time_at(later.r, leg, tau - 1e-6);
      if (passed) {
        EXPECT_NEAR(orbit.at(*passed).r, later.r, 1e-10 * later.r);
      }
    }
  }
}

// The ends of an orbit are passed, whichever way they are rounded.
TEST(KerrOrbit, PassesItsOwnEnds) {
  for (const double spin : {0.3, 0.9, 0.998})
    for (const double inclination : {0.0, 0.7, 2.6})
      for (const auto& [least, most] :
           {std::pair(6.0, 10.0), std::pair(8.0, 9.0), std::pair(10.0, 14.0)}) {
        const KerrHole hole{spin, 0};
        const auto motion = kerr_bound(hole, least, most, inclination);
        if (!motion) continue;
        const KerrOrbit orbit(hole, least, pi / 2, *motion);
        for (const double r : {least, most})
          for (const Leg leg : {Leg::kInward, Leg::kOutward}) {
            const auto passed = orbit.time_at(r, leg, 1);
            ASSERT_TRUE(passed) << spin << " " << inclination << " " << r;
            EXPECT_NEAR(orbit.at(*passed).r, r, 1e-11 * r);
          }
      }
}

// What a script rounds to nearly a circle is nearly a circle.
TEST(KerrOrbit, OfNearlyNoEccentricityIsNoOther) {
  const KerrHole hole{0.9, 0};
  for (const double inclination : {0.0, 1e-4, 1.05, pi / 2, 2.1, pi})
    for (double width = 1e-14; width < 1e-4; width *= 10) {
      SCOPED_TRACE(testing::Message() << inclination << " " << width);
      const auto motion = kerr_bound(hole, 10, 10 * (1 + width), inclination);
      ASSERT_TRUE(motion);
      const KerrOrbit orbit(hole, 10, pi / 2, *motion),
          circle(hole, 10, pi / 2, kerr_bound(hole, 10, 10, inclination).value());
      for (const double tau : {0.0, 30.0, 500.0}) {
        EXPECT_NEAR(orbit.at(tau).r, 10 * (1 + width / 2), 6 * width + 1e-6);
        EXPECT_NEAR(orbit.at(tau).theta, circle.at(tau).theta, 1e3 * width + 1e-6);
      }
    }
}

// Without spin it is Schwarzschild's orbit.
TEST(KerrOrbit, OfLittleSpinIsThatOfNone) {
  const KerrHole hole{1e-13L, 0};
  const auto motion = kerr_bound(hole, 8, 20, 0);
  ASSERT_TRUE(motion);
  const KerrOrbit orbit(hole, 8, pi / 2, *motion);
  const Geodesic known = bound_by_turning_points(8, 20);
  for (const double tau : {0.0, 50.0, 333.0, 2000.0}) {
    const OrbitPoint a = orbit.at(tau), b = known.at(tau);
    EXPECT_NEAR(a.r, b.r, 1e-9);
    EXPECT_NEAR(a.azimuth, b.azimuth, 1e-10);
    EXPECT_NEAR(double(a.null_time) - double(orbit.at(0).null_time),
                double(b.null_time - known.at(0).null_time), 1e-8);
  }
}

TEST(KerrOrbit, OfRainFallsStraightAlongTheLightThatFalls) {
  for (const double theta : {0.0, 0.7, pi / 2}) {
    const KerrHole hole{0.9L, 0};
    const auto a = static_cast<double>(hole.spin), s = std::sin(theta), c = std::cos(theta);
    const auto motion =
        kerr_motion(hole, 12, theta, 1, 0, a * a * c * c + a * a * s * s - a * a, -1, 0);
    ASSERT_TRUE(motion);
    const KerrOrbit orbit(hole, 12, theta, *motion);
    EXPECT_EQ(orbit.birth(), -kInfinity);
    const OrbitPoint late = orbit.at(orbit.death() * 0.999);
    EXPECT_LT(late.r, static_cast<double>(hole.horizon()));
    EXPECT_EQ(late.region, Region::kII);
    EXPECT_NEAR(late.theta, theta, 1e-13);
    EXPECT_NEAR(late.celerity.length() * 0 + kerr_motion(hole, late.r, theta, late.celerity).energy,
                1, 1e-12);
  }
}

// Who falls from where nothing rises has the angular momentum that is asked for, and comes down.
TEST(KerrDragged, HasItsAngularMomentum) {
  const KerrHole hole{0.9, 0};
  for (const double theta : {0.8, 1.2, pi / 2})
    for (const double momentum : {-2.0, 0.0, 1.0}) {
      const KerrMotion motion = kerr_dragged(hole, 6, theta, momentum);
      EXPECT_NEAR(motion.momentum, momentum, 1e-14);
      const KerrOrbit orbit(hole, 6, theta, motion);
      EXPECT_NEAR(orbit.at(0).r, 6, 1e-12);
      EXPECT_LT(orbit.at(5).r, 5.95);
      EXPECT_NEAR(orbit.at(0.01).r, 6, 1e-4);
    }
}

TEST(KerrBound, TurnsWhereItShould) {
  for (const double spin : {0.3, 0.9, 0.998})
    for (const double inclination : {0.0, 0.5, 1.2, pi / 2, 2.0, pi}) {
      const KerrHole hole{spin, 0.02};
      const double least = inclination > pi / 2 ? 9.5 : 7;
      for (const double most : {least, 15.0}) {
        const auto motion = kerr_bound(hole, least, most, inclination);
        ASSERT_TRUE(motion) << spin << " " << inclination;
        const KerrOrbit orbit(hole, least, pi / 2, *motion);
        EXPECT_NEAR(orbit.reach().first, least, 1e-9);
        EXPECT_NEAR(orbit.reach().second, most, 1e-9);
        double highest = 0;
        for (int k = 0; k < 900; ++k)
          highest = std::max(highest, pi / 2 - orbit.at(3.71 * k).theta);
        EXPECT_NEAR(highest, inclination > pi / 2 ? pi - inclination : inclination, 2e-2);
        EXPECT_EQ(orbit.at(100).azimuth > 0, inclination <= pi / 2);
        // It turns again after the beginning.
        const auto next = orbit.next_periastron(1);
        EXPECT_EQ(next.has_value(), most > least);
        if (next) {
          EXPECT_NEAR(orbit.at(*next).r, least, 1e-9);
          EXPECT_NEAR(double(*next), orbit.radial_period(), 1e-6);
          EXPECT_NEAR(double(*orbit.next_periastron(0)), 0, 1e-9);
        }
      }
    }
  // Too close to turn.
  EXPECT_FALSE(kerr_bound({0.9L, 0}, 1.6, 15, 0.3));
  EXPECT_FALSE(kerr_bound({0.9L, 0}, 5, 15, pi));
}

// Over the axis it keeps to a plane but for what the hole drags along.
TEST(KerrBound, GoesOverTheAxis) {
  const KerrHole hole{1e-13L, 0};
  const KerrOrbit orbit(hole, 8, pi / 2, kerr_bound(hole, 8, 20, pi / 2).value());
  const Geodesic known = bound_by_turning_points(8, 20);
  for (const double tau : {0.0, 33.0, 50.0, 333.0, 2000.0}) {
    const OrbitPoint a = orbit.at(tau), b = known.at(tau);
    EXPECT_NEAR(a.r, b.r, 1e-9);
    EXPECT_NEAR(std::sin(pi / 2 - a.theta), std::sin(b.azimuth), 1e-9);
    EXPECT_NEAR(std::sin(a.azimuth), 0, 1e-9);
  }
  // One step of inclination beside it changes hardly anything.
  const KerrHole fast{0.9L, 0};
  const KerrOrbit over(fast, 8, pi / 2, kerr_bound(fast, 8, 20, pi / 2).value());
  const KerrOrbit beside(fast, 8, pi / 2, kerr_bound(fast, 8, 20, pi / 2 - 2e-6).value());
  EXPECT_NEAR(over.at(300).r, beside.at(300).r, 1e-4);
  EXPECT_NEAR(std::remainder(over.at(300).azimuth - beside.at(300).azimuth, 2 * pi), 0, 1e-4);
}

// On the axis there is none, and next to it space drags it along.
TEST(KerrOrbit, KeepsItsAzimuthOnTheAxis) {
  const KerrHole hole{0.9L, 0};
  const auto fall_from = [&](double theta) {
    return KerrOrbit(hole, 10, theta, *kerr_circling(hole, 10, theta, 0));
  };
  for (const double theta : {0.0, pi}) {
    const KerrOrbit fall = fall_from(theta);
    EXPECT_EQ(fall.at(20).azimuth, 0);
    EXPECT_NEAR(fall.at(20).r, fall_from(std::abs(theta - 1e-4)).at(20).r, 1e-6);
  }
  EXPECT_NE(fall_from(1e-3).at(20).azimuth, 0);
}

TEST(KerrOrbit, IsFollowedToTheFarEndsOfShows) {
  for (const double theta : {0.0, 1.0, pi / 2}) {
    const KerrHole hole{0.9L, 0};
    const auto rest = [&](double r) { return kerr_dragged(hole, r, theta); };
    for (const double gamma : {2.0, 1e3, 1e9}) {
      for (const double sign : {-1.0, 1.0}) {
        const double from = sign > 0 ? 10 : 1e9, to = sign > 0 ? 1e9 : 10;
        const Celerity<RestFrame> own(sign * std::sqrt((gamma - 1) * (gamma + 1)), 0, 0);
        const KerrOrbit orbit(
            hole, from, theta,
            kerr_motion(hole, from, theta, celerity_against(rest(from).celerity, own)));
        const auto there = orbit.time_at(to, sign > 0 ? Leg::kOutward : Leg::kInward, 0);
        ASSERT_TRUE(there) << gamma;
        EXPECT_NEAR(orbit.at(*there).r, to, 1e-13 * to) << gamma << " " << theta;
      }
    }
    const KerrOrbit fall(hole, 1e9, theta, rest(1e9));
    EXPECT_NEAR(fall.reach().second, 1e9, 1);
    const auto near = fall.time_at(5, Leg::kInward, 0);
    ASSERT_TRUE(near);
    EXPECT_NEAR(fall.at(*near).r, 5, 1e-12);
    // E^2 = 1 - 2 r/(r^2 + a^2 cos^2 theta), but for what is dragged.
    EXPECT_NEAR(rest(1e9).excess, -2e-9, 1e-24);
  }
}

TEST(KerrCircling, TurnsEvenly) {
  const KerrHole hole{0.9L, 0};
  const auto circle = kerr_circle(hole, 6, true);
  const KerrCircling orbit{hole, 6, pi / 2, circle->angle / circle->time};
  EXPECT_NEAR(orbit.at(10).azimuth, 10 * circle->angle, 1e-12);
  EXPECT_NEAR(double(orbit.at(10).null_time), 10 * circle->time, 1e-12);
  // It is a geodesic.
  const KerrOrbit same(hole, 6, pi / 2,
                       kerr_circling(hole, 6, pi / 2, orbit.angular_velocity).value());
  EXPECT_NEAR(same.at(500).r, 6, 1e-9);
  EXPECT_NEAR(same.at(500).azimuth, orbit.at(500).azimuth, 1e-9);
}

}  // namespace
}  // namespace domefall
