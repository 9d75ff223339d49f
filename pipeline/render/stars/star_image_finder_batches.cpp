// This part of the class StarImageFinder finds the images of a batch of stars at once.
#include <algorithm>
#include <cmath>

#include "pipeline/render/scene/star_light.h"
#include "pipeline/render/stars/blackbody_table.h"
#include "pipeline/render/stars/star_image_finder.h"

namespace domefall {
namespace {

// Sources at a smaller angle (radians) from the axis are not found in batches, since their azimuth
// about the axis is lost in rounding.
constexpr double kOnAxis = 1e-6;

void copy_source(const StarSources& from, int k, StarSources& to, int at) {
  const auto i = static_cast<std::size_t>(k), o = static_cast<std::size_t>(at);
  to.x[o] = from.x[i], to.y[o] = from.y[i], to.z[o] = from.z[i];
  to.sine[o] = from.sine[i], to.v[o] = from.v[i];
  to.flux[o] = from.flux[i], to.temperature[o] = from.temperature[i];
}

}  // namespace

// A Batch holds up to kStarBatch stars on their way to images.
struct StarImageFinder::Batch {
  std::size_t first;  // index of its first star
  int count;
  StarSources sources;
  // The next order of these sources is found at once.  They are off the axis and bright enough.
  StarColumn<int> candidates;
  int candidate_count = 0;
  // The orders of a source from first_order to before end_order are found one by one.
  struct SetAside {
    int source, first_order, end_order;
  };
  std::vector<SetAside> set_aside;
};

void StarImageFinder::prepare_batches() {
  batch_frame_.axes = axes_;
  batch_frame_.tetrad_from_camera = observer_.tetrad_from_camera;
  batch_frame_.from_tetrad = from_tetrad_;
  batch_frame_.gain = sky_.star_gain;
  // count() has applied a hard limit.
  batch_frame_.limit = sky_.soft_limit ? sky_.max_magnitude : HUGE_VAL;
  batch_frame_.inverse_fade = 1 / kFadeMagnitudes;
  // The boost multiplies amplification/(1+z)^4 in the tetrad by the square of its frequency ratio,
  // which is at most stretch_.
  brightness_per_flux_ =
      blackbody_table().most_luminance() * peak_per_lux_ * stretch_ * stretch_ / kFaintestPeak;
  // A bound covers all later orders too, so it is the largest from the last order down.
  bound_.resize(static_cast<std::size_t>(points_->orders()));
  double largest = 0;
  for (int order = points_->orders() - 1; order >= 0; --order) {
    largest = std::max(points_->most_light(order) * brightness_per_flux_, largest);
    bound_[static_cast<std::size_t>(order)] = largest;
  }
}

std::size_t StarImageFinder::count(const SceneStars& stars) const {
  if (!points_) return 0;
  std::size_t number = stars.count_to_magnitude(sky_.max_magnitude);
  if (!in_batches_) return number;
  // The sine of the angle from the axis counts as half the radius of the star's disc or more
  // (least_sine()).
  const double least = points_->has_axis() ? scene_.least_star_radius / 2 : 1;
  while (number > 0 && !(stars.most_flux_from(number - 1) * sky_.star_gain * bound_[0] > least))
    number = (number - 1) / SceneStars::kBlock * SceneStars::kBlock;
  return number;
}

void StarImageFinder::append(const SceneStars& stars, std::size_t first, std::size_t end,
                             std::vector<StarImage>& images) const {
  end = std::min(end, first + kStarBatch);
  if (!in_batches_ || points_->lists_images()) {
    for (std::size_t k = first; k < end; ++k) append(stars[k], images);
    return;
  }
  Batch batch;
  batch.first = first;
  const int count = batch.count = static_cast<int>(end - first);
  find_sources(batch_frame_, stars, first, count, batch.sources);
  points_->locate(batch.sources, count);
  set_aside_axis(batch, stars.most_angular_radius());
  for (int order = 0; order < points_->orders_in_batches() && batch.candidate_count > 0; ++order) {
    drop_faint(batch, order);
    append_batch(batch, order, images);
  }
  set_aside_high_orders(batch);
  append_exact(stars, batch, images);
}

void StarImageFinder::set_aside_axis(Batch& batch, double most_radius) const {
  const double near =
      std::max({kNearAxis * std::max(scene_.least_star_radius, most_radius), near_, kOnAxis});
  for (int k = 0; k < batch.count; ++k) {
    batch.candidates[static_cast<std::size_t>(batch.candidate_count)] = k;
    if (batch.sources.sine[static_cast<std::size_t>(k)] < near)
      batch.set_aside.push_back({k, 0, points_->orders()});
    else
      ++batch.candidate_count;
  }
}

// Drops the candidates that are too faint in this order and in all that follow.
void StarImageFinder::drop_faint(Batch& batch, int order) const {
  const double bound = bound_[static_cast<std::size_t>(order)];
  int kept = 0;
  for (int n = 0; n < batch.candidate_count; ++n) {
    const int source = batch.candidates[static_cast<std::size_t>(n)];
    const auto k = static_cast<std::size_t>(source);
    batch.candidates[static_cast<std::size_t>(kept)] = source;
    kept += batch.sources.flux[k] * bound > batch.sources.sine[k] ? 1 : 0;
  }
  batch.candidate_count = kept;
}

// Appends the candidates' images of one order.  Sources whose images the lens does not find in
// batches are set aside.
void StarImageFinder::append_batch(Batch& batch, int order, std::vector<StarImage>& images) const {
  StarColumn<float> bounds;
  points_->bounds(order, batch.sources, batch.candidates.data(), batch.candidate_count,
                  bounds.data());
  StarColumn<int> bright;
  int count = 0;
  for (int n = 0; n < batch.candidate_count; ++n) {
    const int source = batch.candidates[static_cast<std::size_t>(n)];
    const auto k = static_cast<std::size_t>(source);
    const float bound = bounds[static_cast<std::size_t>(n)];
    bright[static_cast<std::size_t>(count)] = source;
    count += batch.sources.flux[k] * brightness_per_flux_ * bound > batch.sources.sine[k] ? 1 : 0;
    if (bound < 0) batch.set_aside.push_back({source, order, order + 1});
  }
  if (count == 0) return;
  // If all sources of the batch are bright, they need not be copied.
  StarSources copied;
  const StarSources* sources = &batch.sources;
  if (count < batch.count) {
    for (int n = 0; n < count; ++n)
      copy_source(batch.sources, bright[static_cast<std::size_t>(n)], copied, n);
    sources = &copied;
  }
  PointImageBatch bent;
  points_->images(order, *sources, count, bent);
  StarViews views;
  receive_images(batch_frame_, bent, *sources, count, views);
  append_views(views, count, kFaintestPeak, images);
}

void StarImageFinder::set_aside_high_orders(Batch& batch) const {
  const int first = points_->orders_in_batches();
  if (first >= points_->orders()) return;
  drop_faint(batch, first);
  for (int n = 0; n < batch.candidate_count; ++n)
    batch.set_aside.push_back(
        {batch.candidates[static_cast<std::size_t>(n)], first, points_->orders()});
}

// Appends the images that were set aside, one by one.
void StarImageFinder::append_exact(const SceneStars& stars, const Batch& batch,
                                   std::vector<StarImage>& images) const {
  for (const Batch::SetAside& orders : batch.set_aside)
    if (const auto star = with_gain(stars[batch.first + static_cast<std::size_t>(orders.source)]))
      append_orders(*star, apply_transposed(axes_, star->direction.v), orders.first_order,
                    orders.end_order, images);
}

// Gives the views that reach the frame their colours, and appends those that are brighter than
// `least_peak`.
void StarImageFinder::append_views(StarViews& views, int count, double least_peak,
                                   std::vector<StarImage>& images) const {
  StarColumn<int> listed;
  const int number = plane_.place(views, count, listed.data());
  const BlackbodyTable& blackbodies = blackbody_table();
  std::size_t bright = images.size();
  images.resize(bright + static_cast<std::size_t>(number));
  for (int n = 0; n < number; ++n) {
    const auto k = static_cast<std::size_t>(listed[static_cast<std::size_t>(n)]);
    const BlackbodyTable::Light per_flux = blackbodies(views.temperature[k]);
    const WorkingRgb colour =
        saturated({per_flux.r, per_flux.g, per_flux.b}, per_flux.luminance, scene_.star_saturation);
    const double flux = views.flux[k], pixel_flux = flux * scene_.exposure;
    images[bright] = {
        static_cast<float>(views.i[k]),
        static_cast<float>(views.j[k]),
        {static_cast<float>(colour.r * pixel_flux), static_cast<float>(colour.g * pixel_flux),
         static_cast<float>(colour.b * pixel_flux)}};
    bright += per_flux.luminance * flux * peak_per_lux_ > least_peak ? 1 : 0;
  }
  images.resize(bright);
}

bool StarImageFinder::append_trail_in_batches(const SceneStar& star, const StarTrail& trail,
                                              std::vector<StarImage>& images) const {
  const M33d& camera = observer_.tetrad_from_camera;
  StarViews views;
  std::vector<int> pieces;
  double brightest = 0;
  for (std::size_t k = 0; k < trail.parts(); ++k) {
    // The whole part as one piece, of a star of unit flux and temperature, shows how bright it is.
    trail.store(k, 1, 0, 1, from_tetrad_, camera, views, 0);
    const double luminance = blackbody_table()(star.temperature * views.temperature[0]).luminance;
    const double peak = luminance * star.flux * views.flux[0] * peak_per_lux_;
    pieces.push_back(pieces_of(sigmas_of(trail, k), peak, brightest));
  }
  if (!(brightest > kFaintestPeak)) return false;
  int filled = 0;
  const auto append_filled = [&] {
    for (int k = 0; k < filled; ++k) {
      views.flux[static_cast<std::size_t>(k)] *= star.flux;
      views.temperature[static_cast<std::size_t>(k)] *= star.temperature;
    }
    append_views(views, filled, 0, images);
    filled = 0;
  };
  for (std::size_t k = 0; k < trail.parts(); ++k)
    for (int first = 0; first < pieces[k];) {
      const int count = std::min(pieces[k] - first, kStarBatch - filled);
      trail.store(k, pieces[k], first, count, from_tetrad_, camera, views, filled);
      first += count;
      filled += count;
      if (filled == kStarBatch) append_filled();
    }
  append_filled();
  return true;
}

}  // namespace domefall
