// The view of an observer near a charge, in zones.  A zone is a range of alpha in which light comes
// from one sky and the azimuth is smooth and monotone, so that a table of it can be made and
// inverted.  Zones lie side by side from alpha = 0 to pi.
//
// A zone is counted from one of its ends, its edge, in x = 2 tan(|alpha - edge|/4), as SkyTable
// does.  There the azimuth grows like a logarithm, or vanishes like a root or a line, or is level:
//
//     kLogarithm   phi = -coefficient ln x + c + x (a + b ln x) + ..., at a critical ray
//     kRoot        phi = coefficient sqrt(x) + a x + ..., on the axis, where light turned at the core
//     kLine        phi = coefficient x + O(x^3), on the axis, where light came straight from the sky
//     kLevel       phi = c + a x^2 + ..., at a maximum, where two images of the sky become one
//
// A sky that reaches from a critical ray to the core, or over a maximum, has several zones.  So has
// one whose azimuth next to the axis has a form of its own.  They meet where it is smooth.
#pragma once

#include <vector>

#include "pipeline/light/charged_azimuth.h"
#include "pipeline/light/half_angle.h"

namespace domefall {

enum class ZoneStart : char { kLogarithm, kRoot, kLine, kLevel, kDark };

struct ChargedZone {
  ChargedView view;
  ChargedOrigin sky;      // kDark: there is no azimuth
  ZoneStart start;        // how the azimuth begins at the edge
  double coefficient;     // of that, 0 for kLevel
  Critical critical;      // the critical ray, for kLogarithm
  PolarAngle edge_angle;  // alpha of the edge
  double sign;            // +1: the zone lies at larger alpha than its edge; -1: at smaller
  double reach;           // radians from the edge to the other end
  bool ends_on_axis;      // the other end is the axis, through which the azimuth passes oddly
  // The smallest angle, in radians, over which the azimuth has a form of its own next to the edge.
  // Far below it the law above holds.
  double smallest_angle;

  HalfAngle edge() const;
  double x_max() const;
  // Returns the ray at an offset of [0, reach] radians from the edge.
  ChargedRay ray(double offset) const;
  // Returns its azimuth, also a little beyond the reach, where it is continued smoothly.
  double azimuth(double offset) const;
};

// Returns the zones by their lower alpha.  They fill [0, pi].  T' (`outgoing`) is the tetrad of
// what comes out of the inner horizon; alpha is pi - delta there.
std::vector<ChargedZone> charged_zones(const ChargedHole& hole, const ChargedRadius& at,
                                       bool outgoing);

}  // namespace domefall
