// An EmissionTimeTable holds the emission times of the light of the past singularity, for pictures
// in which it glows with t.  It is a companion of WhiteHoleTable and has the same coordinate s.
//
// Next to an edge t goes like -+3 sqrt 3 phi, so the curve is that of the rest, t + 3 sqrt 3 phi,
// which is finite there.  Where there is no edge, it is that of t alone.  In II and IV it is that
// of the half with E < 0, because t less the observer's is odd in E.  Towards the axis t moves like
// b^(4/3) while phi moves like b^(1/3).
#pragma once

#include "pipeline/light/white_hole_table.h"

namespace domefall {

class EmissionTimeTable {
 public:
  // OctaveCurve explains `bits`.  The white hole's table is only needed to make this one.
  explicit EmissionTimeTable(const WhiteHoleTable& table, int bits = OctaveCurve::kPerOctaveBits);

  struct Value {
    double time;   // as exact_emission_time() counts it; M
    double slope;  // |d time/d alpha|, finite
  };
  // Returns the value in a direction, of which the white hole's table says the place, the azimuth
  // and the |slope|, which must be finite.  `beyond` says whether E is positive, that is
  // tan(alpha/2) > T_0, and counts in II and IV only.  Measured over 1e-6 <= r <= 1e8, the error of
  // the time is below 1e-5 for every distance to an edge.
  Value at(const WhiteHoleTable::Place& place, bool beyond, double azimuth, double slope) const;

  std::size_t node_count() const { return curve_.node_count(); }

 private:
  double time_at_place(const WhiteHoleTable& table, double s) const;

  bool odd_;          // in E, as in II and IV
  double offset_;     // of the observer's t from the coordinate that times count from
  double phi_share_;  // 3 sqrt 3, or 0 without an edge
  WhiteHoleTable::Range range_;
  OctaveCurve curve_;
  // These are the values on the axis, and at the end of the curve next to it.
  bool axis_above_ = false, axis_below_ = false;
  double axis_time_ = 0, end_time_ = 0, end_azimuth_ = 1;
};

}  // namespace domefall
