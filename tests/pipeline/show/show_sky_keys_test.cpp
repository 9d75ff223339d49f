// Tests of the keys of a show file that say what its skies show, and of their defaults.
#include <algorithm>

#include "pipeline/sources/stars/solar_system.h"
#include "tests/pipeline/show/show_file.h"

namespace domefall {
namespace {

using ShowSkyKeys = ShowKeys;

TEST_F(ShowSkyKeys, RegionThreeIsLikeRegionOneButForWhatItSays) {
  write("art/sky.png", "");
  write("art/stars.csv", "");
  const Show show = with(
      "sky:\n"
      "  region_I: {background: art/sky.png, gain: 2, stars: {catalogue: art/stars.csv, "
      "max_magnitude: 9, gain: 3}}\n"
      "  region_III: {background: grid, stars: {max_magnitude: 4}}\n"
      "  blueshift_power: 3.5\n"
      "  epoch: 2026.5\n");
  EXPECT_EQ(std::get<PanoramaSky>(show.sky[SkyRegion::kI].background).image,
            folder_ / "art/sky.png");
  EXPECT_EQ(show.sky[SkyRegion::kI].background_gain, 2);
  EXPECT_EQ(show.sky[SkyRegion::kI].stars->catalogue, folder_ / "art/stars.csv");
  EXPECT_EQ(show.sky[SkyRegion::kI].stars->max_magnitude, 9);
  EXPECT_EQ(show.sky[SkyRegion::kI].star_gain, 3);
  EXPECT_TRUE(std::holds_alternative<GridSky>(show.sky[SkyRegion::kIII].background));
  EXPECT_EQ(show.sky[SkyRegion::kIII].background_gain, 2);
  EXPECT_EQ(show.sky[SkyRegion::kIII].stars->catalogue, folder_ / "art/stars.csv");
  EXPECT_EQ(show.sky[SkyRegion::kIII].stars->max_magnitude, 4);
  EXPECT_EQ(show.sky[SkyRegion::kIII].star_gain, 3);
  EXPECT_EQ(show.panorama_shift.blueshift_power, 3.5);
  EXPECT_EQ(show.star_epoch, 2026.5);
}

// Jupiter met Saturn on 21 December 2020 at RA 302.5, Dec -20.5.
TEST_F(ShowSkyKeys, PlanetsAreInTheirPlacesOfTheYear) {
  const std::string year = "begins_year: 2020.97266\n";
  const Show show =
      with(year + "camera: {look_at: JUPITER}\ntitles: [{text: a, place: {star: saturn}}]\n",
           "{type: infall, from_r: 30}", "{mass_solar: 1, at: Moon}");
  EXPECT_FALSE(show.sky[SkyRegion::kI].stars->planets_year);
  const auto& camera = std::get<LookAtSky>(show.timeline[0].camera.attitude);
  expect_near(camera.target.v, place(302.5, -20.5).v, 0.003);
  expect_near(show.titles[0].place->v, camera.target.v, 0.003);
  EXPECT_NE(show.titles[0].place->v, camera.target.v);
  expect_near(show.hole_at.v, seen_from_earth(SolarBody::kMoon, 2020.97266).v);
  const Show drawn = with(year + "sky: {planets: true}\n");
  EXPECT_EQ(drawn.sky[SkyRegion::kI].stars->planets_year, 2020.97266);
  EXPECT_FALSE(drawn.sky[SkyRegion::kIII].stars->planets_year);
}

TEST_F(ShowSkyKeys, PlanetsAreStarsAmongStarsToTheLimit) {
  const StarField field{asset("stars_to_9.stars"), 7, 2020.97266};
  const StarCatalogue stars = read_star_field(field, field.max_magnitude, kCatalogueEpoch);
  ASSERT_EQ(stars.stars.size(), 3U + 6U);  // without Neptune
  EXPECT_TRUE(std::ranges::is_sorted(stars.stars, {}, &Star::v_magnitude));
  EXPECT_EQ(std::ranges::count(stars.names, "Jupiter", &NamedStar::name), 1);
}

TEST_F(ShowMistakes, OfPlanetsAreTold) {
  expect_complaints_of_lines({
      {"camera: {look_at: Mars}",
       "3:19: camera.look_at names Mars, which needs the show's begins_year, since it moves on the "
       "sky"},
      {"camera: {look_at: Mars}\nbegins_year: 3000.5",
       "3:19: camera.look_at names Mars, whose place is known from -2999 to 3000, but begins_year "
       "is 3000.5"},
      {"titles: [{text: a, place: {star: moon}}]\nbegins_year: 1054",
       "3:34: titles[1].place.star names Moon, whose place is known from 1800 to 2050, but "
       "begins_year is 1054"},
      {"camera: {look_at: Jupitre}\nbegins_year: 2020",
       "3:19: camera.look_at must be hole, motion or outward, or a place on the sky; it names "
       "'Jupitre', which is no star, planet, constellation or object that Domefall knows; did you "
       "mean Jupiter?"},
      {"sky: {planets: true}",
       "3:16: sky.planets needs the show's begins_year, the year in which it begins"},
      {"sky: {planets: true}\nbegins_year: -3001",
       "3:16: sky.planets needs a begins_year from -2999 to 3000, got -3001"},
      {"sky: {planets: true, region_I: {stars: none}}\nbegins_year: 2020",
       "3:16: sky.planets needs stars in region_I, among which they are drawn"},
  });
}

TEST_F(ShowSkyKeys, ASegmentSaysTheBlackOfItsSky) {
  const Show show = read(
      "sky: {region_I: {black_cd_m2: 1e-5}}\n"
      "timeline:\n"
      "  - {duration_s: 1}\n"
      "  - {duration_s: 1, sky: {region_I: {black_cd_m2: none}}}\n");
  EXPECT_EQ(std::get<PanoramaSky>(show.sky[SkyRegion::kI].background).black, 1e-5);
  EXPECT_FALSE(show.timeline[0].backgrounds[SkyRegion::kI]);
  ASSERT_TRUE(show.timeline[1].backgrounds[SkyRegion::kI]);
  EXPECT_EQ(std::get<PanoramaSky>(*show.timeline[1].backgrounds[SkyRegion::kI]).black, 0);
}

TEST_F(ShowSkyKeys, TheBlackOfAMapIsItsOwnUnlessTheShowSaysIt) {
  using Levels = std::vector<std::optional<double>>;
  const auto levels = [this](const std::string& sky) {
    const Show show = with("sky: {" + sky + "}\n");
    Levels found;
    for (const SkyRegion at : {SkyRegion::kI, SkyRegion::kIII, SkyRegion::kIV}) {
      const auto* map = std::get_if<PanoramaSky>(&show.sky[at].background);
      found.push_back(map ? map->black : std::nullopt);
    }
    return found;
  };
  const std::optional<double> of_map;
  EXPECT_EQ(levels("blueshift_power: 2"), (Levels{of_map, of_map, of_map}));
  EXPECT_EQ(levels("region_I: {black_cd_m2: 3e-5}"), (Levels{3e-5, 3e-5, of_map}));
  EXPECT_EQ(levels("region_I: {black_cd_m2: none}, region_III: {black_cd_m2: auto}"),
            (Levels{0, of_map, of_map}));
  EXPECT_EQ(levels("region_IV: {background: milky_way, black_cd_m2: 1e-6}"),
            (Levels{of_map, of_map, 1e-6}));
}

TEST_F(ShowSkyKeys, SkiesMayBeBlackAndStarless) {
  const Show show = with("sky: {region_I: {background: black, stars: none}}\n");
  for (const RegionSky& sky : {show.sky[SkyRegion::kI], show.sky[SkyRegion::kIII]}) {
    EXPECT_TRUE(std::holds_alternative<BlackSky>(sky.background));
    EXPECT_FALSE(sky.stars);
  }
  const Show back = with(
      "sky: {region_I: {background: black, stars: none}, region_III: {background: milky_way, "
      "stars: naked_eye}}\n");
  EXPECT_EQ(std::get<PanoramaSky>(back.sky[SkyRegion::kIII].background).image,
            asset("milky_way.sky"));
  EXPECT_EQ(back.sky[SkyRegion::kIII].stars->catalogue, asset("stars_to_9.stars"));
}

TEST_F(ShowSkyKeys, ACatalogueIsTakenWhole) {
  const auto stars = [this](const std::string& value) {
    return with("sky: {region_I: {stars: " + value + "}}\n").sky[SkyRegion::kI].stars.value();
  };
  EXPECT_EQ(stars("standard").catalogue, asset("stars_to_9.stars"));
  EXPECT_EQ(stars("standard").max_magnitude, 9);
  EXPECT_EQ(stars("naked_eye").catalogue, asset("stars_to_9.stars"));
  EXPECT_EQ(stars("naked_eye").max_magnitude, 6.5);
  EXPECT_EQ(stars("{catalogue: naked_eye, max_magnitude: 5}").max_magnitude, 5);
  EXPECT_EQ(stars("{max_magnitude: 5}").catalogue, asset("stars_to_9.stars"));
  write_star_file(folder_ / "own.stars", three_stars());
  EXPECT_EQ(stars("own.stars").max_magnitude, double{0.45f});  // of its faintest
}

TEST_F(ShowSkyKeys, TheDeepestStarsAreThoseThatWereFetchedAndTakeTheMapWithoutThem) {
  const auto sky = [this](const std::string& stars) {
    return with("sky: {region_I: {stars: " + stars + "}}\n").sky[SkyRegion::kI];
  };
  EXPECT_EQ(sky("deepest").stars->catalogue, asset("stars_to_9.stars"));
  EXPECT_EQ(std::get<PanoramaSky>(sky("deepest").background).image, asset("milky_way.sky"));
  RawCatalogue many = three_stars();
  many.names.clear();
  many.stars.resize(600'000, many.stars.back());
  for (const char* place : {"assets/tycho2.stars", "tycho2.stars"}) {  // the show's own goes first
    write_star_file(folder_ / place, many);
    EXPECT_EQ(sky("deepest").stars->catalogue, folder_ / place);
    EXPECT_EQ(std::get<PanoramaSky>(sky("deepest").background).image, asset("milky_way_deep.sky"));
  }
  for (const char* fewer : {"standard", "none", "{catalogue: deepest, max_magnitude: 0}"})
    EXPECT_EQ(std::get<PanoramaSky>(sky(fewer).background).image, asset("milky_way.sky")) << fewer;
}

TEST_F(ShowSkyKeys, TheSingularityMayGlowInRings) {
  const auto rings = [this](const std::string& value) {
    const Show show = with("sky: {region_IV: " + value + "}\n");
    return std::pair(std::get<RingsSky>(show.sky[SkyRegion::kIV].background).period,
                     show.sky[SkyRegion::kIV].background_gain);
  };
  EXPECT_EQ(rings("rings"), std::pair(4.0, 1.0));
  EXPECT_EQ(rings("{background: rings}"), std::pair(4.0, 1.0));
  EXPECT_EQ(rings("{background: rings, period_m: 2.5, gain: 3}"), std::pair(2.5, 3.0));
}

TEST_F(ShowSkyKeys, AShowThatNamesItsOwnSkyNeedsNoShippedOne) {
  std::filesystem::remove_all(folder_ / "assets");
  EXPECT_NO_THROW(with("sky: {region_I: {background: grid, stars: none}}\n"));
}

TEST_F(ShowSkyKeys, FilesBesideTheShowComeBeforeThoseOfTheWorkingFolder) {
  const auto before = std::filesystem::current_path();
  write("elsewhere/sky.png", "");
  write("elsewhere/only_here.png", "");
  write("sky.png", "");
  std::filesystem::current_path(folder_ / "elsewhere");
  const auto image = [&](const std::string& name) {
    const Show show = with("sky: {region_I: {background: " + name + "}}\n");
    return std::filesystem::canonical(
        std::get<PanoramaSky>(show.sky[SkyRegion::kI].background).image);
  };
  EXPECT_EQ(image("sky.png"), std::filesystem::canonical(folder_ / "sky.png"));
  EXPECT_EQ(image("only_here.png"),
            std::filesystem::canonical(folder_ / "elsewhere/only_here.png"));
  std::filesystem::current_path(before);
}

// What a show says of a region's stars goes before the law's own balance, and region III has that
// of region I.
TEST_F(ShowKeys, TheGainOfStarsIsTheShowsIfItNamesOne) {
  const Show show = with("stars: {law: psf}\nsky: {region_I: {stars: {gain: 1}}}\n");
  EXPECT_EQ(show.sky[SkyRegion::kI].star_gain, 1);
  EXPECT_EQ(show.sky[SkyRegion::kIII].star_gain, 1);
  const Show limited = with("sky: {region_III: {stars: {max_magnitude: 5}}}\n");
  EXPECT_EQ(limited.sky[SkyRegion::kI].star_gain, 0.4);
  EXPECT_EQ(limited.sky[SkyRegion::kIII].star_gain, 0.4);
}

}  // namespace
}  // namespace domefall
