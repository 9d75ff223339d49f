// A WhiteHoleTable holds the azimuth swept by light from the past singularity (region IV).  This
// light fills the silhouette seen from outside, the shell between the two skies inside, and all
// directions in region IV.  [Riazuelo] sec. sec_Kruskal, figs. dev_wh_0, dev_wh and fig_IV_dev.
//
// The coordinate s is made of ratios of T = tan(alpha/2).  Radial boosts only scale T, so that none
// of the structure is lost however close the horizon is:
//   outside      s = T_edge/T - 1 (outgoing frame: T/T_edge - 1) goes from 0 at the silhouette,
//                where phi diverges like -ln s, to infinity on the axis, where phi is odd in the
//                cube root of y = 1/(1 + s).
//   region II    s = T/T_3 - 1 from the edge of region III (s = T_1/T - 1 from the silhouette) goes
//                to E = 0, where phi has its minimum 2 pi - (arcsin(r - 1) + pi/2).  phi is even in
//                E, so one curve serves both halves.  Every source beyond the minimum has two
//                images.
//   region IV    s = y = T/T_0 (T_0/T) goes from 0 on the axis, where phi again goes like a cube
//                root, to 1 at T_0, where E = 0 and phi has its maximum arcsin(r - 1) + pi/2.
#pragma once

#include <array>
#include <functional>
#include <optional>
#include <vector>

#include "pipeline/light/null_ray.h"
#include "pipeline/light/octave_curve.h"
#include "pipeline/light/sky_table.h"

namespace domefall {

// An AxisLaw is phi next to the axis.  It is odd in t = cbrt(y/y_min), and fitted at five points up
// to t = 1.
struct AxisLaw {
  double y_min = 0;
  std::array<double, 5> c{};  // of t, t^3, t^5, t^7, t^9

  double azimuth(double y) const;
  double slope(double y) const;       // d phi/d y; infinite at 0
  double distance(double phi) const;  // its inverse; phi <= azimuth(y_min)
};

// A WhiteHolePlace gives s of a direction as (n1 sin + n2 cos)/(d1 sin + d2 cos) of alpha/2, for
// the half below T_0 and the one beyond it.  Outside both are the same.
struct WhiteHolePlace {
  struct Ratio {
    double n1, n2, d1, d2;
  };
  double zero = 0;
  Ratio below{}, beyond{};

  double operator()(double sin_half, double cos_half, double& rate) const {
    const bool far = sin_half > zero * cos_half;
    const double n1 = far ? beyond.n1 : below.n1, n2 = far ? beyond.n2 : below.n2;
    const double d1 = far ? beyond.d1 : below.d1, d2 = far ? beyond.d2 : below.d2;
    const double over = d1 * sin_half + d2 * cos_half;
    rate = (n1 * d2 - n2 * d1) / (2 * over * over);  // d s/d alpha
    return (n1 * sin_half + n2 * cos_half) / over;
  }
};

class WhiteHoleTable {
 public:
  // Makes the table outside for rain or outgoing at r > 2, in region II for rain at r <= 2, and in
  // region IV for outgoing at r <= 2.  OctaveCurve explains `bits`.
  WhiteHoleTable(const Radius& at, bool outgoing, int bits = OctaveCurve::kPerOctaveBits);

  // A Place says where a ray stands in the table.
  struct Place {
    double s;     // > 0, or 0 or infinite on the axis; negative: not from the singularity
    double rate;  // d s/d alpha
  };
  Place place_of(const NullRay& ray) const;
  Place place_of(double sin_half, double cos_half) const;

  // Measured over 1e-6 <= r <= 1e8, the |error| is < 1e-9.
  double azimuth(const Place& p) const;
  double slope(const Place& p) const;  // d phi/d alpha, signed; infinite on the axis

  // Branches are all rays on which phi is seen.  There is one outside.  In II and IV there are two
  // or none, and the extremum parts the branches.
  struct Branches {
    int count = 0;
    std::array<NullRay, 2> ray{NullRay{0.0, 0, 0, 0, 0}, NullRay{0.0, 0, 0, 0, 0}};
  };
  Branches rays_of(double phi) const;

  // A Turn is the extremum at E = 0, in II and IV.  There is none outside.
  struct Turn {
    double alpha, azimuth;
    double curvature;  // d2 phi/d alpha2
  };
  const std::optional<Turn>& turn() const { return turn_; }

  std::size_t node_count() const { return curve_.node_count(); }
  const OctaveCurve& curve() const { return curve_; }  // in s

  // A Lookup is for loops that are to become SIMD code.  It holds place() and, between low and
  // high, curve().  Beyond those the laws are the caller's, by way of azimuth() and slope().
  struct Lookup {
    WhiteHolePlace place;
    OctaveCurve::Lookup curve;
    double low, high;
  };
  Lookup lookup() const;

  // These serve other functions of the same rays.  They say where the curve runs in s, and which
  // ray stands at an s.  In II and IV this is the one of smaller alpha, where E <= 0.
  struct Range {
    double low, high;
  };
  Range curve_range() const { return {curve_.x_min(), range_.high}; }
  NullRay ray_at_place(double s) const;
  const Radius& at() const { return at_; }
  bool is_outgoing() const { return kind_ == Kind::kOutsideOutgoing || kind_ == Kind::kWhiteHole; }
  bool has_edge() const { return kind_ != Kind::kWhiteHole; }

 private:
  enum class Kind { kOutside, kOutsideOutgoing, kInside, kWhiteHole };

  WhiteHoleTable(const Radius& at, Kind kind, int bits);
  Range range() const;
  double axis_scale() const;
  bool has_axis() const { return kind_ != Kind::kInside; }
  bool is_outside() const { return kind_ == Kind::kOutside || kind_ == Kind::kOutsideOutgoing; }
  WhiteHolePlace ratios() const;
  Place off_edge(const Place& p) const;
  double place_of_azimuth(double phi) const;
  // Returns the ray of the same phi on the other side of E = 0.
  NullRay other_half(double s) const;

  Radius at_;
  Kind kind_;
  double first_, second_;  // T of the critical rays
  double zero_;            // T_0, of E = 0
  WhiteHolePlace place_;
  Range range_;
  OctaveCurve curve_;
  EdgeLaw edge_law_;
  AxisLaw axis_law_;
  std::optional<Turn> turn_;
};

}  // namespace domefall
