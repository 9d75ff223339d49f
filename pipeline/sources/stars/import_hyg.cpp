#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <memory>
#include <utility>

#include "pipeline/base/talk.h"
#include "pipeline/sources/stars/catalogue_formats.h"
#include "pipeline/sources/stars/catalogue_rows.h"

namespace domefall {
namespace {

// The table gives right ascension in hours, of 15 degrees each.  Versions differ in how they call
// the motions.
StarColumns columns_of(const CsvFile& row) {
  const bool joined = row.has("pmra");
  return {"ra", "dec",    "mag", "ci", joined ? "pmra" : "pm_ra", joined ? "pmdec" : "pm_dec",
          15,   -kReddest};
}

// Returns "alpha CMa" for "Alp" and "CMa", "alpha1 Cru" for "Alp-1" or "Alp1" and "Cru".
std::string bayer_name(std::string_view letter, std::string_view constellation) {
  // The first name that begins with an abbreviation is taken, in the order of the alphabet.
  static constexpr std::array<std::string_view, 24> kLetters{
      "alpha", "beta",  "gamma",  "delta",   "epsilon", "zeta", "eta",     "theta",
      "iota",  "kappa", "lambda", "mu",      "nu",      "xi",   "omicron", "pi",
      "rho",   "sigma", "tau",    "upsilon", "phi",     "chi",  "psi",     "omega"};
  const std::size_t end = std::min(letter.find_first_of("-0123456789"), letter.size());
  const std::string_view start = letter.substr(0, end);
  // The shortest names of Greek letters (mu, nu, xi and pi) have two letters.
  if (start.size() < 2 || constellation.empty()) return "";
  for (const std::string_view full : kLetters) {
    // The table has only the beginning of a letter's name, with a capital.
    std::string abbreviated(full.substr(0, start.size()));
    abbreviated[0] = static_cast<char>(abbreviated[0] - 'a' + 'A');
    if (abbreviated != start) continue;
    const bool dash = letter.substr(end).starts_with('-');
    const std::string_view index = letter.substr(end + (dash ? 1 : 0));
    return fmt::format("{}{} {}", full, index, constellation);
  }
  return "";
}

struct TychoCounts {
  std::size_t converted = 0, rough = 0;
};

// Says whether `mag` is VT and `ci` BT - VT, as AT-HYG has it of most stars ("TYC" in version 1).
bool is_of_tycho(const CsvFile& row) {
  const std::string_view source = row.text("mag_src");
  return source == "T" || source == "TYC";
}

// Turns VT and BT - VT into V and B-V as note 7 of Tycho-2's ReadMe does (catalogue_formats.h).
void convert_from_tycho(const CsvFile& row, CatalogueStar& star, TychoCounts& counts) {
  const auto bt_vt = row.number("ci", -kReddest, kReddest);
  star.v_is_rough = !bt_vt;
  ++(bt_vt ? counts.converted : counts.rough);
  if (!bt_vt) return;
  const double v = row.required("mag", kBrightestV, kFaintestV) - 0.090 * *bt_vt;
  if (v < kBrightestV || v > kFaintestV) row.fail("mag and ci are beyond those of a star");
  star.v = static_cast<float>(v);
  star.colour = colour_of_b_v(0.850 * *bt_vt);
}

CatalogueStar read_hyg_row(const CsvFile& row, const StarColumns& columns, TychoCounts& counts) {
  CatalogueStar star = read_star_row(row, columns);
  if (is_of_tycho(row)) convert_from_tycho(row, star, counts);
  if (const auto tycho = parse_star_id("TYC " + std::string(row.text("tyc"))); tycho && !star.id)
    star.id = *tycho;
  return star;
}

std::vector<std::string> notes_of(std::size_t suns, const TychoCounts& counts) {
  std::vector<std::string> notes;
  if (suns) notes.emplace_back("the sun left out");
  if (counts.converted)
    notes.push_back(counted(counts.converted, "star") +
                    " with V = VT - 0.090 (BT - VT) and B-V = 0.850 (BT - VT) of Tycho-2");
  if (counts.rough)
    notes.push_back(counted(counts.rough, "star") + " of Tycho-2 with VT for V, without a colour");
  return notes;
}

}  // namespace

ImportedCatalogue import_hyg(const Paths& inputs) {
  ImportedCatalogue out;
  RawCatalogue& catalogue = out.catalogue;
  std::unique_ptr<CsvFile> first;
  std::size_t suns = 0;
  TychoCounts counts;
  for (const std::filesystem::path& input : inputs) {
    const std::vector<std::string_view> needed{"ra", "dec", "mag"};
    auto part = std::make_unique<CsvFile>(input, needed, first.get());
    CsvFile& row = *part;
    const StarColumns columns = columns_of(row);
    while (row.next()) {
      const std::string_view proper = row.text("proper");
      // The table has the sun, too, which has no place among the stars of a sky.
      if (proper == "Sol") {
        ++suns;
        continue;
      }
      const auto place = static_cast<std::uint32_t>(catalogue.stars.size());
      catalogue.stars.push_back(read_hyg_row(row, columns, counts));
      if (!proper.empty()) catalogue.names.push_back({place, std::string(proper)});
      const std::string bayer = bayer_name(row.text("bayer"), row.text("con"));
      if (!bayer.empty()) catalogue.names.push_back({place, bayer});
    }
    if (!first) first = std::move(part);
  }
  identify_by_hipparcos(catalogue.stars);
  out.notes = notes_of(suns, counts);
  catalogue.text = {first->has("tyc")
                        ? "AT-HYG (D. Nash, astronexus.com), from Tycho-2, Gaia DR3 and HYG"
                        : "HYG database (D. Nash, astronexus.com), from Hipparcos, Yale and Gliese",
                    first->has("tyc") ? "CC BY-SA 2.5 (versions 1 and 2) or 4.0 (from version 3 on)"
                                      : "CC BY-SA 2.5 (versions 2 and 3) or 4.0 (version 4)",
                    ""};
  return out;
}

}  // namespace domefall
