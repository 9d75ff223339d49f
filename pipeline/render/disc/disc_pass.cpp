#include "pipeline/render/disc/disc_pass.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "pipeline/render/disc/disc_row.h"
#include "pipeline/render/disc/rim_coverage.h"
#include "pipeline/simd/vector_math.h"

namespace domefall {
namespace {

using std::numbers::pi;

DiscImages images_for(const FrameScene& scene) {
  const Disc& disc = scene.disc->disc();
  return {Radius(scene.state.observer.r),
          is_outgoing(scene.state.observer.tetrad),
          scene.tracer.goes_straight(),
          disc.inner,
          disc.outer,
          disc.pattern.has_value()};
}

}  // namespace

DiscPass::Clock::Clock(const ObserverState& observer) : outgoing(is_outgoing(observer.tetrad)) {
  const double r = observer.r, tortoise = r + 2 * logarithm(std::abs(r / 2 - 1));
  // The t of a mirrored observer counts backwards.  With t -> -t, v = t + r* becomes 2 r* - v, and
  // u = t - r* becomes -2 r* - u.
  null_time = is_mirrored(observer.tetrad) ? (outgoing ? -2 : 2) * tortoise - observer.null_time
                                           : observer.null_time;
  observer_v = outgoing ? null_time + 2 * tortoise : null_time;
}

double DiscPass::Clock::time_at(double r, double delay) const {
  // On the horizon r* is infinite.  No pattern shows there, so that a finite number will do.
  constexpr double kLeast = 1e-9;
  const double tortoise = r + 2 * logarithm(std::max(r / 2 - 1, kLeast));
  return null_time + delay + (outgoing ? tortoise : -tortoise);
}

DiscPass::DiscPass(const FrameScene& scene)
    : scene_(scene),
      images_(images_for(scene)),
      r_(scene.state.observer.r),
      s_(std::sqrt(2 / r_)),
      one_minus_s_((r_ - 2) / (r_ * (1 + s_))),
      label_sign_(is_outgoing(scene.state.observer.tetrad) ? -1 : 1),
      energy_sign_(is_mirrored(scene.state.observer.tetrad) ? -1 : 1),
      clock_(scene.state.observer) {
  const Disc& disc = scene.disc->disc();
  if (disc.pattern) pattern_.emplace(*disc.pattern);
  const V3d normal =
      apply_transposed(scene.state.observer.sky_from_tetrad, scene.disc->disc().normal.v);
  normal_up_ = normal.x;
  normal_across_ = std::sqrt(normal.y * normal.y + normal.z * normal.z);
  normal_cosine_ = normal_across_ > 0 ? normal.y / normal_across_ : 1;
  normal_sine_ = normal_across_ > 0 ? normal.z / normal_across_ : 0;
  node_ = apply_transposed(scene.state.observer.sky_from_tetrad, disc.node.v);
  quarter_ = normal.cross(node_);
  // Straight light is labelled in the frame of the observer at rest, where alpha counts from the
  // hole and p = cos alpha/(r sin alpha).
  if (scene.tracer.goes_straight()) label_sign_ = 1;
}

double DiscPass::left_before(const CameraDirection& n, double psi) const {
  // A body that moves in the plane itself is not hidden by the disc there.
  constexpr double kInPlane = 1e-6;
  Crossings pixel;
  const double angle = central_pixel_angle(scene_.projection());
  locate(&n, &angle, 1, pixel);
  if (!(pixel.energy[0] > 0)) return 1;
  const double p = pixel.label[0], per = pixel.label_per[0];
  // Each image that the ray crosses before psi takes its part of the light.  An image covers the
  // part of the pixel that lies beyond its outer rim and not beyond its inner rim.
  double left = 1;
  for (int order = 0; order < images_.orders(); ++order) {
    const double turn = pixel.turn[0] + order * pi;
    if (turn > psi - kInPlane) break;
    const DiscImages::Interval rims = images_.interval(turn);
    const double covered = beyond_rim((p - rims.low) / per) - beyond_rim((p - rims.high) / per);
    left *= 1 - scene_.disc->disc().opacity * std::clamp(covered, 0.0, 1.0);
  }
  return left;
}

void DiscPass::draw(Row& line, int first, int end, float* rgb) const {
  for (int row = first; row < end; ++row)
    line.draw(row,
              rgb + 3 * static_cast<std::ptrdiff_t>(row - first) * columns(scene_.projection()));
}

void DiscPass::draw_rows(int first, int end, float* rgb) const {
  Row line(*this, Row::is_steady(scene_));
  draw(line, first, end, rgb);
}

void DiscPass::draw_rows_singly(int first, int end, float* rgb) const {
  Row line(*this, false);
  draw(line, first, end, rgb);
}

}  // namespace domefall
