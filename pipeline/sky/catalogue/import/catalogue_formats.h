// The formats of star catalogues that Domefall imports, and one importer for each.
//
// A further format is a function import_NAME in a file of that name, declared below and listed in
// catalogue_formats.cpp.  An importer reads whole files and trusts nothing in them: whatever their
// bytes, it returns stars within the ranges of raw_catalogue.h or throws InputError, with file and
// line (or byte), for what is damaged, cut short or of another kind.  A star without a magnitude
// has kNoMagnitude.
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "pipeline/sky/catalogue/raw_catalogue.h"

namespace domefall {

using Paths = std::vector<std::filesystem::path>;

struct ImportedCatalogue {
  RawCatalogue catalogue;
  std::vector<std::string> notes;  // what was left out and why, a line each
};

struct CatalogueFormat {
  std::string_view name;   // in commands
  std::string_view title;  // in sentences
  ImportedCatalogue (*import)(const Paths& inputs);
};

std::span<const CatalogueFormat> catalogue_formats();

// Guesses the format of the first input by what lies in the folder or how the file begins; null
// where that does not tell.  Throws InputError where the file cannot be read.
const CatalogueFormat* guess_format(const Paths& inputs);

// Tycho-2, CDS I/259: the folder with tyc2.dat.00 to .19 and suppl_1.dat, or such files, which the
// lengths of their lines tell apart.  Positions are those of J2000.  V = VT - 0.090 (BT - VT) and
// B-V = 0.850 (BT - VT), by note 7 of its ReadMe; V from one band alone is marked as rough.
ImportedCatalogue import_tycho2(const Paths& inputs);

// d3-celestial's stars.N.json: GeoJSON points with the Hipparcos number as id, without proper
// motion.
ImportedCatalogue import_d3_celestial(const Paths& inputs);

// Henry Draper Catalogue and Extension, CDS III/135A: catalog.dat.  Positions of B1900, good to 1.5
// arcminutes, are turned to J2000.  V is the photovisual magnitude or, where there is none, the
// photographic one less the colour.  Colours come from spectral types (spectral_type.h).  Deleted
// and repeated entries, nebulae and clusters are left out.
ImportedCatalogue import_henry_draper(const Paths& inputs);

// ASCC-2.5, CDS I/280B: its cc*.dat files.  Positions of J1991.25 are moved to J2000.
ImportedCatalogue import_ascc(const Paths& inputs);

// The HYG database, versions 3 and 4: a table in quotes.
ImportedCatalogue import_hyg(const Paths& inputs);

// Stellarium's stars_*.cat of types 0 and 1, as in versions 0.13 to 23, or the folder they are in.
// The folder's hip_pm.dat gives better proper motions than they do.
ImportedCatalogue import_stellarium(const Paths& inputs);

// Domefall's own table (read_star_catalogue.h), with identifiers where it has a column hip or hd.
ImportedCatalogue import_csv(const Paths& inputs);

}  // namespace domefall
