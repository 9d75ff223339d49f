// Messages about orbits that do not exist and clocks that no trajectory has, in full, with line and
// column.
#include "tests/pipeline/show/show_mistakes.h"

namespace domefall {
namespace {

using ShowErrorsInOrbits = ShowMistakes;

TEST_F(ShowErrorsInOrbits, Parabolas) {
  expect_complaints({
      {"Parabolas1", moving("{type: parabolic}"),
       "3:33: timeline[1].trajectory.periastron is missing (units of M); or give angular_momentum "
       "(units of M), or excess"},
      {"Parabolas2", moving("{type: parabolic, periastron: 4}"),
       "3:63: timeline[1].trajectory.periastron must exceed 4 (units of M), got 4: what falls from "
       "rest at infinity does not come back from there"},
      {"Parabolas3", moving("{type: parabolic, periastron: 5}"),
       "3:33: timeline[1].trajectory.from_r is missing (units of M): where it begins"},
      {"Parabolas4", moving("{type: parabolic, angular_momentum: 3.9, from_r: 30}"),
       "3:69: timeline[1].trajectory.angular_momentum must exceed 4 (units of M), got 3.9: what "
       "falls from rest at infinity with less is captured"},
  });
}

TEST_F(ShowErrorsInOrbits, Hyperbolas) {
  expect_complaints({
      {"Hyperbolas1", moving("{type: hyperbolic, v_inf: 0.4, periastron: 3.5, from_r: 30}"),
       "3:59: timeline[1].trajectory.v_inf must exceed 0.4714045208 (fraction of c), got 0.4: to "
       "turn at r = 3.5 takes more than 141323.52 km/s"},
      {"Hyperbolas2", moving("{type: hyperbolic, v_inf: 0.4, periastron: 3, from_r: 30}"),
       "3:76: timeline[1].trajectory.periastron must exceed 3 (units of M), got 3: no orbit turns "
       "there"},
      {"Hyperbolas3", moving("{type: hyperbolic, v_inf: 1.4, periastron: 5, from_r: 30}"),
       "3:59: timeline[1].trajectory.v_inf must stay below 1 (speed of light = 1), got 1.4"},
      {"Hyperbolas4", moving("{type: hyperbolic, v_inf: 0.4, impact_parameter: 5, from_r: 30}"),
       "3:82: timeline[1].trajectory.impact_parameter must exceed 10.68688275 (units of M), got 5: "
       "at v_inf = 0.4 what comes closer is captured"},
      {"Hyperbolas5", moving("{type: hyperbolic, v_inf: 0.4, from_r: 30}"),
       "3:33: timeline[1].trajectory.periastron is missing (units of M); or give impact_parameter "
       "(units of M)"},
      {"Hyperbolas6", moving("{type: hyperbolic, excess: 1e-3, periastron: 5, from_r: 30}"),
       "3:78: timeline[1].trajectory.periastron must be below 4 (units of M), got 5: from there on "
       "any speed is enough"},
  });
}

TEST_F(ShowErrorsInOrbits, BoundOrbits) {
  expect_complaints({
      {"BoundOrbits1", moving("{type: bound, periastron: 3.9, apoastron: 20}"),
       "3:59: timeline[1].trajectory.periastron must exceed 4.444444444 (units of M), got 3.9: "
       "below it an orbit that rises to 20 falls into the hole"},
      {"BoundOrbits2", moving("{type: bound, periastron: 20, apoastron: 5}"),
       "3:74: timeline[1].trajectory.apoastron must exceed 6 (units of M), got 5: no stable orbit "
       "is smaller"},
      {"BoundOrbits3", moving("{type: bound, eccentricity: 0.5, semilatus_rectum: 6.9}"),
       "3:84: timeline[1].trajectory.semilatus_rectum must exceed 7 (units of M), got 6.9: at e = "
       "0.5 a smaller orbit falls into the hole (p > 6 + 2e)"},
      {"BoundOrbits4", moving("{type: bound, periastron: 5}"),
       "3:33: timeline[1].trajectory.apoastron is missing (units of M)"},
  });
}

TEST_F(ShowErrorsInOrbits, Falls) {
  expect_complaints({
      {"Falls1", moving("{type: infall, rest_r: 10, angular_momentum: 5}"),
       "3:78: timeline[1].trajectory.angular_momentum must be below 3.535533906 (units of M), got "
       "5: with more, what starts at r = 10 does not fall in"},
      {"Falls2", moving("{type: infall, rest_r: 1}"),
       "3:56: timeline[1].trajectory.rest_r must exceed 2 (units of M), got 1: nothing rests at or "
       "inside the horizon"},
      {"Falls3", moving("{type: infall, from_r: 10, angular_momentum: 4}"),
       "3:78: timeline[1].trajectory.angular_momentum must be below 4 (units of M), got 4: what "
       "falls from rest at infinity with more comes back"},
      {"Falls4", moving("{type: infall, v_inf: 0.5, impact_parameter: 9, from_r: 10}"),
       "3:78: timeline[1].trajectory.impact_parameter must be below 8.80733895 (units of M), got "
       "9: at v_inf = 0.5 what passes farther out comes back"},
  });
}

TEST_F(ShowErrorsInOrbits, Throws) {
  expect_complaints({
      {"Throws1", moving("{type: thrown, from_r: 10, speed: 0.5}"),
       "3:33: timeline[1].trajectory.direction is missing: a word such as inward or forward, "
       "{radial, theta, phi} or a place on the sky"},
      {"Throws2", moving("{type: thrown, from_r: 1, speed: 0.5, direction: outward}"),
       "3:56: timeline[1].trajectory.from_r must exceed 2 (units of M), got 1: inside the horizon "
       "nothing is static; a velocity there needs 'against: free_fall'"},
      {"Throws3", moving("{type: kruskal, energy: -1}"),
       "3:57: timeline[1].trajectory.energy must be at least 0, got -1"},
      {"Throws4", moving("{type: kruskal, energy: 1e-9}"),
       "3:57: timeline[1].trajectory.energy must be at least 1e-6 (of the unit of mass), got "
       "1e-9: closer to 0 it is 0 in double precision"},
      {"Throws5", moving("{type: continue}"),
       "3:33: timeline[1].trajectory goes on with the trajectory of the segment before, but this "
       "is the first segment"},
      {"Throws6", moving("{type: velocity, r: 5, speed: [0, 1], direction: inward}"),
       "3:67: timeline[1].trajectory.speed[2] must stay below 1 (speed of light = 1), got 1"},
  });
}

TEST_F(ShowErrorsInOrbits, Paths) {
  expect_complaints({
      {"Paths1", moving("{type: path}"),
       "3:33: timeline[1].trajectory.keyframes is missing: a list of {at_m, r, azimuth_deg}; or "
       "give file, a table of states"},
      {"Paths2", moving("{type: path, keyframes: [{at_m: 0, r: 5}]}"),
       "3:57: timeline[1].trajectory.keyframes cannot be flown: a path must have at least 2 keys"},
      {"Paths3", moving("{type: path, keyframes: [{at_m: 0, r: 5}, {at_m: 0, r: 4}]}"),
       "3:57: timeline[1].trajectory.keyframes cannot be flown: key 2, at proper time 0 (units of "
       "M): its proper "
       "time must exceed that of the key before"},
      {"Paths4", moving("{type: path, keyframes: [{at_m: 0, r: 1.5}, {at_m: 10, r: 1.4}]}"),
       "3:57: timeline[1].trajectory.keyframes cannot be flown: key 1, at proper time 0 (units of "
       "M): after it, at "
       "r = 1.5, the path is faster than light: it must cross r faster, or turn less"},
      {"Paths5",
       moving("{type: path, keyframes: [{at_m: 0, r: 5}, {at_m: 10, r: 4}], to_tau_m: 11}"),
       "3:104: timeline[1].trajectory.to_tau_m must be at least 0, where the segment begins, and "
       "below 10 (units of M), got 11"},
      {"Paths6", moving("{type: path, file: nix.csv}"),
       "3:52: timeline[1].trajectory.file names the file 'nix.csv', which is neither beside the "
       "show nor in the working folder"},
  });
}

TEST_F(ShowErrorsInOrbits, Clocks) {
  expect_complaints({
      {"Clocks1", moving("{type: parabolic, periastron: 5, from_r: 4}"),
       "3:74: timeline[1].trajectory.from_r is not passed on the inward leg by this trajectory; it "
       "moves between r = 5 M and infinity"},
      {"Clocks2", moving("{type: parabolic, periastron: 5, from_r: 30, to_r: 4}"),
       "3:84: timeline[1].trajectory.to_r is not passed after the segment's beginning; it moves "
       "between r = 5 M and infinity"},
      {"Clocks3", moving("{type: parabolic, periastron: 5, from_r: 30, pace: slowing}"),
       "3:84: timeline[1].trajectory.pace of 'slowing' needs a trajectory that ends in the "
       "singularity"},
      {"Clocks4", moving("{type: parabolic, periastron: 5, from_r: 30, to_r: 10, pace: frozen}"),
       "3:84: timeline[1].trajectory.to_r is for time that passes; the pace is frozen"},
      {"Clocks5", moving("{type: infall, rest_r: 10, rate_m_per_s: 100}"),
       "3:74: timeline[1].trajectory.rate_m_per_s lets 200 M of proper time pass in the segment, "
       "but the trajectory ends 35.12407366 M after its beginning; slow it down, shorten "
       "duration_s or give to_r"},
      {"Clocks6", moving("{type: parabolic, periastron: 5, from_r: 30, rate_m_per_s: [1]}"),
       "3:92: timeline[1].trajectory.rate_m_per_s must be a list of 2 numbers (units of M per "
       "second of show), got 1"},
      {"Clocks7", moving("{type: infall, from_r: 3, to_r: 1, pace: eased, rate_m_per_s: 3}"),
       "3:95: timeline[1].trajectory.rate_m_per_s excludes to_r; give one of them"},
      {"Clocks8",
       moving("{type: parabolic, periastron: 5, from_r: 30, to_leg: inward, rate_m_per_s: 1}"),
       "3:86: timeline[1].trajectory.to_leg says on which leg to_r lies; give that too"},
  });
}

}  // namespace
}  // namespace domefall
