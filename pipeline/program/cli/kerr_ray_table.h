// The rows near a spinning hole of the tables that `domefall trace --table` is given, and those that ask
// for passages of the equatorial plane.
#pragma once

#include "pipeline/base/csv_file.h"
#include "pipeline/light/kerr_start.h"

namespace domefall {

struct AskedKerrRay {
  KerrPlace at;
  KerrDirection direction;
};

// Reads the row that was read last.  Throws InputError for cells that are no ray.
AskedKerrRay asked_kerr_ray(const CsvFile& row);

// Print the further cells of a row: where a ray comes from, or its k-th passage, which are empty where
// there is none.
void print_kerr_ray(const AskedKerrRay& asked);
void print_kerr_passage(const AskedKerrRay& asked, int k);

}  // namespace domefall
