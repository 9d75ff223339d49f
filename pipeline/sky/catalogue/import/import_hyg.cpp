#include <fmt/format.h>

#include <array>

#include "pipeline/sky/catalogue/import/catalogue_formats.h"
#include "pipeline/sky/catalogue/import/star_row.h"

namespace domefall {
namespace {

// The table gives right ascension in hours, of 15 degrees each.
constexpr StarColumns kColumns{"ra", "dec", "mag", "ci", "pmra", "pmdec", 15, -kReddest};

// Returns "alpha CMa" for "Alp" and "CMa", "alpha1 Cru" for "Alp-1" and "Cru".
std::string bayer_name(std::string_view letter, std::string_view constellation) {
  // The first name that begins with an abbreviation is taken, in the order of the alphabet.
  static constexpr std::array<std::string_view, 24> kLetters{
      "alpha", "beta",  "gamma",  "delta",   "epsilon", "zeta", "eta",     "theta",
      "iota",  "kappa", "lambda", "mu",      "nu",      "xi",   "omicron", "pi",
      "rho",   "sigma", "tau",    "upsilon", "phi",     "chi",  "psi",     "omega"};
  const std::string_view start = letter.substr(0, letter.find('-'));
  // The shortest names of Greek letters (mu, nu, xi and pi) have two letters.
  if (start.size() < 2 || constellation.empty()) return "";
  for (const std::string_view full : kLetters) {
    // The table has only the beginning of a letter's name, with a capital.
    std::string abbreviated(full.substr(0, start.size()));
    abbreviated[0] = static_cast<char>(abbreviated[0] - 'a' + 'A');
    if (abbreviated != start) continue;
    const std::size_t dash = letter.find('-');
    const std::string_view index = dash == std::string_view::npos ? "" : letter.substr(dash + 1);
    return fmt::format("{}{} {}", full, index, constellation);
  }
  return "";
}

}  // namespace

ImportedCatalogue import_hyg(const Paths& inputs) {
  ImportedCatalogue out;
  RawCatalogue& catalogue = out.catalogue;
  for (const std::filesystem::path& input : inputs) {
    // The other columns may be missing, and are empty then.
    CsvFile row(input, {"ra", "dec", "mag", "ci"});
    while (row.next()) {
      const std::string_view proper = row.text("proper");
      // The table has the sun, too, which has no place among the stars of a sky.
      if (proper == "Sol") {
        out.notes.emplace_back("the sun left out");
        continue;
      }
      const auto place = static_cast<std::uint32_t>(catalogue.stars.size());
      catalogue.stars.push_back(read_star_row(row, kColumns));
      if (!proper.empty()) catalogue.names.push_back({place, std::string(proper)});
      const std::string bayer = bayer_name(row.text("bayer"), row.text("con"));
      if (!bayer.empty()) catalogue.names.push_back({place, bayer});
    }
  }
  identify_by_hipparcos(catalogue.stars);
  catalogue.text = {"HYG database (D. Nash, astronexus.com), from Hipparcos, Yale and Gliese",
                    "CC BY-SA 2.5 (versions 2 and 3) or 4.0 (version 4)", ""};
  return out;
}

}  // namespace domefall
