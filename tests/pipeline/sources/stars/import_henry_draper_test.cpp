// Rows laid out byte by byte as the ReadMe of III/135A says.  The J2000 places of the first test
// are those that the catalogue service publishes; their B1900 numbers are the ones in the
// catalogue.
#include <cstdio>

#include "pipeline/sources/stars/star_colour.h"
#include "tests/pipeline/sources/stars/importing.h"

namespace domefall {
namespace {

struct Row {
  int hd, ra_hours, ra_tenths;
  char sign;
  int degrees, minutes;
  const char *visual, *photographic, *type;
  char remark = ' ';
};

std::string text_of(const Row& r) {
  char line[64];
  std::snprintf(line, sizeof line, "%6d%-12s%2d%3d%c%2d%2d%c%5s%c%c%5s%c%-3s%2s%c\n", r.hd,
                "BD+00  123", r.ra_hours, r.ra_tenths, r.sign, r.degrees, r.minutes, '0', r.visual,
                ' ', '0', r.photographic, ' ', r.type, "10", r.remark);
  return line;
}

class HenryDraper : public Imports {
 protected:
  ImportedCatalogue read(const std::string& text) const {
    return import_henry_draper({file(text)});
  }
  CatalogueStar star(const Row& row) const { return read(text_of(row)).catalogue.stars.at(0); }
};

TEST_F(HenryDraper, PlacesOf1900AreTurnedTo2000) {
  struct Known {
    int hd, tenths;
    char sign;
    int minutes;
    double ra, dec;
  };
  for (const auto& [hd, tenths, sign, minutes, ra, dec] :
       {Known{18667, 550, '-', 9, 45.031103, 0.247934},
        Known{18496, 533, '+', 2, 44.607348, 0.434141},
        Known{18738, 556, '+', 37, 45.186327, 1.01356},
        Known{19043, 587, '+', 38, 45.961499, 1.024907}}) {
    const CatalogueStar found = star({hd, 2, tenths, sign, 0, minutes, " 8.00", " 8.00", "A0"});
    EXPECT_LT(arcseconds_from(found.direction, ra, dec), 1) << hd;
    EXPECT_NEAR(found.direction.v.length(), 1, 3e-16);
    EXPECT_EQ(found.id, henry_draper_id(hd));
  }
  // Sirius moved by 2.2 arcminutes in that century.
  const CatalogueStar sirius = star({48915, 6, 407, '-', 16, 35, "-1.58", "-1.58", "A0"});
  EXPECT_LT(arcseconds_from(sirius.direction, 101.287155, -16.716116), 180);
  EXPECT_NEAR(sirius.v, -1.58, 1e-6);
}

TEST_F(HenryDraper, CodesAreNotTakenForMagnitudes) {
  const ImportedCatalogue all =
      read(text_of({1, 0, 0, '+', 10, 0, "20.00", "20.00", "   "}) +           // a nebula
           text_of({2, 0, 10, '+', 10, 0, "50.00", "     ", "   "}) +          // a cluster
           text_of({174638, 18, 464, '+', 33, 15, "30.00", "30.00", "B2p"}) +  // beta Lyrae
           text_of({4, 0, 10, '+', 10, 0, "40.00", "     ", "Pec"}) +          // a nova
           text_of({5, 0, 10, '+', 10, 0, "     ", " 9.20", "K0 "}) +
           text_of({6, 0, 10, '+', 10, 0, " 8.20", " 9.20", "G5 ", 'D'}) +
           text_of({5, 0, 10, '+', 10, 0, " 8.20", " 9.20", "G5 "}) +
           text_of({194648, 20, 10, '+', 10, 0, " 8.20", " 9.20", "G5 "}));
  ASSERT_EQ(all.catalogue.stars.size(), 3u);
  EXPECT_EQ(all.catalogue.stars[0].v, kNoMagnitude);
  EXPECT_EQ(all.catalogue.stars[1].v, kNoMagnitude);
  EXPECT_NEAR(all.catalogue.stars[2].v, 9.2 - 1.07, 1e-5);  // photographic less the colour of K0
  const std::vector<std::string> notes{"1 row marked as deleted, left out",
                                       "2 rows repeating another number, left out",
                                       "2 rows of nebulae and clusters, left out",
                                       "2 stars without a magnitude (variables, novae, pairs), "
                                       "left out unless a correction gives one"};
  EXPECT_EQ(all.notes, notes);
}

TEST_F(HenryDraper, LinesMayHaveLostTheirTrailingBlanks) {
  const std::string row = text_of({7, 0, 10, '-', 10, 0, " 8.20", " 9.20", "G5 "});
  EXPECT_EQ(read(row.substr(0, 44) + "\n").catalogue.stars.size(), 1u);
  EXPECT_EQ(read(row.substr(0, 44) + "\r\n").catalogue.stars.size(), 1u);
}

TEST_F(HenryDraper, DamageIsToldWithItsLine) {
  const std::string good = text_of({7, 0, 10, '-', 10, 0, " 8.20", " 9.20", "G5 "});
  const std::string file = (folder_ / "input").string();
  std::string bad = good;
  bad[23] = 'x';
  EXPECT_EQ(complaint(import_henry_draper, good + bad),
            file + ":2: the sign of the declination (byte 24) must be + or -");
  bad = good;
  bad.replace(29, 5, " 8.x0");
  EXPECT_EQ(complaint(import_henry_draper, good + bad),
            file + ":2: Ptm (bytes 30-34) must be a number from -2 to 50, got '8.x0'");
  EXPECT_NE(
      complaint(import_henry_draper, text_of({7, 0, 10, '-', 90, 5, " 8.20", " 9.20", "G5 "})), "");
  EXPECT_NE(
      complaint(import_henry_draper, text_of({7, 0, 10, '-', 10, 5, "25.20", " 9.20", "G5 "})), "");
}

TEST(SpectralTypes, HaveTheColoursOfTheTable) {
  EXPECT_NEAR(colour_of_spectral_type("K0"), 1.07, 1e-6);
  EXPECT_NEAR(colour_of_spectral_type("G2"), 0.60 + 0.4 * 0.29, 1e-6);
  EXPECT_NEAR(colour_of_spectral_type("Mb"), 1.64, 1e-6);
  EXPECT_NEAR(colour_of_spectral_type("B5"), 15700, 1);
  EXPECT_NEAR(colour_of_spectral_type("Oe5"), 41400, 1);
  EXPECT_NEAR(colour_of_spectral_type("B8p"), 9700 * std::pow(15700 / 9700.0, 0.4), 1);
  for (const char* none : {"", "Pec", "Con", "?", "X5"})
    EXPECT_EQ(colour_of_spectral_type(none), kNoColour);
}

TEST(SpectralTypes, CoolSteadilyFromOToM) {
  double last = 1e9;
  for (const char letter : std::string("OBAFGKM"))
    for (char digit = letter == 'O' ? '5' : '0'; digit <= '9'; ++digit) {
      const double t = temperature_of(colour_of_spectral_type(std::string{letter, digit}));
      EXPECT_LE(t, last) << letter << digit;
      // No jump where temperatures give way to colours.
      if (letter != 'O') {
        EXPECT_GT(t, 0.8 * last) << letter << digit;
      }
      last = t;
    }
}

}  // namespace
}  // namespace domefall
