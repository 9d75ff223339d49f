// Tests of what each key of a show file means, in the units of the program, and of its default.
#include <cmath>
#include <numbers>

#include "tests/pipeline/show/show_file.h"

namespace domefall {
namespace {

const char* const kSixLines =
    "title: Into the dark\n"
    "black_hole: {mass_solar: 4.3e6}\n"
    "camera: {look_at: hole}\n"
    "timeline:\n"
    "  - duration_s: 10\n"
    "    trajectory: {type: infall, from_r: 30}\n";

TEST_F(ShowKeys, SixLinesMakeAShowForADome) {
  const Show show = read(kSixLines);
  EXPECT_EQ(show.title, "Into the dark");
  EXPECT_EQ(show.frames_per_second, 30);
  EXPECT_EQ(frame_count(show), 300);
  EXPECT_EQ(std::get<Domemaster>(show.projection).size, 4096);
  EXPECT_EQ(show.spacetime.solar_masses(), 4.3e6);
  expect_near(show.hole_at.v, place(266.405, -28.936).v);
  EXPECT_DOUBLE_EQ(show.heading, 90 * kDegree);
  ASSERT_EQ(show.timeline.size(), 1u);
  const Segment& s = show.timeline[0];
  EXPECT_EQ(std::get<RadialInfall>(s.trajectory).from_r, 30);
  EXPECT_EQ(s.timing.tau_begin, 0);
  EXPECT_NEAR(point_at(s.trajectory, s.timing.tau_end).r, 0.05, 1e-12);
  EXPECT_TRUE(std::holds_alternative<LookAtHole>(s.camera.attitude));
  EXPECT_EQ(s.camera.roll, 0);
  EXPECT_DOUBLE_EQ(s.camera.elevation, 45 * kDegree);
  EXPECT_EQ(s.camera.dome_tilt, 0);
}

TEST_F(ShowKeys, SixLinesShowTheMilkyWayAndAllOfTheShippedStarsPlainly) {
  const Show show = read(kSixLines);
  for (const RegionSky& sky : {show.sky[SkyRegion::kI], show.sky[SkyRegion::kIII]}) {
    EXPECT_EQ(std::get<PanoramaSky>(sky.background).image, asset("milky_way.sky"));
    EXPECT_EQ(sky.background_gain, 1);
    ASSERT_TRUE(sky.stars);
    EXPECT_EQ(sky.stars->catalogue, asset("stars_to_9.stars"));
    EXPECT_EQ(sky.stars->max_magnitude, 9);
    EXPECT_EQ(sky.star_gain, 0.4);
  }
  EXPECT_EQ(show.panorama_shift.blueshift_power, 2);
  EXPECT_EQ(show.star_epoch, 2000);
  EXPECT_DOUBLE_EQ(show.point_spread.min_sigma, 0.04 * kDegree);
  EXPECT_EQ(show.point_spread.halo, 0.12);
  EXPECT_DOUBLE_EQ(show.point_spread.halo_sigma, 0.08 * kDegree);
  EXPECT_EQ(show.point_spread.white_core, 0);
  EXPECT_EQ(show.star_saturation, 0.8);
  EXPECT_DOUBLE_EQ(show.least_star_radius, 0.005 * kDegree);
  EXPECT_EQ(show.exposure.ev, 0);
  EXPECT_EQ(show.grade.config, asset("dome.ocio"));
  EXPECT_EQ(show.grade.display, "");
  EXPECT_EQ(show.grade.view, "");
  EXPECT_EQ(show.grade.cdl.slope, (std::array<double, 3>{1, 1, 1}));
  EXPECT_EQ(show.grade.cdl.saturation, 1);
  EXPECT_EQ(show.output.graded, GradedFormat{GradedKind::kPng16});
}

TEST_F(ShowKeys, TheTitleIsTheFilesNameWhereNoneIsGiven) {
  EXPECT_EQ(read_show(write("deep_fall.yaml", "timeline: [{duration_s: 1}]\n")).title, "deep_fall");
}

TEST_F(ShowKeys, FrameRateSizeAndOutput) {
  EXPECT_EQ(with("frames_per_second: 23.976\n").frames_per_second, 24000.0 / 1001);
  EXPECT_EQ(with("frames_per_second: 23.98\n").written_rate, 23.98);
  for (const char* fraction : {"24000/1001", "\"24000/1001\"", "48000/2002"}) {
    const Show exact = with("frames_per_second: " + std::string(fraction) + "\n");
    EXPECT_EQ(exact.frames_per_second, 24000.0 / 1001) << fraction;
    EXPECT_FALSE(exact.written_rate) << fraction;
  }
  EXPECT_FALSE(with("frames_per_second: 12.5\n").written_rate);
  EXPECT_EQ(frame_count(with("frames_per_second: 60\n")), 600);
  for (const auto& [text, pixels] :
       {std::pair{"1k", 1024}, {"2k", 2048}, {"4k", 4096}, {"8k", 8192}, {"16", 16}, {"777", 777}})
    EXPECT_EQ(std::get<Domemaster>(with("size: " + std::string(text) + "\n").projection).size,
              pixels);
}

TEST_F(ShowKeys, GradedFilesHaveAKindAndAJpegAQuality) {
  using enum GradedKind;
  const std::pair<const char*, std::optional<GradedFormat>> formats[] = {
      {"png16", {{kPng16}}},   {"png8", {{kPng8}}},   {"jpeg", {{kJpeg}}},
      {"tiff16", {{kTiff16}}}, {"tiff8", {{kTiff8}}}, {"jpeg, quality: 80", {{kJpeg, 80}}},
      {"png", {{kPng16}}},     {"tiff", {{kTiff16}}}, {"none", std::nullopt}};
  for (const auto& [words, format] : formats)
    EXPECT_EQ(with("output: {graded: " + std::string(words) + "}\n").output.graded, format);
}

TEST_F(ShowKeys, FlatImagesAreFullHdAtNinetyDegreesOrWhatIsGiven) {
  const auto flat = [this](const std::string& keys) {
    return std::get<Stereographic>(with(keys).projection);
  };
  const Stereographic plain = flat("camera: {projection: stereographic}"),
                      given = flat(
                          "size: [640, 480]\ncamera: {projection: stereographic, fov_deg: 270}");
  EXPECT_EQ(std::pair(plain.columns, plain.rows), std::pair(1920, 1080));
  EXPECT_DOUBLE_EQ(plain.fov, 90 * kDegree);
  EXPECT_EQ(std::pair(given.columns, given.rows), std::pair(640, 480));
  EXPECT_DOUBLE_EQ(given.fov, 270 * kDegree);
}

TEST_F(ShowKeys, TheHolesPlaceIsGivenInDegreesOrByAStar) {
  const Show given = with("", "{type: static, r: 9}",
                          "{mass_solar: 10, at: {ra_deg: 83.6, dec_deg: 22}, heading_deg: -30}");
  EXPECT_EQ(given.spacetime.solar_masses(), 10);
  expect_near(given.hole_at.v, place(83.6, 22).v);
  EXPECT_DOUBLE_EQ(given.heading, -30 * kDegree);
  for (const char* star : {"Betelgeuse", "betelgeuse", "alpha Ori", "{star: Betelgeuse}"})
    expect_near(with("", "{type: static, r: 9}", "{mass_solar: 10, at: " + std::string(star) + "}")
                    .hole_at.v,
                place(88.793, 7.407).v, kStarPlace);
}

TEST_F(ShowKeys, WithoutAMassSpaceIsFlatAndASegmentMayRest) {
  for (const char* hole : {"", "black_hole: {mass_solar: 0}\n", "black_hole: {at: Vega}\n"}) {
    const Show show = read(
        hole +
        std::string("timeline: [{duration_s: 4}, {duration_s: 2, trajectory: {type: static}}]\n"));
    EXPECT_TRUE(show.spacetime.is_flat()) << hole;
    for (const Segment& s : show.timeline) {
      EXPECT_EQ(std::get<StaticObserver>(s.trajectory).r, kFlatSpace);
      EXPECT_EQ(s.timing.tau_end, s.duration_s);  // seconds
    }
  }
}

// ---- camera ----

TEST_F(ShowKeys, CamerasLookAtTheHoleTheMotionOrAPlace) {
  const auto attitude = [&](const std::string& look_at) {
    return with("camera: {look_at: " + look_at + "}").timeline[0].camera.attitude;
  };
  EXPECT_TRUE(std::holds_alternative<LookAtHole>(attitude("hole")));
  EXPECT_TRUE(std::holds_alternative<LookAlongMotion>(attitude("motion")));
  expect_near(std::get<LookAtSky>(attitude("Sirius")).target.v, place(101.287, -16.716).v,
              kStarPlace);
  expect_near(std::get<LookAtSky>(attitude("{ra_deg: 12, dec_deg: -90}")).target.v,
              place(12, -90).v);
}

TEST_F(ShowKeys, CameraAnglesAreDegrees) {
  const Camera c =
      with("camera: {roll_deg: 20, elevation_deg: -10, dome_tilt_deg: 30}").timeline[0].camera;
  EXPECT_DOUBLE_EQ(c.roll, 20 * kDegree);
  EXPECT_DOUBLE_EQ(c.elevation, -10 * kDegree);
  EXPECT_DOUBLE_EQ(c.dome_tilt, 30 * kDegree);
  const Camera euler = with("camera: {euler_deg: [10, 20, 30]}").timeline[0].camera;
  const auto angles = std::get<EulerAngles>(euler.attitude);
  EXPECT_DOUBLE_EQ(angles.phi, 10 * kDegree);
  EXPECT_DOUBLE_EQ(angles.vartheta, 20 * kDegree);
  EXPECT_DOUBLE_EQ(angles.psi, 30 * kDegree);
}

TEST_F(ShowKeys, ASegmentsCameraIsLaidOverTheShowsKeyByKey) {
  const Show show = read(
      "black_hole: {mass_solar: 1}\n"
      "camera: {look_at: Vega, roll_deg: 5, elevation_deg: 30, dome_tilt_deg: 15}\n"
      "timeline:\n"
      "  - {duration_s: 1, trajectory: {type: circular, r: 9}}\n"
      "  - {duration_s: 1, trajectory: {type: circular, r: 9}, camera: {look_at: motion}}\n"
      "  - {duration_s: 1, trajectory: {type: circular, r: 9}, camera: {roll_deg: 7}}\n"
      "  - {duration_s: 1, trajectory: {type: circular, r: 9}, camera: {euler_deg: [0, 90, 0]}}\n");
  const auto camera = [&](std::size_t k) { return show.timeline[k].camera; };
  EXPECT_TRUE(std::holds_alternative<LookAtSky>(camera(0).attitude));
  EXPECT_TRUE(std::holds_alternative<LookAlongMotion>(camera(1).attitude));
  EXPECT_DOUBLE_EQ(camera(1).roll, 5 * kDegree);
  EXPECT_DOUBLE_EQ(camera(1).elevation, 30 * kDegree);
  EXPECT_TRUE(std::holds_alternative<LookAtSky>(camera(2).attitude));
  EXPECT_DOUBLE_EQ(camera(2).roll, 7 * kDegree);
  EXPECT_TRUE(std::holds_alternative<EulerAngles>(camera(3).attitude));
  EXPECT_EQ(camera(3).roll, 0);
  EXPECT_DOUBLE_EQ(camera(3).dome_tilt, 15 * kDegree);
}

// ---- effects, stars, exposure, grade ----

TEST_F(ShowKeys, EffectsAreThoseOfNatureUnlessTheShowLeavesThemOut) {
  const auto effects = [this](const std::string& keys) {
    return with("effects: {" + keys + "}\n", "{type: static, r: 30}").effects;
  };
  EXPECT_EQ(with("").effects, Effects{});
  EXPECT_EQ(effects("aberration: true, doppler_colour: true, intensity: true, lensing: true, "
                    "amplification: stars"),
            Effects{});
  EXPECT_FALSE(effects("aberration: false").aberration);
  EXPECT_FALSE(effects("doppler_colour: false").doppler_colour);
  EXPECT_FALSE(effects("intensity: false").intensity);
  EXPECT_FALSE(effects("lensing: false").lensing);
  EXPECT_EQ(effects("amplification: none").amplification, Amplification::kNone);
  EXPECT_EQ(effects("amplification: everything").amplification, Amplification::kEverything);
}

// Only the places of frames count: a fall may end at the horizon if the frame before is outside.
TEST_F(ShowKeys, LensingMayBeLeftOutWhereverAllFramesAreOutside) {
  const std::string straight = "effects: {lensing: false}\n";
  EXPECT_FALSE(with(straight, "{type: infall, from_r: 6, to_r: 2}").effects.lensing);
  EXPECT_FALSE(with(straight, "{type: infall, from_r: 6, to_r: 3}").effects.lensing);
  EXPECT_FALSE(with(straight, "{type: velocity, region: III, r: 4, speed: 0.5, direction: inward}")
                   .effects.lensing);
  EXPECT_FALSE(with(straight, "{type: static}", "{mass_solar: 0}").effects.lensing);
}

// The law of the paper has the paper's colours, and any key of it stands for it.
TEST_F(ShowKeys, StarsByTheLawOfThePaper) {
  for (const char* keys : {"{law: size}", "{growth: 0.2}", "{reference_magnitude: 5}",
                           "{max_sigma_deg: 0.3}", "{law: size, saturation: 1}"}) {
    const Show show = with(std::string("stars: ") + keys + "\n");
    EXPECT_DOUBLE_EQ(show.point_spread.min_sigma, 0.04 * kDegree);
    EXPECT_EQ(show.point_spread.growth, 0.2);
    EXPECT_EQ(show.point_spread.reference_magnitude, 5);
    EXPECT_DOUBLE_EQ(show.point_spread.max_sigma, 0.3 * kDegree);
    EXPECT_EQ(show.point_spread.halo, 0);
    EXPECT_EQ(show.point_spread.white_core, 10);
    EXPECT_EQ(show.star_saturation, 1);
    EXPECT_EQ(show.sky[SkyRegion::kI].star_gain, 1);
    EXPECT_EQ(show.sky[SkyRegion::kIII].star_gain, 1);
  }
}

TEST_F(ShowKeys, StarsWithAHalo) {
  const PointSpreadLaw own = with("stars: {law: psf}\n").point_spread;
  EXPECT_EQ(own.halo, 0.12);
  EXPECT_DOUBLE_EQ(own.halo_sigma, 0.08 * kDegree);
  const Show dim = with("stars: {saturation: 0.3, least_radius_deg: 0.01}\n");
  EXPECT_EQ(dim.star_saturation, 0.3);
  EXPECT_DOUBLE_EQ(dim.least_star_radius, 0.01 * kDegree);
  const PointSpreadLaw given =
      with("stars: {law: psf, min_sigma_deg: 0.06, halo: 0.3, halo_sigma_deg: 1, white_core: 0}\n")
          .point_spread;
  EXPECT_DOUBLE_EQ(given.min_sigma, 0.06 * kDegree);
  EXPECT_EQ(given.halo, 0.3);
  EXPECT_DOUBLE_EQ(given.halo_sigma, kDegree);
  EXPECT_EQ(given.white_core, 0);
}

TEST_F(ShowKeys, StarsExposureAndGrade) {
  write("house.ocio", "");
  const Show show = with(
      "stars: {min_sigma_deg: 0.1, growth: 0.5, reference_magnitude: 3, max_sigma_deg: 2}\n"
      "exposure: {ev: -2.5}\n"
      "grade:\n"
      "  config: house.ocio\n"
      "  display: Dome\n"
      "  view: Dark\n"
      "  cdl: {slope: [1.1, 1, 0.9], offset: 0.01, power: [1, 1.2, 1], saturation: 0.8}\n");
  EXPECT_DOUBLE_EQ(show.point_spread.min_sigma, 0.1 * kDegree);
  EXPECT_EQ(show.point_spread.growth, 0.5);
  EXPECT_EQ(show.point_spread.reference_magnitude, 3);
  EXPECT_DOUBLE_EQ(show.point_spread.max_sigma, 2 * kDegree);
  EXPECT_EQ(show.exposure.ev, -2.5);
  EXPECT_EQ(show.grade.config, folder_ / "house.ocio");
  EXPECT_EQ(show.grade.display, "Dome");
  EXPECT_EQ(show.grade.view, "Dark");
  EXPECT_EQ(show.grade.cdl.slope, (std::array<double, 3>{1.1, 1, 0.9}));
  EXPECT_EQ(show.grade.cdl.offset, (std::array<double, 3>{0.01, 0.01, 0.01}));
  EXPECT_EQ(show.grade.cdl.power, (std::array<double, 3>{1, 1.2, 1}));
  EXPECT_EQ(show.grade.cdl.saturation, 0.8);
}

TEST_F(ShowKeys, ADomesOwnLight) {
  using enum DomeSettings::Light;
  EXPECT_EQ(with("").grade.dome.light, kNone);
  EXPECT_EQ(with("dome: {light: simulate}\n").grade.dome.light, kSimulate);
  EXPECT_EQ(with("dome: {light: simulate}\n").grade.dome.reflectance, 0.45);
  EXPECT_EQ(with("dome: {light: compensate, reflectance: 0.3}\n").grade.dome.light, kCompensate);
  EXPECT_EQ(with("dome: {light: compensate, reflectance: 0.3}\n").grade.dome.reflectance, 0.3);
}

// ---- trajectories ----

TEST_F(ShowKeys, AFallEndsAtItsToR) {
  const Segment s = segment("{type: infall, from_r: 12, to_r: 3}");
  EXPECT_NEAR(point_at(s.trajectory, s.timing.tau_end).r, 3, 1e-13);
}

TEST_F(ShowKeys, RatesAreUnitsOfMPerSecondOfShow) {
  EXPECT_EQ(segment("{type: infall, from_r: 30, rate_m_per_s: 1.5}").timing.tau_end, 15);
  EXPECT_EQ(segment("{type: circular, r: 8, rate_m_per_s: 0.25}").timing.tau_end, 2.5);
  EXPECT_EQ(segment("{type: circular, r: 8}").timing.tau_end, 10)
      << "1 M per second is the default";
}

TEST_F(ShowKeys, AFallMaySlowDown) {
  EXPECT_EQ(segment("{type: infall, from_r: 12}").timing.pace, Pace::kSteady);
  EXPECT_EQ(segment("{type: infall, from_r: 12, pace: steady}").timing.pace, Pace::kSteady);
  EXPECT_EQ(segment("{type: infall, from_r: 12, pace: slowing}").timing.pace, Pace::kSlowing);
}

TEST_F(ShowKeys, OrbitsCountRevolutionsInTheSegment) {
  const Segment s = segment("{type: circular, r: 6, orbits: 1.5}");
  EXPECT_EQ(std::get<CircularOrbit>(s.trajectory).r, 6);
  EXPECT_NEAR(point_at(s.trajectory, s.timing.tau_end).azimuth, 3 * std::numbers::pi, 1e-13);
}

TEST_F(ShowKeys, TimeLapseIsRealSecondsPerSecondOfShow) {
  // One M of 4e6 suns is 4e6 * 4.925490947e-6 s = 19.701963788 s.
  EXPECT_NEAR(double(segment("{type: circular, r: 8, time_lapse: 100}").timing.tau_end),
              1000 / 19.701963788, 1e-11);
  EXPECT_NEAR(double(segment("{type: infall, from_r: 900, time_lapse: 100}").timing.tau_end),
              1000 / 19.701963788, 1e-11);
  EXPECT_NEAR(double(segment("{type: static, r: 8}").timing.tau_end), 10 / 19.701963788, 1e-13);
}

TEST_F(ShowKeys, AVelocityAgainstTheStaticFrameIsTheDefault) {
  const double rest = std::sqrt(2.0 / 6);  // gamma v of the static frame at r = 8
  expect_near(celerity("r: 8, speed: 0"), V3d(rest, 0, 0));
  // Free fall from rest at infinity moves inward at sqrt(2/r) = 1/2 against the static frame.
  expect_near(celerity("r: 8, speed: 0.5, direction: inward"), V3d(0, 0, 0));
  expect_near(celerity("r: 8, speed: 0.5, direction: inward, against: static"), V3d(0, 0, 0));
}

TEST_F(ShowKeys, DirectionsOfAVelocity) {
  const double c = 0.75;  // gamma v at v = 0.6
  const auto along = [&](const std::string& direction) {
    return celerity("r: 1, against: free_fall, speed: 0.6, direction: " + direction);
  };
  expect_near(along("inward"), V3d(-c, 0, 0));
  expect_near(along("outward"), V3d(c, 0, 0));
  expect_near(along("forward"), V3d(0, 0, c));
  expect_near(along("backward"), V3d(0, 0, -c));
  expect_near(along("north"), V3d(0, -c, 0));
  expect_near(along("south"), V3d(0, c, 0));
  expect_near(along("{radial: -3, phi: 4}"), V3d(-0.6, 0, 0.8) * c);
  expect_near(along("{theta: 2}"), V3d(0, c, 0));
  expect_near(along("{radial: 1e9, theta: 1e9, phi: 1e9}"), V3d(1, 1, 1) * (c / std::sqrt(3)));
}

TEST_F(ShowKeys, LorentzFactorsKeepTheirDigitsUpToABillion) {
  for (const auto& [text, factor] : {std::pair{"1", 1.0}, {"1.25", 1.25}, {"1e9", 1e9}}) {
    const V3d u = celerity("against: free_fall, r: 5, direction: forward, lorentz_factor: " +
                           std::string(text));
    EXPECT_NEAR(u.z / std::max(1.0, factor), std::sqrt((factor - 1) * (factor + 1)) / factor,
                1e-15);
  }
}

TEST_F(ShowKeys, InFlatSpaceAVelocityPointsToAPlaceOnTheSky) {
  const Show show = with("", "{type: velocity, speed: 0.6, direction: Vega}", "{mass_solar: 0}");
  const auto v = std::get<GivenVelocity>(show.timeline[0].trajectory);
  EXPECT_EQ(v.r, kFlatSpace);
  EXPECT_EQ(show.timeline[0].timing.tau_end, 10);
  const V3d u = celerity("speed: 0.6, direction: {ra_deg: 279.235, dec_deg: 38.784}", "{}");
  expect_near(u, v.celerity, kStarPlace);
  EXPECT_NEAR(u.length(), 0.75, 1e-14);
}

// ---- YAML ----

TEST_F(ShowKeys, ByteOrderMarksCrlfAnchorsAndDocumentMarksChangeNothing) {
  std::string crlf;
  for (const char c : std::string(kSixLines)) crlf += c == '\n' ? "\r\n" : std::string(1, c);
  for (const std::string& text :
       {"\xEF\xBB\xBF" + std::string(kSixLines), crlf, "---\n" + std::string(kSixLines) + "...\n",
        "# a comment\n\n" + std::string(kSixLines)}) {
    const Show show = read(text);
    EXPECT_EQ(show.title, "Into the dark");
    EXPECT_EQ(std::get<RadialInfall>(show.timeline.at(0).trajectory).from_r, 30);
  }
  const Show twice = read(
      "black_hole: {mass_solar: 1}\n"
      "timeline:\n"
      "  - &once {duration_s: 2, trajectory: {type: circular, r: 7}}\n"
      "  - *once\n");
  ASSERT_EQ(twice.timeline.size(), 2u);
  EXPECT_EQ(twice.timeline[1].duration_s, 2);
}

}  // namespace
}  // namespace domefall
