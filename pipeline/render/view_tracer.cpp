#include "pipeline/render/view_tracer.h"

#include <algorithm>
#include <cmath>

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
};

// Directions in the rain frame and what leads to the tables.
struct Rain {
  LookBatch::Column<double> x, y, z, sine, sin_half, cos_half, inverse_doppler;
};

DOMEFALL_SIMD void to_rain(const Frame& frame, const CameraDirection* n, int count, Rain& rain,
                           LookBatch& batch) {
  const Frame f = frame;
  for (int k = 0; k < count; ++k) {
    const AberratedLight in = f.aberration.to_rest(apply(f.tetrad_from_camera, n[k].v));
    const V3d d = in.direction;
    const double sine = std::sqrt(d.y * d.y + d.z * d.z);
    const HalfAngle half = half_angle(-d.x, sine);
    const double energy =
        std::abs((1 + f.s) * half.sine * half.sine + f.one_minus_s * half.cosine * half.cosine);
    rain.x[k] = d.x, rain.y[k] = d.y, rain.z[k] = d.z;
    rain.sine[k] = sine, rain.sin_half[k] = half.sine, rain.cos_half[k] = half.cosine;
    rain.inverse_doppler[k] = 1 / in.frequency_ratio;
    batch.frequency_ratio[k] = rain.inverse_doppler[k] / energy;
    batch.to_edge[k] = HUGE_VAL;
  }
}

DOMEFALL_SIMD void flat_sky(const Frame& frame, const Rain& rain, int count, LookBatch& batch) {
  const Frame f = frame;
  for (int k = 0; k < count; ++k) {
    const V3d sky = apply(f.sky_from_tetrad, V3d(rain.x[k], rain.y[k], rain.z[k]));
    batch.sky_x[k] = sky.x, batch.sky_y[k] = sky.y, batch.sky_z[k] = sky.z;
    batch.frequency_ratio[k] = rain.inverse_doppler[k];
    batch.radial_scale[k] = batch.tangential_scale[k] = rain.inverse_doppler[k];
  }
}

DOMEFALL_SIMD void distances(const SkyTable::Lookup& lookup, const Rain& rain, int count,
                             LookBatch& batch) {
  const SkyTable::Lookup table = lookup;
  for (int k = 0; k < count; ++k) {
    const double x = table.distance(rain.sin_half[k], rain.cos_half[k]);
    const double to_edge = 2 * std::abs(x) / rain.inverse_doppler[k];
    batch.distance[k] = x;
    batch.to_edge[k] = to_edge < batch.to_edge[k] ? to_edge : batch.to_edge[k];
  }
}

// The swept azimuth and its slope, where the table reaches.
DOMEFALL_SIMD void sweeps(const SkyTable::Lookup& lookup, const double* distance, int count,
                          double* azimuth, double* slope) {
  const SkyTable::Lookup table = lookup;
  for (int k = 0; k < count; ++k) {
    const SkyTable::Sweep sweep = table(distance[k]);
    azimuth[k] = sweep.azimuth;
    slope[k] = sweep.slope;
  }
}

DOMEFALL_SIMD void onto_sky(const Frame& frame, const Rain& rain, const double* azimuth,
                            const double* slope, int count, LookBatch& batch) {
  const Frame f = frame;
  for (int k = 0; k < count; ++k) {
    const SineCosine phi = sin_cos(azimuth[k]);
    const double sine = rain.sine[k];
    const double across = sine > 0 ? phi.sine / (sine > 0 ? sine : 1) : 0;
    const V3d sky =
        apply(f.sky_from_tetrad, V3d(phi.cosine, rain.y[k] * across, rain.z[k] * across));
    batch.sky_x[k] = sky.x, batch.sky_y[k] = sky.y, batch.sky_z[k] = sky.z;
    batch.radial_scale[k] = slope[k] * rain.inverse_doppler[k];
    batch.tangential_scale[k] = std::abs(across) * rain.inverse_doppler[k];
  }
}

// Looks up the directions that `table` shows and that no table before it did.
void add_sky(const SkyTable& table, SeenSky name, const Rain& rain, int count, LookBatch& batch,
             double* azimuth, double* slope) {
  const SkyTable::Lookup lookup = table.lookup();
  distances(lookup, rain, count, batch);
  const double* x = batch.distance.data();
  LookBatch::Column<double> phi, d;
  sweeps(lookup, x, count, phi.data(), d.data());
  for (int k = 0; k < count; ++k) {
    if (!(x[k] > 0) || batch.sky[k] != SeenSky::kNone) continue;
    batch.sky[k] = name;
    const bool beyond = x[k] < lookup.x_min();
    azimuth[k] = beyond ? table.azimuth(x[k]) : phi[k];
    slope[k] = beyond ? table.slope(x[k]) : d[k];
  }
}

}  // namespace

ViewTracer::ViewTracer(const FrameState& state, const HoleOptics& optics)
    : tetrad_from_camera_(state.observer.tetrad_from_camera),
      sky_from_tetrad_(state.observer.sky_from_tetrad),
      celerity_(state.observer.celerity),
      optics_(optics),
      flat_(is_flat(state.observer)),
      s_(std::sqrt(2 / state.observer.r)),
      one_minus_s_(flat_ ? 1 : (state.observer.r - 2) / (state.observer.r * (1 + s_))) {}

Look ViewTracer::look(const CameraDirection& n) const {
  const AberratedLight in = Aberration(celerity_).to_rest(apply(tetrad_from_camera_, n.v));
  Look look;
  if (flat_) {
    look.sky = SeenSky::kOne;
    look.sky_direction = apply(sky_from_tetrad_, in.direction);
    look.frequency_ratio = look.radial_scale = look.tangential_scale = 1 / in.frequency_ratio;
    return look;
  }
  const V3d& d = in.direction;
  const double sin_delta = std::hypot(d.y, d.z);
  const HalfAngle half = half_angle(-d.x, sin_delta);
  const SkyTable* table = nullptr;
  double x = -1;
  if (optics_.sky_one) {
    x = optics_.sky_one->distance_from_half_angle(half.sine, half.cosine);
    look.to_edge = 2 * std::abs(x) * in.frequency_ratio;
    if (x > 0) table = &*optics_.sky_one, look.sky = SeenSky::kOne;
  }
  if (optics_.sky_three) {
    const double x3 = optics_.sky_three->distance_from_half_angle(half.sine, half.cosine);
    look.to_edge = std::min(look.to_edge, 2 * std::abs(x3) * in.frequency_ratio);
    if (!table && x3 > 0) x = x3, table = &*optics_.sky_three, look.sky = SeenSky::kThree;
  }
  if (!table) return look;
  const double phi = table->azimuth(x);
  const double across = sin_delta > 0 ? std::sin(phi) / sin_delta : 0;
  look.sky_direction = apply(sky_from_tetrad_, V3d(std::cos(phi), d.y * across, d.z * across));
  const double energy =
      std::abs((1 + s_) * half.sine * half.sine + one_minus_s_ * half.cosine * half.cosine);
  look.frequency_ratio = 1 / (energy * in.frequency_ratio);
  look.radial_scale = table->slope(x) / in.frequency_ratio;
  look.tangential_scale = std::abs(across) / in.frequency_ratio;
  return look;
}

void ViewTracer::look(const CameraDirection* n, int count, LookBatch& batch) const {
  const Frame frame{tetrad_from_camera_, sky_from_tetrad_, Aberration(celerity_), s_, one_minus_s_};
  Rain rain;
  to_rain(frame, n, count, rain, batch);
  if (flat_) {
    std::fill_n(batch.sky.begin(), count, SeenSky::kOne);
    flat_sky(frame, rain, count, batch);
    return;
  }
  std::fill_n(batch.sky.begin(), count, SeenSky::kNone);
  LookBatch::Column<double> azimuth, slope;
  std::fill_n(azimuth.begin(), count, 0.0);
  std::fill_n(slope.begin(), count, 0.0);
  if (optics_.sky_one)
    add_sky(*optics_.sky_one, SeenSky::kOne, rain, count, batch, azimuth.data(), slope.data());
  if (optics_.sky_three)
    add_sky(*optics_.sky_three, SeenSky::kThree, rain, count, batch, azimuth.data(), slope.data());
  onto_sky(frame, rain, azimuth.data(), slope.data(), count, batch);
}

}  // namespace domefall
