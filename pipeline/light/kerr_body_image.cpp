#include "pipeline/light/kerr_body_image.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>

#include "pipeline/light/kerr_body_track.h"
#include "pipeline/light/kerr_cone.h"
#include "pipeline/light/kerr_view.h"

namespace domefall {
namespace {

using std::numbers::pi;

// Places are compared where infinity is near.
V3d compact(double w, const V3d& place) { return place / (1 + 2 * w); }

// A cell of the net, and at its eight corners by how much the body is elsewhere at that v.
struct ConeCell {
  static constexpr std::size_t kCorners = 8;
  std::array<V3d, kCorners> apart;
  std::array<double, kCorners> mino, tau;
  double size = 0;  // of the places in it

  // Returns a value within, by x, y and z from 0 to 1.
  template <class Value>
  Value at(const std::array<Value, kCorners>& corners, const V3d& x) const {
    const auto mixed = [](const Value& a, const Value& b, double part) {
      return a * (1 - part) + b * part;
    };
    std::array<Value, 4> faces;
    for (std::size_t k = 0; k < 4; ++k) faces[k] = mixed(corners[2 * k], corners[2 * k + 1], x.z);
    return mixed(mixed(faces[0], faces[1], x.y), mixed(faces[2], faces[3], x.y), x.x);
  }
  // Says whether the body may be within.  What is bent between the corners has a margin.
  bool may_hold() const {
    constexpr double kMargin = 0.15;
    for (int axis = 0; axis < 3; ++axis) {
      double low = HUGE_VAL, high = -HUGE_VAL;
      for (const V3d& corner : apart)
        low = std::min(low, corner[axis]), high = std::max(high, corner[axis]);
      const double margin = kMargin * (high - low) + 0.1 * size;
      if (low > margin || high < -margin) return false;
    }
    return true;
  }
  // Returns the place of the body from a start, by Newton's method, and whether the cell is the mirror
  // image of what it shows there.
  struct Solution {
    V3d x;
    bool mirrored;
  };
  std::optional<Solution> solve(V3d x) const;
  double mino_span() const {
    const auto [low, high] = std::ranges::minmax(mino);
    return high - low;
  }
};

std::optional<ConeCell::Solution> ConeCell::solve(V3d x) const {
  constexpr double kBeyond = 0.6, kStep = 1e-3;
  bool mirrored = false;
  for (int i = 0; i < 12; ++i) {
    const V3d off = at(apart, x);
    std::array<V3d, 3> by;
    for (int axis = 0; axis < 3; ++axis) {
      V3d moved = x;
      moved[axis] += kStep;
      by[static_cast<std::size_t>(axis)] = (at(apart, moved) - off) / kStep;
    }
    const V3d yz = by[1].cross(by[2]);
    const double det = by[0].dot(yz);
    if (det == 0 || !std::isfinite(det)) return std::nullopt;
    mirrored = det < 0;
    V3d step(off.dot(yz), off.dot(by[2].cross(by[0])), off.dot(by[0].cross(by[1])));
    step /= -det;
    const double length = step.length();
    x += length > 0.5 ? step * (0.5 / length) : step;
    for (int axis = 0; axis < 3; ++axis) x[axis] = std::clamp(x[axis], -1.0, 2.0);
    if (length < 1e-3) break;
  }
  for (int axis = 0; axis < 3; ++axis)
    if (!(std::abs(x[axis] - 0.5) < 0.5 + kBeyond)) return std::nullopt;
  return Solution{x, mirrored};
}

// Says whether a ray's neighbours see the mirror image of what is there.
bool is_mirrored(const KerrPass& pass) {
  return pass.by_delta.cross(pass.across).dot(pass.leaving) > 0;
}

class BodySearch {
 public:
  BodySearch(const KerrBodyRays& rays, double radius)
      : rays_(rays), track_(rays), cone_(kerr_cone(rays.at())), radius_(radius) {
    const BodyMotion& motion = rays.motion();
    least_w_ = motion.most_r < HUGE_VAL ? 1 / motion.most_r : 0;
    most_w_ = motion.least_r > 0 ? 1 / motion.least_r : HUGE_VAL;
  }

  std::vector<BodyImage> images() {
    for (int row = 0; row + 1 < cone_->rows(); ++row)
      for (int column = 0; column < cone_->columns(); ++column)
        for (int sample = 0; sample + 1 < cone_->samples(); ++sample)
          look_into(row, column, sample);
    std::ranges::sort(found_, {}, [](const KerrPass& pass) { return -pass.event.null_time; });
    std::vector<BodyImage> images;
    for (const KerrPass& pass : found_) images.push_back(image_of(pass));
    return images;
  }

 private:
  void look_into(int row, int column, int sample);
  void add(const V3d& view, double mino, double tau);
  BodyImage image_of(const KerrPass& pass) const;
  double shorter(const KerrPass& pass, const KerrStretch& stretch) const;

  const KerrBodyRays& rays_;
  KerrBodyTrack track_;
  std::shared_ptr<const KerrCone> cone_;
  double radius_, least_w_, most_w_;
  std::vector<KerrPass> found_;
};

void BodySearch::look_into(int row, int column, int sample) {
  std::array<const KerrCone::Node*, ConeCell::kCorners> nodes;
  double low = HUGE_VAL, high = -HUGE_VAL;
  for (std::size_t k = 0; k < nodes.size(); ++k) {
    nodes[k] = &cone_->node(row + static_cast<int>(k >> 2), column + static_cast<int>(k >> 1 & 1),
                            sample + static_cast<int>(k & 1));
    if (nodes[k]->w < 0) return;
    low = std::min<double>(low, nodes[k]->w), high = std::max<double>(high, nodes[k]->w);
  }
  const double margin = 0.15 * (high - low) + 0.03 * high;
  if (low - margin > most_w_ || high + margin < least_w_) return;
  ConeCell cell;
  V3d first(0, 0, 0);
  for (std::size_t k = 0; k < nodes.size(); ++k) {
    const auto body = track_.at(rays_.null_time() + nodes[k]->null_time);
    if (!body) return;
    const V3d place = compact(nodes[k]->w, nodes[k]->place());
    if (k == 0) first = place;
    cell.size = std::max(cell.size, (place - first).length());
    cell.apart[k] = place - compact(body->w, body->place);
    cell.mino[k] = nodes[k]->mino, cell.tau[k] = body->tau;
  }
  if (!cell.may_hold()) return;
  const auto corner = [&](int k, int j) {
    const auto n = cone_->direction(row + k, column + j);
    return kerr_view(n.delta, n.eta);
  };
  const double wide = (corner(1, 1) - corner(0, 0)).length();
  // Two images may be in one cell, next to a caustic.
  std::vector<V3d> starts;
  constexpr std::array<std::pair<double, double>, 5> kStarts{
      {{0.5, 0.5}, {0.2, 0.2}, {0.2, 0.8}, {0.8, 0.2}, {0.8, 0.8}}};
  for (const auto& [x, y] : kStarts) {
    const auto start = cell.solve({x, y, 0.5});
    if (!start || std::ranges::any_of(
                      starts, [&](const V3d& one) { return (one - start->x).length() < 0.1; }))
      continue;
    starts.push_back(start->x);
    const auto n = cone_->direction(row + start->x.x, column + start->x.y);
    const V3d view = kerr_view(n.delta, n.eta);
    const double mino = cell.at(cell.mino, start->x);
    // The image of a neighbouring cell
    const bool known = std::ranges::any_of(found_, [&](const KerrPass& one) {
      return (one.view - view).length() < wide && is_mirrored(one) == start->mirrored &&
             std::abs(one.mino - mino) < cell.mino_span();
    });
    if (!known) add(view, mino, cell.at(cell.tau, start->x));
  }
}

// Images that are mirror images of each other are two, however near they are.
void BodySearch::add(const V3d& view, double mino, double tau) {
  constexpr double kSame = 1e-6, kFarthestSwept = 10, kFarOff = 0.4;
  // A body that is far from the ray was in no cell.
  const auto start = rays_.pass(view, mino, tau);
  if (!start || !(start->off.length() + std::abs(start->late) < kFarOff * start->body.at.r)) return;
  const auto pass = rays_.meet(view, mino, tau);
  if (!pass || !(pass->event.swept < kFarthestSwept)) return;
  for (const KerrPass& one : found_)
    if ((one.view - pass->view).length() < kSame && is_mirrored(one) == is_mirrored(*pass) &&
        std::abs(one.mino - pass->mino) < 1e-3 * pass->mino)
      return;
  found_.push_back(*pass);
}

// Next to a caustic the shorter of the two stretches goes to 0.  Over a body of a size, that of the mean
// of its light does not: next to a fold x it is sqrt(2 c x), with its own change c, and next to an axis as
// far from it as the body is large over the angle of the ring.
double BodySearch::shorter(const KerrPass& pass, const KerrStretch& stretch) const {
  constexpr double kNear = 0.3, kStep = 1e-4;
  const double least = stretch.shorter;
  const double half = std::sin(std::min(pass.event.swept, pi) / 2),
               beside = std::hypot(pass.view.y, pass.view.z);
  const double ring = beside > 0 ? radius_ * half * half / beside : 0;
  double fold = 0;
  if (least < kNear * pass.body.at.r) {
    const V3d view = (pass.view + stretch.shorter_view * kStep).normalized();
    if (const auto next = rays_.nearest(view, pass.mino, pass.tau)) {
      const KerrStretch there = kerr_stretch(*next);
      const bool turned = is_mirrored(pass) != is_mirrored(*next);
      fold = radius_ * std::abs((turned ? -there.shorter : there.shorter) - least) / kStep;
    }
  }
  return std::hypot(std::sqrt(std::hypot(least * least, fold)), ring);
}

BodyImage BodySearch::image_of(const KerrPass& pass) const {
  constexpr double kDimmed = 9;
  const KerrStretch stretch = kerr_stretch(pass);
  const double left = std::clamp(kDimmed + 1 - pass.event.swept, 0.0, 1.0);
  BodyImage image{};
  image.direction = pass.view;
  image.frequency_ratio = 1 / pass.frequency;
  image.r = pass.body.at.r;
  image.mino = pass.mino;
  image.proper_time = pass.tau;
  image.solid_angle_per_area = left / (stretch.longer * shorter(pass, stretch));
  image.angle_per_length = 1 / stretch.longer;
  // The body's direction is that of psi, which is the angle swept where nothing is dragged along.
  const V3d place = apply_transposed(rays_.axes(), pass.body.at.place);
  const double sine = std::hypot(place.y, place.z), angle = std::atan2(sine, place.x);
  const double turns = std::round(pass.event.swept / (2 * pi)) * 2 * pi;
  const V3d towards = sine > 0 ? V3d(0, place.y, place.z) / sine : V3d(0, 1, 0);
  const bool onward =
      std::abs(turns + angle - pass.event.swept) <= std::abs(turns - angle - pass.event.swept);
  image.psi = onward ? turns + angle : turns - angle;
  image.across = onward ? towards : -towards;
  image.swing = V3d(0, 0, 0);
  const M33d own = kerr_axes(pass.body.at.place);
  const auto in_view = [&](const V3d& v) { return apply_transposed(rays_.axes(), apply(own, v)); };
  image.celerity = in_view(pass.body.velocity.s);
  image.ray = in_view(pass.event.light.s / pass.event.light.t);
  return image;
}

}  // namespace

std::vector<BodyImage> kerr_body_images(const KerrPlace& at, double null_time,
                                        const BodyMotion& motion, double radius) {
  const KerrBodyRays rays(at, null_time, motion);
  return BodySearch(rays, radius).images();
}

double kerr_size_of_sphere(const BodyImage& image, double radius) {
  const double longer = image.solid_angle_per_area / image.angle_per_length;
  return 2 * radius * std::max(image.angle_per_length, longer);
}

}  // namespace domefall
