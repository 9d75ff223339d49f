// Traces batches of rays that a hole lenses, by SIMD code.
#include <algorithm>
#include <cmath>

#include "pipeline/base/simd/dispatch.h"
#include "pipeline/base/simd/vector_math.h"
#include "pipeline/light/azimuth_batch.h"
#include "pipeline/light/singularity_light.h"
#include "pipeline/light/spherical_lens.h"

namespace domefall {
namespace {

// An Observer holds what the loops need to know of the observer.  Each loop copies it, so that the
// compiler knows that no store of the loop alters it.
struct Observer {
  M33d axes;  // of R, Theta and Phi on the sky
  ViewEnergy energy;
  double inward;  // of SkyZone
};

// TetradRays holds the sine of each ray's alpha, and the sine and cosine of alpha/2.
struct TetradRays {
  ViewRayBatch::Column<double> sine, sin_half, cos_half;
};

// LensedRays holds the azimuths of rays and how fast these change with alpha.
struct LensedRays {
  AzimuthBatch azimuths;
  ViewRayBatch::Column<double> rate;   // d x/d alpha on the white hole's curve
  ViewRayBatch::Column<double> slope;  // |d phi/d alpha|
};
static_assert(AzimuthBatch::kSize == ViewRayBatch::kSize);
// These are the curves of an AzimuthBatch, in the order in which rays are assigned to them: the two
// parts of HoleOptics, and the past singularity of the white hole for all rays that neither has.
constexpr int kFirst = 0, kSecond = 1, kHole = 2;

// ---- angles from the hole ----

// Sets the frequency ratio of light from a sky too.
[[gnu::always_inline]] inline void find_angles_loop(const Observer& observer,
                                                    const DirectionBatch& __restrict n, int count,
                                                    TetradRays& __restrict rays,
                                                    ViewRayBatch& __restrict batch) {
  const Observer o = observer;
  for (int k = 0; k < count; ++k) {
    const double sine = std::sqrt(n.y[k] * n.y[k] + n.z[k] * n.z[k]);
    const HalfAngle half = half_angle(-o.inward * n.x[k], sine);
    const double energy = o.energy.one_plus_z(o.energy.sine2 * half.sine * half.sine +
                                              o.energy.cosine2 * half.cosine * half.cosine);
    rays.sine[k] = sine;
    rays.sin_half[k] = half.sine;
    rays.cos_half[k] = half.cosine;
    batch.frequency_ratio[k] = 1 / energy;
    batch.emission_time[k] = batch.time_scale[k] = 0;
  }
}
Dispatched<find_angles_loop> find_angles;

// ---- which sky a ray comes from ----

// EdgeValues holds the edge of a sky.  It counts as an edge in the image unless both sides of it
// are dark.
struct EdgeValues {
  SkyEdge edge;
  bool counts;
};

// Assigns the rays on the sky's side of its edge to that sky's part, unless one before has them.  The
// coordinate x is half the angle to the edge to first order.
[[gnu::always_inline]] inline void assign_loop(const EdgeValues& values, std::int64_t part,
                                               const TetradRays& __restrict rays, int count,
                                               LensedRays& __restrict lensed,
                                               double* __restrict to_edge) {
  const EdgeValues e = values;
  for (int k = 0; k < count; ++k) {
    const double x = e.edge.distance(rays.sin_half[k], rays.cos_half[k]);
    const bool on = (lensed.azimuths.curve[k] == kHole) & (x > 0);
    lensed.azimuths.x[k] = on ? x : lensed.azimuths.x[k];
    lensed.azimuths.curve[k] = on ? part : lensed.azimuths.curve[k];
    const double beside = 2 * std::abs(x);
    const double away = e.counts ? (beside > e.edge.width ? beside : e.edge.width) : HUGE_VAL;
    to_edge[k] = away < to_edge[k] ? away : to_edge[k];
  }
}
Dispatched<assign_loop> assign;

// Sets the coordinate x of the rays that belong to the hole (WhiteHoleTable::Place::s), and
// d x/d alpha of all rays.
[[gnu::always_inline]] inline void locate_in_hole_loop(const WhiteHolePlace& white_hole,
                                                       const TetradRays& __restrict rays, int count,
                                                       LensedRays& __restrict lensed) {
  const WhiteHolePlace place = white_hole;
  for (int k = 0; k < count; ++k) {
    double rate = 0;
    const double x = place(rays.sin_half[k], rays.cos_half[k], rate);
    lensed.azimuths.x[k] = lensed.azimuths.curve[k] == kHole ? x : lensed.azimuths.x[k];
    lensed.rate[k] = rate;
  }
}
Dispatched<locate_in_hole_loop> locate_in_hole;

// ---- azimuths from the tables ----

// Turns d phi/d x of the skies' curves into |d phi/d alpha|.  From x = 2 tan(|alpha - edge|/4)
// follows |d x/d alpha| = (1 + x^2/4)/2.
[[gnu::always_inline]] inline void set_slopes_loop(int count, LensedRays& __restrict lensed) {
  for (int k = 0; k < count; ++k) {
    const double x = lensed.azimuths.x[k], slope = std::abs(lensed.azimuths.slope[k]);
    lensed.slope[k] = slope * ((1 + x * x / 4) / 2);
  }
}
Dispatched<set_slopes_loop> set_slopes;

// Does the same for the rays of the hole.  No redshift is defined for their light, so its
// frequency ratio becomes 1.
[[gnu::always_inline]] inline void set_hole_slopes_loop(int count, LensedRays& __restrict lensed,
                                                        double* __restrict frequency_ratio) {
  for (int k = 0; k < count; ++k) {
    const bool hole = lensed.azimuths.curve[k] == kHole;
    const double steep = std::abs(lensed.azimuths.slope[k] * lensed.rate[k]);
    const double slope = steep < kSteepestSlope ? steep : kSteepestSlope;
    lensed.slope[k] = hole ? slope : lensed.slope[k];
    frequency_ratio[k] = hole ? 1 : frequency_ratio[k];
  }
}
Dispatched<set_hole_slopes_loop> set_hole_slopes;

// Returns the tables of the first and the second part, each of which may be null.
std::array<const SkyTable*, 2> tables_of(const HoleOptics& optics) {
  std::array<const SkyTable*, 2> tables{};
  for (std::size_t k = 0; k < optics.parts.size(); ++k)
    if (optics.parts[k].table) tables[k] = &*optics.parts[k].table;
  return tables;
}

// CurveRanges holds the coordinates between which each curve is tabulated.
struct CurveRanges {
  std::array<double, AzimuthBatch::kCurves> low, high;
};

CurveRanges ranges_of(const HoleOptics& optics) {
  CurveRanges ranges;
  ranges.low.fill(-HUGE_VAL);
  ranges.high.fill(HUGE_VAL);
  const auto [first, second] = tables_of(optics);
  if (first) ranges.low[kFirst] = first->curve().x_min(), ranges.high[kFirst] = first->curve_end();
  if (second)
    ranges.low[kSecond] = second->curve().x_min(), ranges.high[kSecond] = second->curve_end();
  if (!optics.white_hole) return ranges;
  ranges.low[kHole] = optics.white_hole->lookup().low;
  ranges.high[kHole] = optics.white_hole->lookup().high;
  return ranges;
}

// Says whether any ray lies outside the range of its curve.
[[gnu::always_inline]] inline bool any_outside_loop(const CurveRanges& ranges,
                                                    const AzimuthBatch& azimuths, int count) {
  const CurveRanges r = ranges;
  std::int64_t outside = 0;
  for (int k = 0; k < count; ++k) {
    const double x = azimuths.x[k];
    const std::int64_t c = azimuths.curve[k];
    const double low = c == kFirst ? r.low[kFirst] : c == kSecond ? r.low[kSecond] : r.low[kHole];
    const double high = c == kFirst    ? r.high[kFirst]
                        : c == kSecond ? r.high[kSecond]
                                       : r.high[kHole];
    outside |= ((x >= low) & (x <= high)) ? 0 : 1;
  }
  return outside != 0;
}
Dispatched<any_outside_loop> any_outside;

// Returns the three curves that find_azimuths needs.  Another table takes the place of a missing
// one, and nothing reads the azimuths that are found there.
std::array<OctaveCurve::Lookup, AzimuthBatch::kCurves> curves_of(const HoleOptics& optics) {
  const auto [first, second] = tables_of(optics);
  const SkyTable* any = first ? first : second;
  std::array<OctaveCurve::Lookup, AzimuthBatch::kCurves> curves;
  curves.fill(any ? any->curve().lookup() : optics.white_hole->curve().lookup());
  if (second) curves[kSecond] = second->curve().lookup();
  if (optics.white_hole) curves[kHole] = optics.white_hole->curve().lookup();
  return curves;
}

// Sets the azimuths of rays that lie outside the curves, next to an edge or the axis, where the
// tables go on with fitted laws or another curve.  Such rays are taken one by one.
void apply_laws(const HoleOptics& optics, const CurveRanges& ranges, const TetradRays& rays,
                int count, LensedRays& lensed) {
  const std::array<const SkyTable*, 2> tables = tables_of(optics);
  for (int k = 0; k < count; ++k) {
    const auto curve = static_cast<std::size_t>(lensed.azimuths.curve[k]);
    const double x = lensed.azimuths.x[k];
    if (x >= ranges.low[curve] && x <= ranges.high[curve]) continue;
    if (curve == kHole && optics.white_hole) {
      const auto at = optics.white_hole->place_of(rays.sin_half[k], rays.cos_half[k]);
      lensed.azimuths.azimuth[k] = optics.white_hole->azimuth(at);
      lensed.slope[k] = bounded_slope(*optics.white_hole, at);
    }
    if (curve == kHole || !tables[curve]) continue;
    lensed.azimuths.azimuth[k] = tables[curve]->azimuth(x);
    lensed.slope[k] = tables[curve]->slope(x);
  }
}

void set_azimuths(const HoleOptics& optics, const TetradRays& rays, int count, LensedRays& lensed,
                  ViewRayBatch& batch) {
  // Without a table all skies are black.  Zeros keep finite what is still computed.
  const auto [first, second] = tables_of(optics);
  if (!first && !second && !optics.white_hole) {
    std::fill_n(lensed.azimuths.azimuth.begin(), count, 0.0);
    std::fill_n(lensed.slope.begin(), count, 0.0);
    return;
  }
  if (optics.white_hole) locate_in_hole(optics.white_hole->lookup().place, rays, count, lensed);
  find_azimuths(curves_of(optics), count, lensed.azimuths);
  set_slopes(count, lensed);
  if (optics.white_hole) set_hole_slopes(count, lensed, batch.frequency_ratio.data());
  const CurveRanges ranges = ranges_of(optics);
  if (any_outside(ranges, lensed.azimuths, count)) apply_laws(optics, ranges, rays, count, lensed);
}

void add_emission_times(const HoleOptics& optics, const TetradRays& rays, const LensedRays& lensed,
                        int count, ViewRayBatch& batch) {
  for (int k = 0; k < count; ++k) {
    if (lensed.azimuths.curve[k] != kHole) continue;
    const auto value = emission_of(optics, {rays.sin_half[k], rays.cos_half[k]},
                                   lensed.azimuths.azimuth[k], lensed.slope[k]);
    batch.emission_time[k] = value.time;
    batch.time_scale[k] = value.slope;
  }
}

// ---- onto the sky ----

// Finds where on the sky the light started.  Light that sweeps the azimuth phi in the plane of R
// and the ray comes from cos(phi) R + sin(phi) e, with e the part of the ray across R made a unit
// vector.  The derivative of this by phi is the direction `along`.
[[gnu::always_inline]] inline void onto_sky_loop(const Observer& observer, const DirectionBatch& n,
                                                 const TetradRays& rays, const LensedRays& lensed,
                                                 int count, ViewRayBatch& batch) {
  const Observer o = observer;
  for (int k = 0; k < count; ++k) {
    const SineCosine phi = sin_cos(lensed.azimuths.azimuth[k]);
    const double sine = rays.sine[k];
    // On the axis e does not exist.  SIMD code divides there all the same, hence by 1.
    const double inverse = sine > 0 ? 1 / (sine > 0 ? sine : 1) : 0;
    const double across = phi.sine * inverse;
    const double back = phi.cosine * inverse;
    const V3d sky = apply(o.axes, V3d(phi.cosine, n.y[k] * across, n.z[k] * across));
    batch.sky_x[k] = sky.x;
    batch.sky_y[k] = sky.y;
    batch.sky_z[k] = sky.z;
    const V3d along = apply(o.axes, V3d(-phi.sine, n.y[k] * back, n.z[k] * back));
    batch.along_x[k] = along.x;
    batch.along_y[k] = along.y;
    batch.along_z[k] = along.z;
    batch.scale_along[k] = lensed.slope[k];
    batch.scale_across[k] = std::abs(across);
  }
}
Dispatched<onto_sky_loop> onto_sky;

// Puts the rays of sky III, which have the axes of sky I, onto their own sky.
void turn_far_rays(const PerSky<M33d>& axes, int count, ViewRayBatch& batch) {
  const M33d& from = axes[SkyRegion::kI];
  const M33d& to = axes[SkyRegion::kIII];
  for (int k = 0; k < count; ++k) {
    if (batch.sky[k] != SkyRegion::kIII) continue;
    const V3d sky = apply(to, apply_transposed(from, batch.sky_direction(k)));
    const V3d along = apply(to, apply_transposed(from, batch.along(k)));
    batch.sky_x[k] = sky.x, batch.sky_y[k] = sky.y, batch.sky_z[k] = sky.z;
    batch.along_x[k] = along.x, batch.along_y[k] = along.y, batch.along_z[k] = along.z;
  }
}

}  // namespace

void SphericalLens::rays(const DirectionBatch& n, int count, ViewRayBatch& batch) const {
  const Observer observer{axes_[SkyRegion::kI], optics_->energy, optics_->inward};
  TetradRays rays;
  find_angles(observer, n, count, rays, batch);
  LensedRays lensed;
  double* to_edge = batch.to_edge.data();
  std::fill_n(lensed.azimuths.curve.begin(), count, std::int64_t{kHole});
  std::fill_n(lensed.azimuths.x.begin(), count, -1.0);
  std::fill_n(to_edge, count, HUGE_VAL);
  const std::vector<SkyPart>& parts = optics_->parts;
  for (std::size_t k = 0; k < parts.size(); ++k) {
    const SkyPart& part = parts[k];
    assign({part.zone.edge, part.table || optics_->white_hole}, static_cast<std::int64_t>(k), rays,
           count, lensed, to_edge);
  }
  std::array<SkyRegion, AzimuthBatch::kCurves> skies;
  skies.fill(SkyRegion::kIV);
  for (std::size_t k = 0; k < parts.size(); ++k) skies[k] = parts[k].sky;
  for (int k = 0; k < count; ++k)
    batch.sky[k] = skies[static_cast<std::size_t>(lensed.azimuths.curve[k])];
  set_azimuths(*optics_, rays, count, lensed, batch);
  if (optics_->emission_times) add_emission_times(*optics_, rays, lensed, count, batch);
  onto_sky(observer, n, rays, lensed, count, batch);
  if (far_mirrored_) turn_far_rays(axes_, count, batch);
}

}  // namespace domefall
