// Files with bytes changed, cut out and doubled: each gives stars that can be written and read, or
// an InputError.
#include <random>

#include "pipeline/base/errors.h"
#include "pipeline/sources/stars/amend_catalogue.h"
#include "pipeline/sources/stars/catalogue_formats.h"
#include "pipeline/sources/stars/star_catalogue.h"
#include "pipeline/sources/stars/star_file.h"
#include "tests/pipeline/image/test_folder.h"
#include "tests/pipeline/sources/stars/importing.h"

namespace domefall {
namespace {

constexpr int kTries = 400;

std::string mutated(std::string text, std::mt19937& random) {
  const auto place = [&] { return random() % (text.size() + 1); };
  for (unsigned i = 0, n = 1 + random() % 4; i < n && !text.empty(); ++i) {
    const std::size_t at = random() % text.size();
    switch (random() % 6) {
      case 0:
        text[at] = static_cast<char>(random());
        break;
      case 1:
        text[at] = "0123456789.-+|,\"{}[] \n"[random() % 22];
        break;
      case 2:
        text.erase(at, random() % 30);
        break;
      case 3:
        text.insert(place(), text.substr(at, random() % 60));
        break;
      case 4:
        text.resize(at);
        break;
      default:
        text.insert(place(), "nan");
    }
  }
  return text;
}

class Fuzz : public TestFolder {
 protected:
  // How often it was read; the rest were refused.
  template <class Reading>
  int survive(const std::string& text, Reading read) {
    std::mt19937 random(3);
    int accepted = 0;
    const auto file = folder_ / "mutated";
    for (int i = 0; i < kTries; ++i) {
      put(file, mutated(text, random));
      try {
        RawCatalogue catalogue = read(file);
        keep_brighter(catalogue, kFaintestV);
        sort_by_brightness(catalogue);
        // Writing waits for the disk; every one would take half a minute on a busy machine.
        if (accepted++ % 16 != 0) continue;
        write_star_file(folder_ / "out.stars", catalogue);
        const StarCatalogue back = read_star_catalogue(folder_ / "out.stars", kFaintestV, 2100);
        EXPECT_EQ(back.stars.size(), catalogue.stars.size());
      } catch (const InputError& error) {
        EXPECT_NE(std::string(error.what()).find(folder_.string()), std::string::npos);
      }
    }
    return accepted;
  }

  int survive_import(const std::string& text, const char* name) {
    for (const CatalogueFormat& format : catalogue_formats())
      if (format.name == name)
        return survive(text, [&](const auto& file) { return format.import({file}).catalogue; });
    return -1;
  }
};

TEST_F(Fuzz, Tycho2) {
  EXPECT_GT(survive_import(contents(kRows / "tyc2.dat"), "tycho2"), 5);
  EXPECT_GT(survive_import(contents(kRows / "suppl_1.dat"), "tycho2"), 5);
}

TEST_F(Fuzz, D3CelestialAndItsNames) {
  EXPECT_GT(survive_import(contents(kRows / "stars.json"), "d3-celestial"), 5);
  const RawCatalogue stars = import_d3_celestial({kRows / "stars.json"}).catalogue;
  EXPECT_GT(survive(contents(kRows / "starnames.json"),
                    [&](const auto& file) {
                      RawCatalogue named = stars;
                      add_names(named, file);
                      return named;
                    }),
            5);
}

TEST_F(Fuzz, OtherCatalogues) {
  std::string ascc(210, ' ');
  ascc.replace(0, 12, " 6.752569403"), ascc.replace(13, 12, "-16.71314306");
  ascc.replace(49, 7, " -54601"), ascc.replace(57, 7, "-122308");
  ascc.replace(77, 5, "-1430"), ascc.replace(83, 5, "-1440"), ascc.replace(147, 6, " 32349");
  // Three stars in a zone of Stellarium's, 20 zones to version 24 and 21 of Gaia's.
  const auto stellarium = [](const std::string& head, int zones, const std::string& records) {
    std::string file = head;
    for (int zone = 0; zone < zones; ++zone)
      file += std::string(zone == 4 ? "\x03\0\0\0" : "\0\0\0\0", 4);
    return file + records;
  };
  const std::string start("\x0a\x04\x5f\x83\x01\0\0\0\0\0\0\0\x04\0\0\0\0\0\0\0\x04\x29\0\0", 24);
  const std::pair<const char*, std::string> files[] = {
      {"hd",
       "174638BD+33 3223  18464+3315030.00 030.00 B2p10 \n"
       "172167BD+38 3238  18336+38410 0.14 0 0.14 A0  9 \n"},
      {"ascc", ascc + "\n" + ascc + "\n"},
      {"hyg",
       "id,hip,hd,proper,ra,dec,pmra,pmdec,mag,ci,bayer,con\n"
       "1,24436,34085,\"Rigel\",5.242298,-8.20164,1.87,-0.56,0.18,-0.03,Bet,Ori\n"
       "2,,,,1,2,0,0,9,,,\n"},
      {"csv",
       "hip,ra_deg,dec_deg,v_mag,b_v,name\n32349,101.2872,-16.7161,-1.44,0.009,Sirius\n"
       "5,10,20,5,,\n"},
      {"stellarium",
       stellarium(start + std::string("\x40\x06\0\0\x20\0\0\0", 8), 20, std::string(30, 'Q'))},
      {"stellarium", stellarium(start + "\xb4\xfc\x15\x4a", 21, std::string(96, '\3'))},
  };
  for (const auto& [name, file] : files) EXPECT_GT(survive_import(file, name), 5) << name;
}

TEST_F(Fuzz, Corrections) {
  const RawCatalogue stars = import_d3_celestial({kRows / "stars.json"}).catalogue;
  EXPECT_GT(
      survive("star,action,v_mag,b_v,ra_deg,dec_deg\nHIP 32349,,-1.4,0.1,,\nHIP 55203,remove,,,,\n"
              "New,add,5,,10,20\n",
              [&](const auto& file) {
                RawCatalogue corrected = stars;
                apply_corrections(corrected, file);
                return corrected;
              }),
      5);
}

}  // namespace
}  // namespace domefall
