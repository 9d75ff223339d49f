#include "pipeline/render/lens_map.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "pipeline/image/digest.h"
#include "pipeline/render/key_parts.h"
#include "pipeline/render/overlay/seen_better.h"
#include "pipeline/render/rays/view_tracer.h"

namespace domefall {
namespace {

// The version is raised with every change that alters a number.
constexpr int kLensMapVersion = 1;

constexpr double kHalfTurn = 180;  // degrees

// Returns the number that stands for a region in its channel.
float number_of(SkyRegion sky) {
  switch (sky) {
    case SkyRegion::kI:
      return 1;
    case SkyRegion::kIII:
      return 3;
    case SkyRegion::kIV:
      break;
  }
  return 4;
}

class LensMapper {
 public:
  // `show` and `state` must outlive this object.
  LensMapper(const Show& show, const FrameState& state)
      : projection_(state.projection),
        straight_(is_flat(state.observer) || !show.effects.lensing),
        optics_(make_hole_optics(state.observer.r, state.observer.tetrad, {{true, true, true}})),
        tracer_(state, optics_, show.effects) {}

  // Fills in the numbers of a pixel, which must be 0 before.
  void fill(PixelPosition at, float* out) const {
    if (!is_inside(projection_, at)) return;
    const ViewRay ray = tracer_.trace(direction_at(projection_, at));
    const auto set = [out](LensChannel channel, double value) {
      out[channel] = static_cast<float>(value);
    };
    set(kSkyX, ray.sky_direction.x);
    set(kSkyY, ray.sky_direction.y);
    set(kSkyZ, ray.sky_direction.z);
    const SkyMapPlace place = sky_map_place(ray.sky_direction);
    set(kStS, place.s);
    set(kStT, place.t);
    out[kSkyRegion] = number_of(ray.sky);
    set(kEdgeDistance, std::min(ray.to_edge * kHalfTurn / std::numbers::pi, kHalfTurn));
    if (ray.sky == SkyRegion::kIV) return;
    set(kOnePlusZ, 1 / ray.frequency_ratio);
    set(kAmplification, amplification(ray.bundle, pixel_angle(projection_, at)));
    // Images of one order have swept azimuths between two neighbouring multiples of pi.
    if (!straight_) set(kOrder, std::floor(ray.bundle.azimuth / std::numbers::pi));
  }

 private:
  const Projection& projection_;
  bool straight_;  // then all images are of order 0
  HoleOptics optics_;
  ViewTracer tracer_;
};

}  // namespace

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
                                              "edge.distance"};
  return names;
}

SkyMapPlace sky_map_place(const V3d& d) {
  const double turns = std::atan2(d.y, d.x) / (2 * std::numbers::pi);  // of right ascension
  // The left and the right edge of the map are one meridian, which counts as the left edge.
  const double s = turns < 0.5 ? 0.5 - turns : 0.0;
  return {s < 1 ? s : 0.0, 0.5 + std::atan2(d.z, std::hypot(d.x, d.y)) / std::numbers::pi};
}

std::string lens_map_key(const Show& show, const FrameState& state) {
  const FrameState& seen = seen_better(state);
  Digest digest;
  digest.add("lens map").add(DOMEFALL_VERSION).add(kLensMapVersion).add(show.title);
  digest.add(show.frames_per_second).add(state.frame);
  add_observer(digest, seen.observer);
  add_projection(digest, seen.projection);
  add_effects(digest, show.effects);
  return digest.hex();
}

ChannelImage make_lens_map(const Show& show, const FrameState& state, int threads) {
  const FrameState& seen = seen_better(state);
  const LensMapper mapper(show, seen);
  ChannelImage map(columns(seen.projection), rows(seen.projection), lens_channel_names());
  tbb::task_arena(threads).execute([&] {
    tbb::parallel_for(0, map.height, [&](int y) {
      for (int x = 0; x < map.width; ++x) mapper.fill({x + 1.0, y + 1.0}, map.pixel(x, y));
    });
  });
  return map;
}

}  // namespace domefall
