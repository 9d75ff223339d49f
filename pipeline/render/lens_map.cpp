#include "pipeline/render/lens_map.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "pipeline/base/digest.h"
#include "pipeline/render/disc_scene.h"
#include "pipeline/render/key_parts.h"

namespace domefall {
namespace {

// The version is raised with every change that alters a number.
constexpr int kLensMapVersion = 2;

constexpr double kHalfTurn = 180;  // degrees

float number_of(SkyRegion sky) {
  switch (sky) {
    case SkyRegion::kI:
      return 1;
    case SkyRegion::kIII:
      return 3;
    case SkyRegion::kIV:
      return 4;
    case SkyRegion::kNext:
      break;
  }
  return 5;
}

// A LensMapper follows the rays of one instant, for any number of threads at a time.
class LensMapper {
 public:
  // `show` and `state` must outlive this object.
  LensMapper(const Show& show, const FrameState& state)
      : projection_(state.projection), scene_(show, state) {}

  // Fills in the numbers of a pixel, which must be 0 before.
  void fill(PixelPosition at, float* out) const {
    if (!is_inside(projection_, at)) return;
    const CameraDirection n = direction_at(projection_, at);
    const double width = pixel_angle(projection_, at);
    const ViewRay ray = scene_.scene.tracer.trace(n);
    const auto set = [out](LensChannel channel, double value) {
      out[channel] = static_cast<float>(value);
    };
    // A ray that comes from no sky, as within the silhouette of a charged hole, leaves these 0.
    if (ray.known) {
      set(kSkyX, ray.sky_direction.x);
      set(kSkyY, ray.sky_direction.y);
      set(kSkyZ, ray.sky_direction.z);
      const SkyMapPlace place = sky_map_place(ray.sky_direction);
      set(kStS, place.s);
      set(kStT, place.t);
      out[kSkyRegion] = number_of(ray.sky);
    }
    // The distance is infinite where there is no edge, and no two directions are farther apart than
    // half a turn.
    set(kEdgeDistance, std::min(ray.to_edge * kHalfTurn / std::numbers::pi, kHalfTurn));
    const auto gas = scene_.disc ? scene_.disc->places(n, width) : std::vector<DiscPass::Place>{};
    if (!gas.empty()) {
      set(kGasRadius, gas[0].r);
      set(kGasAzimuth, gas[0].azimuth * kHalfTurn / std::numbers::pi);
      set(kGasOnePlusZ, 1 / gas[0].frequency_ratio);
      set(kGasOrder, gas[0].order);
      set(kGasCovered, gas[0].covered);
    }
    // Redshift, amplification and order are not stated for the past singularity's light
    // (lens_map.h).
    if (ray.sky == SkyRegion::kIV) return;
    // 1 + z is the frequency as it was emitted over that observed.
    set(kOnePlusZ, 1 / ray.frequency_ratio);
    set(kAmplification, amplification(ray.bundle, width));
    // Images of one order have swept azimuths between two neighbouring multiples of pi.
    set(kOrder, std::floor(ray.swept / std::numbers::pi));
  }

 private:
  const Projection& projection_;
  DiscScene scene_;
};

}  // namespace

// The names stand in the order of LensChannel.  To programs that read OpenEXR, what stands before a
// point names a layer.
const std::vector<std::string>& lens_channel_names() {
  static const std::vector<std::string> names{"sky.x",
                                              "sky.y",
                                              "sky.z",
                                              "st.s",
                                              "st.t",
                                              "sky.region",
                                              "light.one_plus_z",
                                              "light.amplification",
                                              "light.order",
                                              "edge.distance",
                                              "gas.radius",
                                              "gas.azimuth",
                                              "gas.one_plus_z",
                                              "gas.order",
                                              "gas.covered"};
  return names;
}

SkyMapPlace sky_map_place(const V3d& d) {
  const double turns = std::atan2(d.y, d.x) / (2 * std::numbers::pi);  // of right ascension
  // The left and the right edge of the map are one meridian, which counts as the left edge.
  const double s = turns < 0.5 ? 0.5 - turns : 0.0;
  // An arctangent keeps the digits of declination at the poles, where an arcsine of z would lose
  // half of them.
  return {s < 1 ? s : 0.0, 0.5 + std::atan2(d.z, std::hypot(d.x, d.y)) / std::numbers::pi};
}

std::string lens_map_key(const Show& show, const FrameState& state) {
  const FrameState& seen = dominant_view(state);
  Digest digest;
  digest.add("lens map").add(DOMEFALL_VERSION).add(kLensMapVersion).add(show.title);
  digest.add(show.frames_per_second).add(state.frame);
  // No sky, star, light or exposure acts on a lens map, so that a change to these leaves its key as it is.
  add_observer(digest, seen.observer);
  add_projection(digest, seen.projection);
  add_effects(digest, show.effects);
  add_disc(digest, show.disc);
  return digest.hex();
}

ChannelImage make_lens_map(const Show& show, const FrameState& state, int threads) {
  // Directions of two views have no mean, so that a dissolve has the map of one of them.
  const FrameState& seen = dominant_view(state);
  const LensMapper mapper(show, seen);
  ChannelImage map(columns(seen.projection), rows(seen.projection), lens_channel_names());
  tbb::task_arena(threads).execute([&] {
    // Each row is written by one task, so that the map is the same for any number of threads.
    tbb::parallel_for(0, map.height, [&](int y) {
      for (int x = 0; x < map.width; ++x) mapper.fill({x + 1.0, y + 1.0}, map.pixel(x, y));
    });
  });
  return map;
}

}  // namespace domefall
