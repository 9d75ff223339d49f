// Shows near a charged hole, near a naked singularity and in a wormhole: what their trajectories do,
// and what is said of those that do not exist.
#include <fmt/format.h>

#include <numbers>

#include "pipeline/show/attitude.h"
#include "tests/pipeline/show/show_file.h"
#include "tests/trajectories/conserved.h"

namespace domefall {
namespace {

class OtherSpaces : public ObservedShow {
 protected:
  static inline const std::string kCharge = "black_hole: {mass_solar: 4e6, charge: 0.8}\n";
  static inline const std::string kNaked =
      "black_hole: {mass_solar: 4e6, charge: 1.2, naked: true}\n";
  static inline const std::string kWormhole =
      "wormhole: {radius_km: 1000, length: 0.5, lensing_width: 0.1}\n";

  Show show_in(const std::string& space, const std::string& segments,
               const std::string& more = "") {
    return read(space + more + "timeline:\n" + segments);
  }
  // The message about a trajectory in line 3, column 33, without the trajectory's name.
  std::string complaint_of(const std::string& space, const std::string& trajectory) {
    std::string told =
        complaint(space + "timeline:\n  - {duration_s: 2, trajectory: " + trajectory + "}\n");
    const std::string name = "timeline[1].trajectory";
    if (const auto at = told.find(name); at != std::string::npos) told.erase(at, name.size());
    return told;
  }
};

double energy_there(const ObserverState& o) {
  OrbitPoint p;
  p.r = o.r, p.tetrad = o.tetrad, p.celerity = o.celerity;
  return conserved_by(o.spacetime, p).energy;
}

void expect_joined(const Show& s, double joint) {
  const int k = segment_at(s, joint);
  const ObserverState a = observer_at(s, k - 1, 1), b = observer_at(s, k, 0);
  EXPECT_NEAR(a.r, b.r, 1e-9 * (1 + a.r)) << joint;
  EXPECT_NEAR(a.l, b.l, 1e-9) << joint;
  EXPECT_NEAR(a.azimuth, b.azimuth, 1e-9) << joint;
  EXPECT_NEAR(a.null_time, b.null_time, 1e-9 * (1 + std::abs(a.null_time))) << joint;
  EXPECT_LT((a.celerity - b.celerity).length(), 1e-9) << joint;
  EXPECT_EQ(a.region, b.region);
}

// ---- a charge ----

TEST_F(OtherSpaces, NearAChargeFlightsGoOnFromEachOther) {
  const Show s = show_in(kCharge,
                         "  - {duration_s: 5, trajectory: {type: infall, from_r: 60, to_r: 30}}\n"
                         "  - {duration_s: 5, trajectory: {type: braked, from_r: 30, stop_r: 9}}\n"
                         "  - {duration_s: 5, trajectory: {type: path, keyframes: [{at_m: 0, r: 9, "
                         "speed: 0}, {at_m: 90, "
                         "r: 9, azimuth_deg: 40, speed: 0.2, direction: forward}]}}\n"
                         "  - {duration_s: 5, trajectory: {type: thrown, from_r: 9, speed: 0.2, "
                         "direction: forward, to_r: "
                         "5}}\n");
  for (const double joint : {5.0, 10.0, 15.0}) expect_joined(s, joint);
  EXPECT_NEAR(energy_there(at(s, 1)), 1, 1e-13);
  EXPECT_NEAR(static_celerity(at(s, 10)).length(), 0, 1e-14);
  const ObserverState thrown = at(s, 15);
  EXPECT_NEAR(static_celerity(thrown).z, 0.2 / std::sqrt(0.96), 1e-13);
  EXPECT_NEAR(energy_there(at(s, 19)), energy_there(thrown), 1e-12);
  EXPECT_NEAR(at(s, 20).r, 5, 1e-12);
}

TEST_F(OtherSpaces, NearAChargeASpiralGoesOnFromACircle) {
  const Show s = show_in(
      kCharge,
      "  - {duration_s: 5, trajectory: {type: circular, r: 12, orbits: 0.25}}\n"
      "  - {duration_s: 10, trajectory: {type: spiral, from_r: 12, turns: 2.5, to_r: 1.6}}\n"
      "  - {duration_s: 5, trajectory: {type: continue, to_r: 0.5}}\n");
  for (const double joint : {5.0, 15.0}) expect_joined(s, joint);
  EXPECT_NEAR(at(s, 15).azimuth, 5.5 * std::numbers::pi, 1e-10);
  EXPECT_EQ(at(s, 20).region, Region::kII);
}

// Proper time counts from where a fall begins, as near a hole without charge.
TEST_F(OtherSpaces, NearAChargeProperTimesHaveTheSameZero) {
  for (const char* fall : {"from_r: 30", "rest_r: 30", "from_r: 30, angular_momentum: 1"}) {
    const Show s =
        show_in(kCharge, fmt::format("  - {{duration_s: 5, trajectory: {{type: infall, {}, "
                                     "to_r: 3}}}}\n",
                                     fall));
    EXPECT_NEAR(at(s, 0).proper_time, 0, 1e-12) << fall;
    EXPECT_NEAR(at(s, 0).r, 30, 1e-12) << fall;
  }
}

TEST_F(OtherSpaces, NearAChargeWhatDoesNotExistIsNamed) {
  const auto complains = [&](const char* trajectory, const char* told) {
    EXPECT_EQ(complaint_of(kCharge, trajectory), std::string("show.yaml:3:") + told) << trajectory;
  };
  complains(
      "{type: kruskal}",
      "40: .type of 'kruskal' is not possible: the singularity of a charge repels, and nothing "
      "comes out of it");
  complains("{type: body, body: moon}",
            "40: .type of 'body' is not possible: bodies move near holes without charge only");
  complains(
      "{type: circular, r: 2.4}",
      "53: .r must exceed 2.48488578 (units of M), got 2.4: at the light circle an orbit needs "
      "the speed of light, below it more");
  complains(
      "{type: parabolic, periastron: 3.2, from_r: 9}",
      "63: .periastron must exceed 3.251389983 (units of M), got 3.2: what falls from rest at "
      "infinity does not come back from there");
  complains("{type: parabolic, excess: 1e-21, from_r: 9}",
            "59: .excess must be at least 1e-20, got 1e-21");
  complains(
      "{type: bound, periastron: 3, apoastron: 20}",
      "59: .periastron must exceed 3.543409468 (units of M), got 3: below it an orbit that rises "
      "to 20 falls into the hole");
  complains(
      "{type: bound, periastron: 4, apoastron: 4.5}",
      "73: .apoastron must exceed 4.890766671 (units of M), got 4.5: no stable orbit is smaller");
  complains("{type: infall, rest_r: 8, angular_momentum: 4}",
            "77: .angular_momentum must be below 3.170880655 (units of M), got 4: with more, what "
            "starts at r = 8 does not fall in");
  complains(
      "{type: thrown, from_r: 1, against: constant_t, speed: 0}",
      "87: .speed leads through the crossing of the inner horizons, where no tetrad is regular; "
      "change it a little");
  complains(
      "{type: braked, from_r: 8, stop_r: 1.59}",
      "67: .stop_r must exceed 1.6 (units of M), got 1.59: nothing rests at or inside the horizon");
  complains(
      "{type: spiral, from_r: 2.4}",
      "56: .from_r must exceed 2.48488578 (units of M), got 2.4: at the light circle an orbit "
      "needs the speed of light, below it more");
  complains(
      "{type: path, keyframes: [{at_m: 0, r: 1.5}, {at_m: 50, r: 1}]}",
      "57: .keyframes cannot be flown: key 1, at proper time 0 (units of M): after it, at r = "
      "1.5, the path is faster than light: it must cross r faster, or turn less");
  EXPECT_EQ(
      complaint_of("black_hole: {mass_solar: 1, charge: 1}\n",
                   "{type: spiral, from_r: 12, turns: 0.6}"),
      "show.yaml:3:67: .turns must be at least 0.7351051939 (revolutions), got 0.6: with fewer "
      "nothing is left of the orbit");
  EXPECT_EQ(
      complaint_of("black_hole: {mass_solar: 1, charge: 1}\n", "{type: static, r: 3, region: III}"),
      "show.yaml:3:62: .region must be I, which a hole with a charge of 1 or more has alone");
}

TEST_F(OtherSpaces, AChargeIsThatOfAHole) {
  const std::string rest = "timeline: [{duration_s: 2, trajectory: {type: static, r: 9}}]\n";
  EXPECT_EQ(complaint("black_hole: {charge: 0.5}\ntimeline: [{duration_s: 2}]\n"),
            "show.yaml:1:22: black_hole.charge is of a hole, which needs mass_solar");
  EXPECT_EQ(complaint("black_hole: {mass_solar: 1, charge: 1.2}\n" + rest),
            "show.yaml:1:37: black_hole.charge must be at most 1, got 1.2: with more no horizon "
            "hides the singularity; if that is meant, say naked: true");
  EXPECT_EQ(complaint("black_hole: {mass_solar: 1, charge: 1, naked: true}\n" + rest),
            "show.yaml:1:47: black_hole.naked is for a charge above 1; with less, a horizon hides "
            "the singularity");
}

// ---- a naked singularity ----

TEST_F(OtherSpaces, ANakedSingularityTurnsEveryFallBack) {
  const Show s = show_in(
      kNaked,
      "  - {duration_s: 5, trajectory: {type: infall, from_r: 20, to_r: 0.72}}\n"
      "  - {duration_s: 5, trajectory: {type: continue, to_leg: outward, to_r: 20}}\n"
      "  - {duration_s: 5, trajectory: {type: braked, from_r: 20, stop_r: 0.2, speed: 0.9}}\n"
      "  - {duration_s: 5, trajectory: {type: infall, rest_r: 0.2, to_leg: outward, to_r: 3}}\n",
      "markers: {turn: periastron}\n");
  EXPECT_NEAR(s.markers[0].at_s, 5, 1e-6);
  expect_joined(s, 5);
  expect_joined(s, 15);
  EXPECT_NEAR(at(s, 5).r, 0.72, 1e-13);
  for (const double t : {1.0, 5.0, 9.0, 15.0, 19.0}) EXPECT_EQ(at(s, t).region, Region::kI);
  EXPECT_NEAR(energy_there(at(s, 9)), 1, 1e-12);
  EXPECT_NEAR(at(s, 20).r, 3, 1e-12);
}

TEST_F(OtherSpaces, BodiesRestAtTheSquareOfANakedCharge) {
  const Show s = show_in(kNaked, "  - {duration_s: 5, trajectory: {type: static, r: 1.44}}\n");
  const ObserverState o = at(s, 2);
  // What rests there by itself falls nowhere.
  EXPECT_NEAR(o.spacetime.lapse_squared(1.44), 1 - 1 / 1.44, 1e-15);
  EXPECT_GT(
      show_in(kNaked, "  - {duration_s: 5, trajectory: {type: circular, r: 1.5, orbits: 1}}\n")
          .timeline[0]
          .timing.tau_end.hi,
      0);
}

TEST_F(OtherSpaces, NearANakedSingularityWhatDoesNotExistIsNamed) {
  const auto complains = [&](const char* trajectory, const char* told) {
    EXPECT_EQ(complaint_of(kNaked, trajectory), std::string("show.yaml:3:") + told) << trajectory;
  };
  complains("{type: spiral, from_r: 9}",
            "40: .type of 'spiral' is not possible: nothing falls into a naked singularity; give a "
            "path");
  complains("{type: parabolic, excess: 1e-3, from_r: 9}",
            "59: .excess is for holes: nothing falls into a naked singularity, so that there is no "
            "bound to exceed");
  complains(
      "{type: circular, r: 1.44}",
      "53: .r must exceed 1.44 (units of M), got 1.44: within r = q^2 the charge repels, and at "
      "it bodies rest");
  complains(
      "{type: infall, from_r: 9, to_r: 0.7}",
      "65: .to_r is not passed after the segment's beginning; it moves between r = 0.72 M and "
      "infinity");
  complains(
      "{type: velocity, r: 0.5, against: free_fall, speed: 0}",
      "53: .r is where no free fall from rest far away comes, since the charge turns it above");
  complains(
      "{type: thrown, from_r: 0.5, against: constant_t, speed: 0}",
      "70: .against of constant_t is what rests in t between two horizons, which a charge of 1 or "
      "more leaves no room for");
  complains("{type: braked, from_r: 0.5, stop_r: 0.2}",
            "33: .speed is missing, since no free fall from rest far away comes to from_r");
  complains("{type: infall, from_r: 9, region: III}",
            "67: .region must be I, which a hole with a charge of 1 or more has alone");
}

// ---- a wormhole ----

TEST_F(OtherSpaces, AWormholeIsPassedThereAndBack) {
  const Show s =
      show_in(kWormhole,
              "  - {duration_s: 5, trajectory: {type: infall, from_l: 8, speed: 0.5, to_l: 0}}\n"
              "  - {duration_s: 5, trajectory: {type: continue, to_l: -6}}\n"
              "  - {duration_s: 5, trajectory: {type: path, keyframes: [{at_m: 0, l: -6, speed: "
              "0.5, direction: "
              "outward}, {at_m: 20, l: -8, speed: 0}, {at_m: 60, l: 8, speed: 0}], to_l: 0}}\n"
              "  - {duration_s: 5, trajectory: {type: continue, to_tau_m: 60}}\n"
              "  - {duration_s: 5, trajectory: {type: static, l: 8}}\n");
  for (const double joint : {5.0, 10.0, 15.0, 20.0}) expect_joined(s, joint);
  EXPECT_NEAR(at(s, 5).l, 0, 1e-12);
  EXPECT_EQ(at(s, 7).region, Region::kIII);
  EXPECT_NEAR(at(s, 7).celerity.x, -0.5 / std::sqrt(0.75), 1e-14);
  EXPECT_NEAR(at(s, 15).l, 0, 1e-12);
  EXPECT_EQ(at(s, 16).region, Region::kI);
  EXPECT_NEAR(at(s, 20).celerity.length(), 0, 1e-12);
}

TEST_F(OtherSpaces, WhatIsThrownInAWormholeFallsFreely) {
  const Show s =
      show_in(kWormhole,
              "  - {duration_s: 5, trajectory: {type: thrown, from_l: -5, speed: 0.6, "
              "direction: inward, to_l: 4}}\n"
              "  - {duration_s: 5, trajectory: {type: thrown, from_l: 4, lorentz_factor: "
              "1e6, direction: {radial: -1, phi: 2}, rate_m_per_s: 1e-6}}\n");
  // Inward is towards the throat, here along growing l.
  EXPECT_NEAR(at(s, 0).celerity.x, 0.75, 1e-15);
  EXPECT_NEAR(at(s, 5).l, 4, 1e-12);
  const ObserverState o = observer_at(s, 1, 0);
  EXPECT_NEAR(gamma_of(o.celerity) / 1e6, 1, 1e-14);
  EXPECT_NEAR(o.celerity.z / o.celerity.x, -2, 1e-13);
  EXPECT_NEAR(observer_at(s, 1, 1).r * observer_at(s, 1, 1).celerity.z / (o.r * o.celerity.z), 1,
              1e-13);
}

// Both sides of the throat have the same r.
TEST_F(OtherSpaces, EventsInAWormholeAreToldByL) {
  const auto fall = [&](const char* shape, const char* markers, const char* lasts,
                        const char* rest) {
    return show_in(fmt::format("wormhole: {{radius_km: 1, {}}}\n", shape),
                   fmt::format("  - {{duration_s: {}, trajectory: {{type: infall, from_l: 5, "
                               "speed: 0.5, {}}}}}\n",
                               lasts, rest),
                   fmt::format("markers: {{{}}}\n", markers));
  };
  const char* const dngr = "length: 1";
  const Show s =
      fall(dngr, "throat: {l: 0}, far: {l: -2}, back: {l: 2, leg: inward}", "10", "to_l: -5");
  ASSERT_EQ(s.markers.size(), 3u);
  EXPECT_NEAR(s.markers[0].at_s, 5, 1e-9);
  EXPECT_NEAR(s.markers[1].at_s, 7, 1e-9);
  EXPECT_NEAR(s.markers[2].at_s, 3, 1e-9);
  EXPECT_NEAR(fall(dngr, "throat: {l: 0}", "10", "to_l: 0").markers[0].at_s, 10, 1e-9);
  EXPECT_NEAR(fall(dngr, "throat: {l: 0}", "throat", "rate_m_per_s: 1").timeline[0].duration_s,
              5 / 0.5 * std::sqrt(0.75), 1e-9);
  const Show turns = fall("profile: ellis", "again: {l: 4, leg: outward}", "again",
                          "impact_parameter: 2, rate_m_per_s: 1");
  // With l = sqrt(3) cosh u, where the way turns at u = 0, its length is int sqrt(1 + 3 cosh(u)^2) du.
  const auto length = [](double l) {
    constexpr int kSteps = 20000;
    const double end = std::acosh(l / std::sqrt(3.0));
    double sum = 0;
    for (int k = 0; k < kSteps; ++k)
      sum += std::hypot(1.0, std::sqrt(3.0) * std::cosh(end * (k + 0.5) / kSteps));
    return sum * end / kSteps;
  };
  EXPECT_NEAR(turns.timeline[0].duration_s, (length(5) + length(4)) / 0.5 * std::sqrt(0.75), 1e-8);
}

// A camera that stays keeps its place near the hole, and its time goes on.
TEST_F(OtherSpaces, ACameraThatStaysKeepsItsPlaceInAFastFall) {
  for (const std::string& trajectory : {std::string("{type: infall, from_r: 16, to_r: 0.7}"),
                                        std::string("{type: circular, r: 9}")}) {
    const Show s = show_in(kCharge, "  - {duration_s: 4, trajectory: " + trajectory + "}\n");
    const FrameState state = frame_state(s, 60);
    const ObserverState stays = observer_after(s, state, 5, CameraMotion::kStays),
                        moves = observer_after(s, state, 5, CameraMotion::kMoves);
    EXPECT_EQ(stays.r, state.observer.r);
    expect_near(stays.celerity, state.observer.celerity);
    EXPECT_EQ(stays.null_time, moves.null_time);
    expect_near(column(stays.sky_from_tetrad, 0), column(moves.sky_from_tetrad, 0));
  }
  const Show s = show_in(kWormhole,
                         "  - {duration_s: 4, trajectory: {type: infall, from_l: 7, speed: 0.5, "
                         "to_l: -6}}\n");
  const FrameState state = frame_state(s, 60);
  const ObserverState stays = observer_after(s, state, 5, CameraMotion::kStays),
                      moves = observer_after(s, state, 5, CameraMotion::kMoves);
  EXPECT_EQ(stays.l, state.observer.l);
  // t = v - l is the observer's own.
  EXPECT_NEAR(stays.null_time - stays.l, moves.null_time - moves.l, 1e-12);
}

TEST_F(OtherSpaces, AVelocityInAWormholeIsHeldAtItsPlace) {
  const Show s = show_in(kWormhole,
                         "  - {duration_s: 5, trajectory: {type: velocity, l: -2, speed: [0, 0.8], "
                         "direction: outward}}\n");
  EXPECT_EQ(at(s, 3).l, -2);
  EXPECT_EQ(at(s, 3).region, Region::kIII);
  EXPECT_NEAR(observer_at(s, 0, 1).celerity.x, -0.8 / 0.6, 1e-14);
}

TEST_F(OtherSpaces, InAWormholeWhatDoesNotExistIsNamed) {
  const auto complains = [&](const char* trajectory, const char* told) {
    EXPECT_EQ(complaint_of(kWormhole, trajectory), std::string("show.yaml:3:") + told)
        << trajectory;
  };
  const std::string pulls =
      "' is not possible: nothing pulls in a wormhole: what moves freely there is of type infall "
      "or "
      "thrown";
  for (const std::string type : {"parabolic", "hyperbolic", "bound"})
    EXPECT_EQ(complaint_of(kWormhole, "{type: " + type + "}"),
              "show.yaml:3:40: .type of '" + type + pulls);
  complains(
      "{type: spiral, from_r: 9}",
      "40: .type of 'spiral' is not possible: nothing pulls in a wormhole: give a path, whose "
      "keyframes may go around and in");
  complains(
      "{type: braked, from_r: 9, stop_r: 3}",
      "40: .type of 'braked' is not possible: a path whose last keyframe has speed: 0 comes to a "
      "stop in a wormhole");
  complains(
      "{type: kruskal}",
      "40: .type of 'kruskal' is not possible: a wormhole has no horizon, and no singularity to "
      "come from");
  complains("{type: infall, from_l: 5, speed: 0.5, impact_parameter: 2, to_l: -3}",
            "98: .to_l is not passed after the segment's beginning; a free fall comes through the "
            "throat with an impact parameter below 1 only, and otherwise turns where r is that");
  complains("{type: thrown, from_l: 5, speed: 0}",
            "66: .speed must exceed 0 (gamma v), got 0: what rests does not fall in a wormhole");
  complains(
      "{type: path, keyframes: [{at_m: 0, l: 5}, {at_m: 9, l: -5}], to_tau_m: 10}",
      "104: .to_tau_m must be at least 0, where the segment begins, and below 9 (units of M), "
      "got 10");
  complains(
      "{type: path, keyframes: [{at_m: 0, l: 5, speed: 0.5, direction: north}, {at_m: 9, l: 0}]}",
      "97: .keyframes[1].direction leaves the plane of the path; give radial and phi only");
}

// ---- the camera on both sides ----

TEST_F(OtherSpaces, ACameraHasTheWormholeInSightOnBothSides) {
  const Show s =
      show_in(kWormhole,
              "  - {duration_s: 10, trajectory: {type: infall, from_l: 5, speed: 0.1, to_l: "
              "-5}}\n",
              "camera: {projection: rectilinear, look_at: hole}\n");
  const auto target = [&](double t) {
    ObserverState o = at(s, t);
    o.celerity = {};
    return *target_direction(LookAtHole{}, o);
  };
  // The throat is half a radius long, and the camera turns within one radius of it.
  EXPECT_EQ(target(3.7), V3d(-1, 0, 0));
  EXPECT_EQ(target(6.3), V3d(1, 0, 0));
  EXPECT_NEAR(target(5).z, 1, 1e-12);
  double most = 0;
  for (double t = 0; t < 9.99; t += 0.01) {
    most = std::max(most, (target(t + 0.01) - target(t)).length());
    ObserverState o = at(s, t);
    o.celerity = {};
    expect_near(*target_direction(LookOutward{}, o), -target(t));
  }
  EXPECT_LT(most, 0.03);
}

}  // namespace
}  // namespace domefall
