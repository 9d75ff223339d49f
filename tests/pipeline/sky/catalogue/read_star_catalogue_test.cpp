#include "pipeline/sky/catalogue/read_star_catalogue.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>

#include "pipeline/image/errors.h"
#include "tests/source_tree.h"
#include "trajectories/equatorial.h"

namespace domefall {
namespace {

const std::string kAssets = source_file("shows/assets/");

TEST(Stars, ToTheNakedEyesLimitAreItsSky) {
  const StarCatalogue catalogue = read_star_catalogue(kAssets + "stars_to_9.stars", 6.5);
  EXPECT_EQ(catalogue.stars.size(), 8883u);
  EXPECT_TRUE(
      std::is_sorted(catalogue.stars.begin(), catalogue.stars.end(),
                     [](const Star& a, const Star& b) { return a.v_magnitude < b.v_magnitude; }));
  for (const auto& [name, ra, dec] :
       {std::tuple("Sirius", 101.287155, -16.716116), std::tuple("Vega", 279.234735, 38.783689),
        std::tuple("alpha Ori", 88.792939, 7.407064)}) {
    const auto found = std::ranges::find(catalogue.names, name, &NamedStar::name);
    ASSERT_NE(found, catalogue.names.end()) << name;
    EXPECT_LT((found->direction.v - sky_direction(ra, dec).v).length(), 3e-6) << "0.5 arcsec";
  }
  EXPECT_EQ(read_star_catalogue(kAssets + "stars_to_9.stars", 1.5).stars.size(), 23u);
}

TEST(Stars, HaveTheSameMagnitudesWithoutTheRest) {
  for (const char* name : {"stars_to_9.stars", "stars_to_8.csv"})
    for (const double limit : {-9.0, 1.5, 6.5}) {
      std::vector<float> expected;
      for (const Star& star : read_star_catalogue(kAssets + name, limit).stars)
        expected.push_back(star.v_magnitude);
      EXPECT_EQ(star_magnitudes(kAssets + name, limit), expected) << name << " to " << limit;
    }
}

TEST(Stars, ADamagedRowIsNamedByFileAndLine) {
  const auto file = std::filesystem::temp_directory_path() / "domefall_damaged_catalogue.csv";
  std::ofstream(file) << "ra_deg,dec_deg,v_mag,b_v,name,designation\n1,2,3,0.5,,\n1,200,3,0.5,,\n";
  try {
    read_star_catalogue(file, 6.5);
    FAIL();
  } catch (const InputError& error) {
    EXPECT_TRUE(std::string(error.what()).starts_with(file.string() + ":3")) << error.what();
  }
  std::filesystem::remove(file);
}

}  // namespace
}  // namespace domefall
