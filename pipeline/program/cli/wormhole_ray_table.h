// The rays in wormholes that `domefall trace --table` is given, and what it answers.
#pragma once

#include <string>

#include "pipeline/base/csv_file.h"

namespace domefall {

// Says whether a table is of such rays, by its columns.
bool is_wormhole_ray_table(const CsvFile& rows);

// Prints the answer, with as many rows, by what renders frames (`tables`) or by the exact integral.
// Throws InputError, with the line, for cells that are no ray.
void trace_wormhole_rays(const std::string& file, bool tables);

}  // namespace domefall
