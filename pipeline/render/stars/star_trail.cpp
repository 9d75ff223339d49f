#include "pipeline/render/stars/star_trail.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace domefall {
namespace {

// The longest step in x from one place where the lens is evaluated to the next.
constexpr double kStep = 0.25;
constexpr int kMostPieces = 4096;

// The image of the source at one place of its way.
struct Node {
  double x;
  V3d direction;
  double frequency_ratio;
  double strength;  // amplification times the distance from the axis, which is finite on it
};

Node node_at(const SkyTable& table, const AxisPassage& passage, int order, double x) {
  const SkyImage image = image_of(&table, passage.source(x), order, 0);
  return {x, image.direction.v, image.frequency_ratio, image.amplification * passage.distance(x)};
}

// Nodes from one x to another, without the last one.
void add_nodes(const SkyTable& table, const AxisPassage& passage, int order, double from, double to,
               std::vector<Node>& nodes) {
  const int count = std::max(1, static_cast<int>(std::ceil((to - from) / kStep)));
  for (int k = 0; k < count; ++k)
    nodes.push_back(node_at(table, passage, order, from + (to - from) * k / count));
}

// Interpolates between nodes k and k + 1 by Lagrange's polynomial through the four around them, or
// through all if there are fewer.  In x the images are so smooth that a step of kStep errs by less
// than 1e-5 of the ring's radius.
Node between(const std::vector<Node>& nodes, std::size_t k, double x) {
  const std::size_t count = std::min<std::size_t>(4, nodes.size());
  const std::size_t first = std::min(k > 0 ? k - 1 : 0, nodes.size() - count);
  Node sum{x, V3d(0, 0, 0), 0, 0};
  for (std::size_t i = first; i < first + count; ++i) {
    double weight = 1;
    for (std::size_t j = first; j < first + count; ++j)
      if (j != i) weight *= (x - nodes[j].x) / (nodes[i].x - nodes[j].x);
    sum.direction += nodes[i].direction * weight;
    sum.frequency_ratio += nodes[i].frequency_ratio * weight;
    sum.strength += nodes[i].strength * weight;
  }
  sum.direction.normalize();
  return sum;
}

}  // namespace

AxisPassage::AxisPassage(const V3d& source, const V3d& half_way, double radius, double sharpness)
    : side_(source.x < 0 ? -1 : 1),
      half_way_(std::hypot(half_way.y, half_way.z)),
      sharpness_(sharpness) {
  along_ = V3d(0, half_way.y, half_way.z) / half_way_;
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

double AxisPassage::u(double x) const { return u_least_ + least_ / half_way_ * std::sinh(x); }

// Since du/distance = dx/half_way, it is the integral of the weight over x by the rule of Gauss and
// Legendre with three points.
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

std::vector<SkyImage> trail_of(const SkyTable& table, const AxisPassage& passage, int order,
                               const std::function<double(const V3d&)>& spacing) {
  std::vector<Node> nodes;
  add_nodes(table, passage, order, passage.begin(), passage.middle(), nodes);
  add_nodes(table, passage, order, passage.middle(), passage.end(), nodes);
  nodes.push_back(node_at(table, passage, order, passage.end()));
  std::vector<SkyImage> pieces;
  for (std::size_t k = 0; k + 1 < nodes.size(); ++k) {
    const Node &from = nodes[k], &to = nodes[k + 1];
    // Equal steps of x between two nodes differ in length by a tenth at most.
    const double length = 1.1 * (to.direction - from.direction).length();
    const double wanted =
        std::ceil(length / std::min({spacing(from.direction), spacing(to.direction)}));
    const int count = static_cast<int>(std::clamp(wanted, 1.0, double{kMostPieces}));
    for (int n = 0; n < count; ++n) {
      const double step = (to.x - from.x) / count, x = from.x + n * step;
      const Node middle = between(nodes, k, x + step / 2);
      pieces.push_back({{middle.direction},
                        middle.frequency_ratio,
                        middle.strength * passage.mean_inverse_distance(x, x + step)});
    }
  }
  return pieces;
}

}  // namespace domefall
