// Star catalogues of other formats, read into one form.  Each reads whole files, throws InputError with
// file and line (or byte) for whatever is damaged, cut short or of another kind, and takes nothing for
// granted: a file of any bytes gives stars within the ranges of star_record.h or that error.  Stars without
// a magnitude come with kNoMagnitude.
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "pipeline/sky/catalogue/star_record.h"

namespace domefall {

using Paths = std::vector<std::filesystem::path>;

struct ImportedCatalogue {
  RawCatalogue catalogue;
  std::vector<std::string> notes;  // what was left out and why, a line each
};

struct Importer {
  std::string_view name;   // in commands
  std::string_view title;  // in sentences
  ImportedCatalogue (*import)(const Paths& inputs);
};

std::span<const Importer> importers();
// By what the first input is or how it begins; null where that does not tell.  Throws InputError where it
// cannot be read.
const Importer* guess_importer(const Paths& inputs);

// Tycho-2, CDS I/259: the folder with tyc2.dat.00 to .19 and suppl_1.dat, or such files, told apart by the
// lengths of their lines.  Positions at J2000.  V = VT - 0.090 (BT - VT) and B-V = 0.850 (BT - VT), its
// ReadMe's note 7; V from one band alone is marked as rough.
ImportedCatalogue import_tycho2(const Paths& inputs);

// d3-celestial's stars.N.json: GeoJSON points with the Hipparcos number as id.  No proper motion.
ImportedCatalogue import_d3_celestial(const Paths& inputs);

// Henry Draper Catalogue and Extension, CDS III/135A: catalog.dat.  Positions of B1900, to 1.5 arcminutes,
// turned to J2000; photovisual magnitudes, or photographic ones less the colour; colours from spectral types
// (spectral_type.h).  Deleted and repeated entries, nebulae and clusters are left out.
ImportedCatalogue import_henry_draper(const Paths& inputs);

// ASCC-2.5, CDS I/280B: its cc*.dat files.  Positions of J1991.25 moved to J2000.
ImportedCatalogue import_ascc(const Paths& inputs);

// The HYG database, versions 3 and 4: a CSV with quotes.
ImportedCatalogue import_hyg(const Paths& inputs);

// Stellarium's stars_*.cat as of versions 0.13 to 23, of types 0 and 1, or the folder they are in, whose hip_pm.dat
// gives the better proper motions.
ImportedCatalogue import_stellarium(const Paths& inputs);

// Domefall's own CSV (star_catalogue.h), its identifiers in the columns hip or hd if there are such.
ImportedCatalogue import_table(const Paths& inputs);

}  // namespace domefall
