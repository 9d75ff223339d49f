#include <fmt/format.h>

#include <cmath>
#include <optional>
#include <set>

#include "pipeline/base/talk.h"
#include "pipeline/sources/stars/catalogue_formats.h"
#include "pipeline/sources/stars/catalogue_rows.h"
#include "pipeline/sources/stars/star_colour.h"
#include "trajectories/equatorial.h"

// The columns are those of the ReadMe of III/135A (Cannon & Pickering 1918-1924).
namespace domefall {
namespace {

// A line may have lost its trailing blanks, but each has text up to the column before the type.
constexpr std::size_t kShortestDraper = 41, kLongestDraper = 48;
constexpr NumberColumn kHdNumber{1, 6, "HD", 1, kLastHd}, kRaHours{19, 20, "RAh", 0, 23},
    kRaTenths{21, 23, "RAdm", 0, 599}, kDecDegrees{25, 26, "DEd", 0, 90},
    kDecMinutes{27, 28, "DEm", 0, 59}, kVisual{30, 34, "Ptm", -2, 50},
    kPhotographic{37, 41, "Ptg", -2, 50};
constexpr TextColumn kType{43, 45};
constexpr int kSign = 24, kRemark = 48;
// The catalogue has these codes in place of a magnitude.
constexpr double kNebula = 20, kVariable = 30, kNova = 40, kCluster = 50;
// The ReadMe says that this star was entered twice: it is HD 194629.
constexpr std::uint32_t kRepeated = 194648;

// Turns a direction of B1900 (FK4) to J2000 (FK5).  The matrix is the product of Newcomb's
// precession to B1950 and the matrix of Standish 1982.  The E-terms of aberration, 0.35 arcseconds,
// are left out, since they are far below the 0.1 minute to which the catalogue gives right
// ascension.
SkyDirection to_j2000(const SkyDirection& b1900) {
  const V3d& p = b1900.v;
  const V3d q(0.999702924 * p.x - 0.0223531344 * p.y - 0.00971607525 * p.z,
              0.0223531339 * p.x + 0.999750132 * p.y - 0.000108653086 * p.z,
              0.00971607628 * p.x - 0.000108563936 * p.y + 0.999952792 * p.z);
  return {q / std::sqrt(q.dot(q))};
}

// Returns the place of a line, whose columns give right ascension to 0.1 minute and declination to
// 1 arcminute.  Blank minutes count as 0.
SkyDirection position(const FixedColumns& line) {
  constexpr double kDegreesPerHour = 15, kMinutes = 60, kTenths = 600;
  const double hours = line.required(kRaHours) + line.number(kRaTenths).value_or(0) / kTenths;
  const double degrees =
      line.required(kDecDegrees) + line.number(kDecMinutes).value_or(0) / kMinutes;
  const char sign = line.letter(kSign);
  if (sign != '+' && sign != '-') line.fail("the sign of the declination (byte 24) must be + or -");
  if (degrees > 90) line.fail("the declination exceeds 90 degrees");
  return to_j2000(sky_direction(hours * kDegreesPerHour, sign == '-' ? -degrees : degrees));
}

// Returns the magnitude, or nothing for one of the catalogue's codes, which exceed every magnitude.
std::optional<double> measured(std::optional<double> magnitude) {
  return magnitude && *magnitude < kNebula ? magnitude : std::nullopt;
}

// These rows are counted for the notes of the import.
struct Skipped {
  std::size_t deleted = 0, repeated = 0, nebulae = 0, unmeasured = 0;
};

// Returns V, from the photographic magnitude and the colour where the star has no visual one.
float magnitude(const FixedColumns& line, float colour) {
  if (const auto visual = measured(line.number(kVisual))) return static_cast<float>(*visual);
  const auto photographic = measured(line.number(kPhotographic));
  if (!photographic) return kNoMagnitude;
  // The catalogue's index, photographic less visual, is 0 at A0 and 1 at K0, which is nearly B-V.
  // Types O and B, whose colour is a temperature, count as 0.
  const double index = is_temperature(colour) ? 0
                       : colour == kNoColour  ? kAssumedColour
                                              : static_cast<double>(colour);
  return static_cast<float>(*photographic - index);
}

// Says whether either magnitude is the code of a nebula or a cluster, which are no points of light.
// Throws InputError for a number that is neither magnitude nor code.
bool is_nebula_or_cluster(const FixedColumns& line) {
  for (const NumberColumn& column : {kVisual, kPhotographic}) {
    const double m = line.number(column).value_or(0);
    if (m == kNebula || m == kCluster) return true;
    if (m > kNebula && m != kVariable && m != kNova)
      line.fail(fmt::format("{} must be a magnitude below 20 or one of the codes 20, 30, 40, 50",
                            column.name));
  }
  return false;
}

std::vector<std::string> notes_of(const Skipped& skipped) {
  std::vector<std::string> notes;
  const auto note = [&notes](std::size_t count, const char* what, const char* why) {
    if (count) notes.push_back(fmt::format("{} {}", counted(count, what), why));
  };
  note(skipped.deleted, "row", "marked as deleted, left out");
  note(skipped.repeated, "row", "repeating another number, left out");
  note(skipped.nebulae, "row", "of nebulae and clusters, left out");
  note(skipped.unmeasured, "star",
       "without a magnitude (variables, novae, pairs), left out unless a correction gives one");
  return notes;
}

}  // namespace

ImportedCatalogue import_henry_draper(const Paths& inputs) {
  ImportedCatalogue out;
  Skipped skipped;
  std::set<std::uint32_t> seen{kRepeated};
  for (const std::filesystem::path& input : inputs) {
    FixedColumns line(input, kShortestDraper, kLongestDraper);
    while (line.next()) {
      // whole() would take a blank number for 0, so that it is refused first.
      line.required(kHdNumber);
      CatalogueStar star;
      const std::uint32_t hd = line.whole(kHdNumber);
      star.id = henry_draper_id(hd);
      star.direction = position(line);
      star.colour = colour_of_spectral_type(line.text(kType));
      star.v = magnitude(line, star.colour);
      const bool nebula = is_nebula_or_cluster(line);
      // A row is counted for one reason only, the first of these that holds.
      if (line.letter(kRemark) == 'D') {
        ++skipped.deleted;
      } else if (nebula) {
        ++skipped.nebulae;
      } else if (!seen.insert(hd).second) {
        ++skipped.repeated;
      } else {
        if (star.v == kNoMagnitude) ++skipped.unmeasured;
        out.catalogue.stars.push_back(star);
      }
    }
  }
  out.notes = notes_of(skipped);
  out.catalogue.text = {
      "Henry Draper Catalogue and Extension, CDS III/135A (Cannon & Pickering 1918-1936)",
      "as the catalogue service gives it", ""};
  return out;
}

}  // namespace domefall
