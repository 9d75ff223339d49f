// Messages about timelines, keyframes and cameras that cannot be, in full, with line and column.

#include "tests/pipeline/show/show_file.h"

namespace domefall {
namespace {

using ShowErrorsInTimelines = ShowMistakes;
using ShowErrorsInKeyframes = ShowMistakes;

TEST_F(ShowErrorsInTimelines, TheListOfSegments) {
  expect_complaints_behind_hole({
      {"timeline: []", "2:11: timeline must be a list of at least one entry, got an empty one"},
      {"timeline: {duration_s: 1}",
       "2:11: timeline must be a list of at least one entry, got a map"},
      {"timeline: [{trajectory: {type: static, r: 9}}]",
       "2:12: timeline[1].duration_s is missing (seconds)"},
      {"timeline: [{duration_s: 0, trajectory: {type: static, r: 9}}]",
       "2:25: timeline[1].duration_s must exceed 0 (seconds), got 0"},
      {"timeline: [{duration_s: 1}]",
       "2:12: timeline[1].trajectory is missing, e.g. {type: infall, from_r: 30}"},
      {"timeline: [{duration_s: 1, trajectroy: {type: static, r: 9}}]",
       "2:28: timeline[1].trajectroy is an unknown key; did you mean trajectory?"},
      {"timeline: [{duration_s: 333334, trajectory: {type: static, r: 9}}]",
       "2:12: timeline[1] brings the show to 10000020 frames; at most 10000000 are possible"},
      {"timeline: [{duration_s: 0.01, trajectory: {type: static, r: 9}}]",
       "2:11: timeline ends after 0.01 s, before half a frame is over; at 30 frames per second a "
       "frame lasts 0.03333333333 s"},
      {"timeline: [{duration_s: 1, orbits: 2, trajectory: {type: circular, r: 9}}]",
       "2:28: timeline[1].orbits is an unknown key; known here: duration_s, trajectory, fade_in_s, "
       "fade_out_s, dissolve_s, camera, exposure, grade, sky, disc, bodies, title_light, keyframes "
       "or titles"},
  });
  expect_complaints({
      {kHole, "1:1: timeline is missing: a list of segments"},
  });
}

TEST_F(ShowErrorsInTimelines, FallsOrbitsAndRestThatDoNotExist) {
  expect_complaints_of_trajectories({
      {"{r: 9}",
       "3:33: type is missing: static, circular, parabolic, hyperbolic, bound, infall, thrown, "
       "kruskal, spiral, braked, path, velocity, body or continue"},
      {"{type: infal, from_r: 9}",
       "3:40: type must be static, circular, parabolic, hyperbolic, bound, infall, thrown, "
       "kruskal, spiral, braked, path, velocity, body or continue, got 'infal'; did you mean "
       "infall?"},
      {"{type: infall, from_r: -3}", "3:56: from_r must exceed 0 (units of M), got -3"},
      {"{type: infall, from_r: 2e9, to_r: 1e8}",
       "3:56: from_r must be at most 1000000000 (units of M), got 2e9"},
      {"{type: infall, from_r: 3, to_r: 4}",
       "3:65: to_r must stay below from_r = 3 (units of M), got 4: a free fall only goes inward"},
      {"{type: infall, from_r: 30, to_r: 1e-7}",
       "3:66: to_r must be at least 1e-6 (units of M), got 1e-7"},
      {"{type: infall, from_r: 0.04}",
       "3:56: from_r must exceed 0.05 (units of M), the default of to_r, got 0.04: a free fall "
       "only goes inward"},
      {"{type: infall, from_r: 10, rate_m_per_s: 20}",
       "3:74: rate_m_per_s lets 40 M of proper time pass in the segment, but from r = 10 the "
       "singularity is 14.90711985 M away; slow it down, shorten duration_s or give to_r"},
      {"{type: infall, from_r: 10, to_r: 3, rate_m_per_s: 2}",
       "3:83: rate_m_per_s excludes to_r; give one of them"},
      {"{type: infall, from_r: 10, rate_m_per_s: 2, pace: slowing}",
       "3:83: pace of 'slowing' needs to_r, not a rate"},
      {"{type: infall, from_r: 10, pace: slow}",
       "3:66: pace must be steady, eased, eased_in, eased_out, slowing, quickening, log_r or "
       "frozen, got 'slow'; did you mean slowing?"},
      {"{type: circular, r: 3}",
       "3:53: r must exceed 3 (units of M), got 3: at the light circle an orbit needs the speed of "
       "light, below it more"},
      {"{type: circular, r: 9, orbits: 1, time_lapse: 3}",
       "3:79: time_lapse excludes orbits; give one of them"},
      {"{type: infall, from_r: 9, orbits: 1}",
       "3:59: orbits is an unknown key; known here: type, region, from_r, to_r, rest_r, "
       "angular_momentum, v_inf, impact_parameter, from_leg, from_tau_m, to_leg, to_tau_m, "
       "rate_m_per_s, time_lapse or pace"},
      {"{type: static, r: 2}",
       "3:51: r must exceed 2 (units of M), got 2: nothing holds still at or inside the horizon"},
  });
  expect_complaints({
      {"black_hole: {mass_solar: 1e-20}\ntimeline: [{duration_s: 1, trajectory: {type: circular, "
       "r: 4, time_lapse: 1}}]\n",
       "2:75: timeline[1].trajectory.time_lapse makes 8.078125856e23 orbits in the segment; at "
       "most 1000000 are possible"},
      {"timeline:\n  - {duration_s: 2, trajectory: {type: static, r: 9}}\n",
       "2:51: timeline[1].trajectory.r needs a black hole; in flat space leave it out"},
      {"timeline:\n  - {duration_s: 2, trajectory: {type: circular, r: 9}}\n",
       "2:40: timeline[1].trajectory.type 'circular' needs a black hole: give the show "
       "black_hole.mass_solar"},
      {"timeline:\n  - {duration_s: 2, trajectory: {type: infall, from_r: 9}}\n",
       "2:40: timeline[1].trajectory.type 'infall' needs a black hole: give the show "
       "black_hole.mass_solar"},
  });
}

TEST_F(ShowErrorsInTimelines, VelocitiesThatDoNotExist) {
  expect_complaints_of_trajectories({
      {"{type: velocity, r: 9, speed: 1, direction: inward}",
       "3:63: speed must stay below 1 (speed of light = 1), got 1"},
      {"{type: velocity, r: 9, lorentz_factor: 0.5, direction: inward}",
       "3:72: lorentz_factor must be at least 1, got 0.5"},
      {"{type: velocity, r: 9, speed: 0.5, lorentz_factor: 2, direction: inward}",
       "3:84: lorentz_factor excludes speed; give one of them"},
      {"{type: velocity, r: 9, direction: inward}", "3:33: speed is missing (speed of light = 1)"},
      {"{type: velocity, r: 9, speed: 0.5}",
       "3:33: direction is missing: a word such as inward or forward, {radial, theta, phi} or a "
       "place on the sky"},
      {"{type: velocity, r: 9, speed: 0.5, direction: inwards}",
       "3:79: direction must be inward, outward, forward, backward, north or south, or a place on "
       "the sky; it names 'inwards', which is no star, planet, constellation or object that "
       "Domefall knows; did you mean inward?"},
      {"{type: velocity, r: 9, speed: 0.5, direction: {radial: 0}}",
       "3:79: direction must not be the zero vector; give radial, theta or phi"},
      {"{type: velocity, r: 1.5, speed: 0.5, direction: inward}",
       "3:53: r must exceed 2 (units of M), got 1.5: inside the horizon nothing is static; a "
       "velocity there needs 'against: free_fall'"},
      {"{type: velocity, r: 9, speed: 0.5, direction: inward, against: rain}",
       "3:96: against must be static, free_fall, outgoing or constant_t, got 'rain'"},
  });
}

TEST_F(ShowErrorsInKeyframes, AreToldWithTheirPlace) {
  expect_complaints_of_lines({
      {"keyframes: [{at_s: 5, exposure: {ev: 1}}]",
       "3:20: keyframes[1].at_s lies behind the end of the show at 2 s, got 5"},
      {"keyframes: [{at_s: 1, exposure: {ev: 1}}, {at_s: 1, exposure: {ev: 1}}]",
       "3:50: keyframes[2].at_s must be later than that of the keyframe before it, 1 (seconds)"},
      {"keyframes: [{exposure: {ev: 1}}]", "3:13: keyframes[1].at_s is missing (seconds)"},
      {"keyframes: [{at_s: 1, camera: {projection: domemaster}}]",
       "3:44: keyframes[1].camera.projection holds for the whole show; it belongs in the show's "
       "own camera section"},
      {"keyframes: [{at_s: 1, camera: {look_at: motion}}]",
       "2:12: timeline[1] has a camera that looks along the motion, but its observer does not "
       "move; give the segment another camera.look_at"},
      {"keyframes: [{at_s: 0, name: first, camera: {look_at: Vega}}, {at_s: 1, camera: {look_at: "
       "{keyframe: frist}}}]",
       "3:101: keyframes[2].camera.look_at.keyframe names no keyframe before this one that has a "
       "name and a direction: 'frist'; did you mean first?"},
      {"keyframes: [{at_s: 1, ease: slow, camera: {look_at: Vega}}]",
       "3:29: keyframes[1].ease must be smooth, linear, hold, eased, eased_in or eased_out, got "
       "'slow'"},
      {"keyframes: [{at_s: 1, camera: {fov_deg: 40}}]",
       "3:41: keyframes[1].camera.fov_deg goes with the projections fisheye, stereographic and "
       "rectilinear; a domemaster shows 180 degrees"},
  });
  expect_complaints_behind_hole({
      {"timeline: [{duration_s: 2, dissolve_s: 1, trajectory: {type: static, r: 9}}]",
       "2:40: timeline[1].dissolve_s needs a segment before this one, out of which the picture "
       "fades in"},
      {"timeline: [{duration_s: 2, trajectory: {type: static, r: 9}}, {duration_s: 2, dissolve_s: "
       "3, trajectory: {type: static, r: 9}}]",
       "2:91: timeline[2].dissolve_s must be at most 2 (seconds), which is how long this segment "
       "and what is left of the one before it last, got 3"},
      {"timeline: [{duration_s: 2, trajectory: {type: static, r: 9}}, {duration_s: 2, dissolve_s: "
       "1.5, trajectory: {type: static, r: 9}}, {duration_s: 2, dissolve_s: 1, trajectory: {type: "
       "static, r: 9}}]",
       "2:159: timeline[3].dissolve_s must be at most 0.5 (seconds), which is how long this "
       "segment and what is left of the one before it last, got 1"},
      {"cameras: {up: {look_at: Vega}}\ntimeline: [{duration_s: 2, trajectory: {type: static, r: "
       "9}, camera: upp}]",
       "3:70: timeline[1].camera names a camera that the show's `cameras` does not have: 'upp'; "
       "did you mean up?"},
      {"cameras: [up]\ntimeline: [{duration_s: 2, trajectory: {type: static, r: 9}}]",
       "2:10: cameras must be a map of names and cameras, got a list"},
      {"cameras: {up: {look_at: Vega}, up: {look_at: hole}}\ntimeline: [{duration_s: 2, "
       "trajectory: {type: static, r: 9}}]",
       "2:32: cameras.up is repeated"},
      {"timeline: [{duration_s: 2, trajectory: {type: static, r: 9}, sky: {region_I: {epoch: "
       "2100}}}]",
       "2:79: timeline[1].sky.region_I.epoch is an unknown key; known here: gain, stars, "
       "background, white_cd_m2 or black_cd_m2"},
      {"timeline: [{duration_s: 2, trajectory: {type: static, r: 9}, keyframes: [{at_s: 3, "
       "exposure: {ev: 2}}]}]",
       "2:81: timeline[1].keyframes[1].at_s must be at most 2 (seconds), got 3"},
      {"timeline: [{duration_s: 2, trajectory: {type: static, r: 9}, disc: {opacity: 0}}]",
       "2:68: timeline[1].disc needs a disc: give the show one"},
      {"bodies: {beacon: {r: 9}}\ntimeline: [{duration_s: 2, trajectory: {type: static, r: 9}, "
       "bodies: {becon: {magnitude: 4}}}]",
       "3:78: timeline[1].bodies.becon is no body of the show; did you mean beacon?"},
      {"bodies: {beacon: {r: 9}}\ntimeline: [{duration_s: 2, trajectory: {type: static, r: 9}, "
       "bodies: {beacon: {temperature_k: 4000}}}]",
       "3:80: timeline[1].bodies.beacon.temperature_k is an unknown key; known here: magnitude"},
      {"bodies: {beacon: {r: 9}}\nkeyframes: [{at_s: 1, bodies: [4]}]\ntimeline: [{duration_s: 2, "
       "trajectory: {type: static, r: 9}}]",
       "3:31: keyframes[1].bodies must be a map of names, e.g. {beacon: {magnitude: 4}}, got a "
       "list"},
      {"timeline: [{duration_s: 2, trajectory: {type: static, r: 9}, exposure: {ev: 200}}]",
       "2:77: timeline[1].exposure.ev must be at most 30 (stops), got 200"},
  });
}

}  // namespace
}  // namespace domefall
