#include <fmt/format.h>

#include "pipeline/base/talk.h"
#include "pipeline/sources/stars/catalogue_formats.h"
#include "pipeline/sources/stars/catalogue_rows.h"
#include "pipeline/sources/stars/raw_catalogue.h"
#include "pipeline/sources/stars/star_colour.h"
#include "trajectories/equatorial.h"

// The columns are those of the ReadMe of I/280B (Kharchenko 2001, Kin. Phys. Cel. Bod. 17, 409;
// version 3).
namespace domefall {
namespace {

// A line may lack its last columns: these are infrared magnitudes, which are not used.
constexpr std::size_t kShortestAscc = 177, kLongestAscc = 210;
constexpr double kEpoch = 1991.25, kDegreesPerHour = 15;
constexpr NumberColumn kRa{1, 12, "RAhour", 0, 24}, kDec{14, 25, "DEdeg", -90, 90},
    kPmRa{50, 56, "pmRA", -1e7, 1e7}, kPmDec{58, 64, "pmDE", -1e7, 1e7},
    kB{78, 82, "Bmag", -5000, 99999}, kV{84, 88, "Vmag", -5000, 99999},
    kRegion{137, 140, "TYC1", 0, 9537}, kNumber{141, 145, "TYC2", 0, 12121},
    kComponent{146, 146, "TYC3", 0, 4}, kHip{148, 153, "HIP", 0, kLastHip},
    kHd{155, 160, "HD", 0, kLastHd};
// The table has kNoMotion or kUnmeasured where nothing was measured.
constexpr double kNoMotion = 999999, kUnmeasured = 99999, kFaintest = 40000;

std::optional<double> magnitude(const FixedColumns& line, const NumberColumn& column) {
  constexpr double kMillimagnitude = 1e-3;
  const auto value = line.number(column);
  if (!value || *value == kUnmeasured) return std::nullopt;
  if (*value > kFaintest)
    line.fail(fmt::format("{} is neither a magnitude nor 99999", column.name));
  return *value * kMillimagnitude;
}

// Returns a proper motion in mas a year, which the file gives in hundredths, or 0 where there is
// none.
float motion(const FixedColumns& line, const NumberColumn& column) {
  constexpr double kHundredth = 0.01;
  const double value = line.number(column).value_or(kNoMotion);
  return value == kNoMotion ? 0 : static_cast<float>(value * kHundredth);
}

// Returns the Henry Draper number or else the Tycho number.  A Hipparcos number takes the place of
// either later on.
StarId identifier(const FixedColumns& line) {
  const std::uint32_t region = line.whole(kRegion), number = line.whole(kNumber),
                      component = line.whole(kComponent), hd = line.whole(kHd);
  if (hd != 0) return henry_draper_id(hd);
  return region && number && component ? tycho_id(region, number, component) : kNoStarId;
}

// Returns the star of a line.  V of a star that was measured in B alone is B less the assumed
// colour.
CatalogueStar read_star(const FixedColumns& line) {
  CatalogueStar star{.pm_ra = motion(line, kPmRa), .pm_dec = motion(line, kPmDec)};
  // The file gives the places of J1991.25, and right ascension in hours.
  star.direction = moved(sky_direction(line.required(kRa) * kDegreesPerHour, line.required(kDec)),
                         star.pm_ra, star.pm_dec, 2000 - kEpoch);
  const auto b = magnitude(line, kB), v = magnitude(line, kV);
  if (b && v) star.colour = colour_of_b_v(*b - *v);
  star.v = v ? static_cast<float>(*v) : b ? static_cast<float>(*b - kAssumedColour) : kNoMagnitude;
  star.v_is_rough = !v;
  star.hip = line.whole(kHip);
  star.id = identifier(line);
  return star;
}

}  // namespace

ImportedCatalogue import_ascc(const Paths& inputs) {
  ImportedCatalogue out;
  std::size_t unmeasured = 0;
  for (const std::filesystem::path& input : inputs) {
    FixedColumns line(input, kShortestAscc, kLongestAscc);
    while (line.next()) {
      out.catalogue.stars.push_back(read_star(line));
      if (out.catalogue.stars.back().v == kNoMagnitude) ++unmeasured;
    }
  }
  if (unmeasured)
    out.notes.push_back(counted(unmeasured, "star") + " without a magnitude, left out");
  identify_by_hipparcos(out.catalogue.stars);
  out.catalogue.text = {"ASCC-2.5 version 3, CDS I/280B (Kharchenko & Roeser 2009)",
                        "as the catalogue service gives it", ""};
  return out;
}

}  // namespace domefall
