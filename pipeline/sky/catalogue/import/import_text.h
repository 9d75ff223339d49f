// What the importers share.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "pipeline/sky/catalogue/star_record.h"

namespace domefall {

// B-V as a catalogue's colour: held to the range that it may have.
float colour_of_b_v(double b_v);

// "1 row", "1,234 rows".
std::string with_commas(std::size_t count);
std::string counted(std::size_t count, std::string_view what);

// Bytes of a file's first line without its end.  Throws InputError where it cannot be read.
std::size_t first_line_length(const std::filesystem::path& file);

// The brightest star of each Hipparcos number is identified by it; the others keep what they have.
void name_by_hipparcos(std::vector<CatalogueStar>& stars);

}  // namespace domefall
