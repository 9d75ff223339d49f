// Shows at the far ends of long ways, where their proper time is little beside that of the orbit.
#include <gmock/gmock.h>

#include <cmath>

#include "tests/pipeline/show/show_file.h"

namespace domefall {
namespace {

constexpr double kBound = 1e-12;  // of r, relative: what shows promise down to 1e-6 M

class FarEnds : public ShowKeys {
 protected:
  static double r_at(const Segment& s, double part) {
    return point_at(s.trajectory, proper_time_at(s, part)).r;
  }
};

// The time t since the past singularity, or to the coming one, of a radial orbit that turns at r_a:
// r = r_a sin^2(x), t = sqrt(r_a^3/2) (x - sin x cos x).  For r << r_a this is the series of t =
// sqrt(2) / 3 r^(3/2) (1 + (3/10) r/r_a + (9/56) (r/r_a)^2 + ...), inverted by Newton's rule.
double radius_after(double t, double r_a) {
  double r = std::pow(3 * t / std::sqrt(2.0), 2.0 / 3);
  for (int k = 0; k < 5; ++k) {
    const double q = r / r_a;
    const double t_at_r = std::sqrt(2.0) / 3 * r * std::sqrt(r) * (1 + q * (0.3 + q * (9.0 / 56)));
    r -= (t_at_r - t) * std::sqrt((2 / r) * (1 - q));
  }
  return r;
}

// They began 44 % and 4 % off, and stood still, or were refused.
TEST_F(FarEnds, AShowOutOfThePastSingularityMovesFrameByFrame) {
  for (const double energy : {0.99999999, 0.9999999, 0.999}) {
    const Segment s = segment("{type: kruskal, energy: " + std::to_string(energy * 1e8) +
                              "e-8, from_r: 0.001, rate_m_per_s: 0.0001}");
    const double r_a = 2 / ((1 - energy) * (1 + energy));
    const double born = std::sqrt(2.0) / 3 * std::pow(0.001, 1.5) * (1 + 0.3 * 0.001 / r_a);
    for (const double part : {0.0, 0.003, 0.1, 0.5, 0.999, 1.0})
      EXPECT_NEAR(r_at(s, part) / radius_after(born + 0.001 * part, r_a), 1, kBound)
          << energy << ' ' << part;
    EXPECT_NEAR(double(s.timing.tau_end - s.timing.tau_begin), 0.001, 1e-18);
  }
}

TEST_F(FarEnds, AFallFromFarAwayMovesFrameByFrameAtItsEnd) {
  for (const char* rest_r : {"1e4", "1e6", "1e8", "1e9"})
    for (const char* region : {"I", "III"}) {
      const Segment s = segment("{type: infall, rest_r: " + std::string(rest_r) +
                                ", region: " + region + ", from_r: 0.001, rate_m_per_s: 1e-6}");
      const double r_a = std::stod(rest_r);
      const double left = std::sqrt(2.0) / 3 * std::pow(0.001, 1.5) * (1 + 0.3 * 0.001 / r_a);
      for (const double part : {0.0, 0.003, 0.1, 0.5, 0.999, 1.0})
        EXPECT_NEAR(r_at(s, part) / radius_after(left - 1e-5 * part, r_a), 1, kBound)
            << rest_r << ' ' << part;
    }
}

// Ways into a singularity, out of one, and past the hole.
TEST_F(FarEnds, ASegmentBeginsAndEndsAtItsRadii) {
  for (const char* orbit : {"infall, from_r: 1e9, to_r: 1e-6", "infall, from_r: 30, to_r: 1e-6",
                            "infall, from_r: 1e9, angular_momentum: 3.9, to_r: 1e-6",
                            "infall, from_r: 1e9, v_inf: 0.5, impact_parameter: 3, to_r: 1e-6",
                            "infall, rest_r: 1e9, from_r: 1e9, to_r: 1e-6",
                            "infall, rest_r: 1e9, from_r: 1e-3, to_r: 1e-6",
                            "infall, from_r: 30, angular_momentum: 1, to_r: 1e-6",
                            "infall, from_r: 30, angular_momentum: 1, to_r: 1e-6, region: III",
                            "kruskal, energy: 0.99999999, from_r: 1e-6, to_r: 1e-5",
                            "kruskal, energy: 0.99999999, from_r: 1e-6, to_r: 1e-6",
                            "kruskal, energy: 0.99999999, from_r: 1e-6, to_r: 1e-6, region: III",
                            "kruskal, energy: 2, from_r: 1e-6, to_r: 1e9",
                            "kruskal, energy: 0, from_r: 1e-6, to_r: 1e-6",
                            "bound, periastron: 10, apoastron: 1e9, from_r: 1e9, to_r: 11"})
    for (const char* pace : {"steady", "eased", "eased_in", "eased_out"}) {
      const std::string keys = orbit;
      const auto value_of = [&keys](const std::string& key) {
        return std::stod(keys.substr(keys.find(key) + key.size()));
      };
      const Segment s = segment("{type: " + keys + ", pace: " + pace + "}");
      EXPECT_NEAR(r_at(s, 0) / value_of("from_r: "), 1, kBound) << orbit << ' ' << pace;
      EXPECT_NEAR(r_at(s, 1) / value_of("to_r: "), 1, kBound) << orbit << ' ' << pace;
      // The last frame of five minutes is not the end.
      EXPECT_NE(r_at(s, 1 - 1e-4), r_at(s, 1)) << orbit << ' ' << pace;
    }
}

TEST_F(FarEnds, LogRFallsEvenlyToTheDeepestPlace) {
  for (const char* orbit :
       {"infall, from_r: 1e4, to_r: 1e-6", "infall, rest_r: 1e9, from_r: 1, to_r: 1e-6"}) {
    const Segment s = segment("{type: " + std::string(orbit) + ", pace: slowing}");
    const double from = std::log(r_at(s, 0)), to = std::log(r_at(s, 1));
    for (const double part : {0.5, 0.9, 0.99, 0.999})
      EXPECT_NEAR(std::log(r_at(s, part)), std::lerp(from, to, part), 0.2) << orbit << part;
    EXPECT_NEAR(r_at(s, 1), 1e-6, 1e-18);
  }
}

// Proper time passes by 0.16 M of 2e12.  The passage on the way in, at the other end, was taken.
TEST_F(FarEnds, TheNextPassageOfARadiusIsNotOverlooked) {
  const Segment s = segment("{type: kruskal, energy: 0.99999999, from_r: 0.001, to_r: 0.5}");
  EXPECT_EQ(point_at(s.trajectory, s.timing.tau_end).region, Region::kIV);
  EXPECT_NEAR(r_at(s, 1) / 0.5, 1, kBound);
}

// The rounding of r at the throw was taken for the way to the next passage.
TEST_F(FarEnds, TheBeginningItselfIsNotTheNextPassage) {
  const Segment s = segment(
      "{type: thrown, from_r: 1e9, speed: 1e-4, direction: {radial: -1, phi: 1e-3}, to_r: 1e9}");
  EXPECT_GT(double(s.timing.tau_end - s.timing.tau_begin), 1e12);
  const Segment whole = segment("{type: bound, periastron: 7, apoastron: 20, to_r: 20}");
  EXPECT_NEAR(double(whole.timing.tau_end - whole.timing.tau_begin),
              std::get<Geodesic>(whole.trajectory).radial_period(), 1e-10);
}

TEST_F(FarEnds, WhatGoesOnGoesOnWhereItWas) {
  const Show show = read(
      "black_hole: {mass_solar: 4e6}\n"
      "timeline:\n"
      "  - {duration_s: 1, trajectory: {type: kruskal, energy: 0.99999999, from_r: 1e-6, to_r: "
      "1e-5}}\n"
      "  - {duration_s: 1, trajectory: {type: continue, rate_m_per_s: 1e-8}}\n"
      "  - {duration_s: 1, trajectory: {type: continue, to_r: 3}}\n");
  for (int k = 0; k < 2; ++k) {
    const ObserverState a = observer_at(show, k, 1), b = observer_at(show, k + 1, 0);
    EXPECT_EQ(a.r, b.r);
    EXPECT_EQ(a.null_time, b.null_time);
  }
  const double since = std::sqrt(2.0) / 3 * std::pow(1e-5, 1.5) + 1e-8;
  EXPECT_NEAR(observer_at(show, 1, 1).r / std::pow(3 * since / std::sqrt(2.0), 2.0 / 3), 1, kBound);
}

// The first was once taken.
TEST_F(FarEnds, NoProperTimeLeadsDeeperThanShowsGo) {
  for (const char* orbit : {"kruskal, from_tau_m: -1.33333333333333, to_r: 1",
                            "kruskal, energy: 0, from_r: 1, to_tau_m: 3.14159265358"})
    EXPECT_THAT(complaint("black_hole: {mass_solar: 4e6}\n"
                          "timeline: [{duration_s: 1, trajectory: {type: " +
                          std::string(orbit) + "}}]\n"),
                testing::ContainsRegex("_tau_m leads to r = .* M; shows go from 1e-6 to"))
        << orbit;
}

// The rings of the singularity's light move with u = t - r*, which gains r^2/4 from r = 0.
TEST_F(FarEnds, TheNullTimeMovesToo) {
  const Show show = with("", "{type: kruskal, energy: 0.99999999, from_r: 1e-4, to_r: 1e-3}");
  const double gained = observer_at(show, 0, 1).null_time;
  // du/dr = 1/(u (E + u)) with u^2 = 2/r nearly: r/2 (1 - sqrt(r/2) + r/2 ...).
  const auto integral = [](double r) {
    const double x = std::sqrt(r / 2);
    return r * r / 4 * (1 - x * (4.0 / 5) + x * x * (2.0 / 3) - x * x * x * (4.0 / 7));
  };
  EXPECT_NEAR(gained / (integral(1e-3) - integral(1e-4)), 1, 1e-5);
}

}  // namespace
}  // namespace domefall
