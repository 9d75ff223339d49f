// Many looks at a time at what a hole bends.
#include <algorithm>
#include <cmath>
#include <optional>

#include "pipeline/render/rays/azimuth_batch.h"
#include "pipeline/render/rays/lensed_ray_parts.h"
#include "pipeline/render/rays/view_tracer.h"
#include "pipeline/simd/dispatch.h"
#include "pipeline/simd/vector_math.h"

namespace domefall {
namespace {

// What a loop over directions needs of the frame, by value: nothing it stores can change it.
struct Frame {
  M33d tetrad_from_camera, sky_from_tetrad;
  Aberration aberration;
  double s, one_minus_s;
  double inward;  // +1: alpha counts from -R; -1 (outgoing tetrad): from +R
};

// Directions in the rain frame and what leads to the tables.
struct Rain {
  ViewRayBatch::Column<double> x, y, z, sine, sin_half, cos_half, doppler, inverse_doppler;
};

// Rays' azimuths, and how fast they change with the angle from the axis.
struct Bent {
  AzimuthBatch sweeps;
  ViewRayBatch::Column<double> rate;  // of the white hole's coordinate by that angle
  ViewRayBatch::Column<double> slope;
};
static_assert(AzimuthBatch::kSize == ViewRayBatch::kSize);
// In the order in which a ray is asked for.
constexpr int kHome = 0, kFar = 1, kHole = 2;

[[gnu::always_inline]] inline void to_rain_loop(const Frame& frame, const CameraDirection* n,
                                                int count, Rain& rain, ViewRayBatch& batch) {
  const Frame f = frame;
  for (int k = 0; k < count; ++k) {
    const AberratedLight in = f.aberration.to_rest(apply(f.tetrad_from_camera, n[k].v));
    const V3d d = in.direction;
    const double sine = std::sqrt(d.y * d.y + d.z * d.z);
    const HalfAngle half = half_angle(-f.inward * d.x, sine);
    const double energy =
        std::abs((1 + f.s) * half.sine * half.sine + f.one_minus_s * half.cosine * half.cosine);
    rain.x[k] = d.x, rain.y[k] = d.y, rain.z[k] = d.z;
    rain.sine[k] = sine, rain.sin_half[k] = half.sine, rain.cos_half[k] = half.cosine;
    const double inverse = 1 / in.frequency_ratio;
    rain.doppler[k] = in.frequency_ratio, rain.inverse_doppler[k] = inverse;
    batch.frequency_ratio[k] = inverse / energy;
  }
}
Dispatched<to_rain_loop> to_rain;

[[gnu::always_inline]] inline void flat_sky_loop(const Frame& frame, const Rain& rain, int count,
                                                 ViewRayBatch& batch) {
  const Frame f = frame;
  for (int k = 0; k < count; ++k) {
    const V3d sky = apply(f.sky_from_tetrad, V3d(rain.x[k], rain.y[k], rain.z[k]));
    batch.sky_x[k] = sky.x, batch.sky_y[k] = sky.y, batch.sky_z[k] = sky.z;
    batch.frequency_ratio[k] = rain.inverse_doppler[k];
    batch.along_x[k] = batch.along_y[k] = batch.along_z[k] =
        0;  // as good as any: a round footprint
    batch.radial_scale[k] = batch.tangential_scale[k] = rain.inverse_doppler[k];
    batch.to_edge[k] = HUGE_VAL;
  }
}
Dispatched<flat_sky_loop> flat_sky;

// Of an edge: whether it counts as one, since between the dark and the dark there is none.
struct Edge {
  SkyEdge edge;
  bool counts;
};

// Rays on the home sky, with their coordinate in its table; all others are the hole's for now.
[[gnu::always_inline]] inline void take_home_loop(const Edge& of, const Rain& __restrict rain,
                                                  int count, Bent& __restrict bent,
                                                  double* __restrict to_edge) {
  const Edge e = of;
  for (int k = 0; k < count; ++k) {
    const double x = e.edge.distance(rain.sin_half[k], rain.cos_half[k]);
    bent.sweeps.x[k] = x;
    bent.sweeps.curve[k] = x > 0 ? kHome : kHole;
    const double away = 2 * std::abs(x) * rain.doppler[k];
    to_edge[k] = e.counts ? away : HUGE_VAL;
  }
}
Dispatched<take_home_loop> take_home;

[[gnu::always_inline]] inline void take_far_loop(const Edge& of, const Rain& __restrict rain,
                                                 int count, Bent& __restrict bent,
                                                 double* __restrict to_edge) {
  const Edge e = of;
  for (int k = 0; k < count; ++k) {
    const double x = e.edge.distance(rain.sin_half[k], rain.cos_half[k]);
    const bool on = (bent.sweeps.curve[k] == kHole) & (x > 0);
    bent.sweeps.x[k] = on ? x : bent.sweeps.x[k];
    bent.sweeps.curve[k] = on ? kFar : bent.sweeps.curve[k];
    const double away = e.counts ? 2 * std::abs(x) * rain.doppler[k] : HUGE_VAL;
    to_edge[k] = away < to_edge[k] ? away : to_edge[k];
  }
}
Dispatched<take_far_loop> take_far;

[[gnu::always_inline]] inline void take_hole_loop(const WhiteHolePlace& of,
                                                  const Rain& __restrict rain, int count,
                                                  Bent& __restrict bent) {
  const WhiteHolePlace place = of;
  for (int k = 0; k < count; ++k) {
    double rate = 0;
    const double s = place(rain.sin_half[k], rain.cos_half[k], rate);
    bent.sweeps.x[k] = bent.sweeps.curve[k] == kHole ? s : bent.sweeps.x[k];
    bent.rate[k] = rate;
  }
}
Dispatched<take_hole_loop> take_hole;

// d phi/d alpha in absolute value, from the slopes of the curves.
[[gnu::always_inline]] inline void set_slopes_loop(int count, Bent& __restrict bent) {
  for (int k = 0; k < count; ++k) {
    const double x = bent.sweeps.x[k], slope = std::abs(bent.sweeps.slope[k]);
    bent.slope[k] = slope * ((1 + x * x / 4) / 2);
  }
}
Dispatched<set_slopes_loop> set_slopes;

// The same for those of the hole, whose light has no redshift.
[[gnu::always_inline]] inline void set_hole_slopes_loop(int count, Bent& __restrict bent,
                                                        double* __restrict frequency_ratio) {
  for (int k = 0; k < count; ++k) {
    const bool hole = bent.sweeps.curve[k] == kHole;
    const double steep = std::abs(bent.sweeps.slope[k] * bent.rate[k]);
    const double slope = steep < kSteepest ? steep : kSteepest;
    bent.slope[k] = hole ? slope : bent.slope[k];
    frequency_ratio[k] = hole ? 1 : frequency_ratio[k];
  }
}
Dispatched<set_hole_slopes_loop> set_hole_slopes;

// Whether any ray is beyond where its curve reaches.
struct Reach {
  std::array<double, AzimuthBatch::kCurves> low, high;
};
[[gnu::always_inline]] inline bool any_beyond_loop(const Reach& of, const AzimuthBatch& sweeps,
                                                   int count) {
  const Reach r = of;
  std::int64_t beyond = 0;
  for (int k = 0; k < count; ++k) {
    const double x = sweeps.x[k];
    const std::int64_t c = sweeps.curve[k];
    const double low = c == kHome ? r.low[kHome] : c == kFar ? r.low[kFar] : r.low[kHole];
    const double high = c == kHole ? r.high[kHole] : HUGE_VAL;
    beyond |= ((x >= low) & (x <= high)) ? 0 : 1;
  }
  return beyond != 0;
}
Dispatched<any_beyond_loop> any_beyond;

[[gnu::always_inline]] inline void onto_sky_loop(const Frame& frame, const Rain& rain,
                                                 const Bent& bent, int count, ViewRayBatch& batch) {
  const Frame f = frame;
  for (int k = 0; k < count; ++k) {
    const SineCosine phi = sin_cos(bent.sweeps.value[k]);
    const double sine = rain.sine[k];
    const double inverse = sine > 0 ? 1 / (sine > 0 ? sine : 1) : 0;
    const double across = phi.sine * inverse, back = phi.cosine * inverse;
    const V3d sky =
        apply(f.sky_from_tetrad, V3d(phi.cosine, rain.y[k] * across, rain.z[k] * across));
    batch.sky_x[k] = sky.x, batch.sky_y[k] = sky.y, batch.sky_z[k] = sky.z;
    const V3d along = apply(f.sky_from_tetrad, V3d(-phi.sine, rain.y[k] * back, rain.z[k] * back));
    batch.along_x[k] = along.x, batch.along_y[k] = along.y, batch.along_z[k] = along.z;
    batch.radial_scale[k] = bent.slope[k] * rain.inverse_doppler[k];
    batch.tangential_scale[k] = std::abs(across) * rain.inverse_doppler[k];
  }
}
Dispatched<onto_sky_loop> onto_sky;

void add_emission_times(const HoleOptics& optics, const Rain& rain, const Bent& bent, int count,
                        ViewRayBatch& batch) {
  for (int k = 0; k < count; ++k) {
    if (bent.sweeps.curve[k] != kHole) continue;
    const auto value = emission_of(optics, rain.sin_half[k], rain.cos_half[k], bent.sweeps.value[k],
                                   bent.slope[k]);
    batch.emission_time[k] = value.time;
    batch.time_scale[k] = value.slope * rain.inverse_doppler[k];
  }
}

// Every curve is one, if any is.
std::array<OctaveCurve::Lookup, AzimuthBatch::kCurves> curves_of(const HoleOptics& optics) {
  const auto& any = optics.home_sky ? optics.home_sky : optics.far_sky;
  std::array<OctaveCurve::Lookup, AzimuthBatch::kCurves> curves;
  curves.fill(any ? any->curve().lookup() : optics.white_hole->curve().lookup());
  if (optics.far_sky) curves[kFar] = optics.far_sky->curve().lookup();
  if (optics.white_hole) curves[kHole] = optics.white_hole->curve().lookup();
  return curves;
}

// Beyond the curves the tables have laws.
void follow_laws(const HoleOptics& optics, const Reach& reach, const Rain& rain, int count,
                 Bent& bent) {
  for (int k = 0; k < count; ++k) {
    const auto curve = static_cast<std::size_t>(bent.sweeps.curve[k]);
    const double x = bent.sweeps.x[k];
    if (x >= reach.low[curve] && x <= reach.high[curve]) continue;
    if (curve == kHole && optics.white_hole) {
      const auto at = optics.white_hole->place_of(rain.sin_half[k], rain.cos_half[k]);
      bent.sweeps.value[k] = optics.white_hole->azimuth(at);
      bent.slope[k] = std::min(std::abs(optics.white_hole->slope(at)), kSteepest);
    }
    const auto& table = curve == kHome ? optics.home_sky : optics.far_sky;
    if (curve == kHole || !table) continue;
    bent.sweeps.value[k] = table->azimuth(x);
    bent.slope[k] = table->slope(x);
  }
}

Reach reach_of(const HoleOptics& optics) {
  Reach reach;
  reach.low.fill(-HUGE_VAL), reach.high.fill(HUGE_VAL);
  if (optics.home_sky) reach.low[kHome] = optics.home_sky->curve().x_min();
  if (optics.far_sky) reach.low[kFar] = optics.far_sky->curve().x_min();
  if (!optics.white_hole) return reach;
  reach.low[kHole] = optics.white_hole->lookup().low;
  reach.high[kHole] = optics.white_hole->lookup().high;
  return reach;
}

void sweep(const HoleOptics& optics, const Rain& rain, int count, Bent& bent, ViewRayBatch& batch) {
  if (!optics.home_sky && !optics.far_sky && !optics.white_hole) {
    std::fill_n(bent.sweeps.value.begin(), count, 0.0);
    std::fill_n(bent.slope.begin(), count, 0.0);
    return;
  }
  if (optics.white_hole) take_hole(optics.white_hole->lookup().place, rain, count, bent);
  look_up(curves_of(optics), count, bent.sweeps);
  set_slopes(count, bent);
  if (optics.white_hole) set_hole_slopes(count, bent, batch.frequency_ratio.data());
  const Reach reach = reach_of(optics);
  if (any_beyond(reach, bent.sweeps, count)) follow_laws(optics, reach, rain, count, bent);
}

}  // namespace

void ViewTracer::lensed_rays(const CameraDirection* n, int count, ViewRayBatch& batch) const {
  const Frame frame{tetrad_from_camera_, sky_from_tetrad_,      Aberration(vantage_.celerity), s_,
                    one_minus_s_,        outgoing_ ? -1.0 : 1.0};
  Rain rain;
  to_rain(frame, n, count, rain, batch);
  if (flat_) {
    std::fill_n(batch.sky.begin(), count, SkyRegion::kI);
    flat_sky(frame, rain, count, batch);
    return;
  }
  Bent bent;
  double* to_edge = batch.to_edge.data();
  // Between the dark and the dark there is no edge.
  const auto edge = [&](const SkyEdge& of, const std::optional<SkyTable>& table) {
    return Edge{of, table || optics_.white_hole};
  };
  if (optics_.home_edge) {
    take_home(edge(*optics_.home_edge, optics_.home_sky), rain, count, bent, to_edge);
  } else {
    std::fill_n(bent.sweeps.curve.begin(), count, std::int64_t{kHole});
    std::fill_n(bent.sweeps.x.begin(), count, -1.0);
    std::fill_n(to_edge, count, HUGE_VAL);
  }
  if (optics_.far_edge)
    take_far(edge(*optics_.far_edge, optics_.far_sky), rain, count, bent, to_edge);
  for (int k = 0; k < count; ++k)
    batch.sky[k] = bent.sweeps.curve[k] == kHome  ? home_
                   : bent.sweeps.curve[k] == kFar ? far_
                                                  : SkyRegion::kIV;
  sweep(optics_, rain, count, bent, batch);
  if (optics_.emission_times) add_emission_times(optics_, rain, bent, count, batch);
  onto_sky(frame, rain, bent, count, batch);
}

}  // namespace domefall
