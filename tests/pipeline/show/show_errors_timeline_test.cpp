// Messages about timelines that cannot be flown, in full, with line and column.
#include "tests/pipeline/show/show_mistakes.h"

namespace domefall {
namespace {

using ShowErrorsInTimelines = ShowMistakes;

TEST_F(ShowErrorsInTimelines, TheListOfSegments) {
  expect_complaints({
      {"NoTimeline", kHole, "1:1: timeline is missing: a list of segments"},
      {"EmptyTimeline", kHole + "timeline: []\n",
       "2:11: timeline must be a list of at least one entry, got an empty one"},
      {"TimelineNoList", kHole + "timeline: {duration_s: 1}\n",
       "2:11: timeline must be a list of at least one entry, got a map"},
      {"NoDuration", kHole + "timeline: [{trajectory: {type: static, r: 9}}]\n",
       "2:12: timeline[1].duration_s is missing (seconds)"},
      {"DurationZero", kHole + "timeline: [{duration_s: 0, trajectory: {type: static, r: 9}}]\n",
       "2:25: timeline[1].duration_s must exceed 0 (seconds), got 0"},
      {"NoTrajectory", kHole + "timeline: [{duration_s: 1}]\n",
       "2:12: timeline[1].trajectory is missing, e.g. {type: infall, from_r: 30}"},
      {"TrajectoryMisspelt",
       kHole + "timeline: [{duration_s: 1, trajectroy: {type: static, r: 9}}]\n",
       "2:28: timeline[1].trajectroy is an unknown key; did you mean trajectory?"},
      {"TooManyFrames",
       kHole + "timeline: [{duration_s: 333334, trajectory: {type: static, r: 9}}]\n",
       "2:12: timeline[1] brings the show to 10000020 frames; at most 10000000 are possible"},
      {"OverBeforeAnyFrame",
       kHole + "timeline: [{duration_s: 0.01, trajectory: {type: static, r: 9}}]\n",
       "2:11: timeline ends after 0.01 s, before half a frame is over; at 30 frames per second a "
       "frame lasts 0.03333333333 s"},
      {"PaceOutsideTheTrajectory",
       kHole + "timeline: [{duration_s: 1, orbits: 2, trajectory: {type: circular, r: 9}}]\n",
       "2:28: timeline[1].orbits is an unknown key; known here: duration_s, dissolve_s, fade_in_s, "
       "fade_out_s, trajectory, camera, exposure, grade, sky, keyframes or titles"},
  });
}

TEST_F(ShowErrorsInTimelines, FallsOrbitsAndRestThatDoNotExist) {
  expect_complaints({
      {"NoType", moving("{r: 9}"),
       "3:33: timeline[1].trajectory.type is missing: static, circular, parabolic, hyperbolic, "
       "bound, infall, thrown, kruskal, path, velocity, body or continue"},
      {"TypeMisspelt", moving("{type: infal, from_r: 9}"),
       "3:40: timeline[1].trajectory.type must be static, circular, parabolic, hyperbolic, "
       "bound, infall, thrown, kruskal, path, velocity, body or continue, got "
       "'infal'; did you mean infall?"},
      {"FromRNegative", moving("{type: infall, from_r: -3}"),
       "3:56: timeline[1].trajectory.from_r must exceed 0 (units of M), got -3"},
      {"FromRTooFar", moving("{type: infall, from_r: 2e9, to_r: 1e8}"),
       "3:56: timeline[1].trajectory.from_r must be at most 1000000000 (units of M), got 2e9"},
      {"FallOutward", moving("{type: infall, from_r: 3, to_r: 4}"),
       "3:65: timeline[1].trajectory.to_r must stay below from_r = 3 (units of M), got 4: a free "
       "fall only goes inward"},
      {"ToRTooDeep", moving("{type: infall, from_r: 30, to_r: 1e-7}"),
       "3:66: timeline[1].trajectory.to_r must be at least 1e-6 (units of M), got 1e-7"},
      {"FromRBelowTheDefaultEnd", moving("{type: infall, from_r: 0.04}"),
       "3:56: timeline[1].trajectory.from_r must exceed 0.05 (units of M), the default of to_r, "
       "got 0.04: a free fall only goes inward"},
      {"FallIntoTheSingularity", moving("{type: infall, from_r: 10, rate_m_per_s: 20}"),
       "3:74: timeline[1].trajectory.rate_m_per_s lets 40 M of proper time pass in the segment, "
       "but from r = 10 the singularity is 14.90711985 M away; slow it down, shorten duration_s or "
       "give to_r"},
      {"FallTimedTwice", moving("{type: infall, from_r: 10, to_r: 3, rate_m_per_s: 2}"),
       "3:83: timeline[1].trajectory.rate_m_per_s excludes to_r; give one of them"},
      {"SlowingAtAGivenRate", moving("{type: infall, from_r: 10, rate_m_per_s: 2, pace: slowing}"),
       "3:83: timeline[1].trajectory.pace of 'slowing' needs to_r, not a rate"},
      {"PaceMisspelt", moving("{type: infall, from_r: 10, pace: slow}"),
       "3:66: timeline[1].trajectory.pace must be steady, eased, eased_in, eased_out, slowing, "
       "quickening, log_r or frozen, got 'slow'; did you mean "
       "slowing?"},
      {"OrbitAtTheLightCircle", moving("{type: circular, r: 3}"),
       "3:53: timeline[1].trajectory.r must exceed 3 (units of M), got 3: at the light circle an "
       "orbit needs the speed of light, below it more"},
      {"MoreOrbitsThanAngleCanCount",
       "black_hole: {mass_solar: 1e-20}\n"
       "timeline: [{duration_s: 1, trajectory: {type: circular, r: 4, time_lapse: 1}}]\n",
       "2:75: timeline[1].trajectory.time_lapse makes 8.078125856e23 orbits in the segment; at "
       "most 1000000 are possible"},
      {"OrbitTimedTwice", moving("{type: circular, r: 9, orbits: 1, time_lapse: 3}"),
       "3:79: timeline[1].trajectory.time_lapse excludes orbits; give one of them"},
      {"FallCountedInOrbits", moving("{type: infall, from_r: 9, orbits: 1}"),
       "3:59: timeline[1].trajectory.orbits is an unknown key; known here: type, from_r, to_r, "
       "pace, rate_m_per_s, "
       "time_lapse, region, rest_r, angular_momentum, v_inf, impact_parameter, from_leg, "
       "from_tau_m, "
       "to_leg or to_tau_m"},
      {"StaticAtTheHorizon", moving("{type: static, r: 2}"),
       "3:51: timeline[1].trajectory.r must exceed 2 (units of M), got 2: nothing holds still at "
       "or inside the horizon"},
      {"StaticInFlatSpaceWithRadius",
       "timeline:\n"
       "  - {duration_s: 2, trajectory: {type: static, r: 9}}\n",
       "2:51: timeline[1].trajectory.r needs a black hole; in flat space leave it out"},
      {"OrbitInFlatSpace",
       "timeline:\n"
       "  - {duration_s: 2, trajectory: {type: circular, r: 9}}\n",
       "2:40: timeline[1].trajectory.type 'circular' needs a black hole: give the show "
       "black_hole.mass_solar"},
      {"FallInFlatSpace",
       "timeline:\n"
       "  - {duration_s: 2, trajectory: {type: infall, from_r: 9}}\n",
       "2:40: timeline[1].trajectory.type 'infall' needs a black hole: give the show "
       "black_hole.mass_solar"},
  });
}

TEST_F(ShowErrorsInTimelines, VelocitiesThatDoNotExist) {
  expect_complaints({
      {"SpeedOfLight", moving("{type: velocity, r: 9, speed: 1, direction: inward}"),
       "3:63: timeline[1].trajectory.speed must stay below 1 (speed of light = 1), got 1"},
      {"LorentzFactorBelowOne",
       moving("{type: velocity, r: 9, lorentz_factor: 0.5, direction: inward}"),
       "3:72: timeline[1].trajectory.lorentz_factor must be at least 1, got 0.5"},
      {"SpeedTwice",
       moving("{type: velocity, r: 9, speed: 0.5, lorentz_factor: 2, direction: inward}"),
       "3:84: timeline[1].trajectory.lorentz_factor excludes speed; give one of them"},
      {"NoSpeed", moving("{type: velocity, r: 9, direction: inward}"),
       "3:33: timeline[1].trajectory.speed is missing (speed of light = 1)"},
      {"NoDirection", moving("{type: velocity, r: 9, speed: 0.5}"),
       "3:33: timeline[1].trajectory.direction is missing: a word such as inward or forward, "
       "{radial, theta, phi} or a place on the sky"},
      {"DirectionMisspelt", moving("{type: velocity, r: 9, speed: 0.5, direction: inwards}"),
       "3:79: timeline[1].trajectory.direction must be inward, outward, forward, backward, north "
       "or south, or a place on the sky; it names 'inwards', which is no star, constellation or "
       "object that Domefall knows; did you mean inward?"},
      {"NoDirectionAtAll", moving("{type: velocity, r: 9, speed: 0.5, direction: {radial: 0}}"),
       "3:79: timeline[1].trajectory.direction must not be the zero vector; give radial, theta or "
       "phi"},
      {"StaticFrameInsideTheHorizon",
       moving("{type: velocity, r: 1.5, speed: 0.5, direction: inward}"),
       "3:53: timeline[1].trajectory.r must exceed 2 (units of M), got 1.5: inside the horizon "
       "nothing is static; a velocity there needs 'against: free_fall'"},
      {"UnknownFrame",
       moving("{type: velocity, r: 9, speed: 0.5, direction: inward, against: rain}"),
       "3:96: timeline[1].trajectory.against must be static, free_fall, outgoing or constant_t, "
       "got 'rain'"},
  });
}

}  // namespace
}  // namespace domefall
