#include <array>

#include "pipeline/sky/import_text.h"
#include "pipeline/sky/importers.h"
#include "pipeline/sky/quoted_table.h"

namespace domefall {
namespace {

constexpr double kDegreesPerHour = 15, kFastest = 1e5, kLastHip = 120416, kLastHd = 359083;

// "Alp", "Alp-1", "Kap-2" and the constellation: "alpha CMa", "alpha1 Cru".
std::string bayer_name(std::string_view letter, std::string_view constellation) {
  static constexpr std::array<std::string_view, 24> kLetters{
      "alpha", "beta",  "gamma",  "delta",   "epsilon", "zeta", "eta",     "theta",
      "iota",  "kappa", "lambda", "mu",      "nu",      "xi",   "omicron", "pi",
      "rho",   "sigma", "tau",    "upsilon", "phi",     "chi",  "psi",     "omega"};
  const std::string_view start = letter.substr(0, letter.find('-'));
  if (start.size() < 2 || constellation.empty()) return "";
  for (const std::string_view full : kLetters) {
    std::string abbreviated(full.substr(0, start.size()));
    abbreviated[0] = static_cast<char>(abbreviated[0] - 'a' + 'A');
    if (abbreviated != start) continue;
    const std::size_t dash = letter.find('-');
    const std::string_view index = dash == std::string_view::npos ? "" : letter.substr(dash + 1);
    return std::string(full) + std::string(index) + " " + std::string(constellation);
  }
  return "";
}

CatalogueStar read_star(const QuotedTable& row) {
  CatalogueStar star;
  star.direction =
      star_direction(row.required("ra", 0, 24) * kDegreesPerHour, row.required("dec", -90, 90));
  star.v = static_cast<float>(row.required("mag", kBrightestV, kFaintestV));
  if (const auto b_v = row.number("ci", -kReddest, kReddest)) star.colour = colour_of_b_v(*b_v);
  star.pm_ra = static_cast<float>(row.number("pmra", -kFastest, kFastest).value_or(0));
  star.pm_dec = static_cast<float>(row.number("pmdec", -kFastest, kFastest).value_or(0));
  star.hip = static_cast<std::uint32_t>(row.number("hip", 0, kLastHip).value_or(0));
  const auto hd = static_cast<std::uint32_t>(row.number("hd", 0, kLastHd).value_or(0));
  if (hd) star.id = henry_draper_id(hd);
  return star;
}

}  // namespace

ImportedCatalogue import_hyg(const Paths& inputs) {
  ImportedCatalogue out;
  RawCatalogue& catalogue = out.catalogue;
  for (const std::filesystem::path& input : inputs) {
    QuotedTable row(input, {"ra", "dec", "mag", "ci"});
    while (row.next()) {
      const std::string_view proper = row.text("proper");
      if (proper == "Sol") {
        out.notes.emplace_back("the sun left out");
        continue;
      }
      const auto place = static_cast<std::uint32_t>(catalogue.stars.size());
      catalogue.stars.push_back(read_star(row));
      if (!proper.empty()) catalogue.names.push_back({place, std::string(proper)});
      const std::string bayer = bayer_name(row.text("bayer"), row.text("con"));
      if (!bayer.empty()) catalogue.names.push_back({place, bayer});
    }
  }
  name_by_hipparcos(catalogue.stars);
  catalogue.text = {"HYG database (D. Nash, astronexus.com), from Hipparcos, Yale and Gliese",
                    "CC BY-SA 2.5 (versions 2 and 3) or 4.0 (version 4)", ""};
  return out;
}

}  // namespace domefall
