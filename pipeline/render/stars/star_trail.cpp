#include "pipeline/render/stars/star_trail.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace domefall {
namespace {

// A piece is at most so long in x.  The weight 1 - |u| and the amplification times the distance
// change little over it.
constexpr double kLongestPiece = 1;
// A piece is halved at most so often, which allows for 4096 pieces of each first one.
constexpr int kMostHalvings = 12;

// Halves a stretch of the trail until its ends are near enough to each other.
class Trail {
 public:
  Trail(const SkyTable& table, const AxisPassage& passage, int order,
        const std::function<double(const V3d&)>& spacing)
      : table_(table), passage_(passage), order_(order), spacing_(spacing) {}

  void add(double from, double to) {
    const int count = std::max(1, static_cast<int>(std::ceil((to - from) / kLongestPiece)));
    V3d before = direction(from);
    for (int k = 0; k < count; ++k) {
      const double begin = from + (to - from) * k / count,
                   end = from + (to - from) * (k + 1) / count;
      const V3d after = direction(end);
      add_piece(begin, before, end, after, 0);
      before = after;
    }
  }

  std::vector<SkyImage> pieces;

 private:
  SkyImage image(double x) const { return image_of(&table_, passage_.source(x), order_, 0); }
  V3d direction(double x) const { return image(x).direction.v; }

  void add_piece(double from, const V3d& first, double to, const V3d& last, int halvings) {
    const double x = (from + to) / 2;
    SkyImage middle = image(x);
    const V3d& d = middle.direction.v;
    // The chord over the whole piece is 0 for a full turn, so both halves count.
    const double length = (d - first).length() + (last - d).length();
    if (length > spacing_(d) && halvings < kMostHalvings) {
      add_piece(from, first, x, d, halvings + 1);
      add_piece(x, d, to, last, halvings + 1);
      return;
    }
    middle.amplification *= passage_.distance(x) * passage_.mean_inverse_distance(from, to);
    pieces.push_back(middle);
  }

  const SkyTable& table_;
  const AxisPassage& passage_;
  int order_;
  const std::function<double(const V3d&)>& spacing_;
};

}  // namespace

AxisPassage::AxisPassage(const V3d& source, const V3d& half_way, double radius)
    : side_(source.x < 0 ? -1 : 1), half_way_(std::hypot(half_way.y, half_way.z)) {
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

// Since du/distance = dx/half_way, it is the integral of 1 - |u| over x by the rule of Gauss and
// Legendre with three points, which is exact to 1e-4 for a step of 1.
double AxisPassage::mean_inverse_distance(double from, double to) const {
  constexpr std::array<double, 3> kNodes{-0.7745966692414834, 0, 0.7745966692414834};
  constexpr std::array<double, 3> kWeights{5.0 / 18, 8.0 / 18, 5.0 / 18};
  double sum = 0;
  for (std::size_t k = 0; k < 3; ++k)
    sum +=
        kWeights[k] * std::max(0.0, 1 - std::abs(u((from + to) / 2 + kNodes[k] * (to - from) / 2)));
  return sum * (to - from) / half_way_;
}

std::vector<SkyImage> trail_of(const SkyTable& table, const AxisPassage& passage, int order,
                               const std::function<double(const V3d&)>& spacing) {
  Trail trail(table, passage, order, spacing);
  trail.add(passage.begin(), passage.middle());
  trail.add(passage.middle(), passage.end());
  return std::move(trail.pieces);
}

}  // namespace domefall
