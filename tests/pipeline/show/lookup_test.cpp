#include "pipeline/show/file/lookup.h"

#include <gtest/gtest.h>

#include <cmath>

#include "pipeline/sources/stars/star_catalogue.h"
#include "tests/pipeline/show/show_file.h"
#include "tests/source_tree.h"
#include "trajectories/equatorial.h"

namespace domefall {
namespace {

SkyPlaces shipped_places() {
  SkyPlaces places;
  places.add(read_star_catalogue(source_file("shows/assets/stars_to_9.stars"), 99).names);
  places.add(read_sky_places(source_file("shows/assets/sky_places.csv")));
  return places;
}

double degrees_between(const SkyDirection& a, const SkyDirection& b) {
  return std::asin(std::min(1.0, (a.v - b.v).length() / 2)) * 2 * 57.29577951308232;
}

TEST(SkyPlaces, StandWhereSimbadHasThem) {
  const SkyPlaces places = shipped_places();
  struct Place {
    const char* name;
    double ra, dec, within;  // degrees
  };
  for (const Place& p : {Place{"Sirius", 101.2872, -16.7161, 0.001},
                         {"M31", 10.6847, 41.2688, 0.001},
                         {"Andromeda Galaxy", 10.6847, 41.2688, 0.001},
                         {"NGC 224", 10.6847, 41.2688, 0.001},
                         {"M 87", 187.7059, 12.3911, 0.02},
                         {"M104", 189.9976, -11.6231, 0.005},
                         {"M 110", 10.0921, 41.6853, 0.005},
                         {"Pleiades", 56.601, 24.114, 0.15},
                         {"NGC 104", 6.0224, -72.0815, 0.001},
                         {"47 Tuc", 6.0224, -72.0815, 0.001},
                         {"IC 1396", 324.74, 57.49, 0.05},
                         {"LMC", 80.8942, -69.7561, 0.005},
                         {"Small Magellanic Cloud", 13.1583, -72.8003, 0.001},
                         {"Sgr A*", 266.41684, -29.00781, 1e-4},
                         {"galactic_centre", 266.405, -28.936, 0.001},
                         {"south celestial pole", 0, -90, 1e-9}}) {
    const auto found = places.find(p.name);
    ASSERT_TRUE(found) << p.name;
    EXPECT_LT(degrees_between(*found, sky_direction(p.ra, p.dec)), p.within) << p.name;
  }
}

TEST(SkyPlaces, EveryMessierObjectAndConstellationIsThere) {
  const SkyPlaces places = shipped_places();
  for (int k = 1; k <= 110; ++k) EXPECT_TRUE(places.find("M" + std::to_string(k))) << k;
  // The middle of a figure lies among its brightest stars.
  for (const auto& [constellation, star, within] :
       {std::tuple("Orion", "epsilon Ori", 8.0), std::tuple("Crux", "delta Cru", 2.5),
        std::tuple("Ursa Major", "delta UMa", 9.0), std::tuple("cassiopeia", "gamma Cas", 3.0),
        std::tuple("Serpens Caput", "alpha Ser", 6.0), std::tuple("Boötes", "epsilon Boo", 8.0)}) {
    ASSERT_TRUE(places.find(constellation) && places.find(star)) << constellation;
    EXPECT_LT(degrees_between(*places.find(constellation), *places.find(star)), within)
        << constellation;
  }
}

TEST(SkyPlaces, AreFoundInAllUsualSpellings) {
  const SkyPlaces places = shipped_places();
  for (const char* name : {"m31", "M 31", "M_31", "M-31", "Messier 31", "messier31", "M031",
                           "ngc224", "NGC 0224", "ANDROMEDA GALAXY", "andromeda_galaxy"})
    EXPECT_TRUE(places.find(name) &&
                degrees_between(*places.find(name), sky_direction(10.6847, 41.2688)) < 0.001)
        << name;
  for (const char* name : {"Galactic Center", "galactic_centre", "galactic-centre"})
    EXPECT_TRUE(places.find(name)) << name;
  EXPECT_TRUE(places.find("Barnards Galaxy") && places.find("Barnard's Galaxy"));
  EXPECT_FALSE(places.find(""));
  EXPECT_FALSE(places.find("M 3 1 1"));
  EXPECT_EQ(folded_place_name("M 100"), "m100");
  EXPECT_EQ(folded_place_name("IC 0010"), "ic10");
}

TEST(SkyPlaces, AMisspeltNameSuggestsStarsAndObjectsButNeverAnotherNumber) {
  const SkyPlaces places = shipped_places();
  for (const auto& [misspelt, meant] :
       {std::pair("Betelguese", "Betelgeuse"), std::pair("Orino", "Orion"),
        std::pair("Casiopeia", "Cassiopeia"), std::pair("Andromeda Galxy", "Andromeda Galaxy"),
        std::pair("NCG 7000", "NGC 7000"), std::pair("Pleyades", "Pleiades"),
        std::pair("Magellanic Small Cloud", ""), std::pair("NGC 9999", ""), std::pair("M 111", ""),
        std::pair("61 Cygn", "61 Cyg")})
    EXPECT_EQ(places.nearest(misspelt), meant);
}

using NamedPlaces = ShowFile;

TEST_F(NamedPlaces, AreTakenWhereverAPlaceOnTheSkyIs) {
  const Show show = read(
      "black_hole: {mass_solar: 1e6, at: galactic_center}\n"
      "cameras: {up: {look_at: messier 31}}\n"
      "timeline:\n"
      "  - {duration_s: 1, trajectory: {type: velocity, r: 9, speed: 0.5, direction: orion}}\n"
      "  - {duration_s: 1, trajectory: {type: static, r: 9}, camera: up}\n"
      "  - {duration_s: 1, trajectory: {type: static, r: 9}, camera: {look_at: {star: Vega}}}\n");
  EXPECT_LT(degrees_between(show.hole_at, sky_direction(266.405, -28.9362)), 1e-9);
  EXPECT_LT(degrees_between(std::get<LookAtSky>(show.timeline[1].camera.attitude).target,
                            sky_direction(10.6847, 41.2687)),
            1e-9);
  // Stars go before other places of the same name.
  EXPECT_LT(degrees_between(std::get<LookAtSky>(show.timeline[2].camera.attitude).target,
                            sky_direction(279.235, 38.784)),
            1e-7);
}

TEST_F(NamedPlaces, ADamagedOrMissingTableIsReportedWhereItIsNeeded) {
  const std::string show = "timeline: [{duration_s: 1}]\ncamera: {look_at: Orion}\n";
  write("assets/sky_places.csv", "name,ra_deg,dec_deg\nOrion,85,100\n");
  EXPECT_NE(complaint(show).find("2:19: camera.look_at needs the table of places on the sky: "),
            std::string::npos);
  std::filesystem::remove(folder_ / "assets/sky_places.csv");
  EXPECT_NE(complaint(show).find("needs Domefall's own file sky_places.csv"), std::string::npos);
  EXPECT_EQ(complaint("timeline: [{duration_s: 1}]\ncamera: {look_at: Vega}\n"), "");
}

}  // namespace
}  // namespace domefall
