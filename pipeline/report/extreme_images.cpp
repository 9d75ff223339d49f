#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "pipeline/optics/exact_azimuth.h"
#include "pipeline/optics/hole_optics.h"
#include "pipeline/report/extreme_cases.h"

namespace domefall {
namespace {

using std::numbers::pi;

// Behind the hole, the primary and the secondary image of a star on the axis meet in a ring, whose
// light is bounded by the star's size.  In front of the hole the star is seen undeflected.  There
// sin(phi)/sin(delta) tends to the slope d phi/d delta, so the amplification sin(delta)/|sin(phi)
// slope| tends to 1/slope^2.
ExtremeResult star_on_the_axis() {
  const double size = 1e-8;
  double worst = 0;
  double ring = 0, front = 0;
  for (const double r : {1e-3, 0.5, 2.5, 10.0, 1e4}) {
    const HoleOptics optics = make_hole_optics(r, Tetrad::kRain, {true, r < 2, true});
    for (const SkyRegion sky : kExteriorSkies) {
      const SkyTable* table = optics.table_of(sky);
      if (table == nullptr) continue;
      const SkyImage behind = image_of(table, V3d(-1, 0, 0), 0, size);
      const SkyImage before = image_of(table, V3d(1, 0, 0), 0, size);
      // The table ends on the axis in front, where the azimuth is 0.
      const double slope = table->slope(table->x_max());
      worst = std::max(worst, std::abs(before.amplification * slope * slope - 1));
      // Behind, no value is expected.  The amplification has to be finite, and the page shows how
      // large it is.
      if (!std::isfinite(behind.amplification)) worst = behind.amplification;
      ring = std::max(ring, behind.amplification * size);
      // At the last radius, 1e4, hardly more than aberration is left.  With s = sqrt(2/r) the light
      // from in front has 1 + z = 1 + s for the faller, so the amplification is near
      // (1 + s)^2 = 1.0285.
      front = before.amplification;
    }
    const WhiteHoleImages images = images_of(*optics.white_hole, V3d(1, 0, 0), 2, size);
    for (int k = 0; k < images.count; ++k)
      if (!std::isfinite(images.image[static_cast<std::size_t>(k)].amplification))
        worst = std::numeric_limits<double>::infinity();
  }
  return {
      worst,
      fmt::format("Behind, the amplification is at most {:.2g} over the star's radius; in front at "
                  "r = 1e4 it is {:.4f}",
                  ring, front)};
}

// [Riazuelo] fig. fig_z zooms into the images up to order 7, seen from 30 M.  The table finds the
// ray of each image, and the exact integral says which azimuth that ray sweeps.  A star at the
// angle phi_star has images where the swept azimuth is phi_star plus whole turns (even orders) and
// where it is whole turns minus phi_star (odd orders).
ExtremeResult seventh_ghost() {
  const double r = 30;
  const SkyTable table(r, Critical::kFirst);
  double worst = 0, nearest = 0;
  for (const double phi_star : {0.1, 1.0, 2.0, 3.0})
    for (int order = 0; order <= 7; ++order) {
      const double phi = order % 2 == 0 ? phi_star + order * pi : (order + 1) * pi - phi_star;
      const NullRay ray = table.ray_at_distance(table.distance(phi));
      worst = std::max(worst, std::abs(exact_azimuth(ray) - phi));
      // After the loops this is the seventh ghost of the last star, whose azimuth is 8 pi - 3.
      nearest = alpha_of(ray) - table.edge_angle();
    }
  return {
      worst,
      fmt::format("The seventh ghost stands {:.1e} rad from the edge, {:.2g} pixels of a 1k frame "
                  "160 mas wide",
                  nearest, nearest / (160e-3 / 3600 * pi / 180 / 1024))};
}

}  // namespace

std::vector<ExtremeCase> extreme_images() {
  return {
      {"StarOnTheAxis", "a star exactly behind the hole, exactly in front",
       "relative error of the amplification in front", 1e-6, star_on_the_axis},
      {"SeventhGhost", "ghost images up to the seventh, from 30 M", "error of phi", 1e-8,
       seventh_ghost},
  };
}

}  // namespace domefall
