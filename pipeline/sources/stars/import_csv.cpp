#include "pipeline/sources/stars/catalogue_formats.h"
#include "pipeline/sources/stars/catalogue_rows.h"

namespace domefall {
namespace {

// The names are those of star_catalogue.h.  Right ascension is in degrees, and B-V may have
// any value that star_colour.h has.
constexpr StarColumns kColumns{"ra_deg",       "dec_deg",       "v_mag", "b_v",
                               "pm_ra_mas_yr", "pm_dec_mas_yr", 1,       kBluest};

}  // namespace

ImportedCatalogue import_csv(const Paths& inputs) {
  ImportedCatalogue out;
  RawCatalogue& catalogue = out.catalogue;
  for (const std::filesystem::path& input : inputs) {
    CsvFile row(input, {"ra_deg", "dec_deg", "v_mag", "b_v"});
    while (row.next()) {
      // Names refer to a star by the index that it gets when it is appended.
      const auto place = static_cast<std::uint32_t>(catalogue.stars.size());
      catalogue.stars.push_back(read_star_row(row, kColumns));
      for (const char* column : {"name", "designation"})
        if (!row.text(column).empty())
          catalogue.names.push_back({place, std::string(row.text(column))});
    }
  }
  identify_by_hipparcos(catalogue.stars);
  // Of several tables the first gives its name to the catalogue.
  catalogue.text = {inputs.front().filename().string(), "as the table's", ""};
  return out;
}

}  // namespace domefall
