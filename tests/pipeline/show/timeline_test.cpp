// Tests of segments, their clocks, and how they join.
#include <cmath>

#include "tests/pipeline/show/show_file.h"
#include "trajectories/degree.h"

namespace domefall {
namespace {

using Timelines = ObservedShow;

// This is a show that is asked for as "from r = 30 M to r = 6 M in 20 s".
TEST_F(Timelines, ASegmentGoesFromOneRadiusToAnother) {
  for (const char* orbit :
       {"type: parabolic, periastron: 5", "type: hyperbolic, v_inf: 0.3, periastron: 4.5",
        "type: bound, periastron: 5, apoastron: 40", "type: infall, angular_momentum: 3",
        "type: infall, rest_r: 50, angular_momentum: 2",
        "type: infall, v_inf: 0.5, impact_parameter: 3", "type: infall"}) {
    const Show s = show("  - {duration_s: 20, trajectory: {" + std::string(orbit) +
                        ", from_r: 30, to_r: 6}}\n");
    EXPECT_NEAR(at(s, 0).r, 30, 1e-9) << orbit;
    EXPECT_NEAR(at(s, 20).r, 6, 1e-9) << orbit;
    double before = 31;
    for (int k = 0; k <= 40; ++k) {
      const double r = at(s, k / 2.0).r;
      EXPECT_LT(r, before) << orbit;  // on the way in all along
      before = r;
    }
    EXPECT_NEAR(rate_at(s, 3), rate_at(s, 17), 1e-4 * rate_at(s, 3)) << orbit;
  }
}

TEST_F(Timelines, ALegNamesWhichOfTwoPassagesIsMeant) {
  const std::string orbit = "{type: parabolic, periastron: 5, from_r: 30, to_r: 10";
  const Show in = show("  - {duration_s: 1, trajectory: " + orbit + "}}\n");
  const Show out = show("  - {duration_s: 1, trajectory: " + orbit + ", to_leg: outward}}\n");
  const Timing &early = in.timeline[0].timing, &late = out.timeline[0].timing;
  EXPECT_LT(early.tau_end, 0);
  EXPECT_NEAR(double(late.tau_end), -double(early.tau_end), 1e-9);
  const Show away = show(
      "  - {duration_s: 1, trajectory: {type: parabolic, periastron: 5, from_r: 10, from_leg: "
      "outward, to_r: 30}}\n");
  EXPECT_NEAR(double(away.timeline[0].timing.tau_begin - late.tau_end), 0, 1e-9);
}

TEST_F(Timelines, AnOrbitGoesOnExactlyWhereItWas) {
  const Show whole = show(
      "  - {duration_s: 9, trajectory: {type: bound, periastron: 5, apoastron: 20, rate_m_per_s: "
      "40}}\n");
  const Show parts = show(
      "  - {duration_s: 3, trajectory: {type: bound, periastron: 5, apoastron: 20, rate_m_per_s: "
      "40}}\n"
      "  - {duration_s: 2, trajectory: {type: continue, rate_m_per_s: 40}}\n"
      "  - {duration_s: 4, trajectory: {type: continue, rate_m_per_s: 40}}\n");
  ASSERT_EQ(frame_count(whole), frame_count(parts));
  for (int frame = 0; frame < frame_count(whole); ++frame) {
    const FrameState a = frame_state(whole, frame), b = frame_state(parts, frame);
    EXPECT_NEAR(a.observer.r, b.observer.r, 1e-11);
    EXPECT_NEAR(a.observer.null_time, b.observer.null_time, 1e-9);
    for (int k = 0; k < 3; ++k)
      EXPECT_LT(
          (column(a.observer.sky_from_tetrad, k) - column(b.observer.sky_from_tetrad, k)).length(),
          1e-12);
  }
}

TEST_F(Timelines, ClocksRunByTheirPace) {
  const auto paced = [this](const std::string& pace) {
    return show("  - {duration_s: 10, trajectory: {type: infall, from_r: 20, to_r: 5, pace: " +
                pace + "}}\n");
  };
  const Show steady = paced("steady"), eased = paced("eased"), in = paced("eased_in"),
             out = paced("eased_out");
  const double mean = rate_at(steady, 5);
  EXPECT_NEAR(rate_at(eased, 0.01), 0, 1e-3 * mean);
  EXPECT_NEAR(rate_at(eased, 9.99), 0, 1e-3 * mean);
  EXPECT_NEAR(rate_at(in, 0.01), 0, 1e-2 * mean);
  EXPECT_NEAR(rate_at(in, 9.99), 2 * mean, 1e-2 * mean);
  EXPECT_NEAR(rate_at(out, 0.01), 2 * mean, 1e-2 * mean);
  EXPECT_NEAR(rate_at(out, 9.99), 0, 1e-2 * mean);
  for (const Show& s : {eased, in, out}) {
    EXPECT_NEAR(at(s, 0).r, 20, 1e-12);
    EXPECT_NEAR(at(s, 10).r, 5, 1e-11);
  }
}

// Where segments meet with equal rates the clock has no jerk.
TEST_F(Timelines, RatesRunFromOneToTheOther) {
  const Show s = show(
      "  - {duration_s: 4, trajectory: {type: circular, r: 8, rate_m_per_s: [0, 6]}}\n"
      "  - {duration_s: 2, trajectory: {type: continue, rate_m_per_s: 6}}\n"
      "  - {duration_s: 4, trajectory: {type: continue, rate_m_per_s: [6, 1]}}\n");
  EXPECT_NEAR(rate_at(s, 0.01), 0, 1e-3);
  EXPECT_NEAR(rate_at(s, 3.99), 6, 1e-3);
  EXPECT_NEAR(rate_at(s, 5), 6, 1e-9);
  EXPECT_NEAR(rate_at(s, 6.01), 6, 1e-3);
  EXPECT_NEAR(rate_at(s, 9.99), 1, 1e-3);
  EXPECT_NEAR(at(s, 10).proper_time, 12 + 12 + 14, 1e-12);
}

TEST_F(Timelines, FrozenTimeStandsStill) {
  const Show s = show(
      "  - {duration_s: 2, trajectory: {type: parabolic, periastron: 6, from_r: 20, to_r: 7}}\n"
      "  - {duration_s: 2, trajectory: {type: continue, pace: frozen}}\n");
  EXPECT_EQ(at(s, 2.5).r, at(s, 3.9).r);
  EXPECT_NEAR(at(s, 3).r, 7, 1e-12);
}

// log r falls evenly towards the singularity, and rises evenly out of the past one.
TEST_F(Timelines, TimeQuickensAndSlowsBesideSingularities) {
  const Show s = show(
      "  - {duration_s: 6, trajectory: {type: kruskal, energy: 1, from_r: 0.001, to_r: 1, pace: "
      "quickening}}\n"
      "  - {duration_s: 6, trajectory: {type: infall, from_r: 1, to_r: 0.001, pace: slowing}}\n");
  for (int k = 1; k < 6; ++k) {
    EXPECT_NEAR(std::log10(at(s, k).r), -3 + 3 * k / 6.0, 1e-6);
    EXPECT_NEAR(std::log10(at(s, 6 + k).r), -3 * k / 6.0, 1e-6);
  }
}

TEST_F(Timelines, DissolvesOverlapTheSegmentsTheyJoin) {
  const Show s = show(
      "  - {duration_s: 4, trajectory: {type: static, r: 9}}\n"
      "  - {duration_s: 3, dissolve_s: 1, trajectory: {type: static, r: 5}}\n"
      "  - {duration_s: 2, trajectory: {type: static, r: 4}}\n",
      "frames_per_second: 10\n");
  EXPECT_EQ(frame_count(s), 80);
  EXPECT_FALSE(frame_state(s, 29).vanishing);
  double before = 1.01;
  for (int frame = 30; frame < 40; ++frame) {
    const FrameState f = frame_state(s, frame);
    ASSERT_TRUE(f.vanishing) << frame;
    EXPECT_EQ(f.observer.r, 5);
    EXPECT_EQ(f.vanishing->observer.r, 9);
    EXPECT_LT(f.vanishing_part, before);
    before = f.vanishing_part;
  }
  EXPECT_EQ(frame_state(s, 30).vanishing_part, 1);
  EXPECT_LT(before, 0.01);
  EXPECT_FALSE(frame_state(s, 40).vanishing);
  EXPECT_EQ(frame_state(s, 60).observer.r, 4);
}

// Segments of every kind of orbit begin in region I and in region III.
TEST_F(Timelines, BeginInAnyRegion) {
  const auto first = [this](const std::string& trajectory) {
    return frame_state(show("  - {duration_s: 1, trajectory: {" + trajectory + "}}\n"), 0)
        .observer.region;
  };
  EXPECT_EQ(first("type: parabolic, periastron: 6, from_r: 20"), Region::kI);
  EXPECT_EQ(first("type: parabolic, periastron: 6, from_r: 20, region: III"), Region::kIII);
  EXPECT_EQ(first("type: circular, r: 6, region: III"), Region::kIII);
  EXPECT_EQ(first("type: static, r: 6, region: III"), Region::kIII);
  EXPECT_EQ(first("type: infall, from_r: 1"), Region::kII);
  EXPECT_EQ(first("type: kruskal"), Region::kIV);
  EXPECT_EQ(first("type: thrown, from_r: 5, speed: 0.3, direction: outward, region: III"),
            Region::kIII);
  const Show journey = show(
      "  - {duration_s: 9, trajectory: {type: kruskal, energy: 0.9, from_r: 0.5, to_r: 0.5, "
      "region: III}}\n");
  EXPECT_EQ(at(journey, 0).region, Region::kIV);
  EXPECT_EQ(at(journey, 4.5).region, Region::kIII);
  EXPECT_EQ(at(journey, 9).region, Region::kII);
}

// A throw across the orbit turns its plane, and one against it goes backwards, while the place
// stays.
TEST_F(Timelines, ThrowsSetOutFromThePlaceInTheirDirection) {
  const std::string start =
      "  - {duration_s: 2, trajectory: {type: circular, r: 8, orbits: 0.3}}\n";
  const auto thrown = [&](const std::string& direction) {
    return show(
        start +
        "  - {duration_s: 2, trajectory: {type: thrown, from_r: 8, speed: 0.4, direction: " +
        direction + ", rate_m_per_s: 3}}\n");
  };
  for (const auto& [direction, north, forward] : {std::tuple{"forward", 0., 1.},
                                                  {"backward", 0., -1.},
                                                  {"north", 1., 0.},
                                                  {"south", -1., 0.},
                                                  {"{theta: 0.6, phi: -0.8}", -0.6, -0.8}}) {
    const Show s = thrown(direction);
    const ObserverState joint = observer_at(s, 0, 1), start_of = observer_at(s, 1, 0),
                        later = observer_at(s, 1, 1e-3);
    const V3d place = column(joint.sky_from_tetrad, 0);
    EXPECT_LT((column(start_of.sky_from_tetrad, 0) - place).length(), 1e-12) << direction;
    const V3d goal =
        -column(joint.sky_from_tetrad, 1) * north + column(joint.sky_from_tetrad, 2) * forward;
    const V3d went = column(later.sky_from_tetrad, 0) - place;
    EXPECT_GT(went.normalized().dot(goal), 1 - 1e-5) << direction;
  }
}

// The null time runs on between v and u and across regions, so that the singularity's rings do not
// jump.
TEST_F(Timelines, NullTimeRunsOnAcrossSegmentsAndFrames) {
  const Show s = show(
      "  - {duration_s: 2, trajectory: {type: static, r: 9}}\n"
      "  - {duration_s: 2, trajectory: {type: velocity, r: 9, against: outgoing, speed: 0}}\n"
      "  - {duration_s: 2, trajectory: {type: static, r: 9}}\n");
  const double r_star = 9 + 2 * std::log(3.5);
  const double v = observer_at(s, 0, 1).null_time, u = observer_at(s, 1, 0).null_time;
  EXPECT_NEAR(v - u, 2 * r_star, 1e-12);
  EXPECT_NEAR(observer_at(s, 2, 0).null_time, v, 1e-12);
}

// A show that is read hands each segment what following the timeline from its start would find.
TEST_F(Timelines, JointsHoldWhatTheTimelineLeadsTo) {
  const Show joined = show(
      "  - {duration_s: 2, trajectory: {type: static, r: 9}}\n"
      "  - {duration_s: 3, dissolve_s: 0.5, trajectory: {type: circular, r: 7, orbits: 1}}\n"
      "  - {duration_s: 2, trajectory: {type: velocity, r: 9, against: outgoing, speed: 0}}\n"
      "  - {duration_s: 2, trajectory: {type: infall, from_r: 9, to_r: 1}}\n");
  ASSERT_EQ(joined.joints.size(), 4u);
  Show followed = joined;
  followed.joints.clear();
  ASSERT_EQ(frame_count(joined), frame_count(followed));
  for (int frame = 0; frame < frame_count(joined); ++frame) {
    const FrameState a = frame_state(joined, frame), b = frame_state(followed, frame);
    EXPECT_EQ(a.segment, b.segment);
    EXPECT_EQ(a.vanishing_part, b.vanishing_part);
    EXPECT_EQ(a.observer.r, b.observer.r);
    EXPECT_EQ(a.observer.azimuth, b.observer.azimuth);
    EXPECT_EQ(a.observer.null_time, b.observer.null_time);
    EXPECT_EQ(a.observer.sky_from_tetrad, b.observer.sky_from_tetrad);
  }
}

TEST_F(Timelines, SpeedsChangeEvenlyInRapidity) {
  const Show s = read(
      "timeline:\n  - {duration_s: 4, trajectory: {type: velocity, speed: [0, 0.8], direction: "
      "Vega}}\n");
  const double all = std::atanh(0.8);
  for (const int quarter : {1, 2, 3, 4}) {
    const ObserverState o = at(s, quarter - 1e-9);
    EXPECT_NEAR(std::asinh(o.celerity.length()), all * quarter / 4, 1e-8);
  }
}

TEST_F(Timelines, PathsAreFlownThroughTheirKeys) {
  const Show s = show(
      "  - duration_s: 6\n"
      "    trajectory:\n"
      "      type: path\n"
      "      keyframes:\n"
      "        - {at_m: 0, r: 10, speed: 0}\n"
      "        - {at_m: 30, r: 6, azimuth_deg: 40, speed: 0.3, direction: {radial: -1, phi: 1}}\n"
      "        - {at_m: 60, r: 2.5, azimuth_deg: 90, speed: 0}\n");
  EXPECT_NEAR(at(s, 0).r, 10, 1e-12);
  EXPECT_NEAR(at(s, 3).r, 6, 1e-12);
  EXPECT_NEAR(at(s, 3).azimuth, 40 * kDegree, 1e-12);
  EXPECT_NEAR(at(s, 6).r, 2.5, 1e-12);
  // The velocities are at rest and at 0.3 c against the static observer there.
  const auto speed = [&](double t) {
    const ObserverState o = at(s, t);
    const V3d v = celerity_against(Celerity<RestFrame>(-resting_celerity(o.r)), o.celerity);
    return v.length() / std::sqrt(1 + v.length2());
  };
  EXPECT_NEAR(speed(0), 0, 1e-12);
  EXPECT_NEAR(speed(3), 0.3, 1e-12);
  EXPECT_NEAR(speed(6), 0, 1e-10);
}

}  // namespace
}  // namespace domefall
