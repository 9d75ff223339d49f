#include "pipeline/render/view_tracer.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "pipeline/render/simd.h"
#include "pipeline/render/vector_math.h"

namespace domefall {
namespace {

// Sine and cosine of delta/2 from those of delta, without cancellation.
struct HalfAngle {
  double sine, cosine;
};
inline HalfAngle half_angle(double cos_delta, double sin_delta) {
  const double larger = std::sqrt((1 + std::abs(cos_delta)) / 2);
  const double smaller = sin_delta / (2 * larger);
  return cos_delta >= 0 ? HalfAngle{smaller, larger} : HalfAngle{larger, smaller};
}

// What a loop over directions needs of the frame, by value: nothing it stores can change it.
struct Frame {
  M33d tetrad_from_camera, sky_from_tetrad;
  Aberration aberration;
  double s, one_minus_s;
  double inward;  // +1: alpha counts from -R; -1 (outgoing tetrad): from +R
};

// Directions in the rain frame and what leads to the tables.
struct Rain {
  LookBatch::Column<double> x, y, z, sine, sin_half, cos_half, inverse_doppler;
};

[[gnu::always_inline]] inline void to_rain_loop(const Frame& frame, const CameraDirection* n,
                                                int count, Rain& rain, LookBatch& batch) {
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
    rain.inverse_doppler[k] = 1 / in.frequency_ratio;
    batch.frequency_ratio[k] = rain.inverse_doppler[k] / energy;
    batch.to_edge[k] = HUGE_VAL;
  }
}
Dispatched<to_rain_loop> to_rain;

[[gnu::always_inline]] inline void flat_sky_loop(const Frame& frame, const Rain& rain, int count,
                                                 LookBatch& batch) {
  const Frame f = frame;
  for (int k = 0; k < count; ++k) {
    const V3d sky = apply(f.sky_from_tetrad, V3d(rain.x[k], rain.y[k], rain.z[k]));
    batch.sky_x[k] = sky.x, batch.sky_y[k] = sky.y, batch.sky_z[k] = sky.z;
    batch.frequency_ratio[k] = rain.inverse_doppler[k];
    batch.along_x[k] = batch.along_y[k] = batch.along_z[k] =
        0;  // as good as any: a round footprint
    batch.radial_scale[k] = batch.tangential_scale[k] = rain.inverse_doppler[k];
  }
}
Dispatched<flat_sky_loop> flat_sky;

// Distances from an edge: the coordinate of its table, and the angle of view.
[[gnu::always_inline]] inline void distances_loop(const SkyEdge& sky_edge, const Rain& rain,
                                                  int count, double* distance, double* away) {
  const SkyEdge edge = sky_edge;
  for (int k = 0; k < count; ++k) {
    const double x = edge.distance(rain.sin_half[k], rain.cos_half[k]);
    distance[k] = x;
    away[k] = 2 * std::abs(x) / rain.inverse_doppler[k];
  }
}
Dispatched<distances_loop> distances;

// The swept azimuth and its slope, where the table reaches.
[[gnu::always_inline]] inline void sweeps_loop(const SkyTable::Lookup& lookup,
                                               const double* __restrict distance, int count,
                                               double* __restrict azimuth,
                                               double* __restrict slope) {
  const SkyTable::Lookup table = lookup;
  for (int k = 0; k < count; ++k) {
    const SkyTable::Sweep sweep = table(distance[k]);
    azimuth[k] = sweep.azimuth;
    slope[k] = sweep.slope;
  }
}
Dispatched<sweeps_loop> sweeps;

[[gnu::always_inline]] inline void white_hole_sweeps_loop(const WhiteHoleTable::Lookup& lookup,
                                                          const Rain& rain, int count,
                                                          double* __restrict place,
                                                          double* __restrict azimuth,
                                                          double* __restrict slope) {
  const WhiteHoleTable::Lookup table = lookup;
  for (int k = 0; k < count; ++k) {
    double rate = 0;
    place[k] = table.place(rain.sin_half[k], rain.cos_half[k], rate);
    const double within = place[k] < table.high ? place[k] : table.high;
    const auto at = table.curve(within);
    azimuth[k] = at.value;
    slope[k] = std::abs(at.slope * rate);
  }
}
Dispatched<white_hole_sweeps_loop> white_hole_sweeps;

[[gnu::always_inline]] inline void onto_sky_loop(const Frame& frame, const Rain& rain,
                                                 const double* azimuth, const double* slope,
                                                 int count, LookBatch& batch) {
  const Frame f = frame;
  for (int k = 0; k < count; ++k) {
    const SineCosine phi = sin_cos(azimuth[k]);
    const double sine = rain.sine[k];
    const double across = sine > 0 ? phi.sine / (sine > 0 ? sine : 1) : 0;
    const V3d sky =
        apply(f.sky_from_tetrad, V3d(phi.cosine, rain.y[k] * across, rain.z[k] * across));
    batch.sky_x[k] = sky.x, batch.sky_y[k] = sky.y, batch.sky_z[k] = sky.z;
    const double back = sine > 0 ? phi.cosine / (sine > 0 ? sine : 1) : 0;
    const V3d along = apply(f.sky_from_tetrad, V3d(-phi.sine, rain.y[k] * back, rain.z[k] * back));
    batch.along_x[k] = along.x, batch.along_y[k] = along.y, batch.along_z[k] = along.z;
    batch.radial_scale[k] = slope[k] * rain.inverse_doppler[k];
    batch.tangential_scale[k] = std::abs(across) * rain.inverse_doppler[k];
  }
}
Dispatched<onto_sky_loop> onto_sky;

using Doubles = LookBatch::Column<double>;

// Looks up the directions that lie on the sky `name`.
void add_sky(const SkyTable& table, SeenSky name, const Doubles& x, int count,
             const LookBatch& batch, Doubles& azimuth, Doubles& slope) {
  const SkyTable::Lookup lookup = table.lookup();
  Doubles phi, d;
  sweeps(lookup, x.data(), count, phi.data(), d.data());
  for (int k = 0; k < count; ++k) {
    if (batch.sky[k] != name) continue;
    const bool beyond = x[k] < lookup.x_min();
    azimuth[k] = beyond ? table.azimuth(x[k]) : phi[k];
    slope[k] = beyond ? table.slope(x[k]) : d[k];
  }
}

// On the axis the azimuth of the singularity's light changes like the cube root of the angle: faster
// than any picture can show.
constexpr double kSteepest = 1e9;

void add_white_hole(const WhiteHoleTable& table, const Rain& rain, int count, LookBatch& batch,
                    Doubles& azimuth, Doubles& slope) {
  const WhiteHoleTable::Lookup lookup = table.lookup();
  Doubles place, phi, d;
  white_hole_sweeps(lookup, rain, count, place.data(), phi.data(), d.data());
  for (int k = 0; k < count; ++k) {
    if (batch.sky[k] != SeenSky::kFour) continue;
    batch.frequency_ratio[k] = 1;
    azimuth[k] = phi[k];
    slope[k] = d[k];
    if (!(place[k] >= lookup.low && place[k] <= lookup.high)) {
      const WhiteHoleTable::Place at = table.place_of(rain.sin_half[k], rain.cos_half[k]);
      azimuth[k] = table.azimuth(at);
      slope[k] = std::abs(table.slope(at));
    }
    slope[k] = std::min(slope[k], kSteepest);
  }
}

EmissionTimeTable::Value emission_of(const HoleOptics& optics, double sin_half, double cos_half,
                                     double azimuth, double slope) {
  const WhiteHoleTable::Place place = optics.white_hole->place_of(sin_half, cos_half);
  const bool beyond = sin_half > optics.white_hole->lookup().place.zero * cos_half;
  return optics.emission_times->at(place, beyond, azimuth, slope);
}

void add_emission_times(const HoleOptics& optics, const Rain& rain, const Doubles& azimuth,
                        const Doubles& slope, int count, LookBatch& batch) {
  for (int k = 0; k < count; ++k) {
    if (batch.sky[k] != SeenSky::kFour) continue;
    const auto value =
        emission_of(optics, rain.sin_half[k], rain.cos_half[k], azimuth[k], slope[k]);
    batch.emission_time[k] = value.time;
    batch.time_scale[k] = value.slope * rain.inverse_doppler[k];
  }
}

bool any(const LookBatch& batch, int count, SeenSky name) {
  return std::find(batch.sky.begin(), batch.sky.begin() + count, name) != batch.sky.begin() + count;
}

}  // namespace

ViewTracer::ViewTracer(const FrameState& state, const HoleOptics& optics, const Effects& effects)
    : tetrad_from_camera_(state.observer.tetrad_from_camera),
      sky_from_tetrad_(state.observer.sky_from_tetrad),
      celerity_(state.observer.celerity),
      optics_(optics),
      flat_(is_flat(state.observer)),
      outgoing_(is_outgoing(state.observer.tetrad)),
      home_(is_mirrored(state.observer.tetrad) ? SeenSky::kThree : SeenSky::kOne),
      far_(is_mirrored(state.observer.tetrad) ? SeenSky::kOne : SeenSky::kThree),
      s_(std::sqrt(2 / state.observer.r)),
      one_minus_s_(flat_ ? 1 : (state.observer.r - 2) / (state.observer.r * (1 + s_))) {
  const Vantage vantage = vantage_of(state.observer, effects);
  celerity_ = vantage.celerity;
  if (vantage.measured) to_measured_.emplace(-*vantage.measured);
  if (effects.lensing || flat_) return;
  to_rest_.emplace(-vantage.rest);
  gravitational_ratio_ = gravitational_ratio(state.observer.r);
}

Look ViewTracer::bent_look(const CameraDirection& n) const {
  const AberratedLight in = Aberration(celerity_).to_rest(apply(tetrad_from_camera_, n.v));
  Look look;
  if (flat_) {
    look.sky = SeenSky::kOne;
    look.known = true;
    look.sky_direction = apply(sky_from_tetrad_, in.direction);
    look.frequency_ratio = look.radial_scale = look.tangential_scale = 1 / in.frequency_ratio;
    look.bundle.doppler = look.frequency_ratio;
    return look;
  }
  const V3d& d = in.direction;
  const double sin_alpha = std::hypot(d.y, d.z);
  const HalfAngle half = half_angle(outgoing_ ? d.x : -d.x, sin_alpha);
  const SkyTable* table = nullptr;
  double x = -1;
  const auto try_sky = [&](const std::optional<SkyEdge>& edge, const std::optional<SkyTable>& its,
                           SeenSky name) {
    if (!edge) return;
    const double away = edge->distance(half.sine, half.cosine);
    if (its || optics_.white_hole)
      look.to_edge = std::min(look.to_edge, 2 * std::abs(away) * in.frequency_ratio);
    if (!(away > 0) || look.sky != SeenSky::kFour) return;
    look.sky = name;
    x = away;
    table = its ? &*its : nullptr;
  };
  try_sky(optics_.home_edge, optics_.home_sky, home_);
  try_sky(optics_.far_edge, optics_.far_sky, far_);
  double phi = 0, slope = 0;
  if (look.sky == SeenSky::kFour) {
    if (!optics_.white_hole) return look;
    const WhiteHoleTable::Place place = optics_.white_hole->place_of(half.sine, half.cosine);
    phi = optics_.white_hole->azimuth(place);
    slope = std::min(std::abs(optics_.white_hole->slope(place)), kSteepest);
    if (optics_.emission_times) {
      const auto value = emission_of(optics_, half.sine, half.cosine, phi, slope);
      look.emission_time = value.time;
      look.time_scale = value.slope / in.frequency_ratio;
    }
  } else {
    if (!table) return look;
    phi = table->azimuth(x);
    slope = table->slope(x);
    look.bundle = {2 * std::atan2(half.sine, half.cosine), phi, slope, 1 / in.frequency_ratio};
    const double energy =
        std::abs((1 + s_) * half.sine * half.sine + one_minus_s_ * half.cosine * half.cosine);
    look.frequency_ratio = 1 / (energy * in.frequency_ratio);
  }
  look.known = true;
  const double across = sin_alpha > 0 ? std::sin(phi) / sin_alpha : 0;
  look.sky_direction = apply(sky_from_tetrad_, V3d(std::cos(phi), d.y * across, d.z * across));
  look.radial_scale = slope / in.frequency_ratio;
  look.tangential_scale = std::abs(across) / in.frequency_ratio;
  return look;
}

void ViewTracer::bent_looks(const CameraDirection* n, int count, LookBatch& batch) const {
  const Frame frame{tetrad_from_camera_, sky_from_tetrad_,      Aberration(celerity_), s_,
                    one_minus_s_,        outgoing_ ? -1.0 : 1.0};
  Rain rain;
  to_rain(frame, n, count, rain, batch);
  if (flat_) {
    std::fill_n(batch.sky.begin(), count, SeenSky::kOne);
    flat_sky(frame, rain, count, batch);
    return;
  }
  std::fill_n(batch.sky.begin(), count, SeenSky::kFour);
  Doubles azimuth, slope, x, away;
  std::fill_n(azimuth.begin(), count, 0.0);
  std::fill_n(slope.begin(), count, 0.0);
  const auto add = [&](const std::optional<SkyEdge>& edge, const std::optional<SkyTable>& table,
                       SeenSky name) {
    if (!edge) return;
    distances(*edge, rain, count, x.data(), away.data());
    if (table || optics_.white_hole)  // an edge between the dark and the dark is none
      for (int k = 0; k < count; ++k) batch.to_edge[k] = std::min(batch.to_edge[k], away[k]);
    for (int k = 0; k < count; ++k)
      if (x[k] > 0 && batch.sky[k] == SeenSky::kFour) batch.sky[k] = name;
    if (table && any(batch, count, name)) add_sky(*table, name, x, count, batch, azimuth, slope);
  };
  add(optics_.home_edge, optics_.home_sky, home_);
  add(optics_.far_edge, optics_.far_sky, far_);
  if (optics_.white_hole && any(batch, count, SeenSky::kFour))
    add_white_hole(*optics_.white_hole, rain, count, batch, azimuth, slope);
  if (optics_.emission_times) add_emission_times(optics_, rain, azimuth, slope, count, batch);
  onto_sky(frame, rain, azimuth.data(), slope.data(), count, batch);
}

}  // namespace domefall
