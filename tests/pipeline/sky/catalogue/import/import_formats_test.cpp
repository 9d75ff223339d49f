// ASCC-2.5, HYG, Stellarium and Domefall's own tables.
#include <cstdio>
#include <cstring>

#include "pipeline/image/errors.h"
#include "pipeline/sky/catalogue/import/stellarium_zones.h"
#include "tests/pipeline/image/test_folder.h"
#include "tests/pipeline/sky/sky_places.h"

namespace domefall {
namespace {

class Imports : public TestFolder {
 protected:
  std::filesystem::path file(const std::string& text) const {
    put(folder_ / "input", text);
    return folder_ / "input";
  }
  template <class Importing>
  std::string complaint(Importing import, const std::string& text) const {
    try {
      import({file(text)});
    } catch (const InputError& error) {
      return error.what();
    }
    return "";
  }
};

// ---- ASCC-2.5: byte by byte as the ReadMe of I/280B ----

std::string ascc_row(double ra_hours, double dec, int pm_ra, int pm_dec, int b, int v, int hip,
                     int hd) {
  std::string line(210, ' ');
  const auto set = [&line](int first, const char* format, auto value) {
    char text[32];
    const int length = std::snprintf(text, sizeof text, format, value);
    line.replace(static_cast<std::size_t>(first) - 1, static_cast<std::size_t>(length), text);
  };
  set(1, "%12.9f", ra_hours), set(14, "%12.8f", dec);
  set(50, "%7d", pm_ra), set(58, "%7d", pm_dec);
  set(78, "%5d", b), set(84, "%5d", v);
  set(137, "%4d", 0), set(141, "%5d", 0), set(146, "%1d", 0), set(148, "%6d", hip),
      set(155, "%6d", hd);
  return line + "\n";
}

TEST_F(Imports, AsccHasHoursHundredthsOfMasAndMillimagnitudes) {
  // Sirius as Hipparcos has it at J1991.25.
  const auto input = file(
      ascc_row(101.28854105 / 15, -16.71314306, -54601, -122308, -1430, -1440, 32349, 48915) +
      ascc_row(1.5, 10, 999999, 999999, 99999, 8250, 0, 7) +
      ascc_row(1.6, 10, 0, 0, 9000, 99999, 0, 0) + ascc_row(1.7, 10, 0, 0, 99999, 99999, 0, 8));
  const ImportedCatalogue all = import_ascc({input});
  ASSERT_EQ(all.catalogue.stars.size(), 4u);
  const CatalogueStar sirius = star_of(all.catalogue, "HIP 32349");
  EXPECT_LT(arcseconds_from(sirius.direction, 101.287155, -16.716116), 0.01);
  EXPECT_NEAR(sirius.v, -1.44, 1e-6);
  EXPECT_NEAR(sirius.colour, 0.01, 1e-6);
  EXPECT_NEAR(sirius.pm_ra, -546.01, 1e-3);
  const CatalogueStar second = star_of(all.catalogue, "HD 7");
  EXPECT_EQ(second.colour, kNoColour);
  EXPECT_EQ(second.pm_dec, 0);
  EXPECT_TRUE(all.catalogue.stars[2].v_is_rough);
  EXPECT_EQ(all.catalogue.stars[3].v, kNoMagnitude);
  EXPECT_EQ(all.notes, std::vector<std::string>{"1 star without a magnitude, left out"});
}

TEST_F(Imports, AsccDamageIsToldWithItsLine) {
  const std::string good = ascc_row(1.5, 10, 0, 0, 9000, 8250, 0, 7);
  std::string bad = good;
  bad[85] = 'V';
  EXPECT_TRUE(
      complaint(import_ascc, good + bad).find("input:2: Vmag (bytes 84-88) must be a number") !=
      std::string::npos);
  EXPECT_TRUE(
      complaint(import_ascc, good + good.substr(0, 100)).find("input:2: a line has 177 to 210") !=
      std::string::npos);
  EXPECT_NE(complaint(import_ascc, ascc_row(1.5, 10, 0, 0, 9000, 50000, 0, 7)), "");
}

// ---- HYG ----

const std::string kHygHeader =
    "id,hip,hd,hr,gl,bf,proper,ra,dec,dist,pmra,pmdec,rv,mag,absmag,spect,ci,bayer,flam,con\n";

TEST_F(Imports, HygIsReadWithAndWithoutQuotesAndWithoutTheSun) {
  const std::string v3 =
      kHygHeader +
      "0,,,,,,Sol,0,0,0,0,0,0,-26.7,4.85,G2V,0.656,,,\n"
      "24378,24436,34085,1713,,19Bet "
      "Ori,Rigel,5.242298,-8.20164,264.5,1.87,-0.56,20.7,0.18,-6.9,B8Ia,-0.03,Bet,19,Ori\n"
      "60530,60718,108248,4730,,Alp1Cru,Acrux,12.443311,-63.099092,99.3,-35.37,-14.73,-11.2,0.77,-"
      "4.2,B0.5IV,,Alp-1,,Cru\n";
  std::string v4 = v3;
  for (const char* word : {"Sol", "Rigel", "Bet", "Ori", "Acrux", "Alp-1", "Cru"}) {
    for (std::size_t at = v4.find("," + std::string(word)); at != std::string::npos;
         at = v4.find("," + std::string(word), at + 3)) {
      const std::size_t after = at + 1 + std::strlen(word);
      if (v4[after] != ',' && v4[after] != '\n') continue;
      v4.insert(after, "\""), v4.insert(at + 1, "\"");
    }
  }
  ASSERT_NE(v3, v4);
  for (const std::string& text : {v3, v4}) {
    const ImportedCatalogue all = import_hyg({file(text)});
    ASSERT_EQ(all.catalogue.stars.size(), 2u);
    const CatalogueStar rigel = star_of(all.catalogue, "HIP 24436");
    EXPECT_LT(arcseconds_from(rigel.direction, 78.634467, -8.201638), 0.1);
    EXPECT_NEAR(rigel.v, 0.18, 1e-6);
    EXPECT_NEAR(rigel.colour, -0.03, 1e-6);
    EXPECT_NEAR(rigel.pm_ra, 1.87, 1e-6);
    EXPECT_EQ(star_of(all.catalogue, "HIP 60718").colour, kNoColour);
    ASSERT_EQ(all.catalogue.names.size(), 4u);
    EXPECT_EQ(all.catalogue.names[1].name, "beta Ori");
    EXPECT_EQ(all.catalogue.names[3].name, "alpha1 Cru");
    EXPECT_EQ(guess_format({folder_ / "input"})->name, "hyg");
  }
}

TEST_F(Imports, HygDamageIsToldWithItsLine) {
  const std::string row = "2,2,3,,,,,1.5,x10,1,0,0,0,6,4,,0.5,,,\n";
  EXPECT_TRUE(complaint(import_hyg, kHygHeader + row)
                  .ends_with("input:2: dec must be a number from -90 to 90, got 'x10'"));
  EXPECT_TRUE(complaint(import_hyg, kHygHeader + "2,2,3\n")
                  .ends_with("input:2: expected 20 columns, got 3"));
  EXPECT_TRUE(
      complaint(import_hyg, kHygHeader + "2,\"2,3\n").ends_with("input:2: a quote is left open"));
  EXPECT_TRUE(complaint(import_hyg, "a,b\n1,2\n").ends_with("input:1: the table has no column ra"));
  EXPECT_TRUE(complaint(import_hyg, "").ends_with("input: the file is empty"));
}

// ---- Stellarium: files made by the same description, level 0 ----

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

TEST_F(Imports, StellariumStarsStandInTheirZones) {
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
  EXPECT_EQ(star_id_name(star.id), "HIP 32349");
  EXPECT_NEAR(star.pm_ra, -600 / expected.stretch, 1e-4);
  EXPECT_EQ(guess_format({folder_ / "input"})->name, "stellarium");
}

TEST_F(Imports, StellariumBitFieldsAreUnpacked) {
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

TEST_F(Imports, StellariumDamageIsToldWithItsByte) {
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
  other = good, other[4] = 2;
  EXPECT_TRUE(complaint(import_stellarium, other).find("byte 4: stars of type 2") !=
              std::string::npos);
}

// ---- own tables ----

TEST_F(Imports, OwnTablesKeepNamesNumbersAndMotions) {
  const auto input = file(
      "# a comment\nhip,ra_deg,dec_deg,v_mag,b_v,name,designation,pm_ra_mas_yr,pm_dec_mas_yr\n"
      "32349,101.2872,-16.7161,-1.44,0.009,Sirius,alpha CMa,-546,-1223\n,10,20,5,,,,,\n");
  const RawCatalogue catalogue = import_csv({input}).catalogue;
  ASSERT_EQ(catalogue.stars.size(), 2u);
  EXPECT_EQ(star_id_name(catalogue.stars[0].id), "HIP 32349");
  EXPECT_EQ(catalogue.stars[0].pm_dec, -1223);
  EXPECT_EQ(catalogue.stars[1].colour, kNoColour);
  ASSERT_EQ(catalogue.names.size(), 2u);
  EXPECT_EQ(catalogue.names[1].name, "alpha CMa");
  EXPECT_EQ(guess_format({input})->name, "csv");
}

TEST_F(Imports, WhatBeginsLikeNothingKnownIsNotGuessed) {
  EXPECT_EQ(guess_format({file("Dear reader,\nthis is a letter.\n")}), nullptr);
  EXPECT_EQ(guess_format({file("")}), nullptr);
  EXPECT_EQ(guess_format({folder_}), nullptr);
  EXPECT_EQ(guess_format({kRows / "tyc2.dat"})->name, "tycho2");
  EXPECT_EQ(guess_format({kRows / "suppl_1.dat"})->name, "tycho2");
  EXPECT_EQ(guess_format({kRows / "stars.json"})->name, "d3-celestial");
}

TEST_F(Imports, JsonThatIsNoStarsIsToldWithItsByteOrFeature) {
  EXPECT_TRUE(complaint(import_d3_celestial, "{\"features\": [")
                  .ends_with(": this is no JSON, or not all of it"));
  EXPECT_TRUE(complaint(import_d3_celestial, "{\"features\": [").find("input: byte 15") !=
              std::string::npos);
  EXPECT_TRUE(complaint(import_d3_celestial, "{\"a\": 1}")
                  .ends_with("this is no list of stars (GeoJSON with features)"));
  EXPECT_TRUE(complaint(import_d3_celestial, "[]").ends_with("(GeoJSON with features)"));
  EXPECT_TRUE(complaint(import_d3_celestial, "{\"features\": [{\"id\": \"x\"}]}")
                  .find("features[0]: id ") != std::string::npos);
  EXPECT_TRUE(complaint(import_d3_celestial,
                        "{\"features\":[{\"id\":5,\"geometry\":{\"coordinates\":[1,2]},"
                        "\"properties\":{\"mag\":5,\"bv\":\"red\"}}]}")
                  .ends_with("features[0]: bv must be a number in quotes, or empty quotes"));
}

}  // namespace
}  // namespace domefall
