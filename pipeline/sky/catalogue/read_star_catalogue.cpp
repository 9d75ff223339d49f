#include "pipeline/sky/catalogue/read_star_catalogue.h"

#include <algorithm>
#include <cmath>

#include "pipeline/image/csv_file.h"
#include "pipeline/image/regular_file.h"
#include "pipeline/sky/catalogue/proper_motion.h"
#include "pipeline/sky/catalogue/star_colour.h"
#include "pipeline/sky/catalogue/star_file.h"
#include "pipeline/sky/catalogue/star_file_layout.h"
#include "trajectories/equatorial.h"

namespace domefall {
namespace {

// Says whether a number lies in one of the three ranges of star_colour.h.
bool is_colour(float colour) {
  return (colour >= kBluest && colour <= kReddest) || colour == kNoColour ||
         (colour >= kColdest && colour <= kHottest);
}

// Says whether the numbers of a record, whose vector has this squared length, can be those of a
// star.
bool is_star(const StarRecord& r, double length2) {
  // Rounding to 2^-31 changes the square of a unit vector's length by at most 2e-9.
  constexpr double kLengthTolerance = 1e-8;
  return std::abs(length2 - 1) < kLengthTolerance && r.v >= kBrightestV && r.v <= kFaintestV &&
         is_colour(r.colour) && std::isfinite(r.pm_ra) && std::isfinite(r.pm_dec);
}

// Returns the direction of the row's star in that year.
SkyDirection direction_in_row(const CsvFile& row, double epoch) {
  const double ra = row.required("ra_deg", 0, 360), dec = row.required("dec_deg", -90, 90);
  const double pm_ra = row.number("pm_ra_mas_yr", -kFastest, kFastest).value_or(0);
  const double pm_dec = row.number("pm_dec_mas_yr", -kFastest, kFastest).value_or(0);
  SkyDirection direction = sky_direction(ra, dec);
  if (epoch == kCatalogueEpoch || (pm_ra == 0 && pm_dec == 0)) return direction;
  return moved(direction, pm_ra, pm_dec, epoch - kCatalogueEpoch);
}

StarCatalogue read_table(const std::filesystem::path& file, double max_magnitude, double epoch) {
  CsvFile row(file, {"ra_deg", "dec_deg", "v_mag", "b_v"});
  StarCatalogue catalogue;
  while (row.next()) {
    const SkyDirection direction = direction_in_row(row, epoch);
    const double v = row.required("v_mag", kBrightestV, kFaintestV);
    const double b_v = row.number("b_v", kBluest, kReddest).value_or(kAssumedColour);
    for (const char* column : {"name", "designation"})
      if (const std::string_view name = row.text(column); !name.empty())
        catalogue.names.push_back({std::string(name), direction});
    if (v <= max_magnitude)
      catalogue.stars.push_back(
          {direction, static_cast<float>(v), static_cast<float>(temperature_from_b_v(b_v))});
  }
  std::stable_sort(catalogue.stars.begin(), catalogue.stars.end(),
                   [](const Star& a, const Star& b) { return a.v_magnitude < b.v_magnitude; });
  return catalogue;
}

bool begins_as_star_file(const std::filesystem::path& file) {
  return is_of_format(file, {kStarMagic.data(), kStarMagic.size()}, kStarExtension,
                      sizeof(StarFileHeader));
}

}  // namespace

StarCatalogue stars_of(const StarFile& file, double max_magnitude, double epoch) {
  const auto records = file.up_to(max_magnitude);
  const double years = epoch - file.epoch();
  StarCatalogue catalogue;
  catalogue.stars.reserve(records.size());
  for (const StarRecord& r : records) {
    const V3d v(r.x / kUnitLength, r.y / kUnitLength, r.z / kUnitLength);
    const double length2 = v.x * v.x + v.y * v.y + v.z * v.z;
    if (!is_star(r, length2)) file.fail_at(r, "this record is no star");
    // The length differs from 1 by the rounding of the components.
    SkyDirection direction{v / std::sqrt(length2)};
    // Moving a star by nothing would take time and could change its last digits.
    if (years != 0 && (r.pm_ra != 0 || r.pm_dec != 0))
      direction = moved(direction, r.pm_ra, r.pm_dec, years);
    catalogue.stars.push_back({direction, r.v, static_cast<float>(temperature_of(r.colour))});
  }
  for (StarName& name : file.names(records.size()))
    catalogue.names.push_back({std::move(name.name), catalogue.stars[name.star].direction});
  return catalogue;
}

StarCatalogue read_star_catalogue(const std::filesystem::path& file, double max_magnitude,
                                  double epoch) {
  if (begins_as_star_file(file)) return stars_of(StarFile(file), max_magnitude, epoch);
  return read_table(file, max_magnitude, epoch);
}

std::optional<std::string> star_file_fingerprint(const std::filesystem::path& file) {
  if (!begins_as_star_file(file)) return std::nullopt;
  return StarFile(file).fingerprint();
}

std::optional<double> star_file_faintest(const std::filesystem::path& file) {
  if (!begins_as_star_file(file)) return std::nullopt;
  return StarFile(file).faintest();
}

std::optional<std::size_t> star_file_count(const std::filesystem::path& file,
                                           double max_magnitude) {
  if (!begins_as_star_file(file)) return std::nullopt;
  return StarFile(file).at_least_to(max_magnitude);
}

}  // namespace domefall
