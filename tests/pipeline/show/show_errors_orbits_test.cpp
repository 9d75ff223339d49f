// Messages about orbits that do not exist and clocks that no trajectory has, in full, with line and
// column.
#include "tests/pipeline/show/show_file.h"

namespace domefall {
namespace {

using ShowErrorsInOrbits = ShowMistakes;

TEST_F(ShowErrorsInOrbits, Parabolas) {
  expect_complaints_of_trajectories({
      {"{type: parabolic}",
       "3:33: periastron is missing (units of M); or give angular_momentum (units of M), or "
       "excess"},
      {"{type: parabolic, periastron: 4}",
       "3:63: periastron must exceed 4 (units of M), got 4: what falls from rest at infinity does "
       "not come back from there"},
      {"{type: parabolic, periastron: 5}", "3:33: from_r is missing (units of M): where it begins"},
      {"{type: parabolic, angular_momentum: 3.9, from_r: 30}",
       "3:69: angular_momentum must exceed 4 (units of M), got 3.9: what falls from rest at "
       "infinity with less is captured"},
  });
}

TEST_F(ShowErrorsInOrbits, Hyperbolas) {
  expect_complaints_of_trajectories({
      {"{type: hyperbolic, v_inf: 0.4, periastron: 3.5, from_r: 30}",
       "3:59: v_inf must exceed 0.4714045208 (fraction of c), got 0.4: to turn at r = 3.5 takes "
       "more than 141323.52 km/s"},
      {"{type: hyperbolic, v_inf: 0.4, periastron: 3, from_r: 30}",
       "3:76: periastron must exceed 3 (units of M), got 3: no orbit turns there"},
      {"{type: hyperbolic, v_inf: 1.4, periastron: 5, from_r: 30}",
       "3:59: v_inf must stay below 1 (speed of light = 1), got 1.4"},
      {"{type: hyperbolic, v_inf: 0.4, impact_parameter: 5, from_r: 30}",
       "3:82: impact_parameter must exceed 10.68688275 (units of M), got 5: at v_inf = 0.4 what "
       "comes closer is captured"},
      {"{type: hyperbolic, v_inf: 0.4, from_r: 30}",
       "3:33: periastron is missing (units of M); or give impact_parameter (units of M)"},
      {"{type: hyperbolic, excess: 1e-3, periastron: 5, from_r: 30}",
       "3:78: periastron must be below 4 (units of M), got 5: from there on any speed is enough"},
  });
}

TEST_F(ShowErrorsInOrbits, BoundOrbits) {
  expect_complaints_of_trajectories({
      {"{type: bound, periastron: 3.9, apoastron: 20}",
       "3:59: periastron must exceed 4.444444444 (units of M), got 3.9: below it an orbit that "
       "rises to 20 falls into the hole"},
      {"{type: bound, periastron: 20, apoastron: 5}",
       "3:74: apoastron must exceed 6 (units of M), got 5: no stable orbit is smaller"},
      {"{type: bound, eccentricity: 0.5, semilatus_rectum: 6.9}",
       "3:84: semilatus_rectum must exceed 7 (units of M), got 6.9: at e = 0.5 a smaller orbit "
       "falls into the hole (p > 6 + 2e)"},
      {"{type: bound, periastron: 5}", "3:33: apoastron is missing (units of M)"},
  });
}

TEST_F(ShowErrorsInOrbits, Falls) {
  expect_complaints_of_trajectories({
      {"{type: infall, rest_r: 10, angular_momentum: 5}",
       "3:78: angular_momentum must be below 3.535533906 (units of M), got 5: with more, what "
       "starts at r = 10 does not fall in"},
      {"{type: infall, rest_r: 1}",
       "3:56: rest_r must exceed 2 (units of M), got 1: nothing rests at or inside the horizon"},
      {"{type: infall, from_r: 10, angular_momentum: 4}",
       "3:78: angular_momentum must be below 4 (units of M), got 4: what falls from rest at "
       "infinity with more comes back"},
      {"{type: infall, v_inf: 0.5, impact_parameter: 9, from_r: 10}",
       "3:78: impact_parameter must be below 8.80733895 (units of M), got 9: at v_inf = 0.5 what "
       "passes farther out comes back"},
  });
}

TEST_F(ShowErrorsInOrbits, Throws) {
  expect_complaints_of_trajectories({
      {"{type: thrown, from_r: 10, speed: 0.5}",
       "3:33: direction is missing: a word such as inward or forward, {radial, theta, phi} or a "
       "place on the sky"},
      {"{type: thrown, from_r: 1, speed: 0.5, direction: outward}",
       "3:56: from_r must exceed 2 (units of M), got 1: inside the horizon nothing is static; a "
       "velocity there needs 'against: free_fall'"},
      {"{type: kruskal, energy: -1}", "3:57: energy must be at least 0, got -1"},
      {"{type: kruskal, energy: 1e-9}",
       "3:57: energy must be at least 1e-6 (of the unit of mass), got 1e-9: closer to 0 it is 0 in "
       "double precision"},
      {"{type: velocity, r: 5, speed: [0, 1], direction: inward}",
       "3:67: speed[2] must stay below 1 (speed of light = 1), got 1"},
  });
  expect_complaints({
      {moving("{type: continue}"),
       "3:33: timeline[1].trajectory goes on with the trajectory of the segment before, but this "
       "is the first segment"},
  });
}

TEST_F(ShowErrorsInOrbits, FlightsOfASpiralAndABrake) {
  expect_complaints_of_trajectories({
      {"{type: spiral}", "3:33: from_r is missing (units of M)"},
      {"{type: spiral, from_r: 3}",
       "3:56: from_r must exceed 3 (units of M), got 3: at the light circle an orbit needs the "
       "speed of light, below it more"},
      {"{type: spiral, from_r: 8, turns: 0.4}",
       "3:66: turns must be at least 0.5 (revolutions), got 0.4"},
      {"{type: spiral, from_r: 8, turns: 1001}",
       "3:66: turns must be at most 1000 (revolutions), got 1001"},
      {"{type: spiral, from_r: 8, to_r: 9}",
       "3:65: to_r is not passed after the segment's beginning; it moves between r = 0 M and 8 M"},
      {"{type: spiral, from_r: 8, from_leg: inward}",
       "3:59: from_leg is an unknown key; did you mean from_r?"},
      {"{type: spiral, from_r: 8, pace: log_r}",
       "3:65: pace of 'log_r' needs an r that only falls or only rises in the segment; end it, or "
       "begin it, where the orbit turns"},
      {"{type: braked, from_r: 8}", "3:33: stop_r is missing (units of M)"},
      {"{type: braked, from_r: 8, stop_r: 2}",
       "3:67: stop_r must exceed 2 (units of M), got 2: nothing rests at or inside the horizon"},
      {"{type: braked, from_r: 1.5, stop_r: 3}",
       "3:56: from_r must exceed 2 (units of M), got 1.5: nothing rests at or inside the horizon"},
      {"{type: braked, from_r: 8, stop_r: 8}",
       "3:67: stop_r must stay below from_r = 8 (units of M), got 8"},
      {"{type: braked, from_r: 8, stop_r: 3, speed: 0}",
       "3:77: speed must be at least 1e-6 (speed of light = 1), got 0"},
      {"{type: braked, from_r: 8, stop_r: 3, speed: 1}",
       "3:77: speed must stay below 1 (speed of light = 1), got 1"},
      {"{type: braked, from_r: 8, stop_r: 3, pace: slowing}",
       "3:76: pace of 'slowing' needs a trajectory that ends in the singularity"},
      {"{type: braked, from_r: 8, stop_r: 3, to_r: 2.5}",
       "3:76: to_r is not passed after the segment's beginning; it moves between r = 3 M and 8 M"},
  });
}

TEST_F(ShowErrorsInOrbits, Paths) {
  expect_complaints_of_trajectories({
      {"{type: path}",
       "3:33: keyframes is missing: a list of {at_m, r, azimuth_deg}; or give file, a table of "
       "states"},
      {"{type: path, keyframes: [{at_m: 0, r: 5}]}",
       "3:57: keyframes cannot be flown: a path must have at least 2 keys"},
      {"{type: path, keyframes: [{at_m: 0, r: 5}, {at_m: 0, r: 4}]}",
       "3:57: keyframes cannot be flown: key 2, at proper time 0 (units of M): its proper time "
       "must exceed that of the key before"},
      {"{type: path, keyframes: [{at_m: 0, r: 1.5}, {at_m: 10, r: 1.4}]}",
       "3:57: keyframes cannot be flown: key 1, at proper time 0 (units of M): after it, at r = "
       "1.5, the path is faster than light: it must cross r faster, or turn less"},
      {"{type: path, keyframes: [{at_m: 0, r: 5}, {at_m: 10, r: 4}], to_tau_m: 11}",
       "3:104: to_tau_m must be at least 0, where the segment begins, and below 10 (units of M), "
       "got 11"},
      {"{type: path, file: nix.csv}",
       "3:52: file names the file 'nix.csv', which is neither beside the show nor in the working "
       "folder"},
  });
}

TEST_F(ShowErrorsInOrbits, Clocks) {
  expect_complaints_of_trajectories({
      {"{type: parabolic, periastron: 5, from_r: 4}",
       "3:74: from_r is not passed on the inward leg by this trajectory; it moves between r = 5 M "
       "and infinity"},
      {"{type: parabolic, periastron: 5, from_r: 30, to_r: 4}",
       "3:84: to_r is not passed after the segment's beginning; it moves between r = 5 M and "
       "infinity"},
      {"{type: parabolic, periastron: 5, from_r: 30, pace: slowing}",
       "3:84: pace of 'slowing' needs a trajectory that ends in the singularity"},
      {"{type: parabolic, periastron: 5, from_r: 30, to_r: 10, pace: frozen}",
       "3:84: to_r is for time that passes; the pace is frozen"},
      {"{type: infall, rest_r: 10, rate_m_per_s: 100}",
       "3:74: rate_m_per_s lets 200 M of proper time pass in the segment, but the trajectory ends "
       "35.12407366 M after its beginning; slow it down, shorten duration_s or give to_r"},
      {"{type: parabolic, periastron: 5, from_r: 30, rate_m_per_s: [1]}",
       "3:92: rate_m_per_s must be a list of 2 numbers (units of M per second of show), got 1"},
      {"{type: infall, from_r: 3, to_r: 1, pace: eased, rate_m_per_s: 3}",
       "3:95: rate_m_per_s excludes to_r; give one of them"},
      {"{type: parabolic, periastron: 5, from_r: 30, to_leg: inward, rate_m_per_s: 1}",
       "3:86: to_leg says on which leg to_r lies; give that too"},
  });
}

}  // namespace
}  // namespace domefall
