#include "pipeline/light/wormhole_azimuth.h"

#include <gtest/gtest.h>

#include <array>
#include <boost/numeric/odeint.hpp>
#include <cmath>
#include <fstream>
#include <numbers>
#include <sstream>
#include <string>
#include <vector>

#include "tests/pipeline/light/random_rays.h"
#include "tests/source_tree.h"
#include "trajectories/wormhole_path.h"

namespace domefall {
namespace {

using std::numbers::pi;
using Profile = Wormhole::Profile;

struct ReferenceWormholeRay {
  std::string line, origin;
  Wormhole wormhole;
  double l, delta, offset, azimuth, slope, amplification;
};

// The rows of tests/reference/wormhole_rays.csv, with the throat's radius as the unit of length.
std::vector<ReferenceWormholeRay> reference_wormhole_rays() {
  std::ifstream file(source_file("tests/reference/wormhole_rays.csv"));
  std::vector<ReferenceWormholeRay> rays;
  for (std::string line; std::getline(file, line);) {
    if (!line.starts_with("sky,") && !line.starts_with("edge,")) continue;
    std::vector<std::string> cell;
    std::istringstream cells(line);
    for (std::string text; std::getline(cells, text, ',');) cell.push_back(text);
    const bool ellis = cell.at(1) == "ellis";
    const double rho = std::stod(cell[2]), l = std::stod(cell[5]) / rho;
    Wormhole w{rho, ellis ? Profile::kEllis : Profile::kDngr, 2 * std::stod(cell[3]) / rho, 0.05};
    if (!ellis) w.lensing_width = Wormhole::kWidthOfMass * std::stod(cell[4]) / rho;
    const HalfAngle edge = throat_edge(w, l);
    const double delta = std::stod(cell[6]);
    const double offset =
        cell[8].empty() ? delta - 2 * std::atan2(edge.sine, edge.cosine) : std::stod(cell[8]);
    rays.push_back({line, cell[9], w, l, delta, offset, std::stod(cell[10]), std::stod(cell[11]),
                    std::stod(cell[13])});
  }
  return rays;
}

TEST(WormholeAzimuth, IsThatOfEveryReferenceRay) {
  const std::vector<ReferenceWormholeRay> rays = reference_wormhole_rays();
  ASSERT_EQ(rays.size(), 156u);
  double worst = 0;
  for (const ReferenceWormholeRay& ray : rays) {
    EXPECT_EQ(ray.offset > 0 ? "own" : "other", ray.origin) << ray.line;
    const double error =
        std::abs(wormhole_azimuth(ray.wormhole, ray.l, ray.offset) / ray.azimuth - 1);
    worst = std::max(worst, error);
    EXPECT_LE(error, 1e-12) << ray.line;
  }
  RecordProperty("worst", std::to_string(worst * 1e12) + "e-12");
}

TEST(WormholeAzimuth, GrowsAlongTheViewAsTheReferenceSays) {
  double worst = 0;
  for (const ReferenceWormholeRay& ray : reference_wormhole_rays()) {
    const double h = 1e-3 * std::min(std::abs(ray.offset), pi - ray.delta);
    const auto phi = [&](double steps) {
      return wormhole_azimuth(ray.wormhole, ray.l, ray.offset + steps * h);
    };
    const double slope = (8 * (phi(1) - phi(-1)) - (phi(2) - phi(-2))) / (12 * h);
    worst = std::max(worst, std::abs(slope / ray.slope - 1));
    // The difference is right to 1e-11, and its rounding is a thousand times that of the azimuth.
    EXPECT_NEAR(slope / ray.slope, 1, 1e-9) << ray.line;
    // After a million turns the sine of the azimuth has lost its digits.
    if (ray.azimuth < 1e6) {
      EXPECT_NEAR(std::sin(ray.delta) / std::abs(std::sin(phi(0)) * slope) / ray.amplification, 1,
                  1e-7)
          << ray.line;
    }
  }
  RecordProperty("worst", std::to_string(worst * 1e9) + "e-9");
}

// Follows a ray back along its length s, in steps of s/r, until space is flat.  It shares the shape
// alone with the integral.
double followed_azimuth(const Wormhole& w, double l, double offset, bool& other_side) {
  using State = std::array<double, 3>;  // l, dl/ds, azimuth
  constexpr double kFar = 1e10;
  const HalfAngle edge = throat_edge(w, l);
  const double delta = 2 * std::atan2(edge.sine, edge.cosine) + offset, side = l < 0 ? -1 : 1;
  const double b = w.radius(l) * std::sin(delta);
  State at{l, -side * std::cos(delta), 0};
  const auto stepper = boost::numeric::odeint::make_controlled<
      boost::numeric::odeint::runge_kutta_fehlberg78<State>>(1e-14, 1e-14);
  const auto along = [&](const State& s, State& d, double) {
    const double r = w.radius(s[0]);
    d = {s[1] * r, b * b / (r * r) * w.slope(s[0]), b / r};
  };
  // dr/dl has a bend at each mouth, where the steps have to end.
  const double end_side = offset < 0 ? -side : side;
  for (const double mouth : {side * w.half_length(), end_side * w.half_length()}) {
    if ((mouth - at[0]) * end_side <= 0 || w.profile == Profile::kEllis) continue;
    const auto through = [&](const State& s, State& d, double place) {
      along({place, s[1], s[2]}, d, 0);
      d = {1, d[1] / d[0], d[2] / d[0]};
    };
    const double from = at[0];
    boost::numeric::odeint::integrate_adaptive(stepper, through, at, from, mouth,
                                               (mouth - from) / 100);
    at[0] = mouth;
  }
  for (int piece = 0; piece < 10000 && std::abs(at[0]) < kFar; ++piece)
    boost::numeric::odeint::integrate_adaptive(stepper, along, at, 0.0, 0.5, 0.01);
  other_side = (at[0] < 0) != (l < 0);
  return at[2] + b / std::abs(at[0]);
}

TEST(WormholeAzimuth, IsThatOfRaysThatAreFollowed) {
  RandomRays random;
  double worst = 0;
  for (int k = 0; k < 60; ++k) {
    Wormhole w{1, random.one_in(3) ? Profile::kEllis : Profile::kDngr, 0, 0};
    w.length = random.one_in(4) ? 0 : random.logarithmic(1e-3, 4);
    w.lensing_width = random.logarithmic(0.02, 5);
    const double l = (random.one_in(2) ? 1 : -1) * random.logarithmic(1e-3, 30);
    const HalfAngle half = throat_edge(w, l);
    const double edge = 2 * std::atan2(half.sine, half.cosine);
    double offset = random.unit() * pi - edge;
    if (random.one_in(2)) offset = (random.one_in(2) ? 1 : -1) * random.logarithmic(1e-3, edge);
    bool other_side = false;
    const double followed = followed_azimuth(w, l, offset, other_side);
    const double error = std::abs(wormhole_azimuth(w, l, offset) / followed - 1);
    worst = std::max(worst, error);
    EXPECT_EQ(other_side, offset < 0) << k;
    // Steps err by 1e-14 each; next to the edge this grows like 1/offset.
    EXPECT_LE(error, 1e-10) << k << " " << l << " " << offset << " " << w.lensing_width << " "
                            << w.length << " " << int(w.profile) << " " << followed;
  }
  RecordProperty("worst", std::to_string(worst * 1e9) + "e-9");
}

// Free fall has the same curves at any speed, by other sums: for ellis by no elliptic integral.
TEST(WormholeAzimuth, IsThatOfFreeFallWithTheSameImpact) {
  double worst = 0;
  for (const Wormhole& w : {Wormhole{1, Profile::kEllis}, Wormhole{1, Profile::kDngr, 0, 0.05},
                            Wormhole{1, Profile::kDngr, 4, 1.1}})
    for (const double l : {-30.0, -2.3, 0.8, 5.0})
      for (const double offset : {-0.4, -0.02, -1e-4, 1e-4, 0.01, 0.3}) {
        const HalfAngle half = throat_edge(w, l);
        const double delta = 2 * std::atan2(half.sine, half.cosine) + offset;
        if (delta < 0) continue;
        const double b = w.radius(l) * std::sin(delta);
        const WormholeFall fall(w, l, 0.5, b, std::cos(delta) > 0);
        const double error = std::abs(fall.at(1e40).azimuth / wormhole_azimuth(w, l, offset) - 1);
        worst = std::max(worst, error * std::abs(1 - b));
        // b has rounded 1 - b.
        EXPECT_LT(error, 1e-14 + 1e-15 / std::abs(1 - b)) << l << " " << offset;
      }
  RecordProperty("worst", std::to_string(worst * 1e12) + "e-12");
}

// Rays that miss the throat at a radius of l, as in flat space, sweep pi - delta.
TEST(WormholeAzimuth, IsThatOfFlatSpaceFarAway) {
  for (const Profile profile : {Profile::kEllis, Profile::kDngr}) {
    const Wormhole w{1, profile, 1, 0.5};
    for (const double delta : {0.3, 1.5, 2.0, 3.0})
      EXPECT_NEAR(wormhole_azimuth(w, 1e12, delta), pi - delta, 1e-11);
  }
}

TEST(WormholeAzimuth, IsOddThroughTheAxisAndEndlessAtTheEdge) {
  for (const Profile profile : {Profile::kEllis, Profile::kDngr})
    for (const double l : {-7.0, -0.6, 0.0, 0.3, 0.5, 2.0}) {
      const Wormhole w{1, profile, 1, 0.5};
      const HalfAngle half = throat_edge(w, l);
      const double edge = 2 * std::atan2(half.sine, half.cosine);
      for (const double off : {1e-8, 1e-3, 0.1}) {
        EXPECT_NEAR(wormhole_azimuth(w, l, -edge - off), -wormhole_azimuth(w, l, -edge + off),
                    1e-14 * (1 + w.half_length()));
        EXPECT_NEAR(wormhole_azimuth(w, l, pi - edge + off),
                    -wormhole_azimuth(w, l, pi - edge - off), 1e-14);
      }
      EXPECT_EQ(wormhole_azimuth(w, l, 0), HUGE_VAL);
    }
}

// A frame's table is smooth where a ray begins outward, and where one meets the mouth's own impact.
TEST(WormholeAzimuth, HasNoStepWhereItsIntegralsChange) {
  for (const double l : {0.500001, 0.51, 0.8, 3.0, 100.0})
    for (const Profile profile : {Profile::kEllis, Profile::kDngr}) {
      const Wormhole w{1, profile, 1, 0.5};
      const HalfAngle half = throat_edge(w, l);
      const double edge = 2 * std::atan2(half.sine, half.cosine);
      for (const double delta : {pi / 2, pi - edge}) {
        const double h = 1e-4 * (delta - edge);
        const auto phi = [&](double k) { return wormhole_azimuth(w, l, delta - edge + k * h); };
        const double value = phi(0);
        EXPECT_NEAR((phi(-3) + phi(3) - 6 * (phi(-2) + phi(2)) + 15 * (phi(-1) + phi(1))) / 20,
                    value, 1e-15 * (1 + value))
            << l << " " << delta;
        EXPECT_NEAR(phi(1e-12), value, 2e-15 * (1 + value));
      }
    }
}

TEST(WormholeAzimuth, IsANumberForEveryWormholePlaceAndRay) {
  RandomRays random;
  for (int k = 0; k < 20000; ++k) {
    Wormhole w{1, random.one_in(4) ? Profile::kEllis : Profile::kDngr, 0, 0};
    w.length = random.one_in(3) ? 0 : random.logarithmic(1e-12, 1e6);
    w.lensing_width = random.logarithmic(1e-30, 1e30);
    double l = random.one_in(20) ? 0 : random.logarithmic(1e-100, 1e100);
    if (random.one_in(2)) l = w.half_length() + random.logarithmic(1e-12, 1e3);
    if (random.one_in(2)) l = -l;
    const HalfAngle half = throat_edge(w, l);
    const double edge = 2 * std::atan2(half.sine, half.cosine);
    double offset = random.unit() * pi - edge;
    if (random.one_in(2))
      offset = (random.one_in(2) ? 1 : -1) * random.logarithmic(1e-30, 1) * edge;
    const double phi = wormhole_azimuth(w, l, offset);
    ASSERT_TRUE(phi > -1e-15 && std::isfinite(phi))
        << phi << " " << l << " " << offset << " " << w.length << " " << w.lensing_width << " "
        << int(w.profile);
  }
}

}  // namespace
}  // namespace domefall
