#include "pipeline/sky/catalogue/import/star_row.h"

#include "pipeline/sky/catalogue/proper_motion.h"
#include "pipeline/sky/catalogue/star_colour.h"
#include "trajectories/equatorial.h"

namespace domefall {

CatalogueStar read_star_row(const CsvFile& row, const StarColumns& c) {
  constexpr double kTurn = 360;
  CatalogueStar star;
  // Right ascension goes once around in the unit of the table, which is 24 in hours and 360 in
  // degrees.
  star.direction = sky_direction(row.required(c.ra, 0, kTurn / c.degrees) * c.degrees,
                                 row.required(c.dec, -90, 90));
  star.v = static_cast<float>(row.required(c.v, kBrightestV, kFaintestV));
  if (const auto b_v = row.number(c.b_v, c.bluest, kReddest)) star.colour = colour_of_b_v(*b_v);
  star.pm_ra = static_cast<float>(row.number(c.pm_ra, -kFastest, kFastest).value_or(0));
  star.pm_dec = static_cast<float>(row.number(c.pm_dec, -kFastest, kFastest).value_or(0));
  // A number of 0, an empty cell and a missing column all mean that the star has no number there.
  star.hip = static_cast<std::uint32_t>(row.number("hip", 0, kLastHip).value_or(0));
  const auto hd = static_cast<std::uint32_t>(row.number("hd", 0, kLastHd).value_or(0));
  // An importer that calls identify_by_hipparcos() later replaces this for the brightest star of
  // each Hipparcos number.
  if (hd) star.id = henry_draper_id(hd);
  return star;
}

}  // namespace domefall
