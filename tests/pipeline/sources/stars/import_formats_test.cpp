// ASCC-2.5, HYG and Domefall's own tables.
#include <cstdio>

#include "tests/pipeline/sources/stars/importing.h"

namespace domefall {
namespace {

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

// ---- AT-HYG: rows as published ----

const std::string kAtHygHeader =
    "id,tyc,gaia,hyg,hip,hd,hr,gl,bayer,flam,con,proper,ra,dec,pos_src,dist,x0,y0,z0,dist_src,mag,"
    "absmag,ci,mag_src,rv,rv_src,pm_ra,pm_dec,pm_src,vx,vy,vz,spect,spect_src\n";
const std::string kAtHygSun =
    "1,,,0,,,,,,,,Sol,0.0,0.0,OTHER,4.85e-06,4.85e-06,0.0,0.0,OTHER,-26.74,4.831,,OTHER,0.0,OTHER,"
    "0."
    "0,0.0,OTHER,0.0,0.0,0.0,G2 V,OTHER\n";
const std::string kAtHygTycho =
    "2,4669-731-1,2443095153084654208,,,224701,,,,,Psc,,2.263e-05,-5.49436227,T,509.1956,506.8562,"
    "0."
    "003,-48.7544,G_R3,9.239,0.705,1.117,T,-17.371,G_R3,22.5,-11.3,G_R3,-19.9,54.31,-25.49,G8 "
    "IV,T\n";
const std::string kAtHygHip =
    "71681,,,71454,71681,128620,5459,559A,Alp1,,Cen,Rigil Kentaurus,14.66,-60.83,H,1.3248,-0.4967,-"
    "0.4227,-1.1522,H,-0.01,4.38,0.71,H,-21.4,H,-3679.25,473.67,H,-29.29,1.71,13.99,G2 V,H\n";
const std::string kAtHygRough = "9,12-34-1,,,,,,,,,Psc,,3.5,-5.5,T,,,,,N,11.5,,,T,,N,,,N,,,,,N\n";

void expect_at_hyg(const ImportedCatalogue& all) {
  ASSERT_EQ(all.catalogue.stars.size(), 3u);
  const CatalogueStar tycho = star_of(all.catalogue, "HD 224701");
  EXPECT_NEAR(tycho.v, 9.239 - 0.090 * 1.117, 1e-6);
  EXPECT_NEAR(tycho.colour, 0.850 * 1.117, 1e-6);
  EXPECT_NEAR(tycho.pm_ra, 22.5, 1e-6);
  EXPECT_FALSE(tycho.v_is_rough);
  const CatalogueStar hipparcos = star_of(all.catalogue, "HIP 71681");
  EXPECT_NEAR(hipparcos.v, -0.01, 1e-6);
  EXPECT_NEAR(hipparcos.colour, 0.71, 1e-6);
  EXPECT_NEAR(hipparcos.pm_dec, 473.67, 1e-3);
  const CatalogueStar rough = star_of(all.catalogue, "TYC 12-34-1");
  EXPECT_NEAR(rough.v, 11.5, 1e-6);
  EXPECT_EQ(rough.colour, kNoColour);
  EXPECT_TRUE(rough.v_is_rough);
  ASSERT_EQ(all.catalogue.names.size(), 2u);
  EXPECT_EQ(all.catalogue.names[1].name, "alpha1 Cen");
  EXPECT_EQ(all.notes,
            (std::vector<std::string>{
                "the sun left out",
                "1 star with V = VT - 0.090 (BT - VT) and B-V = 0.850 (BT - VT) of Tycho-2",
                "1 star of Tycho-2 with VT for V, without a colour"}));
}

TEST_F(Imports, AtHygHasTheBandsOfTychoWhereItSaysSo) {
  const std::string rows = kAtHygSun + kAtHygTycho + kAtHygHip + kAtHygRough;
  std::string version4 = kAtHygHeader;  // calls the motions as HYG does
  for (const char* name : {"pm_ra", "pm_dec"}) version4.erase(version4.find(name) + 2, 1);
  for (const std::string& header : {kAtHygHeader, version4, "\xEF\xBB\xBF" + kAtHygHeader}) {
    expect_at_hyg(import_hyg({file(header + rows)}));
    ASSERT_NE(guess_format({folder_ / "input"}), nullptr);
    EXPECT_EQ(guess_format({folder_ / "input"})->name, "hyg");
  }
}

TEST_F(Imports, AtHygComesInTwoParts) {
  put(folder_ / "1", kAtHygHeader + kAtHygSun + kAtHygTycho);
  for (const std::string& header : {std::string(), kAtHygHeader}) {
    put(folder_ / "2", header + kAtHygHip + kAtHygRough);
    expect_at_hyg(import_hyg({folder_ / "1", folder_ / "2"}));
    // They may also have been joined.
    expect_at_hyg(import_hyg({file(contents(folder_ / "1") + contents(folder_ / "2"))}));
  }
  EXPECT_TRUE(complaint(import_hyg, kAtHygHip + kAtHygRough)
                  .ends_with("input:1: the table has no column ra; its first line has numbers, so "
                             "name the part with the header line before it"));
}

TEST_F(Imports, HygDamageIsToldWithItsLine) {
  const std::string row = "2,2,3,,,,,1.5,x10,1,0,0,0,6,4,,0.5,,,\n";
  EXPECT_TRUE(complaint(import_hyg, kHygHeader + row)
                  .ends_with("input:2: dec must be a number from -90 to 90, got 'x10'"));
  EXPECT_TRUE(complaint(import_hyg, "a,b\n1,2\n").ends_with("input:1: the table has no column ra"));
}

// ---- own tables ----

TEST_F(Imports, OwnTablesKeepNamesNumbersAndMotions) {
  const auto input = file(
      "# a comment\nhip,ra_deg,dec_deg,v_mag,b_v,name,designation,pm_ra_mas_yr,pm_dec_mas_yr\n"
      "32349,101.2872,-16.7161,-1.44,0.009,Sirius,alpha CMa,-546,-1223\n,10,20,5,,,,,\n");
  const RawCatalogue catalogue = import_csv({input}).catalogue;
  ASSERT_EQ(catalogue.stars.size(), 2u);
  EXPECT_EQ(catalogue.stars[0].id, hipparcos_id(32349));
  EXPECT_EQ(catalogue.stars[0].pm_dec, -1223);
  EXPECT_EQ(catalogue.stars[1].colour, kNoColour);
  ASSERT_EQ(catalogue.names.size(), 2u);
  EXPECT_EQ(catalogue.names[1].name, "alpha CMa");
  EXPECT_EQ(guess_format({input})->name, "csv");
}

TEST_F(Imports, AMarkSpacesAndCapitalsDoNotHideTheFormat) {
  const std::string mark = "\xEF\xBB\xBF";
  const auto guess = [&](const std::string& text) {
    const CatalogueFormat* format = guess_format({file(text)});
    return format ? std::string(format->name) : "none";
  };
  EXPECT_EQ(guess(mark + kHygHeader), "hyg");
  EXPECT_EQ(guess(mark + "# a table\r\n\r\nRA_deg\tDEC_deg\tV_mag\tb_v\r\n"), "csv");
  EXPECT_EQ(guess("\"ra_deg\";\"dec_deg\";\"v_mag\";\"b_v\"\n"), "csv");
  EXPECT_EQ(guess(mark + "\n {\"type\": 1}"), "d3-celestial");
  using namespace std::string_literals;
  EXPECT_EQ(guess("\xFF\xFE{\0}\0"s), "d3-celestial");
  EXPECT_EQ(guess("star,ra_deg,dec_deg,v_mag\n"), "none");
  // Lines of 48 bytes are not all of the Henry Draper Catalogue.
  EXPECT_EQ(guess("ra_deg,dec_deg,v_mag,b_v,a_remark_of_48_bytes_in\n"), "csv");
}

TEST_F(Imports, JsonIsReadPastAMarkAndNullIsNoColour) {
  const std::string json =
      "{\"features\":[{\"id\":5,\"geometry\":{\"coordinates\":[1,2]},\"properties\":{\"mag\":5,"
      "\"bv\":null}}]}";
  EXPECT_EQ(import_d3_celestial({file("\xEF\xBB\xBF" + json)}).catalogue.stars.at(0).colour,
            kNoColour);
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
