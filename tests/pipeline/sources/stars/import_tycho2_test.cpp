// Real rows of Tycho-2 and of d3-celestial's Hipparcos stars (tests/reference/README.md).
#include <algorithm>

#include "pipeline/sources/stars/amend_catalogue.h"
#include "pipeline/sources/stars/catalogue_formats.h"
#include "tests/pipeline/image/test_folder.h"
#include "tests/pipeline/sources/stars/importing.h"

namespace domefall {
namespace {

RawCatalogue tycho() {
  return import_tycho2({kRows / "tyc2.dat", kRows / "suppl_1.dat"}).catalogue;
}
RawCatalogue hipparcos() { return import_d3_celestial({kRows / "stars.json"}).catalogue; }
RawCatalogue repaired() {
  RawCatalogue catalogue = tycho();
  repair_by_hipparcos(catalogue, hipparcos());
  return catalogue;
}

double summed(double a, double b) {
  return -2.5 * std::log10(std::pow(10, -0.4 * a) + std::pow(10, -0.4 * b));
}

TEST(ImportTycho2, StarsOfBothTablesStandWhereTheyDoAtJ2000) {
  const RawCatalogue catalogue = tycho();
  EXPECT_EQ(catalogue.stars.size(), 11u);
  EXPECT_EQ(catalogue.epoch, 2000);
  // The supplement gives J1991.25: without their motion Sirius would stand 11.7 arcsec off.
  EXPECT_LT(arcseconds_from(star_of(catalogue, "HIP 32349").direction, 101.287155, -16.716116),
            0.01);
  EXPECT_LT(arcseconds_from(star_of(catalogue, "HIP 91262").direction, 279.234735, 38.783689),
            0.02);
  EXPECT_LT(arcseconds_from(star_of(catalogue, "HIP 27989").direction, 88.792939, 7.407064), 0.01);
  EXPECT_LT(arcseconds_from(star_of(catalogue, "HIP 32073").direction, 100.52023, -69.70654), 0.1);
  EXPECT_NEAR(star_of(catalogue, "HIP 32349").pm_dec, -1223.1, 1e-3);
}

TEST(ImportTycho2, WithoutAMeanPositionTheObservedOneIsTaken) {
  const CatalogueStar star = star_of(tycho(), "TYC 1-41-1");
  EXPECT_LT(arcseconds_from(star.direction, 1.80874194, 2.31573611), 1e-4);
  EXPECT_EQ(star.pm_ra, 0);
}

TEST(ImportTycho2, VAndColourFollowFromBothBands) {
  const CatalogueStar star = star_of(tycho(), "HIP 32073");  // BT 7.612, VT 7.574
  EXPECT_NEAR(star.v, 7.574 - 0.090 * 0.038, 1e-6);
  EXPECT_NEAR(star.colour, 0.850 * 0.038, 1e-6);
  EXPECT_FALSE(star.v_is_rough);
}

TEST(ImportTycho2, OneBandAloneGivesARoughVAndNoColour) {
  const CatalogueStar visual = star_of(tycho(), "TYC 23-874-1"),
                      blue = star_of(tycho(), "TYC 608-705-1");
  EXPECT_NEAR(visual.v, 10.784, 1e-6);
  // As a star of B-V = 0.6: BT - VT = 0.706.
  EXPECT_NEAR(blue.v, 12.527 - 0.7059 * 1.09, 1e-3);
  for (const CatalogueStar& star : {visual, blue}) {
    EXPECT_EQ(star.colour, kNoColour);
    EXPECT_TRUE(star.v_is_rough);
  }
}

TEST(ImportTycho2, OnlyTheBrighterOfAPairBearsItsHipparcosNumber) {
  const RawCatalogue catalogue = tycho();
  EXPECT_NEAR(star_of(catalogue, "HIP 106395").v, 7.700 - 0.09 * 0.536, 1e-4);
  EXPECT_NEAR(star_of(catalogue, "TYC 1676-789-2").v, 8.043 - 0.09 * 0.546, 1e-4);
  EXPECT_EQ(star_of(catalogue, "TYC 1676-789-2").hip, 106395u);
}

TEST(HipparcosRepair, GivesSiriusVegaAndBetelgeuseTheirVAndColour) {
  // Tycho-2 has Hipparcos' Hp for them, and no colour.
  EXPECT_NEAR(star_of(tycho(), "HIP 32349").v, -1.088, 1e-6);
  const RawCatalogue catalogue = repaired();
  struct Expected {
    const char* id;
    double v, b_v;
  };
  for (const auto& [id, v, b_v] :
       {Expected{"HIP 32349", -1.44, 0.009}, Expected{"HIP 91262", 0.03, -0.001},
        Expected{"HIP 27989", 0.45, 1.5}, Expected{"HIP 32073", 7.58, 0.028}}) {
    EXPECT_NEAR(star_of(catalogue, id).v, v, 1e-6) << id;
    EXPECT_NEAR(star_of(catalogue, id).colour, b_v, 1e-6) << id;
  }
  // Their places and motions stay Tycho's.
  EXPECT_LT(arcseconds_from(star_of(catalogue, "HIP 32349").direction, 101.287155, -16.716116),
            0.01);
}

TEST(HipparcosRepair, LeavesAPairItsLightInsteadOfCountingItTwice) {
  const RawCatalogue catalogue = repaired();
  const double a = star_of(catalogue, "HIP 106395").v, b = star_of(catalogue, "TYC 1676-789-2").v;
  EXPECT_NEAR(a, 7.700 - 0.09 * 0.536, 1e-4);
  // Hipparcos' V of the pair, 7.02, is that of both.
  EXPECT_NEAR(summed(a, b), 7.02, 0.06);
}

TEST(HipparcosRepair, ShiftsAPairOfRoughMagnitudesToTheirSum) {
  RawCatalogue pair, hip;
  for (const float v : {8.1F, 8.5F}) {
    CatalogueStar star;
    star.hip = 5, star.v = v, star.v_is_rough = true;
    pair.stars.push_back(star);
  }
  CatalogueStar both;
  both.hip = 5, both.v = 7.4F, both.colour = 0.3F;
  hip.stars.push_back(both);
  const HipparcosRepair done = repair_by_hipparcos(pair, hip);
  EXPECT_EQ(done.stars, 2u);
  EXPECT_EQ(done.colours, 2u);
  EXPECT_NEAR(summed(pair.stars[0].v, pair.stars[1].v), 7.4, 1e-6);
  EXPECT_NEAR(pair.stars[1].v - pair.stars[0].v, 0.4, 1e-5);
  EXPECT_EQ(pair.stars[1].colour, 0.3F);
}

TEST(HipparcosRepair, AddsWhatIsNotThere) {
  RawCatalogue catalogue = tycho();
  const std::size_t before = catalogue.stars.size();
  const HipparcosRepair done = repair_by_hipparcos(catalogue, hipparcos());
  EXPECT_EQ(done.added, 3u);  // 55203, 104887 and 120416
  EXPECT_EQ(catalogue.stars.size(), before + 3);
  EXPECT_NEAR(star_of(catalogue, "HIP 55203").v, 3.79, 1e-6);
}

TEST(ImportD3Celestial, RightAscensionsBelowZeroAndEmptyColoursAreUnderstood) {
  const RawCatalogue catalogue = hipparcos();
  EXPECT_EQ(catalogue.stars.size(), 9u);
  EXPECT_LT(arcseconds_from(star_of(catalogue, "HIP 91262").direction, 279.2347, 38.7837), 1e-6);
  EXPECT_EQ(star_of(catalogue, "HIP 120416").colour, kNoColour);
}

TEST(ImportD3Celestial, NamesComeWithLettersSpeltOut) {
  RawCatalogue catalogue = hipparcos();
  add_names(catalogue, kRows / "starnames.json");
  std::vector<std::string> names;
  for (const StarName& name : catalogue.names) names.push_back(name.name);
  for (const char* name : {"Sirius", "alpha CMa", "Vega", "alpha Lyr", "xi UMa", "tau Cyg"})
    EXPECT_NE(std::find(names.begin(), names.end(), name), names.end()) << name;
}

class Tycho2Files : public Imports {};

TEST_F(Tycho2Files, AFolderWithoutOneOfItsPartsIsRefused) {
  std::filesystem::copy(kRows / "tyc2.dat", folder_ / "tyc2.dat.00");
  EXPECT_TRUE(message_of([&] {
                import_tycho2({folder_});
              }).starts_with((folder_ / "tyc2.dat.01").string() + ": missing"));
}

TEST_F(Tycho2Files, DamagedRowsAreToldWithTheirLine) {
  const std::string rows = contents(kRows / "tyc2.dat"), name = (folder_ / "input").string();
  std::string letters = rows;
  letters.replace(207 + 110, 6, "12,4x5");
  EXPECT_EQ(complaint(import_tycho2, letters),
            name + ":2: BTmag (bytes 111-116) must be a number from -5 to 20, got '12,4x5'");
  EXPECT_EQ(
      complaint(import_tycho2, rows.substr(0, 207 + 60)),
      name + ":2: a line has 206 bytes, this one 60 at the end of the file, which is cut short");
  EXPECT_EQ(complaint(import_tycho2, rows.substr(0, 207) + rows.substr(210)),
            name + ":2: a line has 206 bytes, this one 203");
  EXPECT_EQ(complaint(import_tycho2, ""), name + ": the file is empty");
  std::string blank = rows;
  blank.replace(15, 12, 12, ' ');
  EXPECT_EQ(complaint(import_tycho2, blank), name + ":1: RA (bytes 16-27) is blank");
}

}  // namespace
}  // namespace domefall
