#include <fmt/format.h>

#include "pipeline/base/errors.h"
#include "pipeline/base/talk.h"
#include "pipeline/sources/stars/catalogue_formats.h"
#include "pipeline/sources/stars/catalogue_rows.h"
#include "pipeline/sources/stars/raw_catalogue.h"
#include "pipeline/sources/stars/star_colour.h"
#include "trajectories/equatorial.h"

// The columns are those of the ReadMe of I/259 (Hog et al. 2000, A&A 355, L27).
namespace domefall {
namespace {

namespace fs = std::filesystem;

// Lines of the main table and of the supplement have these lengths, by which they are told apart.
constexpr std::size_t kMainLine = 206, kSupplementLine = 122;
// The ReadMe gives both: the epoch of the supplement's places, and the number of files into which
// the main table is split.
constexpr double kSupplementEpoch = 1991.25;
constexpr int kMainParts = 20;

constexpr NumberColumn kRegion{1, 4, "TYC1", 1, 9537}, kNumber{6, 10, "TYC2", 1, 12121},
    kComponent{12, 12, "TYC3", 1, 4}, kRa{16, 27, "RA", 0, 360}, kDec{29, 40, "Dec", -90, 90},
    kPmRa{42, 48, "pmRA", -kFastest, kFastest}, kPmDec{50, 56, "pmDE", -kFastest, kFastest};
constexpr int kPositionFlag = 14, kSupplementBand = 82;
constexpr NumberColumn kObservedRa{153, 164, "observed RA", 0, 360},
    kObservedDec{166, 177, "observed Dec", -90, 90};

// The two tables have magnitudes and Hipparcos numbers in different columns.
struct Photometry {
  NumberColumn bt, vt, hip;
};
constexpr Photometry kMain{
    {111, 116, "BTmag", -5, 20}, {124, 129, "VTmag", -5, 20}, {143, 148, "HIP", 1, kLastHip}};
constexpr Photometry kSupplement{
    {84, 89, "BTmag", -5, 20}, {97, 102, "VTmag", -5, 20}, {116, 121, "HIP", 1, kLastHip}};

bool read_photometry(const FixedColumns& line, const Photometry& columns, CatalogueStar& star) {
  const auto bt = line.number(columns.bt), vt = line.number(columns.vt);
  star.hip = line.whole(columns.hip);
  if (!bt && !vt) return false;
  // A star that was measured in BT alone is assumed to have the colour with which it is drawn.  Its
  // V is BT - (BT - VT) - 0.090 (BT - VT).  A star measured in VT alone has VT for V.  The factors
  // are those of note 7 of the ReadMe (catalogue_formats.h).
  const double bt_vt = bt && vt ? *bt - *vt : kAssumedColour / 0.850;
  if (bt && vt) star.colour = colour_of_b_v(0.850 * bt_vt);
  star.v_is_rough = !bt || !vt;
  star.v = static_cast<float>(vt ? *vt - (bt ? 0.090 * bt_vt : 0) : *bt - 1.090 * bt_vt);
  return true;
}

CatalogueStar start_of(const FixedColumns& line) {
  // whole() takes a blank column for 0, which is no part of an identifier.
  for (const NumberColumn& part : {kRegion, kNumber, kComponent}) line.required(part);
  return {.pm_ra = static_cast<float>(line.number(kPmRa).value_or(0)),
          .pm_dec = static_cast<float>(line.number(kPmDec).value_or(0)),
          .id = tycho_id(line.whole(kRegion), line.whole(kNumber), line.whole(kComponent))};
}

class Tycho {
 public:
  void read_main(const fs::path& file) {
    FixedColumns line(file, kMainLine, kMainLine);
    while (line.next()) {
      CatalogueStar star = start_of(line);
      // A star without a mean position has only the observed one, of about J1991.5.
      const bool observed = line.letter(kPositionFlag) == 'X';
      star.direction = sky_direction(line.required(observed ? kObservedRa : kRa),
                                     line.required(observed ? kObservedDec : kDec));
      keep(line, kMain, star);
    }
  }

  void read_supplement(const fs::path& file) {
    FixedColumns line(file, kSupplementLine, kSupplementLine);
    while (line.next()) {
      CatalogueStar star = start_of(line);
      // The supplement gives the places of J1991.25, the main table those of J2000.
      star.direction = moved(sky_direction(line.required(kRa), line.required(kDec)), star.pm_ra,
                             star.pm_dec, 2000 - kSupplementEpoch);
      // The supplement marks with H the stars whose V is the magnitude Hp of Hipparcos.
      if (line.letter(kSupplementBand) == 'H') ++hipparcos_band_;
      keep(line, kSupplement, star);
    }
  }

  ImportedCatalogue finished() {
    ImportedCatalogue out;
    if (unmeasured_)
      out.notes.push_back(counted(unmeasured_, "row") + " without a magnitude left out");
    if (hipparcos_band_)
      out.notes.push_back(counted(hipparcos_band_, "row") +
                          " of the supplement with Hipparcos' Hp for V, without a colour");
    identify_by_hipparcos(stars_);
    out.catalogue.stars = std::move(stars_);
    out.catalogue.text = {"Tycho-2, CDS I/259 (Hog et al. 2000, A&A 355, L27), ESA",
                          "BSD-2-Clause as in Debian's source package tycho2", ""};
    return out;
  }

 private:
  void keep(const FixedColumns& line, const Photometry& columns, CatalogueStar& star) {
    if (read_photometry(line, columns, star))
      stars_.push_back(star);
    else
      ++unmeasured_;
  }

  std::vector<CatalogueStar> stars_;
  std::size_t unmeasured_ = 0, hipparcos_band_ = 0;
};

// Returns all files of the catalogue, packed or not, and throws if one is missing, since that would
// leave a hole in the sky.
Paths parts_of(const fs::path& folder) {
  Paths parts;
  for (int i = 0; i < kMainParts; ++i) parts.push_back(folder / fmt::format("tyc2.dat.{:02}", i));
  parts.push_back(folder / "suppl_1.dat");
  std::error_code ignored;
  for (fs::path& part : parts) {
    if (fs::is_regular_file(part, ignored)) continue;
    const std::string missing = part.string();
    part += ".gz";  // as the CDS hands them out
    if (!fs::is_regular_file(part, ignored))
      throw InputError(missing + ": missing; all of Tycho-2 is tyc2.dat.00 to .19 and suppl_1.dat");
  }
  return parts;
}

}  // namespace

ImportedCatalogue import_tycho2(const Paths& inputs) {
  Tycho tycho;
  for (const fs::path& input : inputs) {
    std::error_code ignored;
    const Paths parts = fs::is_directory(input, ignored) ? parts_of(input) : Paths{input};
    for (const fs::path& part : parts) {
      const std::size_t length = first_line_length(part);
      if (length == kSupplementLine)
        tycho.read_supplement(part);
      else
        tycho.read_main(part);
    }
  }
  return tycho.finished();
}

}  // namespace domefall
