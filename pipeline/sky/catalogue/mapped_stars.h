// The stars of a mapped catalogue as the renderer needs them.
#pragma once

#include "pipeline/sky/catalogue/star_catalogue.h"
#include "pipeline/sky/catalogue/star_file.h"

namespace domefall {

// Those of V <= max_magnitude and their names, where they stand in the Julian year `epoch`.  The same bits
// on every processor.  Throws InputError as StarFile, and where a record is no star.
StarCatalogue stars_of(const StarFile& file, double max_magnitude, double epoch);

// Kelvin, of a catalogue's colour (star_record.h).
double temperature_of(float colour);

}  // namespace domefall
