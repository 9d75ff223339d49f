// A SkyTable is made for one place and one part of its view, a SkyZone, in which a sky is seen.  It
// holds the swept azimuth against the distance from the zone's edge.  It is made from the exact
// integral, evaluated in a few nanoseconds, and invertible, so that pixels and stars use the same
// one.
//
// The coordinate is x = 2 tan(|alpha - edge|/4), half the distance to the edge for small angles and
// smooth up to the far end.  Towards the edge phi = -n ln x + c + x (a + b ln x) + O(x^2 ln x), a
// law that takes over below the table.  Near a Schwarzschild hole n is 1.  Where light also winds
// about a cylinder, that part is known in closed form, and the law has the rest.  An edge may also be
// level, and a far end have a form of its own (ZoneEnd).
#pragma once

#include <algorithm>
#include <cmath>
#include <functional>
#include <optional>

#include "pipeline/light/half_angle.h"
#include "pipeline/light/octave_curve.h"

namespace domefall {

// An EdgeLaw is phi next to an edge, fitted at x_min, x_min/4 and x_min/16.
struct EdgeLaw {
  double x_min = 0;
  double n = 1;                // > 0
  double c = 0, a = 0, b = 0;  // of x/x_min

  double azimuth(double x) const {
    const double z = x / x_min, l = std::log(z);
    return c - n * l + z * (a + b * l);
  }
  double slope(double x) const {  // d phi/d x
    const double z = x / x_min, l = std::log(z);
    return (a + b + b * l - n / z) / x_min;
  }
  double distance(double phi) const;  // its inverse; phi >= azimuth(x_min)
};
EdgeLaw fit_edge_law(double x_min, double n, const std::function<double(double)>& phi);

// A PowerLaw is phi = start + rise (x/x_min)^power, the leading term where phi is finite.
struct PowerLaw {
  double x_min, start, rise, power;

  double azimuth(double x) const { return start + rise * std::pow(x / x_min, power); }
  double slope(double x) const { return rise * power / x_min * std::pow(x / x_min, power - 1); }
  double distance(double phi) const {
    return x_min * std::pow(std::max(0.0, (phi - start) / rise), 1 / power);
  }
};

// A SkyEdge is the edge of a sky, from which the renderer measures how far a direction is.
struct SkyEdge {
  HalfAngle half{0, 1};  // of the edge's alpha
  double sign = 1;       // +1: the sky lies at larger alpha than its edge; -1: at smaller
  double width = 0;      // radians; where no azimuth diverges, how far from the edge it is smooth

  // Returns 2 tan(|alpha - edge|/4), negative on the other side of the edge, from half of alpha.
  // With h = (alpha - edge)/2 it is 2 tan(h/2) = 2 sin h/(1 + cos h), and the addition theorems
  // give both.
  double distance(double sin_half, double cos_half) const {
    const double s = sign * (sin_half * half.cosine - cos_half * half.sine);
    return 2 * s / (1 + cos_half * half.cosine + sin_half * half.sine);
  }
};

// A ViewEnergy gives 1 + z = |sine2 sin^2(alpha/2) + cosine2 cos^2(alpha/2)| of light from a sky, and
// no less than `least`.
struct ViewEnergy {
  double sine2 = 1, cosine2 = 1;
  double least = 0;

  // Returns 1 + z of light with this energy, the sum of the two terms.
  double one_plus_z(double energy) const {
    const double e = std::abs(energy);
    return e > least ? e : least;
  }
};

// A ZoneRay is a ray by half of its alpha.
struct ZoneRay {
  HalfAngle half;
  double one_plus_z;

  double sine() const { return 2 * half.sine * half.cosine; }
  double cosine() const { return (half.cosine - half.sine) * (half.cosine + half.sine); }
};

// A ZoneEnd is how the azimuth falls to zero at the far end, where it has a form of its own there.
// Elsewhere phi passes oddly through the far end.
struct ZoneEnd {
  double least;       // radians; the smallest angle from the far end on which it has structure
  bool core = false;  // phi goes like the root of that angle, for light that turned at the core
  std::function<double(double)> azimuth;  // exact, by the angle from the far end
};

// A SkyZone is a part of the view, all around the axis R, in which one sky is seen: from its edge to
// its far end, which is the axis, where phi vanishes.  The azimuth falls all the way.
struct SkyZone {
  SkyEdge edge;
  double reach;          // radians from the edge to the far end
  double least;          // radians; the smallest angle on which the azimuth has structure
  double logarithm = 1;  // the n of EdgeLaw, where the edge is not level
  bool level = false;    // phi is greatest at the edge, and falls from there by the square of x
  bool uneven = false;   // whether the table needs intervals of half the width
  ViewEnergy energy;
  double inward = 1;  // 1: alpha counts from -R; -1: from R
  // These are exact, for offsets from the edge in [0, reach].
  std::function<double(double)> azimuth;
  std::function<ZoneRay(double)> ray;
  // This is the part of the azimuth that grows by a power next to the edge, in closed form, where
  // there is one.
  std::function<double(double)> winding = nullptr;
  std::optional<ZoneEnd> end{};
};

class SkyTable {
 public:
  // Makes a table by about 300 exact integrals.  OctaveCurve explains `bits`.
  explicit SkyTable(const SkyZone& zone, int bits = OctaveCurve::kPerOctaveBits);

  // Returns the azimuth phi (radians) at x in (0, x_max()].  Measured near a Schwarzschild hole over
  // 1e-6 <= r <= 1e8, |error| < 1e-9 for every distance to the edge above 1e-12.
  double azimuth(double x) const {
    if (x > x_split_) return end_azimuth(from_end(x));
    return x < curve_.x_min() ? beside_edge(x) : curve_.value(x);
  }

  // Returns d phi/d alpha in absolute value.  The measured relative error is < 1e-7.  Where it grows
  // without bound towards the far end, it does not below 1e-12 of the smallest angle there.
  double slope(double x) const;

  // Returns the x with azimuth(x) = phi, for any phi >= 0.  It is the inverse of the same
  // polynomials.  What no ray sweeps has x = 0.
  double distance(double phi) const;

  // Returns the least upper bound of all azimuths, which is infinite but for a level edge.
  double most_azimuth() const { return level_ ? level_->start : HUGE_VAL; }
  // Returns |d2 phi/d alpha2| on a level edge, and 0 elsewhere.
  double curvature() const;

  double x_max() const { return x_max_; }
  const SkyZone& zone() const { return zone_; }
  // Returns the exact ray there.
  ZoneRay ray_at_distance(double x) const;

  std::size_t node_count() const {
    return curve_.node_count() + (end_curve_ ? end_curve_->node_count() : 0);
  }
  // Returns the curve of the azimuth in x, which holds up to curve_end().  Elsewhere the law, or
  // the form of the far end, is the caller's, by way of azimuth() and slope().
  const OctaveCurve& curve() const { return curve_; }
  double curve_end() const { return x_split_; }

 private:
  double continued_azimuth(double x) const;
  double winding(double x) const { return zone_.winding(4 * std::atan(x / 2)); }
  double distance_beside_edge(double phi) const;
  double beside_edge(double x) const;
  double slope_by_x(double x) const;
  // From the far end the coordinate is y = 2 tan(|alpha - end|/4).
  double from_end(double x) const { return (x_max_ - x) / (1 + x * x_max_ / 4); }
  double end_azimuth(double y) const;
  double slope_at_end(double y) const;

  SkyZone zone_;
  double x_max_, x_split_;
  OctaveCurve curve_;
  // Below the curve phi has one of these, or is exact where neither holds.
  std::optional<EdgeLaw> law_;
  std::optional<PowerLaw> level_;
  // These are in y, for x > x_split_.
  std::optional<OctaveCurve> end_curve_;
  std::optional<PowerLaw> end_law_;
};

}  // namespace domefall
