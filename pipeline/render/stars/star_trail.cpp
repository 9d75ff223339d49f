#include "pipeline/render/stars/star_trail.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "pipeline/show/curve.h"

namespace domefall {
namespace {

// The step in x from one place where the lens is evaluated to the next is at most this.
constexpr double kStep = 0.25;

// The window of time depends on the ratio of a source's distance from the axis to its path from
// frame to frame.  Up to kRacing the window reaches kWindow frames to either side and falls to 0
// like the power kSharpness.  The ring of a bright star then fades in and out over several frames.
// Beyond kRacing the window becomes more peaked, until at kSlow its sharpness is kSharpest.  A
// slower image is therefore a dot with faint tails and not a bar.
constexpr double kSharpness = 3, kSharpest = 8;
constexpr double kRacing = 3, kSlow = 12;

}  // namespace

PassageWindow passage_window(double ratio, double instant) {
  return {
      kWindow * (1 - smooth_step((3 * ratio / instant - 1) / 2)),
      kSharpness + (kSharpest - kSharpness) * smooth_step((ratio - kRacing) / (kSlow - kRacing))};
}

AxisPassage::AxisPassage(const V3d& source, const V3d& half_way, double radius, double sharpness)
    : side_(source.x < 0 ? -1 : 1),
      half_way_(std::hypot(half_way.y, half_way.z)),
      sharpness_(sharpness) {
  along_ = V3d(0, half_way.y, half_way.z) / half_way_;
  // Across R the path is the line source + u half_way.  Its part at right angles to the line is the
  // closest approach, and its part along the line gives u there.
  const V3d across(0, -along_.z, along_.y);
  const double offset = source.y * across.y + source.z * across.z;
  outward_ = offset < 0 ? -across : across;
  least_ = std::hypot(offset, radius / 2);
  u_least_ = -(source.y * along_.y + source.z * along_.z) / half_way_;
  const auto x_of = [&](double u) { return std::asinh((u - u_least_) * half_way_ / least_); };
  begin_ = x_of(-1), middle_ = x_of(0), end_ = x_of(1);
}

double AxisPassage::distance(double x) const { return least_ * std::cosh(x); }

V3d AxisPassage::source(double x) const {
  const V3d across = outward_ * least_ + along_ * (least_ * std::sinh(x));
  return V3d(side_ * std::sqrt(std::max(0.0, 1 - across.length2())), across.y, across.z);
}

V3d AxisPassage::across(double x) const {
  return (outward_ + along_ * std::sinh(x)) / std::cosh(x);
}

double AxisPassage::u(double x) const { return u_least_ + least_ / half_way_ * std::sinh(x); }

// From u = u_least + least/half_way sinh(x) and distance = least cosh(x) follows du/distance =
// dx/half_way.  So this is the integral of the weight over x, divided by half_way.  It is found by
// the rule of Gauss and Legendre with three points, at the middle and sqrt(3/5) of half the
// interval to either side.
double AxisPassage::mean_inverse_distance(double from, double to) const {
  constexpr std::array<double, 3> kNodes{-0.7745966692414834, 0, 0.7745966692414834};
  constexpr std::array<double, 3> kWeights{5.0 / 18, 8.0 / 18, 5.0 / 18};
  double sum = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    const double rest = 1 - std::abs(u((from + to) / 2 + kNodes[k] * (to - from) / 2));
    if (rest > 0) sum += kWeights[k] * std::pow(rest, sharpness_);
  }
  return (sharpness_ + 1) / 2 * sum * (to - from) / half_way_;
}

StarTrail::StarTrail(const ImageOf& image_of, const AxisPassage& passage) : passage_(passage) {
  add_nodes(image_of, passage.begin(), passage.middle());
  add_nodes(image_of, passage.middle(), passage.end());
  nodes_.push_back(node_at(image_of, passage.end()));
}

StarTrail::Node StarTrail::node_at(const ImageOf& image_of, double x) const {
  const SkyImage image = image_of(passage_.source(x));
  const V3d& direction = image.direction.v;
  return {x, direction, direction.dot(passage_.across(x)), image.frequency_ratio,
          image.amplification * passage_.distance(x)};
}

void StarTrail::add_nodes(const ImageOf& image_of, double from, double to) {
  const int count = std::max(1, static_cast<int>(std::ceil((to - from) / kStep)));
  for (int k = 0; k < count; ++k)
    nodes_.push_back(node_at(image_of, from + (to - from) * k / count));
}

std::size_t StarTrail::first_around(std::size_t k) const {
  return std::min(k > 0 ? k - 1 : 0, nodes_.size() - count_around());
}

// Interpolates between nodes k and k + 1 by Lagrange's polynomial through the four nodes around
// them, or through all nodes if there are fewer.  In x the numbers are so smooth that with steps of
// kStep the error is below 1e-5 radians, and 1e-4 half a radian from the axis.  The image has the
// strength in place of its amplification.
SkyImage StarTrail::between(std::size_t k, double x) const {
  const std::size_t count = count_around(), first = first_around(k);
  double forward = 0, across = 0, frequency_ratio = 0, strength = 0;
  for (std::size_t i = first; i < first + count; ++i) {
    double weight = 1;
    for (std::size_t j = first; j < first + count; ++j)
      if (j != i) weight *= (x - nodes_[j].x) / (nodes_[i].x - nodes_[j].x);
    forward += nodes_[i].direction.x * weight;
    across += nodes_[i].across * weight;
    frequency_ratio += nodes_[i].frequency_ratio * weight;
    strength += nodes_[i].strength * weight;
  }
  const V3d direction = V3d(forward, 0, 0) + passage_.across(x) * across;
  return {{direction.normalized()}, frequency_ratio, strength};
}

SkyImage StarTrail::part(std::size_t k) const {
  std::vector<SkyImage> whole;
  split(k, 1, whole);
  return whole.front();
}

void StarTrail::split(std::size_t k, int pieces, std::vector<SkyImage>& images) const {
  const Node &from = nodes_[k], &to = nodes_[k + 1];
  for (int n = 0; n < pieces; ++n) {
    const double step = (to.x - from.x) / pieces, x = from.x + n * step;
    images.push_back(between(k, x + step / 2));
    images.back().amplification *= passage_.mean_inverse_distance(x, x + step);
  }
}

}  // namespace domefall
