// A star from the row of a table whose columns bear names.
#pragma once

#include "pipeline/image/csv_file.h"
#include "pipeline/sky/catalogue/star_record.h"

namespace domefall {

// What numbers in a catalogue may be.
inline constexpr double kLastHip = 120416, kLastHd = 359083;
inline constexpr double kFastest = 1e5;  // mas/yr; Barnard's star moves by 1e4

struct StarColumns {
  std::string_view ra, dec, v, b_v, pm_ra, pm_dec;
  double degrees;  // of one unit of ra
  double bluest;   // the least B-V taken
};

// With `hip` and `hd` if there are such columns.  Throws InputError with the line.
CatalogueStar read_table_star(const CsvFile& row, const StarColumns& columns);

}  // namespace domefall
