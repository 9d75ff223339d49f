#include "pipeline/sky/catalogue/star_catalogue.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <fstream>

#include "pipeline/image/errors.h"
#include "pipeline/sky/catalogue/mapped_stars.h"
#include "pipeline/sky/catalogue/star_file_layout.h"
#include "pipeline/sky/catalogue/star_record.h"

namespace domefall {
namespace {

// One line cut at its commas.  The catalogues that Domefall reads quote nothing.
std::vector<std::string_view> cells_of(std::string_view line) {
  std::vector<std::string_view> cells;
  for (;;) {
    const std::size_t comma = line.find(',');
    cells.push_back(line.substr(0, comma));
    if (comma == std::string_view::npos) return cells;
    line.remove_prefix(comma + 1);
  }
}

struct Columns {
  std::size_t ra, dec, v, b_v, name, designation, pm_ra, pm_dec, count;
};

constexpr std::size_t kAbsent = static_cast<std::size_t>(-1);

class Reader {
 public:
  explicit Reader(const std::filesystem::path& file) : file_(file), in_(file) {
    if (!in_) throw InputError(file.string() + ": the star catalogue cannot be read");
  }

  // The next line that is not a comment; false at the end.
  bool next(std::string& line) {
    while (std::getline(in_, line)) {
      ++line_;
      if (!line.empty() && line.back() == '\r') line.pop_back();
      if (!line.empty() && line[0] != '#') return true;
    }
    if (in_.bad()) fail("reading stopped");
    return false;
  }

  [[noreturn]] void fail(const std::string& what) const {
    throw InputError(file_.string() + ":" + std::to_string(line_) + ": " + what);
  }

  double number(std::string_view text, const char* column, double low, double high) const {
    double value = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc() || end != text.data() + text.size() ||
        !(value >= low && value <= high))
      fail(std::string(column) + " must be a number from " + std::to_string(static_cast<int>(low)) +
           " to " + std::to_string(static_cast<int>(high)) + ", got '" + std::string(text) + "'");
    return value;
  }

 private:
  std::filesystem::path file_;
  std::ifstream in_;
  int line_ = 0;
};

Columns read_header(Reader& reader) {
  std::string line;
  if (!reader.next(line)) reader.fail("the star catalogue has no header line");
  const auto names = cells_of(line);
  const auto find = [&](std::string_view name) {
    const auto at = std::find(names.begin(), names.end(), name);
    return at == names.end() ? kAbsent : static_cast<std::size_t>(at - names.begin());
  };
  const Columns c{find("ra_deg"),       find("dec_deg"),       find("v_mag"),
                  find("b_v"),          find("name"),          find("designation"),
                  find("pm_ra_mas_yr"), find("pm_dec_mas_yr"), names.size()};
  for (const auto& [at, name] :
       {std::pair{c.ra, "ra_deg"}, {c.dec, "dec_deg"}, {c.v, "v_mag"}, {c.b_v, "b_v"}})
    if (at == kAbsent) reader.fail(std::string("the star catalogue has no column ") + name);
  return c;
}

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
SkyDirection place_of(const Reader& reader, const Columns& column,
                      const std::vector<std::string_view>& cell, double epoch) {
  const double ra = reader.number(cell[column.ra], "ra_deg", 0, 360);
  const double dec = reader.number(cell[column.dec], "dec_deg", -90, 90);
  const auto motion = [&](std::size_t at, const char* name) {
    return at == kAbsent || cell[at].empty() ? 0 : reader.number(cell[at], name, -1e5, 1e5);
  };
  const double pm_ra = motion(column.pm_ra, "pm_ra_mas_yr");
  const double pm_dec = motion(column.pm_dec, "pm_dec_mas_yr");
  SkyDirection direction = star_direction(ra, dec);
  if (epoch == kCatalogueEpoch || (pm_ra == 0 && pm_dec == 0)) return direction;
  return moved(direction, pm_ra, pm_dec, epoch - kCatalogueEpoch);
}

StarCatalogue read_csv(const std::filesystem::path& file, double max_magnitude, double epoch) {
  Reader reader(file);
  const Columns column = read_header(reader);
  StarCatalogue catalogue;
  for (std::string line; reader.next(line);) {
    const auto cell = cells_of(line);
    if (cell.size() != column.count)
      reader.fail("expected " + std::to_string(column.count) + " columns, got " +
                  std::to_string(cell.size()));
    const SkyDirection direction = place_of(reader, column, cell, epoch);
    const double v = reader.number(cell[column.v], "v_mag", kBrightestV, kFaintestV);
    const double b_v = cell[column.b_v].empty()
                           ? kAssumedColour
                           : reader.number(cell[column.b_v], "b_v", kBluest, kReddest);
    for (const std::size_t at : {column.name, column.designation})
      if (at != kAbsent && !cell[at].empty())
        catalogue.names.push_back({std::string(cell[at]), direction});
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
