// Of StarImages what handles whole batches.
#include <algorithm>
#include <cmath>

#include "pipeline/render/stars/star_arcs.h"
#include "pipeline/render/stars/star_colours.h"
#include "pipeline/render/stars/star_images.h"

namespace domefall {
namespace {

// Of the orders 0 and 1, of 2 and 3, and so on, whose images change only near the edge.
constexpr int kIntervals[] = {512, 64, 64, 64};
// What may be wrong: pixels, and parts of the light.
constexpr double kPositionError = 0.01, kFluxError = 1e-4;
// A batch goes no nearer to the axis, where the azimuth of a source is lost in rounding.
constexpr double kOnAxis = 1e-6;
constexpr double kFade = 0.5;  // magnitudes; see part_taken

void copy_source(const StarSources& from, int k, StarSources& to, int at) {
  const auto i = static_cast<std::size_t>(k), o = static_cast<std::size_t>(at);
  to.y[o] = from.y[i], to.z[o] = from.z[i];
  to.sine[o] = from.sine[i], to.v[o] = from.v[i];
  to.flux[o] = from.flux[i], to.temperature[o] = from.temperature[i];
}

}  // namespace

struct StarImages::Batch {
  std::size_t first;  // of the catalogue
  int count;
  StarSources sources;
  StarColumn<int> open;  // sources that are not on the axis
  int open_count = 0;
  // What is done the exact way: orders first_order to before end_order of a source.
  struct Left {
    int source, first_order, end_order;
  };
  std::vector<Left> left;
};

void StarImages::prepare_batches() {
  batch_frame_.sky_from_tetrad = observer_.sky_from_tetrad;
  batch_frame_.tetrad_from_camera = observer_.tetrad_from_camera;
  batch_frame_.from_tetrad = from_tetrad_;
  batch_frame_.gain = sky_.star_gain;
  // A hard limit is that of count().
  batch_frame_.limit = sky_.soft_limit ? sky_.max_magnitude : HUGE_VAL;
  batch_frame_.inverse_fade = 1 / kFade;
  // The light observed is amplification (1+z)^-4 doppler^2, of the most luminous colour at most.
  per_flux_ = star_colours().most_luminance() * peak_per_lux_ * stretch_ * stretch_ / kFaintestPeak;
  bound_.fill(per_flux_);
  if (table_ == nullptr) return;
  batch_frame_.psi = psi_frame(*table_);
  const LensCurve::Wanted wanted{
      kPositionError * central_pixel_angle(scene_.projection()) / stretch_, kFluxError};
  for (const int intervals : kIntervals)
    curves_.emplace_back(*table_, static_cast<int>(curves_.size()), intervals, wanted);
  for (int order = kLastOrder - 1; order >= 0; --order) {
    const auto k = static_cast<std::size_t>(order);
    const double most = order < 2 * kCurves ? curves_[k / 2].largest_bound(order % 2 != 0)
                                            : most_light_from(*table_, order);
    // Of this order and all that follow.
    bound_[k] = std::max(most * per_flux_, order + 1 < kLastOrder ? bound_[k + 1] : 0);
  }
}

std::size_t StarImages::count(const SceneStars& stars) const {
  std::size_t number = stars.count_to_magnitude(sky_.max_magnitude);
  if (!plain_) return number;
  // As near to the axis as it gets; there is none in flat space.
  const double least = table_ == nullptr ? 1 : disc_ / 2;
  while (number > 0 && !(stars.most_flux_from(number - 1) * sky_.star_gain * bound_[0] > least))
    number = (number - 1) / SceneStars::kBlock * SceneStars::kBlock;
  return number;
}

void StarImages::append(const SceneStars& stars, std::size_t first, std::size_t end,
                        std::vector<StarImage>& images) const {
  end = std::min(end, first + kStarBatch);
  if (!plain_) {
    for (std::size_t k = first; k < end; ++k) append(stars[k], images);
    return;
  }
  Batch batch;
  batch.first = first;
  const int count = batch.count = static_cast<int>(end - first);
  find_sources(batch_frame_, stars, first, count, batch.sources);
  if (table_ == nullptr) {
    StarViews views;
    go_straight(batch_frame_, batch.sources, count, views);
    append_views(views, count, images);
    return;
  }
  leave_axis(batch);
  for (int order = 0; order < 2 * kCurves && batch.open_count > 0; ++order) {
    keep_bright(batch, order);
    append_curved(batch, order, images);
  }
  leave_orders_beyond(batch);
  append_exact(stars, batch, images);
}

void StarImages::leave_axis(Batch& batch) const {
  const double near = std::max(kNearAxis * disc_, kOnAxis);
  for (int k = 0; k < batch.count; ++k) {
    batch.open[static_cast<std::size_t>(batch.open_count)] = k;
    if (batch.sources.sine[static_cast<std::size_t>(k)] < near)
      batch.left.push_back({k, 0, kLastOrder});
    else
      ++batch.open_count;
  }
}

// Of the open sources those that may be seen in this order or a later one.
void StarImages::keep_bright(Batch& batch, int order) const {
  const double bound = bound_[static_cast<std::size_t>(order)];
  int kept = 0;
  for (int n = 0; n < batch.open_count; ++n) {
    const int source = batch.open[static_cast<std::size_t>(n)];
    const auto k = static_cast<std::size_t>(source);
    batch.open[static_cast<std::size_t>(kept)] = source;
    kept += batch.sources.flux[k] * bound > batch.sources.sine[k] ? 1 : 0;
  }
  batch.open_count = kept;
}

// The images of the batch that one order has, by its curve.
void StarImages::append_curved(Batch& batch, int order, std::vector<StarImage>& images) const {
  const LensCurve& curve = curves_[static_cast<std::size_t>(order / 2)];
  const double side = order % 2 == 0 ? 1 : -1;
  const float* bounds = curve.bound();
  StarColumn<int> picked;
  int count = 0;
  for (int n = 0; n < batch.open_count; ++n) {
    const int source = batch.open[static_cast<std::size_t>(n)];
    const auto k = static_cast<std::size_t>(source);
    const float bound = bounds[curve.interval_of(side * batch.sources.v[k])];
    picked[static_cast<std::size_t>(count)] = source;
    count += batch.sources.flux[k] * per_flux_ * bound > batch.sources.sine[k] ? 1 : 0;
    if (bound < 0) batch.left.push_back({source, order, order + 1});
  }
  if (count == 0) return;
  StarViews views;
  if (count == batch.count) {
    bend(batch_frame_, curve, side, batch.sources, count, views);
  } else {
    StarSources copied;
    for (int n = 0; n < count; ++n)
      copy_source(batch.sources, picked[static_cast<std::size_t>(n)], copied, n);
    bend(batch_frame_, curve, side, copied, count, views);
  }
  append_views(views, count, images);
}

void StarImages::leave_orders_beyond(Batch& batch) const {
  keep_bright(batch, 2 * kCurves);
  for (int n = 0; n < batch.open_count; ++n)
    batch.left.push_back({batch.open[static_cast<std::size_t>(n)], 2 * kCurves, kLastOrder});
}

void StarImages::append_exact(const SceneStars& stars, const Batch& batch,
                              std::vector<StarImage>& images) const {
  for (const Batch::Left& left : batch.left)
    if (const auto star = taken(stars[batch.first + static_cast<std::size_t>(left.source)]))
      append_orders(*star, apply_transposed(observer_.sky_from_tetrad, star->direction.v),
                    left.first_order, left.end_order, images);
}

// Colours what lies in the picture.
void StarImages::append_views(StarViews& views, int count, std::vector<StarImage>& images) const {
  StarColumn<int> listed;
  const int number = plane_.place(views, count, listed.data());
  const StarColours& colours = star_colours();
  std::size_t bright = images.size();
  images.resize(bright + static_cast<std::size_t>(number));
  for (int n = 0; n < number; ++n) {
    const auto k = static_cast<std::size_t>(listed[static_cast<std::size_t>(n)]);
    const StarColours::Light per_flux = colours(views.temperature[k]);
    const double flux = views.flux[k], pixel_flux = flux * scene_.exposure;
    images[bright] = {
        static_cast<float>(views.i[k]),
        static_cast<float>(views.j[k]),
        {static_cast<float>(per_flux.r * pixel_flux), static_cast<float>(per_flux.g * pixel_flux),
         static_cast<float>(per_flux.b * pixel_flux)}};
    bright += per_flux.luminance * flux * peak_per_lux_ > kFaintestPeak ? 1 : 0;
  }
  images.resize(bright);
}

}  // namespace domefall
