#include "pipeline/render/disc/disc_pass.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "pipeline/render/disc/disc_row.h"
#include "pipeline/render/disc/kerr_strip.h"
#include "pipeline/render/disc/rim_coverage.h"
#include "pipeline/render/disc/sphere_strip.h"

namespace domefall {
namespace {

using std::numbers::pi;

// Returns the part of a pixel that an image covers, which lies beyond its outer rim and not beyond its
// inner rim.
double covered_part(const PlaneCrossings& pixel, const PlaneImages::Interval& rims, double r) {
  const double p = pixel.label[0], per = pixel.label_per[0];
  const auto beyond = [&](double rim) {
    return beyond_rim((p - rim) / per * label_bend(p, rim, r));
  };
  return std::clamp(beyond(rims.low) - beyond(rims.high), 0.0, 1.0);
}

// Returns the part u of an image's interval at a label.
double part_between(const PlaneImages::Interval& rims, double label) {
  return std::clamp((label - rims.low) / (rims.high - rims.low), 0.0, 1.0);
}

}  // namespace

DiscPass::DiscPass(const FrameScene& scene) : scene_(scene) {
  const Disc& disc = scene.disc->disc();
  const ObserverState& observer = scene.state.observer;
  const V3d normal = apply_transposed(observer.sky_from_tetrad, disc.normal.v);
  const Lens& lens = *scene.tracer.lens();
  kerr_plane_ = lens.kerr_plane({disc.inner, disc.outer});
  if (!kerr_plane_)
    plane_ =
        lens.plane({normal, disc.inner, disc.outer, !disc.patterns.empty()}, observer.null_time);
  if (disc.height > 0) gas_.emplace(scene);
  pattern_ = scene.disc->pattern();
  node_ = apply_transposed(observer.sky_from_tetrad, disc.node.v);
  quarter_ = normal.cross(node_);
}

std::unique_ptr<DiscPass::Strip> DiscPass::make_strip() const {
  if (kerr_plane_) return std::make_unique<KerrStrip>(*this);
  return std::make_unique<SphereStrip>(*this);
}

void DiscPass::locate(const CameraDirection* n, const double* angle, int count,
                      Crossings& crossings) const {
  scene_.tracer.into_frame(n, count, crossings.rays);
  DirectionBatch::Column<double> width;
  for (int k = 0; k < count; ++k) width[k] = angle[k] * crossings.rays.scale[k];
  plane_->locate(crossings.rays, width.data(), count, crossings);
}

double DiscPass::left_before(const CameraDirection& n, double psi, double width) const {
  // A body that moves in the plane itself is not hidden by the disc there.
  constexpr double kInPlane = 1e-6;
  if (gas_) return static_cast<double>(gas_->sight_before(n, psi).left);
  if (kerr_plane_) return KerrStrip(*this).left_before(n, psi, width);
  Crossings pixel;
  locate(&n, &width, 1, pixel);
  if (!(pixel.energy[0] > 0)) return 1;
  // Each image that the ray crosses before psi takes its part of the light.
  double left = 1;
  for (int order = 0; order < plane_->images().orders(); ++order) {
    const double turn = pixel.turn[0] + order * pi;
    if (turn > psi - kInPlane) break;
    const PlaneImages::Interval rims = plane_->images().interval(turn);
    const double covered = covered_part(pixel, rims, scene_.state.observer.r);
    if (!(covered > 0)) continue;
    const Gas gas = gas_at(pixel, 0, turn, pixel.label[0], part_between(rims, pixel.label[0]),
                           pixel.azimuth_sine[0]);
    left *= 1 - scene_.state.settings.disc_opacity * covered * gas.absorbed;
  }
  return left;
}

DiscPass::Gas DiscPass::gas_at(const Crossings& crossings, int k, double turn, double label,
                               double u, double azimuth_sine) const {
  const double r = 1 / plane_->images().inverse_radius(turn, u);
  const double energy = crossings.energy[k], momentum = plane_->momentum(label, energy);
  const double about = plane_->about_normal(azimuth_sine);
  const Disc& disc = scene_.disc->disc();
  const GasOrbits& orbits = disc.orbits;
  const double shift = disc_shift(orbits, {energy, momentum, momentum * about}, r,
                                  r < orbits.last_stable() && goes_outward(turn, label, u));
  if (disc.is_opaque()) return {r, crossings.rays.frequency[k] / shift, 1};
  // The ray's part along the normal, which the gas's motion in the plane leaves as it is.
  const double across = momentum / r * std::sqrt(std::max(0.0, 1 - about * about));
  return {r, crossings.rays.frequency[k] / shift,
          absorbed_part(disc, r, scene_.state.observer.r, across / shift)};
}

// Says whether light sets out to larger radii.  If so, w grows along the ray back in time.
bool DiscPass::goes_outward(double turn, double label, double u) const {
  constexpr double kStep = 1e-3;
  const PlaneImages::Interval later = plane_->images().interval(turn + kStep);
  const double then = std::clamp((label - later.low) / (later.high - later.low), 0.0, 1.0);
  return plane_->images().inverse_radius(turn + kStep, then) >
         plane_->images().inverse_radius(turn, u);
}

std::vector<DiscPass::Place> DiscPass::places(const CameraDirection& n, double width) const {
  if (kerr_plane_) return KerrStrip(*this).places(n, width);
  Crossings pixel;
  locate(&n, &width, 1, pixel);
  std::vector<Place> places;
  if (!(pixel.energy[0] > 0)) return places;
  const double p = pixel.label[0];
  for (int order = 0; order < plane_->images().orders(); ++order) {
    const double turn = pixel.turn[0] + order * pi;
    const PlaneImages::Interval rims = plane_->images().interval(turn);
    const double covered = covered_part(pixel, rims, scene_.state.observer.r);
    if (!(covered > 0)) continue;
    const double sine = pixel.azimuth_sine[0];
    const Gas gas = gas_at(pixel, 0, turn, p, part_between(rims, p), sine);
    const V3d place = plane_->place(turn, pixel.azimuth_cosine[0], sine);
    places.push_back({order, gas.r, std::atan2(place.dot(quarter_), place.dot(node_)),
                      gas.frequency_ratio, covered});
    if (scene_.state.settings.disc_opacity * covered * gas.absorbed == 1) break;
  }
  return places;
}

void DiscPass::draw(Row& line, int first, int end, float* rgb, float* left) const {
  const std::ptrdiff_t width = columns(scene_.projection());
  for (int row = first; row < end; ++row)
    line.draw(row, rgb + 3 * (row - first) * width, left ? left + (row - first) * width : nullptr);
}

void DiscPass::draw_rows(int first, int end, float* rgb, float* left) const {
  Row line(*this, Row::is_steady(scene_));
  draw(line, first, end, rgb, left);
}

void DiscPass::fill_orders(int row, std::span<float* const> orders) const {
  Row(*this, false).fill_orders(row, orders);
}

void DiscPass::draw_rows_singly(int first, int end, float* rgb) const {
  Row line(*this, false);
  draw(line, first, end, rgb, nullptr);
}

}  // namespace domefall
