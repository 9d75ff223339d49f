// A SkyTable is made for one place and one part of its view, a SkyZone, in which a sky is seen.  It
// holds the swept azimuth against the distance from the zone's edge.  It is made from the exact
// integral, evaluated in a few nanoseconds, and invertible, so that pixels and stars use the same
// one.
//
// The coordinate is x = 2 tan(|alpha - edge|/4), half the distance to the edge for small angles and
// smooth up to the far end.  Towards the edge phi = -n ln x + c + x (a + b ln x) + O(x^2 ln x), a
// law that takes over below the table.  Near a Schwarzschild hole n is 1.  Where light also winds
// about a cylinder, that part is known in closed form, and the law has the rest.
#pragma once

#include <cmath>
#include <functional>

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

// A SkyEdge is the edge of a sky, from which the renderer measures how far a direction is.
struct SkyEdge {
  HalfAngle half{0, 1};  // of the edge's alpha
  double sign = 1;       // +1: the sky lies at larger alpha than its edge; -1: at smaller

  // Returns 2 tan(|alpha - edge|/4), negative on the other side of the edge, from half of alpha.
  // With h = (alpha - edge)/2 it is 2 tan(h/2) = 2 sin h/(1 + cos h), and the addition theorems
  // give both.
  double distance(double sin_half, double cos_half) const {
    const double s = sign * (sin_half * half.cosine - cos_half * half.sine);
    return 2 * s / (1 + cos_half * half.cosine + sin_half * half.sine);
  }
};

// A ViewEnergy gives 1 + z = |sine2 sin^2(alpha/2) + cosine2 cos^2(alpha/2)| of light from a sky.
struct ViewEnergy {
  double sine2 = 1, cosine2 = 1;
};

// A ZoneRay is a ray by half of its alpha.
struct ZoneRay {
  HalfAngle half;
  double one_plus_z;

  double sine() const { return 2 * half.sine * half.cosine; }
  double cosine() const { return (half.cosine - half.sine) * (half.cosine + half.sine); }
};

// A SkyZone is a part of the view, all around the axis R, in which one sky is seen: from its edge to
// its far end, which is the axis, where phi vanishes.  The azimuth falls all the way.
struct SkyZone {
  SkyEdge edge;
  double reach;          // radians from the edge to the far end
  double least;          // radians; the smallest angle on which the azimuth has structure
  double logarithm = 1;  // the n of EdgeLaw
  bool uneven = false;   // whether the table needs intervals of half the width
  ViewEnergy energy;
  double inward = 1;  // 1: alpha counts from -R; -1: from R
  // These are exact, for offsets from the edge in [0, reach].
  std::function<double(double)> azimuth;
  std::function<ZoneRay(double)> ray;
  // This is the part of the azimuth that grows by a power next to the edge, in closed form, where
  // there is one.
  std::function<double(double)> winding = nullptr;
};

class SkyTable {
 public:
  // Makes a table by about 300 exact integrals.  OctaveCurve explains `bits`.
  explicit SkyTable(const SkyZone& zone, int bits = OctaveCurve::kPerOctaveBits);

  // Returns the azimuth phi (radians) at x in (0, x_max()].  Measured near a Schwarzschild hole over
  // 1e-6 <= r <= 1e8, |error| < 1e-9 for every distance to the edge above 1e-12.
  double azimuth(double x) const { return x < curve_.x_min() ? beside_edge(x) : curve_.value(x); }

  // Returns d phi/d alpha in absolute value.  The measured relative error is < 1e-7.
  double slope(double x) const;

  // Returns the x with azimuth(x) = phi, for any phi >= 0.  It is the inverse of the same
  // polynomials.
  double distance(double phi) const;

  double x_max() const { return x_max_; }
  const SkyZone& zone() const { return zone_; }
  // Returns the exact ray there.
  ZoneRay ray_at_distance(double x) const;

  std::size_t node_count() const { return curve_.node_count(); }
  // Returns the curve of the azimuth in x.  Below its x_min the law is the caller's, by way of
  // azimuth() and slope().
  const OctaveCurve& curve() const { return curve_; }

 private:
  double continued_azimuth(double x) const;
  double winding(double x) const { return zone_.winding(4 * std::atan(x / 2)); }
  double beside_edge(double x) const {
    return zone_.winding ? law_.azimuth(x) + winding(x) : law_.azimuth(x);
  }
  double distance_beside_edge(double phi) const;

  SkyZone zone_;
  double x_max_;
  OctaveCurve curve_;
  EdgeLaw law_;
};

}  // namespace domefall
