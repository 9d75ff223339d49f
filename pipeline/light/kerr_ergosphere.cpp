#include "pipeline/light/kerr_ergosphere.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "pipeline/light/kerr_view.h"
#include "pipeline/light/light_path.h"

namespace domefall {
namespace {

using std::numbers::pi;

constexpr int kOutlineCorners = 512;
// Directions are tried at parts e^(-k/2) of the way from the edge to straight away from the hole, down
// to 1e-4, and the last step is halved so often.
constexpr double kTry = 0.5;
constexpr int kMostTries = 18, kHalvings = 18;

class Ergosphere {
 public:
  explicit Ergosphere(const KerrPlace& at)
      : at_(at),
        spin2_(static_cast<double>(at.hole.spin * at.hole.spin)),
        squares_(static_cast<double>(at.hole.squares())),
        axis_(std::cos(static_cast<double>(at.theta)), -std::sin(static_cast<double>(at.theta)),
              0) {}

  // Says whether light that is seen outside the silhouette has been in it.
  bool gives(double delta, double eta) const {
    // It is nowhere farther from the hole than r = 2.
    const double outer = std::max(static_cast<double>(at_.r), 2.0);
    const LightPath path = kerr_light_path(at_, delta, eta, outer);
    for (std::size_t k = 1; k < path.places.size(); ++k)
      if (outside(path.places[k], path.places[k], 0) < 0 ||
          nearest(path.places[k - 1], path.places[k]) < 0)
        return true;
    return false;
  }

 private:
  // (Delta - a^2 sin^2(theta))/r^2, which is positive outside, of a place between two of a path.
  double outside(const LightPath::Place& a, const LightPath::Place& b, double part) const {
    const double w = LightPath::inverse_radius(a, b, part),
                 z = LightPath::direction(a, b, part).normalized().dot(axis_);
    return 1 - 2 * w + (squares_ - spin2_ * (1 - z) * (1 + z)) * w * w;
  }
  // By how much it grows with psi.
  double growth(const LightPath::Place& at) const {
    const double z = at.at.dot(axis_), part = squares_ - spin2_ * (1 - z) * (1 + z);
    return 2 * at.slope * (part * at.w - 1) + 2 * spin2_ * z * at.turning.dot(axis_) * at.w * at.w;
  }
  // Returns the least of it between two places.
  double nearest(const LightPath::Place& a, const LightPath::Place& b) const {
    if (!(growth(a) < 0 && growth(b) > 0)) return outside(a, b, 1);
    double low = 0, high = 1;
    for (int k = 0; k < 40; ++k) {
      const double one = low + (high - low) / 3, other = high - (high - low) / 3;
      if (outside(a, b, one) < outside(a, b, other))
        high = other;
      else
        low = one;
    }
    return outside(a, b, low);
  }

  KerrPlace at_;
  double spin2_, squares_;
  V3d axis_;  // along R, Theta and Phi
};

}  // namespace

bool in_ergosphere(const KerrPlace& at) {
  const long double sine = std::sin(at.theta), part = at.hole.spin * sine;
  return at.r < at.hole.horizon() || at.delta() < part * part;
}

std::vector<V3d> ergosphere_outline(const KerrPlace& at) {
  const Ergosphere ergosphere(at);
  std::vector<V3d> corners;
  corners.reserve(kOutlineCorners);
  for (int k = 0; k < kOutlineCorners; ++k) {
    const double eta = -2 * pi * k / kOutlineCorners;
    const double edge = kerr_edge_delta(at, eta);
    const auto gives = [&](double depth) {
      return ergosphere.gives(edge + (pi - edge) * std::exp(-depth), eta);
    };
    double depth = kTry;
    while (depth < kMostTries * kTry && !gives(depth)) depth += kTry;
    if (depth >= kMostTries * kTry) {
      corners.push_back(kerr_view(edge, eta));
      continue;
    }
    double without = depth - kTry;
    for (int i = 0; i < kHalvings; ++i) {
      const double middle = (without + depth) / 2;
      (gives(middle) ? depth : without) = middle;
    }
    corners.push_back(kerr_view(edge + (pi - edge) * std::exp(-depth), eta));
  }
  return corners;
}

}  // namespace domefall
