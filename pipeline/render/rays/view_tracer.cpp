#include "pipeline/render/rays/view_tracer.h"

#include <utility>

#include "pipeline/base/simd/dispatch.h"

namespace domefall {
namespace {

// A MovingCamera holds what the loop needs to know of the observer.  The loop copies it, so that the
// compiler knows that no store of the loop alters it.
struct MovingCamera {
  M33d tetrad_from_camera;
  Aberration aberration;
};

// A boost that multiplies frequencies by D divides small angles by D, so one number serves as scale
// and as frequency.
[[gnu::always_inline]] inline void into_frame_loop(const MovingCamera& camera,
                                                   const CameraDirection* n, int count,
                                                   FrameRayBatch& batch) {
  const MovingCamera c = camera;
  for (int k = 0; k < count; ++k) {
    const AberratedLight in = c.aberration.to_rest(apply(c.tetrad_from_camera, n[k].v));
    batch.x[k] = in.direction.x;
    batch.y[k] = in.direction.y;
    batch.z[k] = in.direction.z;
    batch.scale[k] = batch.frequency[k] = 1 / in.frequency_ratio;
  }
}
Dispatched<into_frame_loop> into_tetrad_frame;

// Takes what the lens says in its frame to the observer's view.
[[gnu::always_inline]] inline void out_of_frame_loop(const FrameRayBatch& __restrict frame,
                                                     int count, ViewRayBatch& __restrict batch) {
  for (int k = 0; k < count; ++k) {
    const double scale = frame.scale[k], ratio = batch.frequency_ratio[k] * frame.frequency[k];
    batch.scale_along[k] *= scale;
    batch.scale_across[k] *= scale;
    batch.time_scale[k] *= scale;
    batch.to_edge[k] /= scale;
    batch.frequency_ratio[k] = batch.sky[k] == SkyRegion::kIV ? 1 : ratio;
  }
}
Dispatched<out_of_frame_loop> out_of_frame;

// Returns what becomes of a unit vector across `from` by the boost that takes `from` to `to`.  Boosts
// leave angles between vectors across a direction as they are.
V3d boosted(const V3d& across, const V3d& from, const V3d& to) {
  return across - (from + to) * (across.dot(to) / (1 + from.dot(to)));
}

}  // namespace

std::shared_ptr<const Lens> lens_of(const ObserverState& observer, const WantedSkies& wanted,
                                    const Effects& effects, LensStore& store) {
  if (effects.lensing) return store.lens(observer, wanted);
  return store.lens(observer, wanted,
                    StraightLight{viewer_of(observer, effects).rest,
                                  observer.spacetime.gravitational_ratio(observer.r)});
}

// The boost multiplies the frequency by `ratio` and divides solid angles by its square.
SkyImage out_of_lens(const Lens& lens, const SkyImage& image) {
  const V3d frame = lens.frame();
  if (frame == V3d(0, 0, 0)) return image;
  const AberratedLight at = to_tetrad(frame, image.direction.v);
  const double ratio = at.frequency_ratio;
  return {{at.direction},
          image.frequency_ratio * ratio,
          image.amplification / (ratio * ratio),
          image.speed / ratio};
}

// The boost to an observer with celerity c is that to rest with -c (aberration.h).
ViewTracer::ViewTracer(const FrameState& state, std::shared_ptr<const Lens> lens,
                       const Effects& effects)
    : tetrad_from_camera_(state.observer.tetrad_from_camera),
      viewer_(viewer_of(state.observer, effects)),
      lens_(std::move(lens)),
      to_tetrad_(viewer_.celerity) {
  if (viewer_.measured) to_measured_.emplace(-*viewer_.measured);
  if (const V3d frame = lens_->frame(); frame != V3d(0, 0, 0)) to_lens_.emplace(-frame);
}

double ViewTracer::measured_ratio(const CameraDirection& n) const {
  return to_measured_->to_rest(apply(tetrad_from_camera_, n.v)).frequency_ratio;
}

ViewRay ViewTracer::trace(const CameraDirection& n) const {
  const V3d seen = apply(tetrad_from_camera_, n.v);
  const AberratedLight in_tetrad = to_tetrad_.to_rest(seen);
  AberratedLight in = in_tetrad;
  if (to_lens_) {
    const AberratedLight at = to_lens_->to_rest(in.direction);
    in = {at.direction, in.frequency_ratio * at.frequency_ratio};
  }
  ViewRay ray = lens_->ray(in.direction);
  ray.to_edge *= in.frequency_ratio;
  if (!ray.known) return ray;
  ray.scale_along /= in.frequency_ratio;
  ray.scale_across /= in.frequency_ratio;
  if (to_lens_) ray.axis = boosted(ray.axis, in.direction, in_tetrad.direction);
  ray.axis = apply_transposed(tetrad_from_camera_, boosted(ray.axis, in_tetrad.direction, seen));
  ray.time_scale /= in.frequency_ratio;
  ray.bundle.doppler = 1 / in.frequency_ratio;
  if (ray.sky == SkyRegion::kIV) return ray;
  ray.frequency_ratio /= in.frequency_ratio;
  if (to_measured_) ray.frequency_ratio *= measured_ratio(n);
  return ray;
}

void ViewTracer::trace(const CameraDirection* n, int count, ViewRayBatch& batch) const {
  FrameRayBatch frame;
  into_frame(n, count, frame);
  lens_->rays(frame, count, batch);
  out_of_frame(frame, count, batch);
}

void ViewTracer::into_frame(const CameraDirection* n, int count, FrameRayBatch& batch) const {
  into_tetrad_frame({tetrad_from_camera_, to_tetrad_}, n, count, batch);
  if (to_lens_)
    for (int k = 0; k < count; ++k) {
      const AberratedLight rest = to_lens_->to_rest(V3d(batch.x[k], batch.y[k], batch.z[k]));
      batch.x[k] = rest.direction.x;
      batch.y[k] = rest.direction.y;
      batch.z[k] = rest.direction.z;
      batch.scale[k] /= rest.frequency_ratio;
      batch.frequency[k] /= rest.frequency_ratio;
    }
  if (to_measured_)
    for (int k = 0; k < count; ++k) batch.frequency[k] *= measured_ratio(n[k]);
}

double ViewTracer::frequency_from(const V3d& in_frame) const {
  const AberratedLight in_tetrad = to_tetrad(lens_->frame(), in_frame),
                       seen = to_observer(viewer_.celerity, in_tetrad.direction);
  const double ratio = in_tetrad.frequency_ratio * seen.frequency_ratio;
  return to_measured_ ? ratio * to_measured_->to_rest(seen.direction).frequency_ratio : ratio;
}

// Directions n with n.u = cos(alpha) are those whose light ray (1, -n) is orthogonal to the vector
// (cos(alpha), -u) of space-time.  So a boost changes the circle as it changes that vector, and turns
// circles into circles.  The square of the vector, -sin^2(alpha), stays the same and gives the sine
// of the new circle.
ViewCurve ViewTracer::seen(const ViewCurve& curve) const {
  const V3d& celerity = viewer_.celerity;
  if (const auto* circle = std::get_if<ViewCircle>(&curve)) {
    const double gamma = gamma_of(celerity), along = celerity.dot(circle->axis);
    const double time = gamma * circle->cosine + along;
    const V3d space = circle->axis + celerity * (along / (gamma + 1) + circle->cosine);
    const double length = space.length();
    return ViewCircle{apply_transposed(tetrad_from_camera_, space / length), time / length,
                      circle->sine / length};
  }
  std::vector<V3d> corners = std::get<std::vector<V3d>>(curve);
  for (V3d& n : corners)
    n = apply_transposed(tetrad_from_camera_, to_observer(celerity, n).direction);
  return corners;
}

std::vector<SkyBorder> ViewTracer::borders() const {
  std::vector<SkyBorder> borders = lens_->borders();
  for (SkyBorder& border : borders) border.curve = seen(border.curve);
  return borders;
}

std::vector<ViewCurve> ViewTracer::einstein_rings() const {
  std::vector<ViewCurve> rings = lens_->einstein_rings();
  for (ViewCurve& ring : rings) ring = seen(ring);
  return rings;
}

std::optional<ViewCurve> ViewTracer::ergosphere() const {
  const std::optional<ViewCurve> outline = lens_->ergosphere();
  return outline ? std::optional(seen(*outline)) : std::nullopt;
}

}  // namespace domefall
