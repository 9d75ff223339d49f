// Traces the view rays of shows that leave effects out: of those without lensing, and of those
// whose frequencies another observer measures.
#include "pipeline/render/rays/view_tracer.h"

namespace domefall {

double ViewTracer::measured_ratio(const CameraDirection& n) const {
  return to_measured_->to_rest(apply(tetrad_from_camera_, n.v)).frequency_ratio;
}

ViewRay ViewTracer::trace(const CameraDirection& n) const {
  ViewRay ray = to_rest_ ? straight_ray(n) : lensed_ray(n);
  if (to_measured_ && ray.known && ray.sky != SkyRegion::kIV)
    ray.frequency_ratio *= measured_ratio(n);
  return ray;
}

// Without lensing, light near a hole goes straight in the frame of the observer at rest.
ViewRay ViewTracer::straight_ray(const CameraDirection& n) const {
  const AberratedLight in = Aberration(vantage_.celerity).to_rest(apply(tetrad_from_camera_, n.v));
  const AberratedLight rest = to_rest_->to_rest(in.direction);
  const double doppler = 1 / (in.frequency_ratio * rest.frequency_ratio);
  ViewRay ray;
  ray.sky = own_sky_;
  ray.known = true;
  ray.sky_direction = apply(sky_from_tetrad_, rest.direction);
  ray.frequency_ratio = gravitational_ratio_ * doppler;
  ray.radial_scale = ray.tangential_scale = ray.bundle.doppler = doppler;
  return ray;
}

void ViewTracer::straight_rays(const CameraDirection* n, int count, ViewRayBatch& batch) const {
  for (int k = 0; k < count; ++k) {
    const ViewRay ray = straight_ray(n[k]);
    batch.sky[k] = ray.sky;
    batch.sky_x[k] = ray.sky_direction.x;
    batch.sky_y[k] = ray.sky_direction.y;
    batch.sky_z[k] = ray.sky_direction.z;
    batch.frequency_ratio[k] = ray.frequency_ratio;
    batch.along_x[k] = batch.along_y[k] = batch.along_z[k] = 0;  // the footprint is round
    batch.radial_scale[k] = batch.tangential_scale[k] = ray.radial_scale;
    batch.to_edge[k] = ray.to_edge;
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
