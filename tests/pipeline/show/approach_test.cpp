// Tests of segments that give both their speeds and their end, and of those even in log r.
#include <cmath>

#include "tests/pipeline/show/show_file.h"

namespace domefall {
namespace {

using Approaches = ObservedShow;

std::string segment(const std::string& trajectory, double seconds = 10) {
  return "  - {duration_s: " + std::to_string(seconds) + ", trajectory: {" + trajectory + "}}\n";
}

TEST_F(Approaches, HaveBothSpeedsTheEndAndTheDuration) {
  for (const char* orbit :
       {"type: infall, from_r: 20, to_r: 5",
        "type: infall, angular_momentum: 2, from_r: 20, to_r: 5",
        "type: parabolic, periastron: 4.5, from_r: 20, to_r: 5",
        "type: parabolic, periastron: 5, from_r: 5, from_leg: outward, to_r: 20",
        "type: bound, periastron: 5, apoastron: 20, from_tau_m: 20, to_tau_m: 150",
        "type: circular, r: 8, orbits: 0.5"}) {
    const Show plain = show(segment(orbit));
    for (const auto& [begin, end] : {std::pair(2.0, 0.5), std::pair(0.0, 0.0), std::pair(30.0, 4.0),
                                     std::pair(0.0, 90.0), std::pair(6.0, 6.0)}) {
      const Show s = show(segment(std::string(orbit) + ", rate_m_per_s: [" + std::to_string(begin) +
                                  ", " + std::to_string(end) + "]"));
      EXPECT_EQ(at(s, 0).r, at(plain, 0).r) << orbit;
      EXPECT_EQ(at(s, 10).r, at(plain, 10).r) << orbit;
      EXPECT_EQ(at(s, 10).azimuth, at(plain, 10).azimuth) << orbit;
      EXPECT_NEAR(rate_at(s, 1e-4), begin, 0.01 + 1e-3 * begin) << orbit;
      EXPECT_NEAR(rate_at(s, 10 - 1e-4), end, 0.01 + 1e-3 * end) << orbit;
      double before = at(s, 0).proper_time;
      for (int k = 1; k <= 200; ++k) {
        const double tau = at(s, k / 20.0).proper_time;
        EXPECT_GE(tau, before) << orbit;
        before = tau;
      }
    }
  }
}

// The clock of a show that is made of such segments never jumps.
TEST_F(Approaches, JoinWithoutAJerkWhereTheirRatesMeet) {
  const Show s =
      show(segment("type: parabolic, periastron: 6, from_r: 40, to_r: 12, rate_m_per_s: [25, 2]") +
           segment("type: continue, to_r: 7, rate_m_per_s: [2, 3]", 6) +
           segment("type: continue, rate_m_per_s: 3", 2));
  for (const double joint : {10.0, 16.0})
    EXPECT_NEAR(rate_at(s, joint - 1e-3), rate_at(s, joint + 1e-3), 1e-3) << joint;
  EXPECT_NEAR(at(s, 10).r, 12, 1e-11);
  EXPECT_NEAR(at(s, 16).r, 7, 1e-11);
}

// Next to the singularity the end is met to all digits although the rates are far from the mean.
TEST_F(Approaches, EndExactlyBesideTheSingularity) {
  const Show s = show(segment("type: infall, from_r: 3, to_r: 1e-6, rate_m_per_s: [1, 0]"));
  EXPECT_NEAR(at(s, 10).r / 1e-6, 1, 1e-12);
  EXPECT_LT(at(s, 9.999).r, 0.02);
}

TEST_F(Approaches, EvenInLogRTakeEqualFactorsInEqualTimes) {
  for (const char* orbit :
       {"type: infall, from_r: 1000, to_r: 2.5", "type: infall, from_r: 10, to_r: 0.1",
        "type: infall, rest_r: 2000, angular_momentum: 3, from_r: 1000, to_r: 3",
        "type: hyperbolic, v_inf: 0.2, periastron: 4, from_r: 1e6, to_r: 4.5",
        "type: parabolic, periastron: 5, from_r: 6, from_leg: outward, to_r: 5000",
        "type: bound, periastron: 8, apoastron: 90, from_r: 80, to_r: 9",
        "type: kruskal, energy: 1.2, from_r: 0.01, to_r: 100"}) {
    const Show s = show(segment(std::string(orbit) + ", pace: log_r"));
    const double begin = at(s, 0).r, end = at(s, 10).r;
    for (int k = 1; k < 10; ++k)
      EXPECT_NEAR(at(s, k).r / (begin * std::pow(end / begin, k / 10.0)), 1, 1e-9) << orbit;
    for (int k = 0; k < 400; ++k)
      EXPECT_GT(at(s, (k + 1) / 40.0).proper_time, at(s, k / 40.0).proper_time) << orbit;
  }
  const Show far = show(segment("type: infall, from_r: 1000, to_r: 2.5"));
  const Show inside = show(segment("type: infall, from_r: 1, to_r: 0.001, pace: slowing")),
             same = show(segment("type: infall, from_r: 1, to_r: 0.001, pace: log_r"));
  for (int k = 0; k <= 10; ++k) EXPECT_NEAR(at(same, k).r / at(inside, k).r, 1, 1e-9);
  EXPECT_GT(at(far, 5).r, 500) << "a steady pace is slow at first";
}

TEST_F(Approaches, MistakesInThemAreTold) {
  const auto told = [this](const std::string& trajectory) {
    return complaint("black_hole: {mass_solar: 4e6}\ntimeline:\n" +
                     std::string("  - {duration_s: 2, trajectory: {") + trajectory + "}}\n");
  };
  const std::string place = "show.yaml:3:";
  EXPECT_EQ(told("type: infall, from_r: 9, to_r: 3, rate_m_per_s: 2"),
            place + "82: timeline[1].trajectory.rate_m_per_s excludes to_r; give one of them");
  EXPECT_EQ(told("type: infall, from_r: 9, to_r: 3, rate_m_per_s: [2, -1]"),
            place +
                "86: timeline[1].trajectory.rate_m_per_s[2] must be at least 0 (units of M per "
                "second of show), got -1");
  EXPECT_EQ(told("type: infall, from_r: 9, to_r: 3, rate_m_per_s: [2, 1], pace: eased"),
            place +
                "96: timeline[1].trajectory.pace excludes two rates, which shape the pace "
                "themselves; give one of them");
  EXPECT_EQ(
      told("type: circular, r: 9, orbits: 0, rate_m_per_s: [2, 1]"),
      place +
          "81: timeline[1].trajectory.rate_m_per_s needs an end behind the segment's beginning");
  const std::string turns =
      "timeline[1].trajectory.pace of 'log_r' needs an r that only falls or only rises in the "
      "segment; end it, or begin it, where the orbit turns";
  EXPECT_EQ(told("type: circular, r: 9, pace: log_r"), place + "62: " + turns);
  EXPECT_EQ(told("type: parabolic, periastron: 5, from_r: 9, to_r: 20, pace: log_r"),
            place + "93: " + turns);
  EXPECT_EQ(
      told("type: bound, periastron: 8, apoastron: 9, from_tau_m: 3, to_tau_m: 4000, pace: log_r"),
      place + "113: " + turns);
}

}  // namespace
}  // namespace domefall
