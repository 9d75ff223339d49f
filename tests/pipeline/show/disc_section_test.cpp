// Tests of what the keys of `disc` mean, and of the messages about discs that cannot be had.
#include "tests/pipeline/show/show_file.h"

namespace domefall {
namespace {

using DiscKeys = ShowKeys;
using DiscMistakes = ShowMistakes;

// How far above the disc's plane the observer of a frame stands, in degrees.
double elevation_deg(const Show& show, int frame) {
  const V3d place = column(frame_state(show, frame).observer.sky_from_tetrad, 0);
  return std::asin(std::clamp(place.dot(show.disc.value().normal.v), -1.0, 1.0)) / kDegree;
}

TEST_F(DiscKeys, AShowHasADiscOnlyIfItSaysSo) {
  EXPECT_FALSE(with("").disc);
  const Disc disc = with("disc: {}\n").disc.value();
  EXPECT_EQ(disc.inner, 6);
  EXPECT_EQ(disc.outer, 20);
  EXPECT_EQ(disc.t_max_k, 3000);
  EXPECT_EQ(disc.luminance, 1e-2);
  EXPECT_EQ(disc.opacity, 1);
  EXPECT_FALSE(disc.plunging);
}

TEST_F(DiscKeys, NearAChargeADiscReachesFurtherIn) {
  const auto near_charge = [this](const std::string& disc) {
    return with(disc, "{type: static, r: 9}", "{mass_solar: 4e6, charge: 1}").disc.value();
  };
  const Disc disc = near_charge("disc: {}\n");
  EXPECT_EQ(disc.inner, 4);
  EXPECT_EQ(disc.orbits.last_stable(), 4);
  EXPECT_EQ(disc.orbits.charge_squared(), 1);
  EXPECT_EQ(near_charge("disc: {plunging: true}\n").inner, 1);
  const Disc spotted = near_charge("disc: {pattern: {type: spot, r: 4.5}}\n");
  EXPECT_EQ(spotted.patterns, std::vector<PatternKind>{SpotPattern({4.5})});
}

TEST_F(DiscKeys, EveryKeyIsTaken) {
  const Disc disc =
      with("disc: {inner_r: 7, outer_r: 30, t_max_k: 5e6, luminance_cd_m2: 0.02, opacity: 0.25}\n")
          .disc.value();
  EXPECT_EQ(disc.inner, 7);
  EXPECT_EQ(disc.outer, 30);
  EXPECT_EQ(disc.t_max_k, 5e6);
  EXPECT_EQ(disc.luminance, 0.02);
  EXPECT_EQ(disc.opacity, 0.25);
}

TEST_F(DiscKeys, PlungingGasReachesTheHorizonUnlessItIsCutOff) {
  EXPECT_EQ(with("disc: {plunging: true}\n").disc->inner, 2);
  EXPECT_EQ(with("disc: {plunging: true, inner_r: 4}\n").disc->inner, 4);
  EXPECT_TRUE(with("disc: {plunging: true}\n").disc->plunging);
}

TEST_F(DiscKeys, TheObserverBeginsAboveThePlaneByTheInclination) {
  EXPECT_NEAR(elevation_deg(with("disc: {}\n"), 0), 10, 1e-9);
  EXPECT_NEAR(elevation_deg(with("disc: {inclination_deg: 60}\n"), 0), 60, 1e-9);
  EXPECT_NEAR(elevation_deg(with("disc: {inclination_deg: 60, node_deg: -90}\n"), 0), -60, 1e-9);
  EXPECT_NEAR(elevation_deg(with("disc: {inclination_deg: 60, node_deg: 0}\n"), 0), 0, 1e-9);
}

// An orbit of a whole turn in 300 frames, against which the disc's gas rises at the node.
TEST_F(DiscKeys, TheNodeLiesAheadOnTheOrbit) {
  const Show show =
      with("disc: {inclination_deg: 30, node_deg: 120}\n", "{type: circular, r: 8, orbits: 1}");
  EXPECT_NEAR(elevation_deg(show, 100), 0, 1e-6);
  EXPECT_NEAR(elevation_deg(show, 25), 30, 1e-6);
  EXPECT_NEAR(elevation_deg(show, 175), -30, 1e-6);
}

TEST_F(DiscKeys, WithoutInclinationItTurnsAsTheOrbitDoesAndWithAHalfTurnAgainstIt) {
  for (const auto& [inclination, sense] : {std::pair{"0", 1.0}, {"180", -1.0}}) {
    const Show show =
        with(std::string("disc: {inclination_deg: ") + inclination + ", node_deg: 77}\n",
             "{type: circular, r: 8, orbits: 1}");
    const M33d axes = frame_state(show, 0).observer.sky_from_tetrad;
    const V3d motion_of_gas = show.disc->normal.v.cross(column(axes, 0));
    expect_near(motion_of_gas, column(axes, 2) * sense);
  }
}

TEST_F(DiscKeys, PatternsAreNamedOrDescribed) {
  const auto pattern = [&](const std::string& text) {
    return with("disc: {pattern: " + text + "}\n").disc->patterns;
  };
  using Patterns = std::vector<PatternKind>;
  EXPECT_EQ(with("disc: {}\n").disc->patterns, Patterns{});
  EXPECT_EQ(pattern("none"), Patterns{});
  EXPECT_EQ(pattern("{type: none}"), Patterns{});
  EXPECT_EQ(pattern("[turbulence, {type: spot, r: 9}, spot, {type: rings, contrast: 1}]"),
            (Patterns{TurbulencePattern{}, SpotPattern{9, 0, 0.7, 5}, SpotPattern{},
                      RingPattern{2, 1, 0.02}}));
  EXPECT_EQ(pattern("turbulence"), (Patterns{TurbulencePattern{1, 1, 1}}));
  EXPECT_EQ(pattern("{type: turbulence, contrast: 0.5, orbits: 4, seed: 17}"),
            (Patterns{TurbulencePattern{0.5, 4, 17}}));
  EXPECT_EQ(pattern("rings"), (Patterns{RingPattern{2, 0.8, 0.02}}));
  EXPECT_EQ(pattern("{type: rings, spacing_r: 1, contrast: 1, inward_speed: 0}"),
            (Patterns{RingPattern{1, 1, 0}}));
  EXPECT_EQ(pattern("spot"), (Patterns{SpotPattern{8, 0, 0.7, 5}}));
  EXPECT_EQ(pattern("{type: spot, r: 10, azimuth_deg: 90, size_r: 0.3, brightness: 20}"),
            (Patterns{SpotPattern{10, 90 * kDegree, 0.3, 20}}));
}

TEST_F(DiscKeys, LightIsSlowUnlessTheShowSaysOtherwise) {
  EXPECT_TRUE(with("disc: {}\n").disc->slow_light);
  EXPECT_FALSE(with("disc: {slow_light: false}\n").disc->slow_light);
}

// Azimuths of patterns count from where the gas rises through the plane of the orbits.
TEST_F(DiscKeys, TheNodeLiesInBothPlanes) {
  const Show show =
      with("disc: {inclination_deg: 30, node_deg: 120}\n", "{type: circular, r: 8, orbits: 1}");
  const M33d axes = frame_state(show, 100).observer.sky_from_tetrad;
  expect_near(show.disc->node.v, column(axes, 0), 1e-12);
  EXPECT_NEAR(show.disc->node.v.dot(show.disc->normal.v), 0, 1e-14);
  // The gas there moves on and to the north, against Theta.
  const V3d motion = show.disc->normal.v.cross(show.disc->node.v);
  EXPECT_NEAR(motion.dot(column(axes, 1)), -0.5, 1e-12);
}

TEST_F(DiscMistakes, NearAChargeAreNamedWithItsBounds) {
  const std::string timeline = "timeline: [{duration_s: 2, trajectory: {type: static, r: 9}}]\n";
  const std::string charge = "black_hole: {mass_solar: 1, charge: 1}\n" + timeline;
  expect_complaints(
      {{charge + "disc: {inner_r: 3}\n",
        "3:17: disc.inner_r must be at least 4 (units of M), got 3: gas inside the last stable "
        "orbit falls in, with plunging: true"},
       {charge + "disc: {plunging: true, inner_r: 0.5}\n",
        "3:33: disc.inner_r must be at least 1 (units of M), got 0.5"},
       {charge + "disc: {pattern: {type: spot, r: 3}}\n",
        "3:33: disc.pattern.r must be at least 4 (units of M), got 3"},
       {"black_hole: {mass_solar: 1, charge: 1.1, naked: true}\n" + timeline + "disc: {}\n",
        "3:7: disc needs a hole with a horizon: gas about a naked singularity is not drawn"},
       {"wormhole: {radius_km: 1}\ntimeline: [{duration_s: 2, trajectory: {type: static, l: 9}}]\n"
        "disc: {}\n",
        "3:7: disc needs a black hole: nothing circles a wormhole"}});
}

TEST_F(DiscMistakes, AreNamedWithTheirBounds) {
  expect_complaints_of_lines({
      {"disc: {outer: 30}", "3:8: disc.outer is an unknown key; did you mean outer_r?"},
      {"disc: true",
       "3:7: disc must be a map of keys (inner_r, outer_r, inclination_deg, node_deg, retrograde, "
       "t_max_k, "
       "optical_depth, rim, height, plunging, pattern, slow_light, luminance_cd_m2 or opacity), "
       "got "
       "'true'"},
      {"disc: {inner_r: 5}",
       "3:17: disc.inner_r must be at least 6 (units of M), got 5: gas inside the last stable "
       "orbit falls in, with plunging: true"},
      {"disc: {inner_r: 1.5, plunging: true}",
       "3:17: disc.inner_r must be at least 2 (units of M), got 1.5"},
      {"disc: {inner_r: 12, outer_r: 9}",
       "3:30: disc.outer_r must exceed inner_r = 12 (units of M), got 9"},
      {"disc: {inner_r: 25}", "3:17: disc.inner_r must be below outer_r = 20 (units of M), got 25"},
      {"disc: {outer_r: 2e6}", "3:17: disc.outer_r must be at most 1000000 (units of M), got 2e6"},
      {"disc: {inclination_deg: 181}",
       "3:25: disc.inclination_deg must be at most 180 (degrees), got 181"},
      {"disc: {t_max_k: 900}", "3:17: disc.t_max_k must be at least 1000 (kelvin), got 900"},
      {"disc: {luminance_cd_m2: 0}", "3:25: disc.luminance_cd_m2 must exceed 0 (cd/m^2), got 0"},
      {"disc: {opacity: 1.5}", "3:17: disc.opacity must be at most 1, got 1.5"},
      {"disc: {pattern: {seed: 1}}",
       "3:17: disc.pattern needs a type: turbulence, rings, spot or file"},
      {"disc: {pattern: stripes}",
       "3:17: disc.pattern must be turbulence, rings, spot, file or none, got 'stripes'"},
      {"disc: {pattern: {type: spots}}",
       "3:24: disc.pattern.type must be turbulence, rings, spot, file or none, got 'spots'; did "
       "you mean "
       "spot?"},
      {"disc: {pattern: {type: rings, seed: 2}}",
       "3:31: disc.pattern.seed is an unknown key; known here: type, spacing_r, contrast or "
       "inward_speed"},
      {"disc: {pattern: {type: turbulence, seed: 1.5}}",
       "3:42: disc.pattern.seed must be a whole number, got 1.5"},
      {"disc: {pattern: {type: spot, r: 5}}",
       "3:33: disc.pattern.r must be at least 6 (units of M), got 5"},
      {"disc: {outer_r: 12, pattern: {type: spot, r: 30}}",
       "3:46: disc.pattern.r is of a spot at r = 30 (units of M), which the disc from 6 to 12 does "
       "not hold"},
      {"disc: {outer_r: 7, pattern: spot}",
       "3:29: disc.pattern is of a spot at r = 8 (units of M), which the disc from 6 to 7 does not "
       "hold"},
      {"disc: {pattern: [turbulence, spot, {type: turbulence}]}",
       "3:36: disc.pattern[3] is of a type that is there already: only spots can be several"},
      {"disc: {pattern: [spot, {type: spot, r: 5}]}",
       "3:40: disc.pattern[2].r must be at least 6 (units of M), got 5"},
      {"disc: {pattern: {file: nowhere.exr}}",
       "3:24: disc.pattern.file names the file 'nowhere.exr', which is neither beside the show nor "
       "in the working folder"},
      {"disc: {pattern: {file: show.yaml}}",
       "3:24: disc.pattern.file cannot be used: show.yaml: the image cannot be read: by its first "
       "bytes it is not OpenEXR, PNG, TIFF, JPEG, Radiance (HDR) or WebP"},
      {"disc: {pattern: {type: file}}", "3:17: disc.pattern.file is missing, a picture"},
      {"disc: {luminance_cd_m2: 1e-300}\nexposure: {disc: 10}",
       "4:18: exposure.disc would need 990 stops of exposure, and 30 are the most"},
      {"disc: {pattern: file}",
       "3:17: disc.pattern must be a map of keys (type, file or at_m), got 'file'"},
      {"disc: {slow_light: 3}", "3:20: disc.slow_light must be true or false, got '3'"},
      {"disc: {plunging: maybe}", "3:18: disc.plunging must be true or false, got 'maybe'"},
  });
  expect_complaints({
      {"disc: {}\ntimeline: [{duration_s: 1}]\n",
       "1:7: disc needs a black hole: give the show black_hole.mass_solar"},
  });
}

TEST_F(DiscKeys, AnExposureMayBeThatOfTheHottestRing) {
  const std::string lit = "disc: {luminance_cd_m2: 3e7}\n";
  EXPECT_NEAR(with(lit + "exposure: {disc: 10}\n").exposure.ev, std::log2(10 * 1e-3 / 3e7), 1e-12);
  EXPECT_EQ(with(lit).exposure.ev, 0);
}

// Their axis is the disc's unless they have their own.
TEST_F(DiscKeys, AHaloAndAJetShareTheDiscsAxis) {
  const Show show = with(
      "disc: {height: 0.1, inclination_deg: 40}\n"
      "halo: {r: 5, height: 0.2, luminance_cd_m2: 3, t_k: 5000}\n"
      "jet: {lorentz_factor: 4, opening_deg: 9, r: 7, length_r: 50, "
      "node_deg: 30}\n");
  EXPECT_EQ(show.disc->height, 0.1);
  EXPECT_EQ(*show.halo, (Halo{show.disc->normal, 5, 0.2, 3, 5000}));
  EXPECT_NE(show.jet->normal.v, show.disc->normal.v);
  EXPECT_EQ(*show.jet, (Jet{show.jet->normal, 4, 9 * std::numbers::pi / 180, 7, 50, 5e-3, {}}));
  const Show alone = with("halo: {}\njet: {}\n");
  EXPECT_FALSE(alone.disc);
  EXPECT_FALSE(alone.halo->temperature);
  EXPECT_EQ(alone.halo->normal.v, with("disc: {}\n").disc->normal.v);
}

TEST_F(DiscMistakes, OfHalosAndJetsAreNamedWithTheirBounds) {
  expect_complaints_of_lines({
      {"exposure: {disc: 10}", "3:18: exposure.disc needs a disc: give the show one"},
      {"disc: {}\nexposure: {disc: 10, ev: 1}",
       "4:18: exposure.disc excludes ev; give one of them"},
      {"halo: {height: 3}", "3:16: halo.height must be at most 2, got 3"},
      {"halo: {t_k: 20}", "3:13: halo.t_k must be at least 500 (kelvin), got 20"},
      {"jet: {lorentz_factor: 0.5}", "3:23: jet.lorentz_factor must be at least 1, got 0.5"},
      {"jet: {opening: 3}", "3:7: jet.opening is an unknown key; did you mean opening_deg?"},
      {"disc: {height: 0.005}",
       "3:16: disc.height must be 0, for a sheet, or at least 0.01, got 0.005"},
      {"disc: {height: 0.6}", "3:16: disc.height must be at most 0.5, got 0.6"},
      {"disc: {}\nhalo: {}",
       "4:7: halo needs a disc with a height, which it can shine through: give disc.height"},
  });
  expect_complaints({
      {"jet: {}\ntimeline: [{duration_s: 1}]\n",
       "1:6: jet needs a black hole: give the show black_hole.mass_solar"},
  });
}

}  // namespace
}  // namespace domefall
