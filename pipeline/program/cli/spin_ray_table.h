// The rays near a charge or a spinning hole that `domefall trace --table` is given, and what it answers.
// With a column k the answer is the k-th passage of the equatorial plane.
#pragma once

#include <string>

#include "pipeline/base/csv_file.h"

namespace domefall {

// Says whether a table is of such rays, by its columns.
bool is_spin_ray_table(const CsvFile& rows);

// Prints the answer, with as many rows.  Throws InputError, with the line, for cells that are no ray.
void trace_spin_rays(const std::string& file);

}  // namespace domefall
