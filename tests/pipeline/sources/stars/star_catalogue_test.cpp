// Where stars stand at other epochs, against places given by SIMBAD and against geometry.
#include "pipeline/sources/stars/star_catalogue.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "pipeline/sources/stars/raw_catalogue.h"
#include "pipeline/sources/stars/star_file.h"
#include "tests/pipeline/image/test_folder.h"
#include "tests/source_tree.h"
#include "trajectories/degree.h"
#include "trajectories/equatorial.h"

namespace domefall {
namespace {

double light(const std::vector<Star>& stars, bool north_only) {
  double sum = 0;
  for (const Star& s : stars)
    if (!north_only || s.direction.v.z > 0) sum += std::pow(10, -0.4 * double{s.v_magnitude});
  return sum;
}

// A table and a .stars file are thinned out in the same way.
TEST(ThinnedStars, SendTheSameLightSortedByMagnitude) {
  for (const char* name : {"stars_to_9.stars", "stars_to_8.csv"}) {
    const std::string file = source_file("shows/assets/") + name;
    const StarCatalogue all = read_star_catalogue(file, 9),
                        few = read_star_catalogue(file, 9, kCatalogueEpoch, 512);
    EXPECT_LT(few.stars.size(), 512 * 6) << name;
    EXPECT_TRUE(std::ranges::is_sorted(few.stars, {}, &Star::v_magnitude)) << name;
    EXPECT_EQ(few.names.size(), all.names.size()) << name;
    EXPECT_EQ(few.names.back().direction.v, all.names.back().direction.v) << name;
    EXPECT_NEAR(light(few.stars, false) / light(all.stars, false), 1, 1e-3) << name;
    // Of half of the sky, it is theirs to what so few can be: 2500 of nearly one brightness.
    EXPECT_NEAR(light(few.stars, true) / light(all.stars, true), 1, 0.02) << name;
  }
}

using Kept = std::vector<std::pair<std::size_t, std::size_t>>;

Kept kept(std::size_t stars, std::size_t whole) {
  Kept found;
  thin_out(stars, whole, [&](std::size_t k, std::size_t count) { found.push_back({k, count}); });
  return found;
}

TEST(ThinnedStars, StandForTheMoreTheFainterTheyAre) {
  EXPECT_EQ(kept(8, 2), (Kept{{0, 1}, {1, 1}, {3, 2}, {6, 4}}));
  EXPECT_EQ(kept(3, 3), (Kept{{0, 1}, {1, 1}, {2, 1}}));
  EXPECT_EQ(kept(2, kAllWhole), (Kept{{0, 1}, {1, 1}}));
  EXPECT_TRUE(kept(0, 5).empty());
}

const std::string kAssets = source_file("shows/assets/");

TEST(Stars, ToTheNakedEyesLimitAreItsSky) {
  const StarCatalogue catalogue = read_star_catalogue(kAssets + "stars_to_9.stars", 6.5);
  EXPECT_EQ(catalogue.stars.size(), 8883u);
  EXPECT_TRUE(std::ranges::is_sorted(catalogue.stars, {}, &Star::v_magnitude));
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

constexpr double kArcsecond = kDegree / 3600;

double separation(const SkyDirection& a, const SkyDirection& b) {
  return std::atan2(a.v.cross(b.v).length(), a.v.dot(b.v));
}

struct Mover {
  const char* name;
  double ra, dec, pm_ra, pm_dec;  // J2000 degrees, mas a year (SIMBAD: van Leeuwen 2007, Gaia DR3)
};
constexpr Mover kBarnard{"Barnard's star", 269.452077, 4.693365, -801.551, 10362.394};
constexpr Mover kSirius{"Sirius", 101.287155, -16.716116, -546.01, -1223.07};
constexpr Mover kArcturus{"Arcturus", 213.915300, 19.182409, -1093.39, -2000.06};

SkyDirection at(const Mover& star, double years) {
  return moved(sky_direction(star.ra, star.dec), star.pm_ra, star.pm_dec, years);
}

TEST(Motion, OverACenturyIsTheProperMotionAlongBothAxes) {
  for (const Mover& star : {kBarnard, kSirius, kArcturus}) {
    const SkyDirection then = at(star, 100);
    const double dec = std::asin(then.v.z) / kDegree, ra = std::atan2(then.v.y, then.v.x) / kDegree;
    const double east = std::remainder(ra - star.ra, 360) * std::cos(dec * kDegree);
    // The curvature of the sky: some (1000 arcsec)^2 in radians, 5 arcsec, at Barnard's star; the
    // others' less.
    EXPECT_NEAR(east * 3600, star.pm_ra * 0.1, 0.4) << star.name;
    EXPECT_NEAR((dec - star.dec) * 3600, star.pm_dec * 0.1, 0.4) << star.name;
    EXPECT_NEAR(then.v.length(), 1, 3e-16);
  }
}

TEST(Motion, BarnardsStarIsHalfADegreeNorthIn175Years) {
  EXPECT_NEAR(separation(at(kBarnard, 0), at(kBarnard, 175)) / kDegree, 0.505, 0.001);
}

TEST(Motion, IsAGreatCircleWhoseAngleIsTheArcTangent) {
  const double rate = std::hypot(kArcturus.pm_ra, kArcturus.pm_dec) * 1e-3 * kArcsecond;
  for (const double years : {-10000.0, -100.0, 1.0, 1000.0, 28000.0})
    EXPECT_NEAR(separation(at(kArcturus, 0), at(kArcturus, years)),
                std::abs(std::atan(rate * years)), 1e-14);
  const V3d pole = at(kArcturus, 0).v.cross(at(kArcturus, 5000).v).normalized();
  EXPECT_NEAR(pole.dot(at(kArcturus, -8000).v), 0, 1e-15);
}

TEST(Motion, AtThePoleGoesAlongTheMeridianOfRightAscensionZero) {
  const SkyDirection pole{V3d(0, 0, 1)};
  const SkyDirection then = moved(pole, 0, -1000, 3600);
  EXPECT_NEAR(then.v.x, kDegree / std::hypot(1, kDegree), 1e-15);
  EXPECT_EQ(then.v.y, 0);
  EXPECT_GT(moved(pole, 1000, 0, 3600).v.y, 0.017);
}

class Epochs : public TestFolder {};

TEST_F(Epochs, TablesAndFilesMoveAlikeAndStandStillAtTheirOwn) {
  const auto table = folder_ / "movers.csv", file = folder_ / "movers.stars";
  put(table,
      "ra_deg,dec_deg,v_mag,b_v,name,pm_ra_mas_yr,pm_dec_mas_yr\n"
      "101.287155,-16.716116,-1.46,0.00,Sirius,-546.01,-1223.07\n"
      "279.234735,38.783689,0.03,0.00,Vega,,\n"
      "269.452077,4.693365,9.54,1.57,Barnard,-801.551,10362.394\n");
  RawCatalogue raw;
  for (const Mover& star : {kSirius, Mover{"Vega", 279.234735, 38.783689, 0, 0}, kBarnard}) {
    CatalogueStar s;
    s.direction = sky_direction(star.ra, star.dec);
    s.pm_ra = static_cast<float>(star.pm_ra), s.pm_dec = static_cast<float>(star.pm_dec);
    s.v = static_cast<float>(raw.stars.size()), s.colour = 0;
    raw.stars.push_back(s);
  }
  write_star_file(file, raw);
  for (const double epoch : {2000.0, 2026.5, -3000.0}) {
    const StarCatalogue a = read_star_catalogue(table, 20, epoch),
                        b = read_star_catalogue(file, 20, epoch);
    ASSERT_EQ(a.stars.size(), 3u);
    for (std::size_t i = 0; i < 3; ++i)
      // The float that holds the motion: 6e-8 of it.
      EXPECT_LT(separation(a.stars[i].direction, b.stars[i].direction),
                (0.0002 + std::abs(epoch - 2000) * 1e-6) * kArcsecond);
    EXPECT_EQ(a.names[2].direction.v, a.stars[2].direction.v);
    EXPECT_LT(separation(a.stars[0].direction, at(kSirius, epoch - 2000)), 1e-12);
  }
  EXPECT_EQ(read_star_catalogue(table, 20).stars[2].direction.v,
            sky_direction(kBarnard.ra, kBarnard.dec).v);
  // The positions of a file of another epoch are those of that epoch.
  raw.epoch = 1991.25;
  write_star_file(file, raw);
  EXPECT_LT(separation(read_star_catalogue(file, 20, 1991.25).stars[2].direction, at(kBarnard, 0)),
            1e-9);
  EXPECT_NEAR(
      separation(read_star_catalogue(file, 20).stars[2].direction, at(kBarnard, 0)) / kArcsecond,
      8.75 * 10.3933, 0.001);
}

TEST_F(Epochs, AMotionThatIsNoNumberIsToldWithItsLine) {
  const auto table = folder_ / "movers.csv";
  put(table, "ra_deg,dec_deg,v_mag,b_v,pm_ra_mas_yr\n1,2,3,0.5,fast\n");
  EXPECT_EQ(
      message_of([&] { read_star_catalogue(table, 20, 2100); }),
      table.string() + ":2: pm_ra_mas_yr must be a number from -100000 to 100000, got 'fast'");
}

}  // namespace
}  // namespace domefall
