#include "pipeline/render/disc/kerr_strip.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "pipeline/base/simd/vector_math.h"
#include "pipeline/light/kerr_ray.h"
#include "pipeline/render/disc/rim_coverage.h"
#include "pipeline/sources/disc/disc_light.h"

namespace domefall {
namespace {

using std::numbers::pi;

// Pixels closer to the edge than so many of their widths are the mean of pieces on lines along the edge.
// From there images are much alike in the logarithm of the distance, so each piece is as high as kPart of
// its distance, or reaches from the edge to kLeast widths.
constexpr double kNearEdge = 8, kPart = 0.15, kLeast = 0.03;
constexpr int kMostSamples = 32;
// The weights of pieces are a tent of a pixel and a half, as about what a pixel's square has of a thin
// ring at any angle.
constexpr double kReach = 0.75;

// Returns the weight of what a pixel has before a place, in its widths from its middle.
double weight_before(double place) {
  const double rest = std::max(0.0, 1 - std::abs(place) / kReach), beyond = rest * rest / 2;
  return place < 0 ? beyond : 1 - beyond;
}

}  // namespace

DiscPass::KerrStrip::KerrStrip(const DiscPass& pass)
    : Strip(pass),
      plane_(*pass.kerr_plane_),
      clock_(plane_.at().hole),
      low_(1 / disc_.outer),
      high_(1 / disc_.inner),
      sense_(disc_.orbits.spin() < 0 ? -1 : 1),
      sine_(std::sin(static_cast<double>(plane_.at().theta))),
      cosine_(std::cos(static_cast<double>(plane_.at().theta))) {}

void DiscPass::KerrStrip::locate(const CameraDirection* n, const double* angle, int count) {
  pixels_ = count;
  pass_.scene_.tracer.into_frame(n, count, rays_);
  for (int k = 0; k < count; ++k) {
    const double x = rays_.x[k], y = rays_.y[k], z = rays_.z[k], beside = length(y, z);
    Pixel& pixel = at_[static_cast<std::size_t>(k)];
    pixel.delta = std::atan2(beside, -x);
    pixel.eta = beside > 0 ? std::atan2(-z, -y) : 0;
    pixel.width = angle[k] * rays_.scale[k];
    pixel.sight = plane_.sight(pixel.delta, pixel.eta);
  }
}

DiscPass::KerrStrip::Image DiscPass::KerrStrip::image(const Piece& piece,
                                                      const KerrPlane::Crossing& at) const {
  const double w = at.w.value, per = std::max(length(piece.along(at.w), piece.across(at.w)), 1e-12);
  return {w, per, beyond_rim((w - high_) / per), beyond_rim((w - low_) / per)};
}

DiscPass::Gas DiscPass::KerrStrip::gas(const Piece& piece, const KerrPlane::Crossing& at,
                                       double r) const {
  const GasOrbits& orbits = disc_.orbits;
  const GasRay ray{piece.sight.energy, piece.sight.momentum, sense_ * piece.sight.about_axis};
  const double shift = disc_shift(orbits, ray, r, at.speed.value > 0);
  // Within a pixel next to where a ray turns around there is gas at radii that the ray itself misses.
  if (!(shift > 0)) return {r, 0, 0};
  if (disc_.is_opaque()) return {r, piece.frequency / shift, 1};
  const double y = ray.about_axis - orbits.spin() * ray.energy;
  const double across = std::sqrt(std::max(0.0, ray.momentum * ray.momentum - y * y)) / r;
  return {r, piece.frequency / shift,
          absorbed_part(disc_, r, pass_.scene_.state.observer.r, std::min(1.0, across / shift))};
}

// Returns the azimuth of gas in the coordinates of Boyer and Lindquist.
double DiscPass::KerrStrip::azimuth(double angle, double r) const {
  const SineCosine at = sin_cos(angle);
  const V3d place(at.cosine * sine_, at.cosine * cosine_, at.sine);
  return std::atan2(place.dot(pass_.quarter_), place.dot(pass_.node_)) - sense_ * clock_.twist(r);
}

// Returns the place and the time of a sample for the pattern.  `part` is the range of w that the sample
// covers, and `of_width` how much of the piece's width.
PatternPlace DiscPass::KerrStrip::place(const Piece& piece, const KerrPlane::Crossing& at, double r,
                                        double part, double of_width) const {
  // Both are infinite on the horizon, where no light is seen.
  const double outside = std::max(r, disc_.orbits.horizon() * (1 + 1e-9));
  const double seen = pass_.scene_.state.observer.null_time;
  const double time = disc_.slow_light ? seen + at.time.value - clock_.tortoise(outside) : seen;
  // The gas turns on while the time of emission changes.
  const double turning = disc_.slow_light ? disc_.orbits.angular_velocity(r) : 0;
  const double along = piece.along(at.angle) - sense_ * turning * piece.along(at.time),
               across = piece.across(at.angle) - sense_ * turning * piece.across(at.time);
  // Across the gradient of w, and along it.
  const double x = piece.along(at.w), y = piece.across(at.w),
               steep = std::max(length(x, y), 1e-300);
  const double beside = (across * x - along * y) / steep,
               onward = (along * x + across * y) / steep * of_width;
  return {r, azimuth(at.angle.value, outside), time, part * r * r, length(beside, onward)};
}

// Adds the samples of a piece, and returns the part of the light from behind that is left there.
double DiscPass::KerrStrip::gather_piece(int k, const Piece& piece) {
  constexpr double kPart = 0.03;
  double left = 1;
  for (int order = 0; order < KerrPlane::kOrders && left > 1e-4; ++order) {
    if (!piece.sight.crosses[static_cast<std::size_t>(order)]) continue;
    const KerrPlane::Crossing& at = piece.sight.at[static_cast<std::size_t>(order)];
    const Image seen = image(piece, at);
    if (!(seen.covered() > 1e-5)) continue;
    const auto w_at = [&](double beyond) {
      return std::clamp(seen.w - distance_to_rim(beyond) * seen.per, low_, high_);
    };
    const double range = w_at(seen.beyond_inner) - w_at(seen.beyond_outer);
    const int count =
        std::clamp(static_cast<int>(std::ceil(range / (high_ - low_) / kPart)), 1, kMostSamples);
    std::array<Gas, kMostSamples> samples;
    double absorbed = 0;
    for (int n = 0; n < count; ++n) {
      const double r = 1 / w_at(seen.beyond_outer - seen.covered() * (n + 0.5) / count);
      absorbed += (samples[static_cast<std::size_t>(n)] = gas(piece, at, r)).absorbed;
    }
    if (!(absorbed > 0)) continue;
    const double taking =
        pass_.scene_.state.settings.disc_opacity * seen.covered() * absorbed / count;
    const double light = piece.weight * left * taking;
    take(k, order) += light;
    for (int n = 0; n < count; ++n) {
      const Gas& one = samples[static_cast<std::size_t>(n)];
      if (!(one.absorbed > 0)) continue;
      add(k, one, light / absorbed,
          pass_.pattern_ ? place(piece, at, one.r, range / count, 1.0 / count) : PatternPlace{});
    }
    left *= 1 - taking;
  }
  return left;
}

double DiscPass::KerrStrip::gather_pixel(int k) {
  const Pixel& pixel = at_[static_cast<std::size_t>(k)];
  const double off = pixel.from_edge();
  if (std::abs(off) > kNearEdge) {
    if (!pixel.sight.from_region_one) return 1;
    return gather_piece(k, {pixel.sight, pixel.width, pixel.width, 1, rays_.frequency[k]});
  }
  return gather_side(k, 1, off) + gather_side(k, -1, -off);
}

// Adds the pieces of a pixel on the side of the edge away from the hole (1) or on the other (-1), on which
// its middle is `off` widths from the edge.  Returns the part of the light from behind that is left there.
double DiscPass::KerrStrip::gather_side(int k, int side, double off) {
  const Pixel& pixel = at_[static_cast<std::size_t>(k)];
  const double nearest = std::max(off - kReach, 0.0), from = std::max(nearest, kLeast);
  const double way = std::log(std::max((off + kReach) / from, 1.0));
  const int pieces = static_cast<int>(std::ceil(way / kPart));
  const double slope = pixel.sight.edge_slope, cosine = pixel.edge_cosine();
  double left = 0, far = nearest;
  for (int n = nearest < kLeast ? 0 : 1; n <= pieces; ++n) {
    const double near = far;
    far = n == 0 ? from : from * std::exp(way * n / pieces);
    const double weight = weight_before(far - off) - weight_before(near - off);
    if (!(weight > 0)) continue;
    const double moved = side * ((near + far) / 2 - off) * pixel.width / cosine;
    const KerrPlane::Sight sight =
        plane_.sight(std::clamp(pixel.delta + moved, 1e-9, pi - 1e-9), pixel.eta);
    const double high = (far - near) * pixel.width / cosine, wide = pixel.width * cosine;
    left += sight.from_region_one
                ? weight * gather_piece(k, {sight, high, wide, weight, rays_.frequency[k], slope})
                : weight;
  }
  return left;
}

DiscPass::Strip::Sighting DiscPass::KerrStrip::sighting(int k) const {
  const Pixel& pixel = at_[static_cast<std::size_t>(k)];
  const double edge = std::abs(pixel.from_edge());
  Sighting seen;
  seen.clearance = std::min(edge, kFar);
  if (!pixel.sight.from_region_one) {
    seen.sight = kNoLight;
    return seen;
  }
  const Piece piece{pixel.sight, pixel.width, pixel.width, 1, 1};
  for (int order = 0; order < KerrPlane::kOrders; ++order) {
    if (!pixel.sight.crosses[static_cast<std::size_t>(order)]) {
      if (pixel.sight.within[static_cast<std::size_t>(order)])
        seen.sight |= static_cast<unsigned>(kAbove) << (2 * order);
      continue;
    }
    const Image at = image(piece, pixel.sight.at[static_cast<std::size_t>(order)]);
    // w is much like a function of the logarithm of the distance from the edge.
    const auto clear = [&](double rim) {
      const double pixels = std::abs(at.w - rim) / at.per;
      return pixels / (1 + pixels / edge);
    };
    seen.clearance = std::min({seen.clearance, clear(low_), clear(high_)});
    Side side = kBeneath;
    if (at.w >= high_) {
      side = kAbove;
    } else if (at.w >= low_) {
      const double stable = disc_.orbits.last_stable();
      side = disc_.inner < stable && at.w * stable > 1 ? kWherePlunging : kWithin;
      seen.lit = true;
    }
    seen.sight |= static_cast<unsigned>(side) << (2 * order);
    if (side != kBeneath && side != kAbove && pass_.scene_.state.settings.disc_opacity == 1 &&
        disc_.is_opaque())
      break;
  }
  return seen;
}

double DiscPass::KerrStrip::left_before(const CameraDirection& n, double mino, double width) {
  // A body that moves in the plane itself is not hidden by the disc there.
  constexpr double kInPlane = 1e-6;
  locate(&n, &width, 1);
  const Pixel& pixel = at_[0];
  if (!(pixel.sight.energy > 0)) return 1;
  const Piece piece{pixel.sight, pixel.width, pixel.width, 1, rays_.frequency[0]};
  double left = 1;
  std::size_t order = 0;
  for (const KerrPassage& passage :
       kerr_passages(plane_.at(), {pixel.delta, pixel.eta}, KerrPlane::kOrders)) {
    if (passage.mino > mino * (1 - kInPlane)) break;
    if (pixel.sight.crosses[order]) {
      const KerrPlane::Crossing& at = pixel.sight.at[order];
      const double covered = image(piece, at).covered();
      if (covered > 0)
        left *= 1 - pass_.scene_.state.settings.disc_opacity * covered *
                        gas(piece, at, std::clamp(passage.r, disc_.inner, disc_.outer)).absorbed;
    }
    ++order;
  }
  return left;
}

std::vector<DiscPass::Place> DiscPass::KerrStrip::places(const CameraDirection& n, double width) {
  locate(&n, &width, 1);
  const Pixel& pixel = at_[0];
  std::vector<Place> places;
  if (!pixel.sight.from_region_one) return places;
  const Piece piece{pixel.sight, pixel.width, pixel.width, 1, rays_.frequency[0]};
  for (int order = 0; order < KerrPlane::kOrders; ++order) {
    if (!pixel.sight.crosses[static_cast<std::size_t>(order)]) continue;
    const KerrPlane::Crossing& at = pixel.sight.at[static_cast<std::size_t>(order)];
    const double covered = image(piece, at).covered();
    if (!(covered > 0)) continue;
    const Gas one = gas(piece, at, 1 / std::clamp(at.w.value, low_, high_));
    if (!(one.frequency_ratio > 0)) continue;
    places.push_back({order, one.r, std::remainder(azimuth(at.angle.value, one.r), 2 * pi),
                      one.frequency_ratio, covered});
    if (pass_.scene_.state.settings.disc_opacity * covered * one.absorbed == 1) break;
  }
  return places;
}

}  // namespace domefall
