// The rows near a spinning hole of the tables that `domefall trace --table` is given which ask for
// passages of the equatorial plane.
#pragma once

#include "pipeline/light/traced_spin.h"

namespace domefall {

// Prints the further cells of a row: those of a ray's k-th passage, which are empty where there is none.
void print_kerr_passage(const KerrQuestion& asked, int k);

}  // namespace domefall
