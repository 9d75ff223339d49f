// Stellarium's catalogues, of the versions to 24 and of those from 25 on.
#include <cstring>

#include "pipeline/sources/stars/raw_catalogue.h"
#include "pipeline/sources/stars/stellarium_zones.h"
#include "tests/pipeline/sources/stars/importing.h"
#include "trajectories/equatorial.h"

namespace domefall {
namespace {

class StellariumImports : public Imports {};

// The files made by the same description, level 0.

template <class T>
void append(std::string& bytes, T value) {
  char raw[sizeof value];
  std::memcpy(raw, &value, sizeof value);
  bytes.append(raw, sizeof value);
}

// One star in a zone of level 0; type 0: 28 bytes, type 1: 10.
std::string stellarium_file(int type, int zone, const std::string& record) {
  std::string bytes;
  append(bytes, std::uint32_t{0x835f040a});
  for (const int value : {type, 0, 8, 0, -2000, 12000, 240}) append(bytes, std::int32_t{value});
  for (int i = 0; i < 20; ++i) append(bytes, std::uint32_t{i == zone ? 1U : 0U});
  return bytes + record;
}

TEST_F(StellariumImports, StarsStandInTheirZones) {
  std::string record;
  append(record, std::uint32_t{32349 | 1u << 24});
  append(record, std::int32_t{1 << 30}), append(record, std::int32_t{-(1 << 29)});
  record += static_cast<char>(16), record += static_cast<char>(11);  // B-V .004, V -1.45
  append(record, std::uint16_t{0});
  for (const int value : {-6000, 3000, 0}) append(record, std::int32_t{value});
  const CatalogueStar star =
      import_stellarium({file(stellarium_file(0, 7, record))}).catalogue.stars.at(0);
  const auto expected =
      StellariumZones(0).place(7, (1 << 30) / 2147483647.0, -(1 << 29) / 2147483647.0);
  EXPECT_EQ(star.direction.v, expected.direction.v);
  EXPECT_NEAR(star.v, -1.45, 1e-6);
  EXPECT_NEAR(star.colour, 16 * 4 / 127.0 - 0.5, 1e-6);
  EXPECT_EQ(star.id, hipparcos_id(32349));
  EXPECT_NEAR(star.pm_ra, -600 / expected.stretch, 1e-4);
  EXPECT_EQ(guess_format({folder_ / "input"})->name, "stellarium");
}

TEST_F(StellariumImports, BitFieldsAreUnpacked) {
  // x0 = 0x12345, x1 = -2, dx0 = -1, dx1 = 5, bV = 100, mag = 21, from the lowest bit up.
  const std::uint64_t low = 0x12345ULL | 0xffffeULL << 20 | 0x3fffULL << 40 | (5ULL & 0x3ff) << 54;
  const std::uint16_t high = static_cast<std::uint16_t>(5 >> 10 | 100 << 4 | 21 << 11);
  std::string record;
  append(record, low), append(record, high);
  const CatalogueStar star =
      import_stellarium({file(stellarium_file(1, 3, record))}).catalogue.stars.at(0);
  const auto expected = StellariumZones(0).place(3, 0x12345 / 524287.0, -2 / 524287.0);
  EXPECT_EQ(star.direction.v, expected.direction.v);
  EXPECT_NEAR(star.v, -2 + 21 * 0.05, 1e-6);
  EXPECT_NEAR(star.colour, 100 * 4 / 127.0 - 0.5, 1e-6);
  EXPECT_NEAR(star.pm_ra, -0.1 / expected.stretch, 1e-6);
  EXPECT_NEAR(star.pm_dec, 0.5 / expected.stretch, 1e-6);
  EXPECT_EQ(star.id, kNoStarId);
}

TEST(StellariumZones, CoverTheSkyAndTouch) {
  for (int level = 0; level < 4; ++level) {
    const StellariumZones zones(level);
    V3d sum(0);
    for (std::size_t i = 0; i < zone_count(level); ++i) sum += zones.place(i, 0, 0).direction.v;
    EXPECT_EQ(zone_count(level), 20u << (2 * level));
    EXPECT_LT(sum.length(), 1e-9);
  }
}

// ---- Stellarium from version 25 on ----

// One star of a type at level 0, in the last zone, which is the one of the whole sky.
std::string gaia_file(int type, const std::string& record) {
  std::string bytes;
  append(bytes, std::uint32_t{0x835f040a});
  for (const int value : {type, 0, 21, 0, -2000}) append(bytes, std::int32_t{value});
  append(bytes, 2457389.0F);
  for (int i = 0; i < 21; ++i) append(bytes, std::uint32_t{i == 20 ? 1U : 0U});
  return bytes + record;
}

TEST_F(StellariumImports, OfGaiaHasPlacesOfJ2016) {
  // Sirius 16 years after it was where Hipparcos' motions lead from J2000.
  const SkyDirection now = moved(sky_direction(101.287155, -16.716116), -546.01, -1223.07, 16);
  const V3d east = V3d(0, 0, 1).cross(now.v).normalized(), north = now.v.cross(east);
  const V3d motion = east * -546.01 + north * -1223.07;
  std::string record;
  append(record, std::int64_t{0});
  for (const double x : {now.v.x, now.v.y, now.v.z})
    append(record, static_cast<std::int32_t>(std::lround(x * 2e9)));
  for (const double x : {motion.x, motion.y, motion.z})
    append(record, static_cast<std::int32_t>(std::lround(x * 1000)));
  append(record, std::int16_t{9}), append(record, std::int16_t{-1440});
  for (int i = 0; i < 4; ++i) append(record, std::uint16_t{7});
  record += '\x01';
  const std::uint32_t hip = 32349 << 5 | 1;
  for (const int shift : {0, 8, 16}) record += static_cast<char>(hip >> shift & 0xff);
  ASSERT_EQ(record.size(), 48u);
  const ImportedCatalogue all = import_stellarium({file(gaia_file(0, record))});
  const CatalogueStar sirius = star_of(all.catalogue, "HIP 32349");
  EXPECT_LT(arcseconds_from(sirius.direction, 101.287155, -16.716116), 0.01);
  EXPECT_NEAR(sirius.v, -1.44, 1e-6);
  EXPECT_NEAR(sirius.colour, 0.009, 1e-6);
  EXPECT_NEAR(sirius.pm_ra, -546.01, 0.01);
  EXPECT_NEAR(sirius.pm_dec, -1223.07, 0.01);
  EXPECT_EQ(guess_format({folder_ / "input"})->name, "stellarium");
  EXPECT_TRUE(all.catalogue.text.source.find("Gaia") != std::string::npos);
  EXPECT_TRUE(complaint(import_stellarium, gaia_file(0, std::string(48, '\0')))
                  .ends_with("input: byte 112: the record that begins here is no star"));
}

TEST_F(StellariumImports, OfGaiaHasFaintStarsByAngles) {
  // The motion in right ascension, 2000 uas a year, is 1 mas a year at declination 60.
  std::string record;
  append(record, std::int64_t{5});
  for (const int value : {30 * 3'600'000, 60 * 3'600'000, 2000, -3000})
    append(record, std::int32_t{value});
  append(record, std::int16_t{650}), append(record, std::int16_t{8250});
  append(record, std::uint32_t{0});
  CatalogueStar star = import_stellarium({file(gaia_file(1, record))}).catalogue.stars.at(0);
  EXPECT_NEAR(star.pm_ra, 1, 1e-6);
  EXPECT_NEAR(star.pm_dec, -3, 1e-6);
  EXPECT_LT(arcseconds_from(star.direction, 30 - 16 * 2e-3 / 3600, 60 + 16 * 3e-3 / 3600), 1e-3);
  EXPECT_NEAR(star.v, 8.25, 1e-6);
  EXPECT_NEAR(star.colour, 0.65, 1e-6);

  record.clear();
  append(record, std::int64_t{5});
  for (const std::uint32_t tenths : {30u * 36000, (90u - 60) * 36000})
    for (const int shift : {0, 8, 16}) record += static_cast<char>(tenths >> shift & 0xff);
  record += static_cast<char>(60), record += static_cast<char>(50);
  star = import_stellarium({file(gaia_file(2, record))}).catalogue.stars.at(0);
  EXPECT_LT(arcseconds_from(star.direction, 30, -60), 1e-3);
  EXPECT_NEAR(star.v, 17, 1e-6);
  EXPECT_NEAR(star.colour, 0.5, 1e-6);
  EXPECT_EQ(star.pm_ra, 0);
}

TEST_F(StellariumImports, StarsOfType2HaveNoMotion) {
  // x0 = 0x1234, x1 = -2, bV = 100, mag = 21, from the lowest bit up.
  const std::uint64_t packed =
      0x1234ULL | (0x3fffeULL & 0x3ffff) << 18 | 100ULL << 36 | 21ULL << 43;
  std::string record;
  append(record, packed);
  const CatalogueStar star =
      import_stellarium({file(stellarium_file(2, 3, record.substr(0, 6)))}).catalogue.stars.at(0);
  const auto expected = StellariumZones(0).place(3, 0x1234 / 131071.0, -2 / 131071.0);
  EXPECT_EQ(star.direction.v, expected.direction.v);
  EXPECT_NEAR(star.v, -2 + 21 * 0.05, 1e-6);
  EXPECT_NEAR(star.colour, 100 * 4 / 127.0 - 0.5, 1e-6);
  EXPECT_EQ(star.pm_ra, 0);
}

TEST_F(StellariumImports, DamageIsToldWithItsByte) {
  const std::string good = stellarium_file(1, 3, std::string(10, '\0'));
  EXPECT_EQ(complaint(import_stellarium, good), "");
  EXPECT_TRUE(complaint(import_stellarium, good.substr(0, good.size() - 1))
                  .find("input: byte 112: the zones should have 1 stars") != std::string::npos);
  EXPECT_TRUE(complaint(import_stellarium, good.substr(0, 50))
                  .ends_with("the file ends within its table of zones"));
  EXPECT_TRUE(complaint(import_stellarium, good.substr(0, 20))
                  .ends_with("the file ends within its header"));
  std::string other = good;
  other[0] = 'x';
  EXPECT_TRUE(complaint(import_stellarium, other)
                  .find("input: byte 0: this is no catalogue of Stellarium's") !=
              std::string::npos);
  other = good, other[4] = 3;
  EXPECT_TRUE(complaint(import_stellarium, other).find("byte 4: stars of type 3") !=
              std::string::npos);
}

}  // namespace
}  // namespace domefall
