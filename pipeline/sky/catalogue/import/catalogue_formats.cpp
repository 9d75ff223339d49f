#include "pipeline/sky/catalogue/import/catalogue_formats.h"

#include <algorithm>
#include <array>
#include <system_error>

#include "pipeline/image/map_file.h"
#include "pipeline/image/regular_file.h"

namespace domefall {
namespace {

namespace fs = std::filesystem;

constexpr std::array kFormats{
    CatalogueFormat{"tycho2", "Tycho-2 (I/259)", import_tycho2},
    CatalogueFormat{"ascc", "ASCC-2.5 (I/280B)", import_ascc},
    CatalogueFormat{"hd", "Henry Draper Catalogue (III/135A)", import_henry_draper},
    CatalogueFormat{"hyg", "HYG database", import_hyg},
    CatalogueFormat{"stellarium", "Stellarium's catalogues", import_stellarium},
    CatalogueFormat{"d3-celestial", "d3-celestial's GeoJSON", import_d3_celestial},
    CatalogueFormat{"csv", "Domefall's CSV", import_csv},
};

const CatalogueFormat* format_named(std::string_view name) {
  const auto found = std::find_if(kFormats.begin(), kFormats.end(),
                                  [&](const CatalogueFormat& each) { return each.name == name; });
  return found == kFormats.end() ? nullptr : &*found;
}

// Returns the format of a folder by the names of its files, or null.  A folder that cannot be read
// tells nothing.
const CatalogueFormat* guess_folder(const fs::path& folder) {
  std::error_code ignored;
  if (fs::exists(folder / "tyc2.dat.00", ignored)) return format_named("tycho2");
  for (fs::directory_iterator entry(folder, ignored), end; !ignored && entry != end;
       entry.increment(ignored))
    if (entry->path().extension() == ".cat") return format_named("stellarium");
  return nullptr;
}

// Says whether a line has a bar at a byte, counted from 1 as in the ReadMes of catalogues.
bool is_bar(std::string_view line, std::size_t byte) { return line[byte - 1] == '|'; }

// Tables with fixed columns differ in the lengths of their lines and in the characters between
// columns.
const CatalogueFormat* guess_table(std::string_view line) {
  // These are the lengths of the lines by the ReadMes.  In both tables of Tycho-2 the flag at byte
  // 14 stands between two bars.
  constexpr std::size_t kTycho = 206, kSupplement = 122, kAscc = 210, kDraper = 48;
  if (line.size() == kTycho && is_bar(line, 13) && is_bar(line, 15)) return format_named("tycho2");
  if (line.size() == kSupplement && is_bar(line, 13) && is_bar(line, 15))
    return format_named("tycho2");
  // ASCC-2.5 gives right ascension as F12.9 in hours, with the point at byte 3.
  if (line.size() == kAscc && line[2] == '.') return format_named("ascc");
  if (line.size() == kDraper) return format_named("hd");
  return nullptr;
}

// Returns the format of a table by its header line, whose names may stand in quotes, or null.
const CatalogueFormat* guess_csv(std::string_view line) {
  std::string plain(line);
  std::erase(plain, '"');
  if (plain.starts_with("id,hip,hd,hr,gl,bf,proper,ra,dec")) return format_named("hyg");
  if (plain.starts_with("star,")) return nullptr;  // corrections
  if (plain.find("ra_deg") != std::string::npos && plain.find("v_mag") != std::string::npos)
    return format_named("csv");
  return nullptr;
}

}  // namespace

std::span<const CatalogueFormat> catalogue_formats() { return kFormats; }

const CatalogueFormat* guess_format(const Paths& inputs) {
  std::error_code ignored;
  if (inputs.empty()) return nullptr;
  if (fs::is_directory(inputs.front(), ignored)) return guess_folder(inputs.front());
  const MappedFile file(require_file(inputs.front()));
  std::string_view bytes = file.bytes();
  // These bytes are kMagic of import_stellarium.cpp, least significant byte first.
  if (bytes.starts_with("\x0a\x04\x5f\x83")) return format_named("stellarium");
  // A table may begin with lines of comment.
  while (bytes.starts_with('#') && bytes.find('\n') != std::string_view::npos)
    bytes.remove_prefix(bytes.find('\n') + 1);
  // GeoJSON is one object.
  if (bytes.starts_with('{')) return format_named("d3-celestial");
  std::string_view line = bytes.substr(0, bytes.find('\n'));
  if (line.ends_with('\r')) line.remove_suffix(1);
  const CatalogueFormat* csv = guess_csv(line);
  return csv ? csv : guess_table(line);
}

}  // namespace domefall
