#include "pipeline/sky/import_text.h"
#include "pipeline/sky/importers.h"
#include "pipeline/sky/quoted_table.h"

namespace domefall {
namespace {

constexpr double kFastest = 1e5, kLastHip = 120416, kLastHd = 359083;

CatalogueStar read_star(const QuotedTable& row) {
  CatalogueStar star;
  star.direction = star_direction(row.required("ra_deg", 0, 360), row.required("dec_deg", -90, 90));
  star.v = static_cast<float>(row.required("v_mag", kBrightestV, kFaintestV));
  if (const auto b_v = row.number("b_v", kBluest, kReddest)) star.colour = colour_of_b_v(*b_v);
  star.pm_ra = static_cast<float>(row.number("pm_ra_mas_yr", -kFastest, kFastest).value_or(0));
  star.pm_dec = static_cast<float>(row.number("pm_dec_mas_yr", -kFastest, kFastest).value_or(0));
  star.hip = static_cast<std::uint32_t>(row.number("hip", 0, kLastHip).value_or(0));
  const auto hd = static_cast<std::uint32_t>(row.number("hd", 0, kLastHd).value_or(0));
  if (hd) star.id = henry_draper_id(hd);
  return star;
}

}  // namespace

ImportedCatalogue import_table(const Paths& inputs) {
  ImportedCatalogue out;
  RawCatalogue& catalogue = out.catalogue;
  for (const std::filesystem::path& input : inputs) {
    QuotedTable row(input, {"ra_deg", "dec_deg", "v_mag", "b_v"});
    while (row.next()) {
      const auto place = static_cast<std::uint32_t>(catalogue.stars.size());
      catalogue.stars.push_back(read_star(row));
      for (const char* column : {"name", "designation"})
        if (!row.text(column).empty())
          catalogue.names.push_back({place, std::string(row.text(column))});
    }
  }
  name_by_hipparcos(catalogue.stars);
  catalogue.text = {inputs.front().filename().string(), "as the table's", ""};
  return out;
}

}  // namespace domefall
