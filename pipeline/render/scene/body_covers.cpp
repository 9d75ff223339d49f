#include "pipeline/render/scene/body_covers.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace domefall {

BodyCovers::BodyCovers(const BodySight& sight, std::span<const Body> bodies, double sigma)
    : sigma_(sigma) {
  if (!sight.sees()) return;
  for (const Body& body : bodies)
    for (int order = sight.first_order(body); order < BodySight::kMostOrders; ++order) {
      const auto image = sight.image(body, order);
      if (!image) break;
      Cover cover{sight.far(body, image->traced), {}};
      for (const BodySight::Piece& piece : sight.pieces(body, *image, sigma)) {
        if (!(piece.solid_angle > 0)) continue;
        const BodySight::Seen seen = sight.seen(piece.at);
        cover.pieces.push_back({seen.direction, piece.solid_angle / (seen.doppler * seen.doppler)});
      }
      if (cover.pieces.empty()) break;  // those of higher orders are smaller
      covers_.push_back(std::move(cover));
    }
}

double BodyCovers::left_before(const CameraDirection& direction, double far) const {
  double left = 1;
  for (const Cover& cover : covers_) {
    if (!(cover.far < far)) continue;
    double covered = 0;
    for (const Piece& piece : cover.pieces) {
      const V3d off = (piece.direction.v - direction.v) / sigma_;
      covered += piece.solid_angle * std::exp(-off.length2() / 2);
    }
    left *= 1 - std::min(covered / (2 * std::numbers::pi * sigma_ * sigma_), 1.0);
  }
  // Blobs ripple; behind a whole sphere there is nothing.
  return left > 1e-3 ? left : 0;
}

}  // namespace domefall
