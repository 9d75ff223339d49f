// The rays that meet places in or about a sphere near the hole, in the planes of R and e
// (sphere_surface.h).
#pragma once

#include <algorithm>
#include <array>
#include <boost/math/tools/toms748_solve.hpp>
#include <cmath>
#include <cstdint>
#include <functional>
#include <optional>
#include <utility>
#include <vector>

#include "pipeline/light/chebyshev.h"
#include "pipeline/light/sphere_centre.h"
#include "pipeline/light/sphere_surface.h"

namespace domefall {

// Returns the root of f between a, where f > 0, and b, where it is not, to a part of that range.
template <class F>
double root_between(double a, double fa, double b, double fb, double part, const F& f) {
  if (!(fa > 0)) return a;
  if (!(fb < 0)) return b;
  const double enough = part * std::abs(b - a);
  if (a > b) std::swap(a, b), std::swap(fa, fb);
  std::uintmax_t steps = 60;
  const auto [from, to] = boost::math::tools::toms748_solve(
      f, a, b, fa, fb, [enough](double x, double y) { return y - x < enough; }, steps);
  return (from + to) / 2;
}

// Azimuths go from one to another with t from -pi/2 to pi/2, slowly at both ends.
class Azimuths {
 public:
  Azimuths() = default;
  explicit Azimuths(const std::pair<double, double>& range)
      : middle_((range.first + range.second) / 2),
        widest_(std::sin((range.second - range.first) / 2)) {}

  double operator()(double t) const { return middle_ + std::asin(widest_ * std::sin(t)); }
  // Returns t, if the azimuth is one of them.
  std::optional<double> t_of(double azimuth) const {
    const double off = azimuth - middle_, share = std::sin(off) / widest_;
    if (!(std::cos(off) > 0 && std::abs(share) < 1)) return std::nullopt;
    return std::asin(share);
  }

 private:
  double middle_ = 0, widest_ = 0;  // sine of half of their range
};

// Returns the nodes along the chord of t, of those along Chebyshev's chords.
template <class Node, std::size_t chords, std::size_t n>
std::array<Node, n> chord_of(const std::array<std::array<Node, n>, chords>& nodes, double t) {
  const auto weights = Chebyshev<static_cast<int>(chords)>::weights(t);
  std::array<Node, n> row;
  for (std::size_t i = 0; i < chords; ++i)
    for (std::size_t j = 0; j < n; ++j) row[j].add(weights[i], nodes[i][j]);
  return row;
}

// Returns what is at w of a chord, from -1 to 1, where nodes are even in asin(w).
template <class Node, std::size_t n>
Node along(const std::array<Node, n>& chord, double w) {
  const auto weights = Chebyshev<static_cast<int>(n)>::weights(std::asin(std::clamp(w, -1.0, 1.0)));
  Node node;
  for (std::size_t j = 0; j < n; ++j) node.add(weights[j], chord[j]);
  return node;
}

// SphereRays are those of one order, to what is within a radius of the centre in the body's frame.
class SphereRays {
 public:
  SphereRays(const SphereView& view, const BodyMotion& motion, const BodyImage& image,
             double radius);

  // Returns e of an azimuth, and the azimuth of e.
  V3d plane(double azimuth) const {
    return across_ * std::cos(azimuth) + beside_ * std::sin(azimuth);
  }
  double azimuth_of(const V3d& e) const { return std::atan2(e.dot(beside_), e.dot(across_)); }
  V3d direction(double azimuth, double angle) const {
    return plane(azimuth) * std::sin(angle) - V3d(std::cos(angle), 0, 0);
  }

  // A Met is a place and what was there when its light left.
  struct Met {
    double tau;
    SphereCentre centre;
    V3d q;
    double r, psi;
    SeenPlace seen;
  };
  std::optional<Met> meet(const V3d& e, const V3d& place, double tau) const;
  // A Slope is q at a place of the plane of R and e, and its derivatives along R and e.
  struct Slope {
    Met at;
    V3d along_r, along_e;
  };
  std::optional<Slope> slope(const V3d& e, const V3d& place, double tau) const;

  // A Leaving is light in the frame of free fall of the place where it leaves the body's matter.
  struct Leaving {
    FallFrame frame;
    V3d outwards;       // unit, the place's direction from the hole
    V3d velocity, ray;  // of the matter and of the light; |ray| = 1
    double rate;        // at which T grows
    double doppler;     // frequency for the matter
    V3d split(const V3d& v, double radial, double across) const {
      return (v - outwards * outwards.dot(v)) * across + outwards * radial;
    }
    double ratio(const Met& met) const { return 1 / (met.seen.frequency * doppler); }
  };
  // Returns nothing where the matter would be faster than light.
  std::optional<Leaving> leaving(const V3d& e, const Met& met) const;

  // Returns the ranges of azimuths at which clear(e) > 0.  Next to the axis what moves across may be
  // seen in several parts.
  std::vector<std::pair<double, double>> ranges(
      const std::function<double(const V3d& e)>& clear) const;

  const SphereView& view;
  const BodyMotion& motion;
  const BodyImage& image;
  const double radius;

 private:
  std::optional<V3d> centre_if_on_axis() const;

  V3d across_, beside_{0, 0, 0};  // e of azimuths 0 and pi/2
};

}  // namespace domefall
