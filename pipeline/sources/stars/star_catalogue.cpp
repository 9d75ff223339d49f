#include "pipeline/sources/stars/star_catalogue.h"

#include <algorithm>
#include <cmath>

#include "pipeline/base/csv_file.h"
#include "pipeline/base/regular_file.h"
#include "pipeline/base/utf8.h"
#include "pipeline/sources/stars/raw_catalogue.h"
#include "pipeline/sources/stars/star_colour.h"
#include "pipeline/sources/stars/star_file.h"
#include "trajectories/equatorial.h"

namespace domefall {
namespace {

// Says whether a number lies in one of the three ranges of star_colour.h.
bool is_colour(float colour) {
  return (colour >= kBluest && colour <= kReddest) || colour == kNoColour ||
         (colour >= kColdest && colour <= kHottest);
}

// Returns the direction of a record, which has a length of 1 to rounding.
V3d vector_of(const StarRecord& r) {
  return {r.x / kUnitLength, r.y / kUnitLength, r.z / kUnitLength};
}

bool is_star(const StarRecord& r) {
  // Rounding to 2^-31 changes the square of a unit vector's length by at most 2e-9.
  constexpr double kLengthTolerance = 1e-8;
  return std::abs(vector_of(r).length2() - 1) < kLengthTolerance && r.v >= kBrightestV &&
         r.v <= kFaintestV && is_colour(r.colour) && std::isfinite(r.pm_ra) &&
         std::isfinite(r.pm_dec);
}

SkyDirection direction_of(const StarRecord& r, double years) {
  const V3d v = vector_of(r);
  // The length differs from 1 by the rounding of the components.
  SkyDirection direction{v / std::sqrt(v.length2())};
  // Moving a star by nothing would take time and could change its last digits.
  if (years == 0 || (r.pm_ra == 0 && r.pm_dec == 0)) return direction;
  return moved(direction, r.pm_ra, r.pm_dec, years);
}

SkyDirection direction_in_row(const CsvFile& row, double epoch) {
  const double ra = row.required("ra_deg", 0, 360), dec = row.required("dec_deg", -90, 90);
  const double pm_ra = row.number("pm_ra_mas_yr", -kFastest, kFastest).value_or(0);
  const double pm_dec = row.number("pm_dec_mas_yr", -kFastest, kFastest).value_or(0);
  SkyDirection direction = sky_direction(ra, dec);
  if (epoch == kCatalogueEpoch || (pm_ra == 0 && pm_dec == 0)) return direction;
  return moved(direction, pm_ra, pm_dec, epoch - kCatalogueEpoch);
}

// Returns the stars of a table.  Every row is read as a whole, so that a damaged one is reported
// whatever the limit is.
StarCatalogue read_table(const std::filesystem::path& file, double max_magnitude, double epoch,
                         std::size_t whole) {
  CsvFile row(file, {"ra_deg", "dec_deg", "v_mag", "b_v"});
  std::vector<Star> stars;
  StarCatalogue catalogue;
  while (row.next()) {
    const SkyDirection direction = direction_in_row(row, epoch);
    const double v = row.required("v_mag", kBrightestV, kFaintestV);
    const double b_v = row.number("b_v", kBluest, kReddest).value_or(kAssumedColour);
    for (const char* column : {"name", "designation"})
      if (const std::string_view name = row.text(column); !name.empty())
        catalogue.names.push_back({std::string(name), direction});
    if (v <= max_magnitude)
      stars.push_back(
          {direction, static_cast<float>(v), static_cast<float>(temperature_from_b_v(b_v))});
  }
  sort_by_magnitude(stars);
  thin_out(stars.size(), whole, [&](std::size_t k, std::size_t count) {
    catalogue.stars.push_back(standing_for(stars[k], count));
  });
  // A star that stands for several is brighter than it was, and may now belong before others.
  sort_by_magnitude(catalogue.stars);
  return catalogue;
}

// Says whether a file is to be read as a .stars file, also one that is shorter than its header
// (is_of_format).
bool begins_as_star_file(const std::filesystem::path& file) {
  return is_of_format(file, {kStarMagic.data(), kStarMagic.size()}, kStarExtension,
                      sizeof(StarFileHeader));
}

}  // namespace

Star standing_for(Star star, std::size_t count) {
  // A factor in flux is -2.5 log10 of it in magnitudes, by Pogson's scale.
  star.v_magnitude -= static_cast<float>(2.5 * std::log10(static_cast<double>(count)));
  return star;
}

void sort_by_magnitude(std::vector<Star>& stars) {
  // Catalogues are sorted as a rule, so that the test saves time.
  if (!std::ranges::is_sorted(stars, {}, &Star::v_magnitude))
    std::ranges::stable_sort(stars, {}, &Star::v_magnitude);
}

std::string folded_star_name(std::string_view name) {
  std::string folded = in_lower_case(name);
  std::erase_if(folded, [](char c) { return c == ' ' || c == '_'; });
  return folded;
}

StarCatalogue stars_of(const StarFile& file, double max_magnitude, double epoch,
                       std::size_t whole) {
  const auto records = file.up_to(max_magnitude);
  // A record is refused wherever it is read, even if another star stands for it.
  for (const StarRecord& r : records)
    if (!is_star(r)) file.fail_at(r, "this record is no star");
  const double years = epoch - file.epoch();
  StarCatalogue catalogue;
  if (whole >= records.size()) catalogue.stars.reserve(records.size());
  thin_out(records.size(), whole, [&](std::size_t k, std::size_t count) {
    const StarRecord& r = records[k];
    catalogue.stars.push_back(
        {direction_of(r, years), r.v, static_cast<float>(temperature_of(r.colour))});
    if (count > 1) catalogue.stars.back() = standing_for(catalogue.stars.back(), count);
  });
  sort_by_magnitude(catalogue.stars);
  for (StarName& name : file.names(records.size()))
    catalogue.names.push_back({std::move(name.name), direction_of(records[name.star], years)});
  return catalogue;
}

StarCatalogue read_star_catalogue(const std::filesystem::path& file, double max_magnitude,
                                  double epoch, std::size_t whole) {
  if (begins_as_star_file(file)) return stars_of(StarFile(file), max_magnitude, epoch, whole);
  return read_table(file, max_magnitude, epoch, whole);
}

std::vector<float> star_magnitudes(const std::filesystem::path& file, double max_magnitude) {
  std::vector<float> magnitudes;
  const auto copy = [&](const auto& stars, auto magnitude) {
    magnitudes.resize(stars.size());
    std::ranges::transform(stars, magnitudes.begin(), magnitude);
  };
  if (begins_as_star_file(file))
    copy(StarFile(file).up_to(max_magnitude), &StarRecord::v);
  else
    copy(read_table(file, max_magnitude, kCatalogueEpoch, kAllWhole).stars, &Star::v_magnitude);
  return magnitudes;
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
