#include "pipeline/light/kerr_sphere_image.h"

#include <algorithm>
#include <cmath>
#include <deque>
#include <numbers>
#include <optional>
#include <set>
#include <utility>

#include "pipeline/light/kerr_body_image.h"
#include "pipeline/light/kerr_view.h"

namespace domefall {
namespace {

// What a small square of view shows of a disc of the radius 1.
struct Shown {
  double part = 0;    // of the square that the disc covers
  double cosine = 0;  // mean over that part, of the angle at which the light left
};

// The square becomes a rectangle about (x, y) with these halves of its sides.
Shown shown_of_disc(double x, double y, double half_x, double half_y) {
  constexpr int kStrips = 12;
  Shown shown;
  double heights = 0;
  for (int k = 0; k < kStrips; ++k) {
    const double off = y + half_y * ((2 * k + 1.0) / kStrips - 1);
    if (!(std::abs(off) < 1)) continue;
    const double chord = std::sqrt((1 - off) * (1 + off));
    const double low = std::clamp(x - half_x, -chord, chord),
                 high = std::clamp(x + half_x, -chord, chord);
    const auto area = [&](double at) {
      const double part = std::clamp(at / chord, -1.0, 1.0);
      return chord * chord * (part * std::sqrt((1 - part) * (1 + part)) + std::asin(part)) / 2;
    };
    shown.part += (high - low) / (2 * half_x * kStrips);
    heights += (area(high) - area(low)) / (2 * half_x * kStrips);
  }
  if (shown.part > 0) shown.cosine = std::min(heights / shown.part, 1.0);
  return shown;
}

// Whether a ray is that of one of these images.
bool is_in(const KerrPass& pass, std::span<const BodyImage> images, double near, double radius) {
  return std::ranges::any_of(images, [&](const BodyImage& image) {
    return (image.direction - pass.view).length() < near &&
           std::abs(image.proper_time - pass.tau) < 2 * radius + 0.1;
  });
}

class SphereNet {
 public:
  SphereNet(const KerrBodyRays& rays, const KerrPass& middle, double radius, double side)
      : rays_(rays), middle_(middle), radius_(radius), side_(side) {
    const KerrStretch stretch = kerr_stretch(middle);
    right_ = stretch.longer_view, up_ = stretch.shorter_view;
  }

  // Returns nothing where the image is one with one of `earlier`.
  std::optional<std::vector<SpherePiece>> pieces(std::span<const BodyImage> earlier);

 private:
  struct Square {
    int i, j;
    double mino, tau;  // about
  };
  // A net of the stereographic projection has squares everywhere.
  V3d view(int i, int j) const {
    const double x = i * side_, y = j * side_, quarter = (x * x + y * y) / 4;
    return (middle_.view * (1 - quarter) + right_ * x + up_ * y) / (1 + quarter);
  }
  double side_at(int i, int j) const {
    const double x = i * side_, y = j * side_;
    return side_ / (1 + (x * x + y * y) / 4);
  }
  const KerrBodyRays& rays_;
  const KerrPass& middle_;
  double radius_, side_;
  V3d right_, up_;
};

// Returns the piece of a place x, y of the disc, in radii, along two axes in the body's frame.
SpherePiece piece_of(const KerrBodyRays& rays, const KerrPass& pass, const V3d& place,
                     double cosine, double solid_angle, double width) {
  const double beyond = place.length(), least = std::sqrt((1 - cosine) * (1 + cosine));
  const V3d beside = beyond > 0 ? place * (std::min(beyond, least) / beyond) : place;
  const double up = std::sqrt(std::max(0.0, 1 - beside.length2()));
  const V3d own = beside + pass.leaving * up;
  const V3d seen = apply_transposed(rays.axes(), apply(kerr_axes(pass.body.at.place), own));
  return {{{pass.view}, 1 / pass.frequency, solid_angle}, cosine, seen, width / cosine};
}

std::optional<std::vector<SpherePiece>> SphereNet::pieces(std::span<const BodyImage> earlier) {
  constexpr std::size_t kMost = 1000000;
  constexpr double kLeastCosine = 0.05;
  std::vector<SpherePiece> pieces;
  std::set<std::pair<int, int>> seen{{0, 0}};
  std::deque<Square> left{{0, 0, middle_.mino, middle_.tau}};
  for (; !left.empty() && seen.size() < kMost; left.pop_front()) {
    const Square& at = left.front();
    const auto pass = rays_.nearest(view(at.i, at.j), at.mino, at.tau);
    if (!pass) continue;
    const KerrStretch stretch = kerr_stretch(*pass);
    const double side = side_at(at.i, at.j), half = side / 2 / radius_;
    const V3d place = pass->off / -radius_;
    const Shown shown = shown_of_disc(place.dot(stretch.along), place.dot(stretch.across),
                                      stretch.longer * half, stretch.shorter * half);
    if (!(shown.part > 0)) continue;
    if (is_in(*pass, earlier, side_, radius_)) return std::nullopt;
    pieces.push_back(piece_of(rays_, *pass, place, std::max(shown.cosine, kLeastCosine),
                              shown.part * side * side, 2 * stretch.longer * half));
    for (int i = -1; i <= 1; ++i)
      for (int j = -1; j <= 1; ++j)
        if (seen.emplace(at.i + i, at.j + j).second)
          left.push_back({at.i + i, at.j + j, pass->mino, pass->tau});
  }
  return pieces;
}

// A thin image of light that winds around the hole lies along the silhouette's edge.  A Ribbon is its line
// in the middle, as rays that are off the sphere's centre only along the image, beside which the lens is
// taken to first order.
class Ribbon {
 public:
  Ribbon(const KerrBodyRays& rays, const KerrPass& middle, double radius, double spacing)
      : rays_(rays), radius_(radius), spacing_(spacing) {
    constexpr double kStrips = 12;
    const double length = radius / kerr_stretch(middle).shorter;
    step_ = std::min(spacing, std::max(length / kStrips, 1e-3 * spacing));
    line_.push_back(middle);
    const bool ring = go(1);
    std::ranges::reverse(line_);
    if (!ring) go(-1);
  }

  const std::vector<KerrPass>& line() const { return line_; }
  double step() const { return step_; }
  std::vector<SpherePiece> pieces() const;

 private:
  // Goes on from the last ray to the end of the image.  Returns whether that is a ring.
  bool go(double sense);
  std::optional<KerrPass> next(const KerrPass& from, const V3d& way) const;
  // Where a ray passes the sphere across the ribbon's line, in radii.
  double place(const KerrPass& pass) const {
    return -pass.off.dot(kerr_stretch(pass).across) / radius_;
  }

  const KerrBodyRays& rays_;
  double radius_, spacing_, step_ = 0;
  std::vector<KerrPass> line_;
};

Turn turn_of(const KerrPass& pass, const V3d& way) {
  const KerrDirection n = kerr_direction_of(pass.view);
  const ViewAxes axes(static_cast<double>(n.delta), static_cast<double>(n.eta));
  return {way.dot(axes.by_delta), way.dot(axes.across)};
}

bool Ribbon::go(double sense) {
  V3d way = kerr_stretch(line_.back()).shorter_view * sense;
  const V3d first = line_.back().view;
  const std::size_t begun = line_.size(),
                    most = begun + static_cast<std::size_t>(2 * std::numbers::pi / step_);
  while (line_.size() < most) {
    const auto pass = next(line_.back(), way * step_);
    if (!pass || !(std::abs(place(*pass)) < 1)) return false;
    const V3d onward = kerr_stretch(*pass).shorter_view;
    way = onward * (onward.dot(pass->view - line_.back().view) < 0 ? -1 : 1);
    line_.push_back(*pass);
    if (line_.size() > begun + 4 && (pass->view - first).length() < step_) return true;
  }
  return true;
}

std::optional<KerrPass> Ribbon::next(const KerrPass& from, const V3d& way) const {
  constexpr int kMost = 16;
  constexpr double kEnough = 3e-3;
  V3d view = turned_view(from, rays_.at(), turn_of(from, way), 1);
  std::optional<KerrPass> pass;
  for (int k = 0; k < kMost; ++k) {
    pass = rays_.nearest(view, from.mino, from.tau);
    if (!pass) return std::nullopt;
    const KerrStretch stretch = kerr_stretch(*pass);
    const double off = pass->off.dot(stretch.along);
    if (std::abs(off) < kEnough * radius_) return pass;
    view = turned_view(*pass, rays_.at(),
                       turn_of(*pass, stretch.longer_view * (off / stretch.longer)), 1);
  }
  return std::nullopt;
}

std::vector<SpherePiece> Ribbon::pieces() const {
  std::vector<SpherePiece> pieces;
  for (std::size_t k = 0; k < line_.size(); ++k) {
    const KerrPass& middle = line_[k];
    const KerrStretch stretch = kerr_stretch(middle);
    const auto to = [&](std::size_t other) { return (line_[other].view - middle.view).length(); };
    const double before = k > 0 ? to(k - 1) : step_,
                 after = k + 1 < line_.size() ? to(k + 1) : step_, length = (before + after) / 2;
    const double t = place(middle), chord = std::sqrt((1 - t) * (1 + t)),
                 half = radius_ * chord / stretch.longer;
    const int parts = std::max(1, static_cast<int>(std::ceil(2 * half / spacing_)));
    for (int j = 0; j < parts; ++j) {
      const double u = (2 * j + 1.0) / parts - 1;
      KerrPass pass = middle;
      pass.view =
          turned_view(middle, rays_.at(), turn_of(middle, stretch.longer_view * (u * half)), 1);
      const double cosine =
          chord * (parts > 1 ? std::sqrt((1 - u) * (1 + u)) : std::numbers::pi / 4);
      pieces.push_back(piece_of(rays_, pass, stretch.across * t + stretch.along * (u * chord),
                                cosine, length * 2 * half / parts,
                                spacing_ * stretch.longer / radius_));
    }
  }
  return pieces;
}

}  // namespace

std::vector<SpherePiece> kerr_image_of_sphere(const KerrPlace& at, double null_time,
                                              const BodyMotion& motion, const BodyImage& image,
                                              std::span<const BodyImage> earlier, double radius,
                                              const std::function<double(const V3d&)>& spacing) {
  const KerrBodyRays rays(at, null_time, motion);
  const auto middle = rays.meet(image.direction, image.mino, image.proper_time);
  if (!middle) return {};
  constexpr double kAcross = 16, kWound = 2.5, kNarrow = 4;
  const double least = spacing(image.direction),
               side = std::min(least, kerr_size_of_sphere(image, radius) / kAcross);
  const KerrDirection n = kerr_direction_of(image.direction);
  const auto delta = static_cast<double>(n.delta), eta = static_cast<double>(n.eta);
  std::vector<SpherePiece> one_with_another{
      {{{image.direction}, image.frequency_ratio, 0}, 1, image.direction}};
  if (middle->event.swept > kWound && std::abs(delta - kerr_edge_delta(at, eta)) < kNarrow * side) {
    const Ribbon ribbon(rays, *middle, radius, least);
    const bool known = std::ranges::any_of(ribbon.line(), [&](const KerrPass& pass) {
      return is_in(pass, earlier, ribbon.step(), radius);
    });
    return known ? one_with_another : ribbon.pieces();
  }
  if (auto pieces = SphereNet(rays, *middle, radius, side).pieces(earlier)) return *pieces;
  return one_with_another;
}

}  // namespace domefall
