#include "pipeline/render/scene/body_covers.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace domefall {
namespace {

constexpr double kSigmas = 4;  // beyond which a blob has ended

}  // namespace

BodyCovers::BodyCovers(const BodySight& sight, std::span<const Body> bodies, double sigma)
    : sigma_(sigma) {
  if (!sight.sees()) return;
  for (const Body& body : bodies)
    for (int order = sight.first_order(body); order < BodySight::kMostOrders; ++order) {
      const auto image = sight.image(body, order);
      if (!image) break;
      Cover cover{sight.far(body, image->traced), {0, 0, 0}, 0, {}, {}};
      for (const BodySight::Piece& piece : sight.pieces(body, *image, sigma)) {
        if (!(piece.solid_angle > 0)) continue;
        const BodySight::Seen seen = sight.seen(piece.at);
        cover.directions.push_back(seen.direction.v);
        cover.solid_angles.push_back(piece.solid_angle / (seen.doppler * seen.doppler));
        cover.middle += seen.direction.v;
      }
      if (cover.directions.empty()) break;  // those of higher orders are smaller
      cover.middle.normalize();
      for (const V3d& direction : cover.directions)
        cover.radius = std::max(cover.radius, (direction - cover.middle).length());
      covers_.push_back(std::move(cover));
    }
}

double BodyCovers::left_before(const CameraDirection& direction, double far) const {
  double left = 1;
  for (const Cover& cover : covers_) {
    if (!(cover.far < far) ||
        (direction.v - cover.middle).length() > cover.radius + kSigmas * sigma_)
      continue;
    double covered = 0;
    for (std::size_t k = 0; k < cover.directions.size(); ++k) {
      const double off = (cover.directions[k] - direction.v).length() / sigma_;
      if (off < kSigmas) covered += cover.solid_angles[k] * std::exp(-off * off / 2);
    }
    left *= 1 - std::min(covered / (2 * std::numbers::pi * sigma_ * sigma_), 1.0);
  }
  // Blobs ripple; behind a whole sphere there is nothing.
  return left > 1e-3 ? left : 0;
}

}  // namespace domefall
