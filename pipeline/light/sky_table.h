// A SkyTable is made for one radius and one sky.  It holds the swept azimuth against the distance
// from the edge of that sky.  It is made from the exact integral, evaluated in a few nanoseconds,
// and invertible, so that pixels and stars use the same one.
//
// The coordinate is x = 2 tan(|alpha - edge|/4), half the distance to the edge for small angles and
// smooth up to the far end.  Towards the edge phi = -ln x + c + x (a + b ln x) + O(x^2 ln x), a law
// that takes over below the table.
#pragma once

#include <cmath>

#include "pipeline/light/half_angle.h"
#include "pipeline/light/null_ray.h"
#include "pipeline/light/octave_curve.h"

namespace domefall {

// An EdgeLaw is phi next to an edge, fitted at x_min, x_min/4 and x_min/16.
struct EdgeLaw {
  double x_min = 0;
  double c = 0, a = 0, b = 0;  // of x/x_min

  double azimuth(double x) const {
    const double z = x / x_min, l = std::log(z);
    return c - l + z * (a + b * l);
  }
  double slope(double x) const {  // d phi/d x
    const double z = x / x_min, l = std::log(z);
    return (a + b + b * l - 1 / z) / x_min;
  }
  double distance(double phi) const;  // its inverse; phi >= azimuth(x_min)
};
EdgeLaw fit_edge_law(double x_min, const std::function<double(double)>& phi);

// A SkyEdge is the edge of a sky, from which the renderer measures how far a direction is.
struct SkyEdge {
  HalfAngle half{0, 1};  // of the edge's alpha
  double sign = 1;       // +1: the sky lies at larger alpha than its edge; -1: at smaller

  SkyEdge() = default;
  SkyEdge(const Radius& at, Critical edge);
  // Returns 2 tan(|alpha - edge|/4), negative on the other side of the edge, from half of alpha.
  // With h = (alpha - edge)/2 it is 2 tan(h/2) = 2 sin h/(1 + cos h), and the addition theorems
  // give both.
  double distance(double sin_half, double cos_half) const {
    const double s = sign * (sin_half * half.cosine - cos_half * half.sine);
    return 2 * s / (1 + cos_half * half.cosine + sin_half * half.sine);
  }
};

class SkyTable {
 public:
  // Makes one of three tables by about 300 exact integrals.  OctaveCurve explains `bits`.
  //   rain, Critical::kFirst      the home sky, from the silhouette to alpha = pi; any finite r > 0
  //   rain, Critical::kSecond     the far sky, from its edge to alpha = 0; 0 < r < 2
  //   outgoing, Critical::kSecond the home sky, from the silhouette to alpha = 0; r > 2
  SkyTable(const Radius& at, Critical edge, bool outgoing = false,
           int bits = OctaveCurve::kPerOctaveBits);

  // Returns the azimuth phi (radians) at x in (0, x_max()].  Measured over 1e-6 <= r <= 1e8,
  // |error| < 1e-9 for every distance to the edge above 1e-12.
  double azimuth(double x) const { return x < curve_.x_min() ? law_.azimuth(x) : curve_.value(x); }

  // Returns d phi/d alpha in absolute value.  The measured relative error is < 1e-7.
  double slope(double x) const;

  // Returns the x with azimuth(x) = phi, for any phi >= 0.  It is the inverse of the same
  // polynomials.
  double distance(double phi) const;

  double edge_angle() const { return edge_angle_; }
  double x_max() const { return x_max_; }
  const SkyEdge& edge() const { return edge_; }
  // Returns the exact ray of the table's frame there.
  NullRay ray_at_distance(double x) const;
  // Returns x from a ray's exact gap.
  double distance_of(const NullRay& ray) const;

  std::size_t node_count() const { return curve_.node_count(); }
  // Returns the curve of the azimuth in x.  Below its x_min the law is the caller's, by way of
  // azimuth() and slope().
  const OctaveCurve& curve() const { return curve_; }

 private:
  SkyTable(const Radius& at, Critical edge, bool outgoing, double tangent, int bits);
  double continued_azimuth(double x) const;

  Radius at_;
  Critical critical_;
  bool outgoing_;
  SkyEdge edge_;
  double edge_angle_;  // radians
  double reach_;       // radians from the edge to the far end
  double x_max_;
  OctaveCurve curve_;
  EdgeLaw law_;
};

}  // namespace domefall
