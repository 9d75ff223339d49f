// Corrections made by hand are laid over a catalogue while it is imported.
#pragma once

#include <filesystem>

#include "pipeline/sky/catalogue/raw_catalogue.h"

namespace domefall {

// Reads a table (csv_file.h) with the column `star` and any of the others below, whose cells may be
// empty:
//
//   star           which star: an identifier ("HIP 92420", "HD 174638", "TYC 2642-2929-1") or a
//                  name in the catalogue.  Of several with | between them, the first that the
//                  catalogue has
//   action         empty: set what the row gives.  remove: remove the star.  add: add a star that
//                  is not there, which needs ra_deg, dec_deg and v_mag
//   v_mag, b_v     magnitude V, colour
//   temperature_k  instead of b_v: 500 to 1e6
//   ra_deg, dec_deg   J2000, both or neither
//   pm_ra_mas_yr, pm_dec_mas_yr   both or neither
//
// Other columns, such as one for the source, are ignored.  Rows act in the file's order.  Returns
// how many rows there are.  Throws InputError with file and line for a row that is damaged, matches
// no star, changes nothing, or adds a star whose identifier is taken.
std::size_t apply_corrections(RawCatalogue& catalogue, const std::filesystem::path& file);

}  // namespace domefall
