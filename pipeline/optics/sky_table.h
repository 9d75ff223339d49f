// One table per radius and sky: the swept azimuth against the distance from the edge of that sky,
// made from the exact integral, evaluated in a few nanoseconds, and invertible, so that pixels and
// stars use the same one.
//
// The coordinate is x = 2 tan(|delta - edge|/4), half the distance to the edge for small angles and
// smooth up to the far end.  Towards the edge phi = -ln x + const + O(x ln x), so the intervals
// divide each octave of x into 16 and are found from the bits of x; in each, phi is a quintic that
// matches value, slope and curvature at both ends.  Those come from Chebyshev interpolation of the
// exact integral in ln x.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <vector>

#include "pipeline/optics/null_ray.h"

namespace domefall {

class SkyTable {
 public:
  // Edge::kSilhouette: sky I, from the silhouette to delta = pi; any finite r > 0.
  // Edge::kRegionThree: sky III, from its edge to delta = 0; 0 < r < 2.
  // About 400 exact integrals.
  SkyTable(const Radius& at, Edge edge);

  // Azimuth phi (radians) at x in (0, x_max()].  Below the table's range the logarithmic law
  // continues it.  Measured over 1e-6 <= r <= 1e8: |error| < 1e-9 for all x > 1e-12 x_max.
  double azimuth(double x) const {
    if (x < x_min_) return first_value_ + std::log(x_min_ / x);
    const Interval& q = interval(x);
    const double u = (x - q.start) * q.inverse_width;
    return q.c[0] + u * (q.c[1] + u * (q.c[2] + u * (q.c[3] + u * (q.c[4] + u * q.c[5]))));
  }

  // d phi / d delta in absolute value.  Measured: relative error < 1e-7.
  double slope(double x) const;

  // The x with azimuth(x) = phi, for any phi >= 0: the inverse of the same polynomials.
  double distance(double phi) const;

  double edge_angle() const { return edge_angle_; }
  double x_max() const { return x_max_; }
  // delta and back.
  double delta_at(double x) const;
  double distance_at(double delta) const;
  // x from sin and cos of delta/2, as the renderer has them; negative on the other side of the edge.
  double distance_from_half_angle(double sin_half, double cos_half) const {
    const double sine = sign_ * (sin_half * cos_edge_ - cos_half * sin_edge_);
    const double cosine = cos_half * cos_edge_ + sin_half * sin_edge_;
    return 2 * sine / (1 + cosine);
  }

  std::size_t node_count() const { return intervals_.size() + 1; }

  struct Sweep {
    double azimuth, slope;
  };
  // azimuth() and slope() of any number of x without a branch, for loops that are to become SIMD
  // code: a copy of what a look-up needs, which no store of the loop can be taken to alter.  Good
  // while the table lives.  x below x_min is looked up there: the logarithmic law is the caller's.
  class Lookup;
  Lookup lookup() const;

 private:
  static constexpr int kPerOctaveBits = 4;
  struct Interval {
    double start, inverse_width;
    std::array<double, 6> c;
  };

  static std::int64_t key(double x) {
    return static_cast<std::int64_t>(std::bit_cast<std::uint64_t>(x) >> (52 - kPerOctaveBits));
  }
  static double key_start(std::int64_t k) {
    return std::bit_cast<double>(static_cast<std::uint64_t>(k) << (52 - kPerOctaveBits));
  }
  const Interval& interval(double x) const {
    const auto last = static_cast<std::int64_t>(intervals_.size()) - 1;
    return intervals_[static_cast<std::size_t>(std::min(key(x) - first_key_, last))];
  }

  double sign_;                 // +1: the sky lies beyond its edge; -1: within it
  double edge_angle_;           // radians
  double sin_edge_, cos_edge_;  // of half the edge
  double x_min_, x_max_;
  double first_value_;  // phi at x_min
  std::int64_t first_key_;
  std::vector<Interval> intervals_;
};

class SkyTable::Lookup {
 public:
  double x_min() const { return x_min_; }
  // As distance_from_half_angle().
  double distance(double sin_half, double cos_half) const {
    const double sine = sign_ * (sin_half * cos_edge_ - cos_half * sin_edge_);
    const double cosine = cos_half * cos_edge_ + sin_half * sin_edge_;
    return 2 * sine / (1 + cosine);
  }
  Sweep operator()(double x) const {
    const double at = x > x_min_ ? x : x_min_;
    const std::int64_t k = key(at) - first_key_;
    const Interval& q = intervals_[k < last_ ? k : last_];
    const double u = (at - q.start) * q.inverse_width;
    const double phi =
        q.c[0] + u * (q.c[1] + u * (q.c[2] + u * (q.c[3] + u * (q.c[4] + u * q.c[5]))));
    const double d =
        q.c[1] + u * (2 * q.c[2] + u * (3 * q.c[3] + u * (4 * q.c[4] + u * 5 * q.c[5])));
    return {phi, std::abs(d * q.inverse_width) * ((1 + at * at / 4) / 2)};
  }

 private:
  friend class SkyTable;
  const Interval* intervals_ = nullptr;
  std::int64_t first_key_ = 0, last_ = 0;
  double x_min_ = 0, sign_ = 1, sin_edge_ = 0, cos_edge_ = 1;
};

inline SkyTable::Lookup SkyTable::lookup() const {
  Lookup l;
  l.intervals_ = intervals_.data();
  l.first_key_ = first_key_;
  l.last_ = static_cast<std::int64_t>(intervals_.size()) - 1;
  l.x_min_ = x_min_;
  l.sign_ = sign_;
  l.sin_edge_ = sin_edge_;
  l.cos_edge_ = cos_edge_;
  return l;
}

}  // namespace domefall
