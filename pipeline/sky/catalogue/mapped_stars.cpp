#include "pipeline/sky/catalogue/mapped_stars.h"

#include <cmath>

#include "pipeline/image/errors.h"
#include "pipeline/sky/catalogue/star_file_layout.h"

namespace domefall {
namespace {

// Rounding to 2^-31 changes the square of a unit vector's length by 2e-9 at most.
constexpr double kLengthTolerance = 1e-8;

bool is_colour(float colour) {
  return (colour >= kBluest && colour <= kReddest) || colour == kNoColour ||
         (colour >= kColdest && colour <= kHottest);
}

bool is_star(const StarRecord& r, double length2) {
  return std::abs(length2 - 1) < kLengthTolerance && r.v >= kBrightestV && r.v <= kFaintestV &&
         is_colour(r.colour) && std::isfinite(r.pm_ra) && std::isfinite(r.pm_dec);
}

}  // namespace

double temperature_of(float colour) {
  if (is_temperature(colour)) return colour;
  return temperature_from_b_v(colour == kNoColour ? kAssumedColour : colour);
}

StarCatalogue stars_of(const StarFile& file, double max_magnitude, double epoch) {
  const auto records = file.up_to(max_magnitude);
  const double years = epoch - file.epoch();
  StarCatalogue catalogue;
  catalogue.stars.reserve(records.size());
  for (const StarRecord& r : records) {
    const V3d v(r.x / kUnit, r.y / kUnit, r.z / kUnit);
    const double length2 = v.x * v.x + v.y * v.y + v.z * v.z;
    if (!is_star(r, length2)) file.fail_at(r, "this record is no star");
    SkyDirection direction{v / std::sqrt(length2)};
    if (years != 0 && (r.pm_ra != 0 || r.pm_dec != 0))
      direction = moved(direction, r.pm_ra, r.pm_dec, years);
    catalogue.stars.push_back({direction, r.v, static_cast<float>(temperature_of(r.colour))});
  }
  for (StarName& name : file.names(records.size()))
    catalogue.names.push_back({std::move(name.name), catalogue.stars[name.star].direction});
  return catalogue;
}

}  // namespace domefall
