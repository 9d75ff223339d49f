// Messages about keyframes, cameras and dissolves that cannot be, in full, with line and column.
#include "tests/pipeline/show/show_mistakes.h"

namespace domefall {
namespace {

using ShowErrorsInKeyframes = ShowMistakes;

TEST_F(ShowErrorsInKeyframes, AreToldWithTheirPlace) {
  expect_complaints({
      {"DissolveOutOfNothing",
       kHole + "timeline: [{duration_s: 2, dissolve_s: 1, trajectory: {type: static, r: 9}}]\n",
       "2:40: timeline[1].dissolve_s needs a segment before this one, out of which the picture "
       "fades in"},
      {"DissolveTooLong",
       kHole + "timeline: [{duration_s: 2, trajectory: {type: static, r: 9}}, {duration_s: 2, "
               "dissolve_s: 3, trajectory: {type: static, r: 9}}]\n",
       "2:91: timeline[2].dissolve_s must be at most 2 (seconds), which is how long this segment "
       "and what is left of the one before it last, got 3"},
      {"DissolvesOverlap",
       kHole + "timeline: [{duration_s: 2, trajectory: {type: static, r: 9}}, {duration_s: 2, "
               "dissolve_s: 1.5, trajectory: {type: static, r: 9}}, {duration_s: 2, dissolve_s: 1, "
               "trajectory: {type: static, r: 9}}]\n",
       "2:159: timeline[3].dissolve_s must be at most 0.5 (seconds), which is how long this "
       "segment and what is left of the one before it last, got 1"},
      {"BehindTheEnd",
       kHole + "timeline: [{duration_s: 2, trajectory: {type: static, r: 9}}]\nkeyframes: [{at_s: "
               "5, exposure: {ev: 1}}]\n",
       "3:20: keyframes[1].at_s lies behind the end of the show at 2 s, got 5"},
      {"OutOfOrder",
       kHole + "timeline: [{duration_s: 2, trajectory: {type: static, r: 9}}]\nkeyframes: [{at_s: "
               "1, exposure: {ev: 1}}, {at_s: 1, exposure: {ev: 1}}]\n",
       "3:50: keyframes[2].at_s must be later than that of the keyframe before it, 1 (seconds)"},
      {"NoInstant",
       kHole + "timeline: [{duration_s: 2, trajectory: {type: static, r: 9}}]\nkeyframes: "
               "[{exposure: {ev: 1}}]\n",
       "3:13: keyframes[1].at_s is missing (seconds)"},
      {"ProjectionOfAKeyframe",
       kHole + "timeline: [{duration_s: 2, trajectory: {type: static, r: 9}}]\nkeyframes: [{at_s: "
               "1, camera: {projection: domemaster}}]\n",
       "3:44: keyframes[1].camera.projection holds for the whole show; it belongs in the show's "
       "own camera section"},
      {"MotionInAKeyframe",
       kHole + "timeline: [{duration_s: 2, trajectory: {type: static, r: 9}}]\nkeyframes: [{at_s: "
               "1, camera: {look_at: motion}}]\n",
       "2:12: timeline[1] has a camera that looks along the motion, but its observer does not "
       "move; give the segment another camera.look_at"},
      {"NoSuchKeyframe",
       kHole + "timeline: [{duration_s: 2, trajectory: {type: static, r: 9}}]\nkeyframes: [{at_s: "
               "0, name: first, camera: {look_at: Vega}}, {at_s: 1, camera: {look_at: {keyframe: "
               "frist}}}]\n",
       "3:101: keyframes[2].camera.look_at.keyframe names no keyframe before this one that has a "
       "name and a direction: 'frist'; did you mean first?"},
      {"EaseMisspelt",
       kHole + "timeline: [{duration_s: 2, trajectory: {type: static, r: 9}}]\nkeyframes: [{at_s: "
               "1, ease: slow, camera: {look_at: Vega}}]\n",
       "3:29: keyframes[1].ease must be smooth, linear or hold, got 'slow'"},
      {"CameraMisspelt",
       kHole + "cameras: {up: {look_at: Vega}}\ntimeline: [{duration_s: 2, trajectory: {type: "
               "static, r: 9}, camera: upp}]\n",
       "3:70: timeline[1].camera names a camera that the show's `cameras` does not have: 'upp'; "
       "did you mean up?"},
      {"CamerasNoMap",
       kHole + "cameras: [up]\ntimeline: [{duration_s: 2, trajectory: {type: static, r: 9}}]\n",
       "2:10: cameras must be a map of names and cameras, got a list"},
      {"CameraTwice",
       kHole + "cameras: {up: {look_at: Vega}, up: {look_at: hole}}\ntimeline: [{duration_s: 2, "
               "trajectory: {type: static, r: 9}}]\n",
       "2:32: cameras.up is repeated"},
      {"FieldOfViewOfADome",
       kHole + "timeline: [{duration_s: 2, trajectory: {type: static, r: 9}}]\nkeyframes: [{at_s: "
               "1, camera: {fov_deg: 40}}]\n",
       "3:41: keyframes[1].camera.fov_deg goes with the projections fisheye, stereographic and "
       "rectilinear; a domemaster shows 180 degrees"},
      {"SkyOfASegment",
       kHole + "timeline: [{duration_s: 2, trajectory: {type: static, r: 9}, sky: {region_I: "
               "{epoch: 2100}}}]\n",
       "2:79: timeline[1].sky.region_I.epoch is an unknown key; known here: gain, stars, "
       "background, "
       "white_cd_m2 or black_cd_m2"},
      {"BehindTheSegment",
       kHole + "timeline: [{duration_s: 2, trajectory: {type: static, r: 9}, keyframes: [{at_s: 3, "
               "exposure: {ev: 2}}]}]\n",
       "2:81: timeline[1].keyframes[1].at_s must be at most 2 (seconds), got 3"},
      {"ExposureOfASegment",
       kHole +
           "timeline: [{duration_s: 2, trajectory: {type: static, r: 9}, exposure: {ev: 200}}]\n",
       "2:77: timeline[1].exposure.ev must be at most 30 (stops), got 200"},
  });
}

}  // namespace
}  // namespace domefall
