// A star is read from the row of a table whose columns have names.
#pragma once

#include "pipeline/image/csv_file.h"
#include "pipeline/sky/catalogue/raw_catalogue.h"

namespace domefall {

struct StarColumns {
  std::string_view ra, dec, v, b_v, pm_ra, pm_dec;  // their names in the table
  double degrees;                                   // in one unit of `ra`
  double bluest;                                    // the least B-V that is taken as a number
};

// Returns the star of the row read last.  Columns `hip` and `hd` identify it where the table has
// them.  Throws InputError with the line.
CatalogueStar read_star_row(const CsvFile& row, const StarColumns& columns);

}  // namespace domefall
