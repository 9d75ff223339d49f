#include "pipeline/sources/stars/amend_catalogue.h"
#include "pipeline/sources/stars/raw_catalogue.h"
#include "tests/pipeline/image/test_folder.h"
#include "tests/pipeline/sources/stars/importing.h"
#include "tests/source_tree.h"
#include "trajectories/equatorial.h"

namespace domefall {
namespace {

class StarCorrections : public TestFolder {
 protected:
  StarCorrections() {
    for (std::uint32_t i = 1; i <= 4; ++i) {
      CatalogueStar star;
      star.direction = sky_direction(10.0 * i, 5.0 * i);
      star.v = static_cast<float>(i), star.id = henry_draper_id(i);
      if (i == 4) star.v = kNoMagnitude;
      stars_.stars.push_back(star);
    }
    stars_.names = {{0, "One"}, {1, "beta Two"}};
  }

  std::size_t apply(const std::string& text) {
    put(folder_ / "c.csv", text);
    return apply_corrections(stars_, folder_ / "c.csv");
  }
  std::string complaint(const std::string& text) {
    const std::string said = message_of([&] { apply(text); });
    return said.empty() ? "" : said.substr(folder_.string().size() + 1);
  }

  RawCatalogue stars_;
};

TEST_F(StarCorrections, SetMagnitudesColoursPlacesAndMotions) {
  EXPECT_EQ(
      apply("# by "
            "hand\nstar,v_mag,b_v,temperature_k,ra_deg,dec_deg,pm_ra_mas_yr,pm_dec_mas_yr,source\n"
            "HD 1,2.5,,,,,,,guessed\n"
            "betatwo,,0.3,,,,,,\n"
            "hd3,,,31400,100,-20,5,-6,\n"),
      3u);
  EXPECT_EQ(stars_.stars[0].v, 2.5F);
  EXPECT_EQ(stars_.stars[1].colour, 0.3F);
  EXPECT_EQ(stars_.stars[1].v, 2);
  EXPECT_EQ(stars_.stars[2].colour, 31400);
  EXPECT_LT(arcseconds_from(stars_.stars[2].direction, 100, -20), 1e-6);
  EXPECT_EQ(stars_.stars[2].pm_dec, -6);
}

TEST_F(StarCorrections, GiveAMagnitudeToOneThatHadNone) {
  apply("star,v_mag\nHIP 92420 | HD 4,3.52\n");
  keep_brighter(stars_, kFaintestV);
  EXPECT_EQ(stars_.stars.size(), 4u);
  EXPECT_EQ(stars_.stars[3].v, 3.52F);
}

TEST_F(StarCorrections, RemoveAndAddStarsAndTheirNames) {
  apply(
      "star,action,v_mag,b_v,ra_deg,dec_deg\nOne,remove,,,,\nHD "
      "9,add,6,0.5,20,30\nNemesis,add,12,,1,2\n");
  ASSERT_EQ(stars_.stars.size(), 5u);
  EXPECT_EQ(stars_.stars[0].id, henry_draper_id(2));
  EXPECT_EQ(stars_.stars[3].id, henry_draper_id(9));
  ASSERT_EQ(stars_.names.size(), 2u);
  EXPECT_EQ(stars_.names[0].star, 0u);  // beta Two moved up
  EXPECT_EQ(stars_.names[1].name, "Nemesis");
  EXPECT_EQ(stars_.names[1].star, 4u);
}

TEST_F(StarCorrections, RowsThatDoNothingAreErrorsWithTheirLine) {
  EXPECT_EQ(complaint("star,v_mag\nHD 1,2\nHD 77 | Nobody,3\n"),
            "c.csv:3: the catalogue has no star 'HD 77 | Nobody'");
  EXPECT_EQ(complaint("star,v_mag\nHD 1,\n"), "c.csv:2: the row changes nothing");
  EXPECT_EQ(complaint("star,v_mag\n,2\n"), "c.csv:2: star is empty");
  EXPECT_EQ(complaint("star,action\nHD 1,delete\n"),
            "c.csv:2: action must be add, remove or empty, got 'delete'");
  EXPECT_EQ(complaint("star,action,ra_deg,dec_deg,v_mag\nHD 1,add,1,2,3\n"),
            "c.csv:2: the catalogue has a star 'HD 1' already");
  EXPECT_EQ(complaint("star,action,v_mag\nHD 8,add,3\n"), "c.csv:2: ra_deg is empty");
  EXPECT_EQ(complaint("star,ra_deg,dec_deg\nHD 1,5,\n"),
            "c.csv:2: ra_deg and dec_deg are given both or neither");
  EXPECT_EQ(complaint("star,b_v,temperature_k\nHD 1,0.5,5000\n"),
            "c.csv:2: b_v and temperature_k exclude each other");
  EXPECT_EQ(complaint("v_mag\n2\n"), "c.csv:1: the table has no column star");
  EXPECT_EQ(complaint("star,action,v_mag\nHD 1,remove,\nHD 1,,3\n"),
            "c.csv:3: the catalogue has no star 'HD 1'");
}

TEST_F(StarCorrections, RowsThatClashAreErrorsWithTheirLine) {
  EXPECT_EQ(complaint("star,v_mag\nHD 1,2\nOne,3\n"), "c.csv:3: the star 'One' is corrected twice");
  EXPECT_EQ(complaint("star,action,v_mag\nHD 2,remove,3\n"),
            "c.csv:2: a star that is removed has no numbers");
  stars_.names.push_back({3, "one"});
  EXPECT_EQ(complaint("star,v_mag\nOne,2\n"),
            "c.csv:2: several stars are called 'One'; name its number");
}

TEST_F(StarCorrections, TheShippedOnesGiveTheHenryDraperCatalogueItsBetaLyrae) {
  RawCatalogue draper;
  for (const std::uint32_t hd :
       {174638U, 19356U, 25204U, 132742U, 65818U, 156633U, 151890U, 31964U, 32068U}) {
    CatalogueStar star;
    star.id = henry_draper_id(hd), star.v = kNoMagnitude;
    draper.stars.push_back(star);
  }
  EXPECT_EQ(apply_corrections(draper, source_file("shows/assets/star_corrections.csv")), 9u);
  EXPECT_EQ(draper.stars[0].v, 3.52F);
  for (const CatalogueStar& star : draper.stars) EXPECT_LT(star.v, 5);
}

TEST(StarIds, AreReadFromNames) {
  const std::pair<const char*, StarId> names[] = {{"HIP 1", hipparcos_id(1)},
                                                  {" hip120416 ", hipparcos_id(120416)},
                                                  {"HD 359083", henry_draper_id(359083)},
                                                  {"TYC 1-1-1", tycho_id(1, 1, 1)},
                                                  {"TYC 9537-12121-4", tycho_id(9537, 12121, 4)}};
  for (const auto& [name, id] : names) EXPECT_EQ(parse_star_id(name), id) << name;
  for (const char* none : {"", "HIP", "HIP x", "HIP 1-2", "TYC 1-2", "TYC 9999-1-1", "TYC 1-2-5",
                           "HIP 4294967296", "HIP -1", "HIP 0", "Sirius", "HD 1.5"})
    EXPECT_EQ(parse_star_id(none), std::nullopt) << none;
}

}  // namespace
}  // namespace domefall
