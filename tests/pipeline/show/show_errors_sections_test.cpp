// Messages about cameras, skies and grades that cannot be had, in full, with line and column.
#include "tests/pipeline/show/show_file.h"

namespace domefall {
namespace {

using ShowErrorsInSections = ShowMistakes;

TEST_F(ShowErrorsInSections, FrameRateSizeAndHole) {
  expect_complaints_of_lines({
      {"frames_per_second: 0.5",
       "3:20: frames_per_second must be at least 1 (frames per second), got 0.5"},
      {"frames_per_second: 241",
       "3:20: frames_per_second must be at most 240 (frames per second), got 241"},
      {"size: 4 k",
       "3:7: size must be 1k, 2k, 4k, 8k or a number of pixels from 16 to 16384, got '4 k'; did "
       "you mean 4k?"},
      {"size: 3k",
       "3:7: size must be 1k, 2k, 4k, 8k or a number of pixels from 16 to 16384, got '3k'"},
      {"size: 15", "3:7: size must be at least 16 (pixels), got 15"},
      {"size: 16385", "3:7: size must be at most 16384 (pixels), got 16385"},
      {"size: 1024.5", "3:7: size must be a whole number (pixels), got 1024.5"},
      {"size: [1920, 1080]",
       "3:7: size must be 1k, 2k, 4k, 8k or a number of pixels (a domemaster is square), got a "
       "list"},
      {"size: 4k\ncamera: {projection: stereographic}",
       "3:7: size must be [width, height] in pixels (this projection is flat), got '4k'"},
      {"camera: {look_at: {ra_deg: 10}}", "3:19: camera.look_at.dec_deg is missing (degrees)"},
  });
  expect_complaints({
      {"black_hole: {mass_solar: -1}\ntimeline: [{duration_s: 1, trajectory: {type: static, r: "
       "9}}]\n",
       "1:26: black_hole.mass_solar must be at least 0 (solar masses; 0 is flat space), got -1"},
      {"black_hole: {mass_solar: 1e-300}\ntimeline: [{duration_s: 1, trajectory: {type: static, r: "
       "9}}]\n",
       "1:26: black_hole.mass_solar must be 0 (flat space) or at least 1e-20 (solar masses), got "
       "1e-300"},
      {"black_hole: {mass: 4e6}\ntimeline: [{duration_s: 1, trajectory: {type: infall, from_r: "
       "9}}]\n",
       "1:14: black_hole.mass is an unknown key; did you mean mass_solar?"},
      {"black_hole: {mass_solar: 1, at: {ra_deg: 10, dec_deg: 91}}\ntimeline: [{duration_s: 1, "
       "trajectory: {type: static, r: 9}}]\n",
       "1:55: black_hole.at.dec_deg must be at most 90 (degrees), got 91"},
  });
}

TEST_F(ShowErrorsInSections, Cameras) {
  expect_complaints_of_lines({
      {"camera: {fov_deg: 90}",
       "3:19: camera.fov_deg goes with the projections fisheye, stereographic and rectilinear; a "
       "domemaster shows 180 degrees"},
      {"camera: {projection: stereographic, fov_deg: 360}",
       "3:46: camera.fov_deg must stay below 360 (degrees), got 360"},
      {"camera: {projection: stereographic, elevation_deg: 3}",
       "3:52: camera.elevation_deg is for domes; this projection is flat"},
      {"camera: {euler_deg: [0, 0, 0], look_at: hole}",
       "3:41: camera.look_at excludes euler_deg; give one of them"},
      {"camera: {roll_deg: 3, euler_deg: [0, 0, 0]}",
       "3:20: camera.roll_deg excludes euler_deg; give one of them"},
      {"camera: {euler_deg: [0, 0]}",
       "3:21: camera.euler_deg must be a list of 3 numbers (degrees), got 2"},
      {"camera: {look_at: motion}",
       "2:12: timeline[1] has a camera that looks along the motion, but its observer does not "
       "move; give the segment another camera.look_at"},
      {"camera: {look_at: Betelgeuze}",
       "3:19: camera.look_at must be hole, motion or outward, or a place on the sky; it names "
       "'Betelgeuze', which is no star, planet, constellation or object that Domefall knows; did "
       "you mean Betelgeuse?"},
      {"camera: {look_at: Qwertyuiop}",
       "3:19: camera.look_at must be hole, motion or outward, or a place on the sky; it names "
       "'Qwertyuiop', which is no star, planet, constellation or object that Domefall knows"},
      {"camera: {look_at: holes}",
       "3:19: camera.look_at must be hole, motion or outward, or a place on the sky; it names "
       "'holes', which is no star, planet, constellation or object that Domefall knows; did you "
       "mean hole?"},
  });
  expect_complaints_behind_hole({
      {"timeline:\n  - duration_s: 1\n    trajectory: {type: static, r: 9}\n    camera: "
       "{projection: domemaster}",
       "5:26: timeline[1].camera.projection holds for the whole show; it belongs in the show's own "
       "camera section"},
      {"camera: {euler_deg: [0, 0, 0]}\ntimeline:\n  - {duration_s: 1, trajectory: {type: static, "
       "r: 9}, camera: {roll_deg: 9}}",
       "4:74: timeline[1].camera.roll_deg goes with look_at only; the show's camera is turned by "
       "euler_deg"},
  });
  expect_complaints({
      {kHole + "camera: {look_at: Orino}\n" + kShow.substr(kHole.size()),
       "2:19: camera.look_at must be hole, motion or outward, or a place on the sky; it names "
       "'Orino', which is no star, planet, constellation or object that Domefall knows; did you "
       "mean Orion?"},
      {"black_hole: {mass_solar: 1, at: Adromeda Galaxy}\n" + kShow.substr(kHole.size()),
       "1:33: black_hole.at names 'Adromeda Galaxy', which is no star, planet, constellation or "
       "object that Domefall knows; did you mean Andromeda Galaxy?"},
  });
}

TEST_F(ShowErrorsInSections, SkiesAndStars) {
  expect_complaints_of_lines({
      {"sky: {region_I: {background: sky.exr}}",
       "3:30: sky.region_I.background names the file 'sky.exr', which is neither beside the show "
       "nor in the working folder"},
      {"sky: {region_I: {background: ./assets}}",
       "3:30: sky.region_I.background names the file './assets', which is a folder"},
      {"sky: {region_III: {background: milkyway}}",
       "3:32: sky.region_III.background must be milky_way, grid or black or an image file, got "
       "'milkyway'; did you mean milky_way?"},
      {"sky: {region_I: {stars: {catalogue: hip.csv}}}",
       "3:37: sky.region_I.stars.catalogue names the file 'hip.csv', which is neither beside the "
       "show nor in the working folder"},
      {"sky: {region_I: {stars: naked_eyes}}",
       "3:25: sky.region_I.stars must be standard, naked_eye, deepest, none or a star catalogue "
       "(.stars, .csv), got 'naked_eyes'; did you mean naked_eye?"},
      {"sky: {region_I: {gain: -0.5}}", "3:24: sky.region_I.gain must be at least 0, got -0.5"},
      {"sky: {region_I: {background: rings}}",
       "3:30: sky.region_I.background must be milky_way, grid or black or an image file, got "
       "'rings'"},
      {"sky: {region_IV: ringz}",
       "3:18: sky.region_IV must be milky_way, grid, black or rings or an image file, got 'ringz'; "
       "did you mean rings?"},
      {"sky: {region_IV: {background: rings, period_m: 0}}",
       "3:48: sky.region_IV.period_m must be at least 0.001 (units of M), got 0"},
      {"sky: {region_IV: {background: grid, period_m: 2}}",
       "3:47: sky.region_IV.period_m is the period of rings; the background must be rings"},
      {"sky: {region_IV: {background: gird, period_m: 2}}",
       "3:31: sky.region_IV.background must be milky_way, grid, black or rings or an image file, "
       "got 'gird'; did you mean grid?"},
      {"sky: {region_I: {background: grid, black_cd_m2: 1e-5}}",
       "3:49: sky.region_I.black_cd_m2 is the black of a map; the background must be milky_way, a "
       ".sky file or an image"},
      {"sky: {region_IV: {background: rings, black_cd_m2: auto}}",
       "3:51: sky.region_IV.black_cd_m2 is the black of a map; the background must be milky_way, a "
       ".sky file or an image"},
      {"sky: {region_I: {background: gird, black_cd_m2: 1}}",
       "3:30: sky.region_I.background must be milky_way, grid or black or an image file, got "
       "'gird'; did you mean grid?"},
      {"sky: {region_III: {black_cd_m2: -1}}",
       "3:33: sky.region_III.black_cd_m2 must be at least 0 (cd/m^2, or auto, or none), got -1"},
      {"sky: {region_III: {black_cd_m2: dark}}",
       "3:33: sky.region_III.black_cd_m2 must be a number (cd/m^2, or auto, or none), got 'dark'"},
      {"sky: {region_III: {period_m: 2}}",
       "3:20: sky.region_III.period_m is an unknown key; known here: gain, stars, background, "
       "white_cd_m2 or black_cd_m2"},
      {"sky: {epoch: 30001}", "3:14: sky.epoch must be at most 30000 (Julian years), got 30001"},
      {"sky: {blueshift_power: 11}", "3:24: sky.blueshift_power must be at most 10, got 11"},
      {"stars: {min_sigma_deg: 0.5, max_sigma_deg: 0.2}",
       "3:44: stars.max_sigma_deg must be at least min_sigma_deg = 0.5 (degrees), got 0.2"},
      {"stars: {growth: 0.6}", "3:17: stars.growth must be at most 0.5, got 0.6"},
      {"stars: {law: pfs}", "3:14: stars.law must be size or psf, got 'pfs'; did you mean psf?"},
      {"stars: {law: size, halo: 0.2}",
       "3:26: stars.halo belongs to stars.law: psf, but the law is size"},
      {"stars: {law: psf, growth: 0.2}",
       "3:27: stars.growth belongs to stars.law: size, but the law is psf"},
      {"stars: {law: psf, halo: 1}", "3:25: stars.halo must be at most 0.9, got 1"},
      {"stars: {law: psf, halo_sigma_deg: 4}",
       "3:35: stars.halo_sigma_deg must be at most 3 (degrees), got 4"},
      {"stars: {white_core: -1}", "3:21: stars.white_core must be at least 0, got -1"},
  });
}

TEST_F(ShowErrorsInSections, Effects) {
  const std::string told =
      "effects.lensing can be false outside the horizon only (r > 2), but frame ";
  expect_complaints_of_lines({
      {"effects: {aberration: 0}", "3:23: effects.aberration must be true or false, got '0'"},
      {"effects: {lensign: false}",
       "3:11: effects.lensign is an unknown key; did you mean lensing?"},
      {"effects: {amplification: star}",
       "3:26: effects.amplification must be stars, none or everything, got 'star'; did you mean "
       "stars?"},
      {"effects: none",
       "3:10: effects must be a map of keys (aberration, doppler_colour, intensity, lensing or "
       "amplification), got 'none'"},
  });
  expect_complaints({
      {moving("{type: velocity, r: 1.5, against: free_fall, speed: 0}") +
           "effects: {lensing: false}\n",
       "4:20: " + told + "0, in timeline[1], lies at r = 1.5 (units of M)"},
      {moving("{type: velocity, r: 1.5, region: IV, against: outgoing, speed: 0}") +
           "effects: {lensing: false}\n",
       "4:20: " + told + "0, in timeline[1], lies at r = 1.5 (units of M)"},
      {moving("{type: velocity, r: 2, against: free_fall, speed: 0}") +
           "effects: {lensing: false}\n",
       "4:20: " + told + "0, in timeline[1], lies at r = 2 (units of M)"},
      {kHole + "timeline:\n  - {duration_s: 1, trajectory: {type: static, r: 9}}\n  - {duration_s: "
               "2, trajectory: {type: infall, from_r: 9, to_r: 1, pace: slowing}}\neffects: "
               "{lensing: false}\n",
       "5:20: " + told + "89, in timeline[2], lies at r = 1.037299197 (units of M)"},
      {moving("{type: infall, from_r: -3}") + "effects: {lensing: false}\n",
       "3:56: timeline[1].trajectory.from_r must exceed 0 (units of M), got -3"},
  });
}

TEST_F(ShowErrorsInSections, ExposureAndGrade) {
  expect_complaints_of_lines({
      {"exposure: {ev: 31}", "3:16: exposure.ev must be at most 30 (stops), got 31"},
      {"frames_per_second: 24/1.001",
       "3:20: frames_per_second must be a number, or a fraction of two whole numbers up to 1001000 "
       "such as 24000/1001, got '24/1.001'"},
      {"frames_per_second: 500/2",
       "3:20: frames_per_second must be at most 240 (frames per second), got 500/2"},
      {"grade: {config: \"ocio://default\"}",
       "3:17: grade.config names a configuration that OpenColorIO 2.2 and later have built in; "
       "this build has OpenColorIO 2.1, which has none; name a file, got 'ocio://default'"},
      {"grade: {config: house.ocio}",
       "3:17: grade.config names the file 'house.ocio', which is neither beside the show nor in "
       "the working folder"},
      {"camera: {projection: stereographic}\ndome: {light: simulate}",
       "4:15: dome.light is for domes; this projection is flat"},
  });
}

}  // namespace
}  // namespace domefall
