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

// What is looked at: a sphere and its rings.
struct Target {
  double radius;  // M
  const RingPlane& rings;

  // How far it reaches from its middle, in radii.
  double reach() const { return rings.edges.empty() ? 1 : rings.edges.back().second; }
};

class SphereNet {
 public:
  SphereNet(const KerrBodyRays& rays, const KerrPass& middle, const Target& target, double side)
      : rays_(rays), middle_(middle), target_(target), side_(side) {
    const KerrStretch stretch = kerr_stretch(middle);
    right_ = stretch.longer_view, up_ = stretch.shorter_view;
  }

  // Returns nothing where the image is one with one of `earlier`.
  std::optional<RingedSphere> pieces(std::span<const BodyImage> earlier);

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
  Target target_;
  double side_;
  V3d right_, up_;
};

constexpr double kLeastCosine = 0.05;

// Returns a vector of the body's frame along the axes of the tetrad.
V3d in_tetrad(const KerrBodyRays& rays, const KerrPass& pass, const V3d& own) {
  return apply_transposed(rays.axes(), apply(kerr_axes(pass.body.at.place), own));
}

// Returns the piece of a place of the disc, in radii.
SpherePiece piece_of(const KerrBodyRays& rays, const KerrPass& pass, const V3d& place,
                     double cosine, double solid_angle, double width) {
  const double beyond = place.length(), least = std::sqrt((1 - cosine) * (1 + cosine));
  const V3d beside = beyond > 0 ? place * (std::min(beyond, least) / beyond) : place;
  const double up = std::sqrt(std::max(0.0, 1 - beside.length2()));
  return {{{pass.view}, 1 / pass.frequency, solid_angle},
          cosine,
          in_tetrad(rays, pass, beside + pass.leaving * up),
          width / cosine};
}

// A Patch is a small rectangle of view, as the body has it: its middle, in radii, and halves of its sides
// along and across the ray's stretch.
struct Patch {
  V3d place;
  double half_along, half_across, solid_angle, width;
};

// Appends what a patch shows of a sphere with rings, by samples.  Next to the body light goes straight.
void append_ringed(const KerrBodyRays& rays, const KerrPass& pass, const KerrStretch& stretch,
                   const Patch& patch, const RingPlane& rings, RingedSphere& pieces) {
  constexpr int kSamples = 12;  // along each side
  // A piece has one place, which is a part of a radius wide.
  constexpr double kPartsOfRadius = 64, kMostParts = 16;
  const auto parts = static_cast<std::size_t>(
      std::clamp(kPartsOfRadius * std::max(patch.half_along, patch.half_across), 1.0, kMostParts));
  // Of the sphere, bare and through each ring, and of each ring.
  std::vector<std::vector<V3d>> sphere(rings.edges.size() + 1), around(rings.edges.size());
  const V3d leaving = in_tetrad(rays, pass, pass.leaving),
            middle = in_tetrad(rays, pass, patch.place),
            along = in_tetrad(rays, pass, stretch.along * patch.half_along),
            across = in_tetrad(rays, pass, stretch.across * patch.half_across);
  const double steep = leaving.dot(rings.normal);
  const auto part = [](int k) { return (2 * k + 1.0) / kSamples - 1; };
  for (int i = 0; i < kSamples; ++i)
    for (int j = 0; j < kSamples; ++j) {
      const V3d at = middle + along * part(i) + across * part(j);
      const double way = -at.dot(rings.normal) / steep;
      const V3d crossed = at + leaving * way;
      const int ring = steep != 0 ? rings.ring_at(crossed) : -1;
      const double up2 = 1 - at.length2();
      const bool hits = up2 > 0, before = ring >= 0 && way > 0;
      if (hits)
        sphere[before ? static_cast<std::size_t>(ring) + 1 : 0].push_back(at +
                                                                          leaving * std::sqrt(up2));
      if (ring >= 0 && (before || !hits)) around[static_cast<std::size_t>(ring)].push_back(crossed);
    }
  // Calls use(image, place) for the parts of what is seen, each by the sample in its middle.
  const auto divide = [&](const std::vector<V3d>& places, const auto& use) {
    for (std::size_t k = 0; k < parts; ++k) {
      const std::size_t from = k * places.size() / parts, to = (k + 1) * places.size() / parts;
      if (from == to) continue;
      use(SkyImage{{pass.view},
                   1 / pass.frequency,
                   patch.solid_angle * static_cast<double>(to - from) / (kSamples * kSamples)},
          places[(from + to) / 2]);
    }
  };
  for (std::size_t k = 0; k < sphere.size(); ++k)
    divide(sphere[k], [&](const SkyImage& image, const V3d& place) {
      const double cosine = std::max(place.dot(leaving), kLeastCosine);
      pieces.sphere.push_back({image,
                               cosine,
                               place,
                               patch.width / cosine,
                               {static_cast<int>(k) - 1, k > 0 ? std::abs(steep) : 1}});
    });
  for (std::size_t k = 0; k < around.size(); ++k)
    divide(around[k], [&](const SkyImage& image, const V3d& place) {
      pieces.rings.push_back({image, static_cast<int>(k), place, leaving,
                              patch.width / std::max(std::abs(steep), kLeastCosine)});
    });
}

std::optional<RingedSphere> SphereNet::pieces(std::span<const BodyImage> earlier) {
  constexpr std::size_t kMost = 1000000;
  const double reach = target_.reach();
  RingedSphere pieces;
  std::set<std::pair<int, int>> seen{{0, 0}};
  std::deque<Square> left{{0, 0, middle_.mino, middle_.tau}};
  for (; !left.empty() && seen.size() < kMost; left.pop_front()) {
    const Square& at = left.front();
    const auto pass = rays_.nearest(view(at.i, at.j), at.mino, at.tau);
    if (!pass) continue;
    const KerrStretch stretch = kerr_stretch(*pass);
    const double side = side_at(at.i, at.j), half = side / 2 / target_.radius;
    const V3d place = pass->off / -target_.radius;
    const Shown shown =
        shown_of_disc(place.dot(stretch.along) / reach, place.dot(stretch.across) / reach,
                      stretch.longer * half / reach, stretch.shorter * half / reach);
    if (!(shown.part > 0)) continue;
    if (is_in(*pass, earlier, side_, reach * target_.radius)) return std::nullopt;
    const double width = 2 * stretch.longer * half;
    if (target_.rings.edges.empty())
      pieces.sphere.push_back(piece_of(rays_, *pass, place, std::max(shown.cosine, kLeastCosine),
                                       shown.part * side * side, width));
    else
      append_ringed(rays_, *pass, stretch,
                    {place, stretch.longer * half, stretch.shorter * half, side * side, width},
                    target_.rings, pieces);
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
  Ribbon(const KerrBodyRays& rays, const KerrPass& middle, const Target& target, double spacing)
      : rays_(rays), target_(target), spacing_(spacing) {
    constexpr double kStrips = 12;
    const double length = target.radius / kerr_stretch(middle).shorter;
    step_ = std::min(spacing, std::max(length / kStrips, 1e-3 * spacing));
    line_.push_back(middle);
    const bool ring = go(1);
    std::ranges::reverse(line_);
    if (!ring) go(-1);
  }

  const std::vector<KerrPass>& line() const { return line_; }
  double step() const { return step_; }
  RingedSphere pieces() const;

 private:
  // Goes on from the last ray to the end of the image.  Returns whether that is a ring.
  bool go(double sense);
  std::optional<KerrPass> next(const KerrPass& from, const V3d& way) const;
  // Where a ray passes the sphere across the ribbon's line, in radii.
  double place(const KerrPass& pass) const {
    return -pass.off.dot(kerr_stretch(pass).across) / target_.radius;
  }

  const KerrBodyRays& rays_;
  Target target_;
  double spacing_, step_ = 0;
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
    if (!pass || !(std::abs(place(*pass)) < target_.reach())) return false;
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
    if (std::abs(off) < kEnough * target_.radius) return pass;
    view = turned_view(*pass, rays_.at(),
                       turn_of(*pass, stretch.longer_view * (off / stretch.longer)), 1);
  }
  return std::nullopt;
}

RingedSphere Ribbon::pieces() const {
  const bool ringed = !target_.rings.edges.empty();
  RingedSphere pieces;
  for (std::size_t k = 0; k < line_.size(); ++k) {
    const KerrPass& middle = line_[k];
    const KerrStretch stretch = kerr_stretch(middle);
    const auto to = [&](std::size_t other) { return (line_[other].view - middle.view).length(); };
    const double before = k > 0 ? to(k - 1) : step_,
                 after = k + 1 < line_.size() ? to(k + 1) : step_, length = (before + after) / 2;
    const double reach = target_.reach(), t = place(middle),
                 chord = std::sqrt((reach - t) * (reach + t)),
                 half = target_.radius * chord / stretch.longer;
    const int parts = std::max(1, static_cast<int>(std::ceil(2 * half / spacing_)));
    const double solid_angle = length * 2 * half / parts,
                 width = spacing_ * stretch.longer / target_.radius;
    for (int j = 0; j < parts; ++j) {
      const double u = (2 * j + 1.0) / parts - 1;
      KerrPass pass = middle;
      pass.view =
          turned_view(middle, rays_.at(), turn_of(middle, stretch.longer_view * (u * half)), 1);
      const V3d place = stretch.across * t + stretch.along * (u * chord);
      if (ringed) {
        append_ringed(rays_, pass, stretch,
                      {place, chord / parts, length * stretch.shorter / target_.radius / 2,
                       solid_angle, width},
                      target_.rings, pieces);
        continue;
      }
      const double cosine =
          chord * (parts > 1 ? std::sqrt((1 - u) * (1 + u)) : std::numbers::pi / 4);
      pieces.sphere.push_back(piece_of(rays_, pass, place, cosine, solid_angle, width));
    }
  }
  return pieces;
}

}  // namespace

RingedSphere kerr_image_of_sphere(const KerrPlace& at, double null_time, const BodyMotion& motion,
                                  const BodyImage& image, std::span<const BodyImage> earlier,
                                  double radius, const RingPlane& rings,
                                  const std::function<double(const V3d&)>& spacing) {
  const KerrBodyRays rays(at, null_time, motion);
  const auto middle = rays.meet(image.direction, image.mino, image.proper_time);
  if (!middle) return {};
  const Target target{radius, rings};
  constexpr double kAcross = 16, kFarRings = 4, kWound = 2.5, kNarrow = 4;
  const double least = spacing(image.direction),
               side = std::min(least, kerr_size_of_sphere(image, radius) / kAcross *
                                          std::max(1.0, target.reach() / kFarRings));
  const KerrDirection n = kerr_direction_of(image.direction);
  const auto delta = static_cast<double>(n.delta), eta = static_cast<double>(n.eta);
  RingedSphere one_with_another{
      {{{{image.direction}, image.frequency_ratio, 0}, 1, image.direction}}, {}};
  if (middle->event.swept > kWound && std::abs(delta - kerr_edge_delta(at, eta)) < kNarrow * side) {
    const Ribbon ribbon(rays, *middle, target, least);
    const bool known = std::ranges::any_of(ribbon.line(), [&](const KerrPass& pass) {
      return is_in(pass, earlier, ribbon.step(), target.reach() * radius);
    });
    return known ? one_with_another : ribbon.pieces();
  }
  if (auto pieces = SphereNet(rays, *middle, target, side).pieces(earlier)) return *pieces;
  return one_with_another;
}

}  // namespace domefall
