// What becomes of looks when a show leaves effects out.
#include "pipeline/render/rays/view_tracer.h"

namespace domefall {

double ViewTracer::measured_ratio(const CameraDirection& n) const {
  return to_measured_->to_rest(apply(tetrad_from_camera_, n.v)).frequency_ratio;
}

ViewRay ViewTracer::trace(const CameraDirection& n) const {
  ViewRay look = to_rest_ ? straight_ray(n) : lensed_ray(n);
  if (to_measured_ && look.known && look.sky != SkyRegion::kIV)
    look.frequency_ratio *= measured_ratio(n);
  return look;
}

// Light near a hole that keeps to the straight lines of the observer at rest.
ViewRay ViewTracer::straight_ray(const CameraDirection& n) const {
  const AberratedLight in = Aberration(vantage_.celerity).to_rest(apply(tetrad_from_camera_, n.v));
  const AberratedLight rest = to_rest_->to_rest(in.direction);
  const double doppler = 1 / (in.frequency_ratio * rest.frequency_ratio);
  ViewRay look;
  look.sky = home_;
  look.known = true;
  look.sky_direction = apply(sky_from_tetrad_, rest.direction);
  look.frequency_ratio = gravitational_ratio_ * doppler;
  look.radial_scale = look.tangential_scale = look.bundle.doppler = doppler;
  return look;
}

void ViewTracer::straight_rays(const CameraDirection* n, int count, ViewRayBatch& batch) const {
  for (int k = 0; k < count; ++k) {
    const ViewRay look = straight_ray(n[k]);
    const V3d& sky = look.sky_direction;
    batch.sky[k] = look.sky;
    batch.sky_x[k] = sky.x, batch.sky_y[k] = sky.y, batch.sky_z[k] = sky.z;
    batch.frequency_ratio[k] = look.frequency_ratio;
    batch.along_x[k] = batch.along_y[k] = batch.along_z[k] =
        0;  // as good as any: a round footprint
    batch.radial_scale[k] = batch.tangential_scale[k] = look.radial_scale;
    batch.to_edge[k] = look.to_edge;
  }
}

void ViewTracer::trace(const CameraDirection* n, int count, ViewRayBatch& batch) const {
  if (to_rest_)
    straight_rays(n, count, batch);
  else
    lensed_rays(n, count, batch);
  if (!to_measured_) return;
  for (int k = 0; k < count; ++k)
    if (batch.sky[k] != SkyRegion::kIV) batch.frequency_ratio[k] *= measured_ratio(n[k]);
}

}  // namespace domefall
