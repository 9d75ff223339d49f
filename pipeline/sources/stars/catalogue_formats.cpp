#include "pipeline/sources/stars/catalogue_formats.h"

#include <algorithm>
#include <array>
#include <system_error>

#include "pipeline/base/regular_file.h"
#include "pipeline/base/unpacked_file.h"
#include "pipeline/base/utf8.h"

namespace domefall {
namespace {

namespace fs = std::filesystem;

constexpr std::array kFormats{
    CatalogueFormat{"tycho2", "Tycho-2 (I/259)", import_tycho2},
    CatalogueFormat{"ascc", "ASCC-2.5 (I/280B)", import_ascc},
    CatalogueFormat{"hd", "Henry Draper Catalogue (III/135A)", import_henry_draper},
    CatalogueFormat{"hyg", "HYG database or AT-HYG", import_hyg},
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

// Returns the format of a table by the names in its header line, or null.  They stand between any
// of the separators of csv_file.h, may be in quotes, and in any case.
const CatalogueFormat* guess_csv(std::string_view line) {
  std::string header = ",";
  for (const char c : in_lower_case(line))
    if (c != '"' && c != ' ') header += c == '\t' || c == ';' || c == '|' ? ',' : c;
  header += ',';
  const auto has = [&](std::string_view name) {
    return header.find("," + std::string(name) + ",") != std::string::npos;
  };
  if (has("star")) return nullptr;  // corrections
  if (has("ra_deg") && has("dec_deg") && has("v_mag")) return format_named("csv");
  if (has("ra") && has("dec") && has("mag") && has("absmag")) return format_named("hyg");
  return nullptr;
}

std::string_view first_line(std::string_view text) {
  while (!text.empty()) {
    const std::string_view line = text.substr(0, text.find_first_of("\r\n"));
    const bool blank = line.find_first_not_of(" \t") == std::string_view::npos;
    if (!blank && !line.starts_with('#') && !line.starts_with("sep=")) return line;
    text.remove_prefix(std::min(line.size() + 1, text.size()));
  }
  return {};
}

}  // namespace

std::span<const CatalogueFormat> catalogue_formats() { return kFormats; }

const CatalogueFormat* guess_format(const Paths& inputs) {
  std::error_code ignored;
  if (inputs.empty()) return nullptr;
  if (fs::is_directory(inputs.front(), ignored)) return guess_folder(inputs.front());
  // Comments and the header of a table fit into this.
  constexpr std::size_t kStart = 1 << 16;
  std::string start = start_of_unpacked(require_file(inputs.front()), kStart);
  // These bytes are kMagic of import_stellarium.cpp, least significant byte first.
  if (start.starts_with("\x0a\x04\x5f\x83")) return format_named("stellarium");
  const std::string text = as_utf8(std::move(start), inputs.front());
  const std::string_view line = first_line(text);
  // GeoJSON is one object.
  const std::size_t begin = line.find_first_not_of(" \t");
  if (begin != std::string_view::npos && line[begin] == '{') return format_named("d3-celestial");
  const CatalogueFormat* csv = guess_csv(line);
  return csv ? csv : guess_table(line);
}

}  // namespace domefall
