#include "pipeline/sky/catalogue/star_catalogue.h"

#include <algorithm>
#include <cmath>
#include <fstream>

#include "pipeline/image/csv_file.h"
#include "pipeline/sky/catalogue/mapped_stars.h"
#include "pipeline/sky/catalogue/star_file_layout.h"
#include "pipeline/sky/catalogue/star_record.h"
#include "trajectories/equatorial.h"

namespace domefall {
namespace {

// Lower case without blanks, so that "Alpha Cen" and "alphacen" are one name.
std::string folded(std::string_view name) {
  std::string out;
  for (const char c : name)
    if (c != ' ' && c != '_')
      out.push_back(static_cast<char>(std::tolower(static_cast<unsigned char>(c))));
  return out;
}

std::size_t edit_distance(const std::string& a, const std::string& b) {
  std::vector<std::size_t> row(b.size() + 1);
  for (std::size_t j = 0; j <= b.size(); ++j) row[j] = j;
  for (std::size_t i = 1; i <= a.size(); ++i) {
    std::size_t diagonal = row[0];
    row[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const std::size_t above = row[j];
      row[j] = std::min({row[j] + 1, row[j - 1] + 1, diagonal + (a[i - 1] == b[j - 1] ? 0u : 1u)});
      diagonal = above;
    }
  }
  return row[b.size()];
}

// Where the row's star stands in that year.
SkyDirection place_of(const CsvFile& row, double epoch) {
  constexpr double kFastest = 1e5;  // mas a year
  const double ra = row.required("ra_deg", 0, 360), dec = row.required("dec_deg", -90, 90);
  const double pm_ra = row.number("pm_ra_mas_yr", -kFastest, kFastest).value_or(0);
  const double pm_dec = row.number("pm_dec_mas_yr", -kFastest, kFastest).value_or(0);
  SkyDirection direction = sky_direction(ra, dec);
  if (epoch == kCatalogueEpoch || (pm_ra == 0 && pm_dec == 0)) return direction;
  return moved(direction, pm_ra, pm_dec, epoch - kCatalogueEpoch);
}

StarCatalogue read_csv(const std::filesystem::path& file, double max_magnitude, double epoch) {
  CsvFile row(file, {"ra_deg", "dec_deg", "v_mag", "b_v"});
  StarCatalogue catalogue;
  while (row.next()) {
    const SkyDirection direction = place_of(row, epoch);
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

// Or should.  Directories and unreadable files are told by the reader of tables, as ever.
bool begins_as_star_file(const std::filesystem::path& file) {
  if (is_cut_short(file, kStarExtension, sizeof(StarFileHeader))) return true;
  std::ifstream in(file, std::ios::binary);
  std::string start(8, '\0');
  return in.read(start.data(), static_cast<std::streamsize>(start.size())) && is_star_file(start);
}

}  // namespace

double temperature_from_b_v(double b_v) {
  const double c = 0.92 * std::clamp(b_v, -0.4, 2.0);
  return 4600 * (1 / (c + 1.7) + 1 / (c + 0.62));
}

StarCatalogue read_star_catalogue(const std::filesystem::path& file, double max_magnitude,
                                  double epoch) {
  if (begins_as_star_file(file)) return stars_of(StarFile(file), max_magnitude, epoch);
  return read_csv(file, max_magnitude, epoch);
}

std::optional<std::string> star_file_fingerprint(const std::filesystem::path& file) {
  if (!begins_as_star_file(file)) return std::nullopt;
  return StarFile(file).fingerprint();
}

std::optional<SkyDirection> find_star(const StarCatalogue& catalogue, std::string_view name) {
  const std::string wanted = folded(name);
  for (const NamedStar& star : catalogue.names)
    if (folded(star.name) == wanted) return star.direction;
  return std::nullopt;
}

std::string nearest_star_name(const StarCatalogue& catalogue, std::string_view name) {
  const std::string wanted = folded(name);
  std::size_t least = std::max<std::size_t>(2, wanted.size() / 3) + 1;
  std::string nearest;
  for (const NamedStar& star : catalogue.names) {
    const std::size_t distance = edit_distance(folded(star.name), wanted);
    if (distance < least) least = distance, nearest = star.name;
  }
  return nearest;
}

}  // namespace domefall
