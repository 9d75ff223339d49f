#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "pipeline/light/exact_azimuth.h"
#include "pipeline/light/hole_optics.h"
#include "pipeline/light/traced_ray.h"
#include "pipeline/report/extreme_cases.h"
#include "pipeline/report/ray_samples.h"

namespace domefall {
namespace {

using std::numbers::pi;

// SkyTable states 1e-9 for rays that are 1e-12 or more off an edge.  Rays here come nearer and have
// ten times that.
constexpr double kPhiBound = 1e-8;  // for the tables, which frames are made with

// A Worst collects the largest errors of the table and of the exact integral over many rays.  Its
// result is the table's error, or infinity if the integral exceeds its own bound.
class Worst {
 public:
  void add(const RayRequest& q) {
    const ReferenceRay truth = reference_ray(reference_request(q));
    const auto phi = static_cast<double>(truth.phi);
    const auto error = [&](TraceMethod method) {
      const TracedRay ray = trace_ray(q, method);
      // Where the slope is 0 the ray is on a caustic, and its amplification is rightly infinite.
      const bool finite = std::isfinite(ray.phi) && std::isfinite(ray.slope) &&
                          (std::isfinite(ray.amplification) || ray.slope == 0);
      const bool right = ray.origin == origin_from(truth.origin) && finite;
      return right ? std::abs(ray.phi - phi) / std::max(1.0, phi)
                   : std::numeric_limits<double>::infinity();
    };
    exact_ = std::max(exact_, error(TraceMethod::kExact));
    table_ = std::max(table_, error(TraceMethod::kTable));
    ++rays_;
  }
  ExtremeResult result(const std::string& more) const {
    // exact_azimuth.h states this bound.
    constexpr double kExactBound = 1e-13;
    const bool exact = exact_ <= kExactBound;
    return {exact ? table_ : std::numeric_limits<double>::infinity(),
            fmt::format("{} rays; integral within {:.1e}, tables {:.1e}. ", rays_, exact_, table_) +
                more};
  }

 private:
  double exact_ = 0, table_ = 0;
  int rays_ = 0;
};

RayRequest at_delta(TraceObserver observer, long double r, double delta) {
  RayRequest q;
  q.observer = observer;
  q.at = Radius(r);
  q.delta = delta;
  return q;
}

RayRequest off_edge(TraceObserver observer, long double r, Edge edge, double offset) {
  RayRequest q = at_delta(observer, r, 0);
  q.edge = edge;
  q.offset = offset;
  return q;
}

// Returns angles over the whole view, some of which lie next to the axis at either end.
const std::vector<double>& everywhere() {
  static const std::vector<double> angles{1e-9, 1e-5, 0.01, 0.3, 0.7,       1.1,      pi / 2,
                                          1.9,  2.3,  2.8,  3.1, pi - 1e-5, pi - 1e-9};
  return angles;
}

void add_everywhere(Worst& worst, TraceObserver observer, long double r) {
  for (const double delta : everywhere()) worst.add(at_delta(observer, r, delta));
}

// Adds rays on both sides of an edge, at offsets from `most` down to 1e-15 of it.
void add_beside(Worst& worst, TraceObserver observer, long double r, Edge edge, double most) {
  for (int decade = 0; decade <= 15; ++decade)
    for (const double side : {-1.0, 1.0})
      worst.add(off_edge(observer, r, edge, side * most * std::pow(10, -decade)));
}

ExtremeResult critical_impact_parameter() {
  Worst worst;
  for (const long double r : {0.5L, 2.5L, 10.0L})
    add_beside(worst, TraceObserver::kRain, r, Edge::kSilhouette, 1e-2);
  // These offsets are too small for any angle to hold.  By phi = -ln(offset) + c a ray nearer to
  // the edge must turn farther, by ln 10 for each decade, but only the growth is checked.  The loop
  // ends before doubles lose digits, at 2e-308.
  double before = 0;
  bool growing = true;
  for (double offset = 1e-16; offset > 1e-307; offset *= 1e-3) {
    const double phi = trace_ray(off_edge(TraceObserver::kRain, 10, Edge::kSilhouette, offset),
                                 TraceMethod::kTable)
                           .phi;
    growing = growing && std::isfinite(phi) && phi > before;
    before = phi;
  }
  ExtremeResult result = worst.result(fmt::format(
      "phi grows by ln 10 with each decade, to {:.0f} rad at an offset of 1e-307; on the edge "
      "itself it is infinite and counted to the singularity",
      before));
  if (!growing) result.worst = std::numeric_limits<double>::infinity();
  return result;
}

// The critical rays are the two roots of [Riazuelo] eq. tan_delta, whose difference has the factor
// r - 3.  They are one at r = 3, and a billionth beside it their plain difference would have lost
// nine digits.
ExtremeResult light_circle() {
  Worst worst;
  for (const long double r : {3.0L, 3 - 1e-9L, 3 + 1e-9L}) {
    for (const TraceObserver observer : {TraceObserver::kRain, TraceObserver::kStatic})
      add_beside(worst, observer, r, Edge::kSilhouette, 1e-2);
    add_everywhere(worst, TraceObserver::kOutgoing, r);
  }
  return worst.result("Both critical rays are one at r = 3; next to it their distance is carried");
}

// Each of the two frames crosses one horizon at r = 2, rain the future one and the outgoing frame
// the past one, and is regular there.
ExtremeResult beside_the_horizon() {
  Worst worst;
  for (const long double r : {2 - 2e-15L, 2 + 2e-15L})
    for (const TraceObserver observer : {TraceObserver::kRain, TraceObserver::kOutgoing})
      add_everywhere(worst, observer, r);
  add_everywhere(worst, TraceObserver::kRain, 2);
  return worst.result("Nothing happens to the falling observer at r = 2");
}

ExtremeResult static_at_the_horizon() {
  Worst worst;
  const long double r = 2 + 1e-12L;
  // The whole sky is 3.7e-6 radians wide, so the offsets from its edge are smaller than that.
  add_everywhere(worst, TraceObserver::kStatic, r);
  add_beside(worst, TraceObserver::kStatic, r, Edge::kSilhouette, 1e-7);
  const double one_plus_z =
      trace_ray(at_delta(TraceObserver::kStatic, r, pi), TraceMethod::kTable).one_plus_z;
  return worst.result(fmt::format(
      "The sky is a disc of {:.1e} rad, blueshifted by {:.2g}",
      pi - edge_delta(TraceObserver::kStatic, Radius(r), Edge::kSilhouette), 1 / one_plus_z));
}

// For small r both edges tend to tan(delta/2) = 1, and the silhouette's numerator r - (r - 3)
// sqrt(1 + 6/r) exceeds that of region III by 2 r.  The skies are therefore (sqrt 2/(3 sqrt 3))
// r^(3/2) = 2.7e-10 radians apart at 1e-6.
ExtremeResult deep_inside() {
  Worst worst;
  const long double r = 1e-6L;
  for (const TraceObserver observer :
       {TraceObserver::kRain, TraceObserver::kTwo, TraceObserver::kFour, TraceObserver::kOutgoing})
    add_everywhere(worst, observer, r);
  for (const Edge edge : {Edge::kSilhouette, Edge::kRegionThree})
    add_beside(worst, TraceObserver::kRain, r, edge, 1e-2);
  const auto edge = [&](Edge e) { return edge_delta(TraceObserver::kRain, Radius(r), e); };
  return worst.result(fmt::format("The two skies are {:.2g} rad apart",
                                  edge(Edge::kSilhouette) - edge(Edge::kRegionThree)));
}

// Far away the silhouette has the radius 3 sqrt(3)/r, 5.2e-8 radians, so the offsets from its edge
// are smaller than that.
ExtremeResult far_away() {
  Worst worst;
  const long double r = 1e8L;
  for (const TraceObserver observer :
       {TraceObserver::kRain, TraceObserver::kStatic, TraceObserver::kOutgoing}) {
    add_everywhere(worst, observer, r);
    add_beside(worst, observer, r, Edge::kSilhouette, 1e-8);
  }
  return worst.result(fmt::format("The silhouette has a radius of {:.1e} rad",
                                  edge_delta(TraceObserver::kRain, Radius(r), Edge::kSilhouette)));
}

// With r = 2 - d, region III is a disc of radius (3 sqrt 3/8) d about delta = 0, all of whose light
// has 1 + z = d/4 to first order (extreme_frames.cpp).  The parts of that radius lie inside
// and outside the disc, on both sides of its edge.
ExtremeResult first_light_of_region_three() {
  Worst worst;
  const long double r = 2 - 1e-9L;
  const double edge = edge_delta(TraceObserver::kRain, Radius(r), Edge::kRegionThree);
  for (const double part : {0.0, 1e-6, 0.1, 0.5, 0.9, 0.999999, 1.000001, 1.5, 10.0})
    worst.add(at_delta(TraceObserver::kRain, r, part * edge));
  add_beside(worst, TraceObserver::kRain, r, Edge::kRegionThree, edge / 2);
  const double middle =
      trace_ray(at_delta(TraceObserver::kRain, r, 0), TraceMethod::kTable).one_plus_z;
  const double rim = trace_ray(off_edge(TraceObserver::kRain, r, Edge::kRegionThree, -edge * 1e-9),
                               TraceMethod::kTable)
                         .one_plus_z;
  return worst.result(
      fmt::format("It is a disc of {:.2g} rad; the blueshift is {:.1e} in the middle and {:.1e} "
                  "at the rim, and grows without bound towards r = 2",
                  edge, 1 / middle, 1 / rim));
}

// In T_II the skies have the radius arctan(sqrt(27 (2/r - 1))/r) about delta = 0 and pi, by L/|E| =
// r tan(delta)/sqrt(2/r - 1) = sqrt 27.  It vanishes with sqrt(2 - r).
ExtremeResult resting_in_t_beside_the_horizon() {
  Worst worst;
  for (const long double r : {2 - 1e-9L, 2 - 1e-12L, 2 - 1e-15L})
    for (const TraceObserver observer : {TraceObserver::kTwo, TraceObserver::kFour})
      add_everywhere(worst, observer, r);
  for (const Edge edge : {Edge::kSilhouette, Edge::kRegionThree})
    add_beside(worst, TraceObserver::kTwo, 2 - 1e-9L, edge, 1e-6);
  return worst.result("Both skies shrink to points, and almost the whole view shows the antipode");
}

// The observer at constant t sees a ray with E = 0 at delta = pi/2.  From the singularity it has
// swept int dr/sqrt(2 r - r^2) = arcsin(r - 1) + pi/2 in region IV ([Riazuelo] fig. fig_IV_dev),
// and 2 pi minus that in region II.  So phi must come to pi from both sides at the sphere where the
// horizons cross.  With r = 2 - d the distance pi - phi is arccos(1 - d) = 2 arcsin(sqrt(d/2)), in
// which nothing cancels.
ExtremeResult bifurcation() {
  double worst = 0;
  for (const double depth : {1e-3, 1e-6, 1e-9, 1e-12, 1e-15}) {
    const long double r = 2 - static_cast<long double>(depth);
    const double expected = 2 * std::asin(std::sqrt(depth / 2));
    const auto phi = [&](TraceObserver observer, TraceMethod method) {
      RayRequest q = at_delta(observer, r, 0);
      q.delta = std::numbers::pi_v<long double> / 2;
      return trace_ray(q, method).phi;
    };
    for (const TraceMethod method : {TraceMethod::kExact, TraceMethod::kTable}) {
      worst = std::max(worst, std::abs(pi - phi(TraceObserver::kFour, method) - expected));
      worst = std::max(worst, std::abs(phi(TraceObserver::kTwo, method) - pi - expected));
    }
  }
  return {worst, "The azimuth at E = 0 passes through pi without a step from IV to II"};
}

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
  const SkyTable table(schwarzschild_zone(r, Critical::kFirst));
  double worst = 0, nearest = 0;
  for (const double phi_star : {0.1, 1.0, 2.0, 3.0})
    for (int order = 0; order <= 7; ++order) {
      const double phi = order % 2 == 0 ? phi_star + order * pi : (order + 1) * pi - phi_star;
      const double x = table.distance(phi);
      worst = std::max(worst, std::abs(table.zone().azimuth(4 * std::atan(x / 2)) - phi));
      // After the loops this is the seventh ghost of the last star, whose azimuth is 8 pi - 3.
      nearest = table.ray_at_distance(x).half.angle() - table.zone().edge.half.angle();
    }
  return {
      worst,
      fmt::format("The seventh ghost stands {:.1e} rad from the edge, {:.2g} pixels of a 1k frame "
                  "160 mas wide",
                  nearest, nearest / (160e-3 / 3600 * pi / 180 / 1024))};
}

}  // namespace

std::vector<ExtremeCase> extreme_rays() {
  const std::string phi = "error of phi, of max(1, phi)";
  return {
      {"CriticalImpactParameter", "b → b_c from both sides, to the last bit", phi, kPhiBound,
       critical_impact_parameter},
      {"LightCircle", "r = 3 and 3(1 ± 3e-10): observers on the light circle", phi, kPhiBound,
       light_circle},
      {"BesideTheHorizon", "r = 2 and 2(1 ± 1e-15)", phi, kPhiBound, beside_the_horizon},
      {"StaticAtTheHorizon", "static at r = 2 + 1e-12", phi, kPhiBound, static_at_the_horizon},
      {"DeepInside", "r = 1e-6", phi, kPhiBound, deep_inside},
      {"FarAway", "r = 1e8", phi, kPhiBound, far_away},
      {"FirstLightOfRegionThree", "r = 2 - 1e-9, a moment after the crossing", phi, kPhiBound,
       first_light_of_region_three},
      {"RestingInTBesideTheHorizon", "T_II and T_IV at r = 2 - 1e-9 to 2 - 1e-15", phi, kPhiBound,
       resting_in_t_beside_the_horizon},
      {"Bifurcation", "E = 0 up to the sphere where the horizons cross", "error of phi", kPhiBound,
       bifurcation},
      {"StarOnTheAxis", "a star exactly behind the hole, exactly in front",
       "relative error of the amplification in front", 1e-6, star_on_the_axis},
      {"SeventhGhost", "ghost images up to the seventh, from 30 M", "error of phi", 1e-8,
       seventh_ghost},
  };
}

}  // namespace domefall
