// These are the formats of star catalogues that Domefall imports, with one importer for each.
//
// A further format is a function import_NAME in a file of that name, which is declared below and
// listed in catalogue_formats.cpp.  An importer reads whole files and trusts nothing in them.
// Whatever their bytes, it returns stars within the ranges of raw_catalogue.h, or it throws
// InputError, with file and line (or byte), for a file that is damaged, cut short or of another
// kind.  A star without a magnitude has kNoMagnitude.
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "pipeline/sources/stars/raw_catalogue.h"

namespace domefall {

using Paths = std::vector<std::filesystem::path>;

struct ImportedCatalogue {
  RawCatalogue catalogue;
  std::vector<std::string> notes;  // one line each about what was left out, and why
};

struct CatalogueFormat {
  std::string_view name;   // the word for it in commands
  std::string_view title;  // its name in sentences
  ImportedCatalogue (*import)(const Paths& inputs);
};

std::span<const CatalogueFormat> catalogue_formats();

// Guesses the format of the first input from the contents of the folder or the beginning of the
// file, which may be packed (unpacked_file.h) and begin with a byte-order mark.  Returns null where
// these do not tell.  Throws InputError where the file cannot be read.
const CatalogueFormat* guess_format(const Paths& inputs);

// Tycho-2, CDS I/259, is the folder with tyc2.dat.00 to .19 and suppl_1.dat, or single files of it,
// which the lengths of their lines tell apart.  Positions are those of J2000.  By note 7 of its
// ReadMe V = VT - 0.090 (BT - VT) and B-V = 0.850 (BT - VT).  V from one band alone is marked as
// rough.
ImportedCatalogue import_tycho2(const Paths& inputs);

// d3-celestial's stars.N.json holds GeoJSON points with the Hipparcos number as id, and no proper
// motions.
ImportedCatalogue import_d3_celestial(const Paths& inputs);

// Adds the names of d3-celestial's starnames.json.  These are proper names, and Bayer letters or
// Flamsteed numbers with the constellation ("Sirius", "alpha CMa", "61 Cyg").  Entries of stars
// that the catalogue does not have are passed over.  Throws InputError where the file is damaged or
// of another kind.
void add_names(RawCatalogue& catalogue, const std::filesystem::path& file);

// The Henry Draper Catalogue and Extension, CDS III/135A, is catalog.dat.  Positions of B1900, good
// to 1.5 arcminutes, are turned to J2000.  V is the photovisual magnitude or, where there is none,
// the photographic one less the colour.  Colours come from spectral types (star_colour.h).
// Deleted and repeated entries, nebulae and clusters are left out.
ImportedCatalogue import_henry_draper(const Paths& inputs);

// ASCC-2.5, CDS I/280B, comes in cc*.dat files.  Positions of J1991.25 are moved to J2000.
ImportedCatalogue import_ascc(const Paths& inputs);

// The HYG database, versions 3 and 4, and AT-HYG, versions 1 to 4, are tables whose cells may stand
// in quotes.  Of a table in parts, only the first needs a header line.  Where AT-HYG has VT and
// BT - VT (mag_src is T or TYC), V and B-V are made of them as those of Tycho-2.
ImportedCatalogue import_hyg(const Paths& inputs);

// Stellarium's catalogues are stars_*.cat of types 0 to 2, or the folder that holds them.  Those of
// the versions to 24 give places within triangles, and the folder's hip_pm.dat gives better proper
// motions than they do.  Those from version 25 on are made of Gaia's third release, with places of
// J2016, which are moved to J2000.
ImportedCatalogue import_stellarium(const Paths& inputs);

// Domefall's own table (star_catalogue.h) gives identifiers where it has a column hip or hd.
ImportedCatalogue import_csv(const Paths& inputs);

}  // namespace domefall
