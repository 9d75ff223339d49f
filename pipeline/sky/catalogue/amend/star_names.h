// Names are laid over a catalogue whose stars bear Hipparcos numbers.
#pragma once

#include <filesystem>

#include "pipeline/sky/catalogue/raw_catalogue.h"

namespace domefall {

// Adds the names of d3-celestial's starnames.json.  These are proper names, and Bayer letters or
// Flamsteed numbers with the constellation ("Sirius", "alpha CMa", "61 Cyg").  Entries of stars
// that the catalogue does not have are passed over.  Throws InputError where the file is damaged or
// of another kind.
void add_names(RawCatalogue& catalogue, const std::filesystem::path& file);

}  // namespace domefall
