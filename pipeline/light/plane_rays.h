// PlaneRays say where the rays of one observer meet a plane through the hole that has rings, such as
// those of a disc.
//
// A ray, followed back in time, sweeps the angle psi.  It meets the plane at psi_0, psi_0 + pi,
// psi_0 + 2 pi and so on, where it sees the direct image, the image from beneath and the photon
// rings.
#pragma once

#include "pipeline/light/direction_batch.h"
#include "pipeline/light/plane_clock.h"
#include "pipeline/spacetime/regions.h"
#include "trajectories/directions.h"

namespace domefall {

// Who is nearer to a plane than this part of r is in it, and sees it edge-on: roundings of a place do not
// choose a side.
inline constexpr double kInPlane = 1e-13;

struct PlaneRings {
  V3d normal;           // along R, Theta, Phi; unit
  double inner, outer;  // M
  bool with_times;      // whether times of emission will be asked for
};

// PlaneCrossings describe where rays meet the plane, column by column.  A column named "..._per" says
// by how much the quantity changes across a pixel.
struct PlaneCrossings {
  DirectionBatch::Column<double> energy;  // E; 0 where light does not come from region I
  DirectionBatch::Column<double> label;   // p of plane_images.h
  DirectionBatch::Column<double> label_per;
  DirectionBatch::Column<double> turn;  // psi_0, radians
  // The azimuth about R counts from where psi_0 is least.
  DirectionBatch::Column<double> azimuth_cosine, azimuth_sine;
  DirectionBatch::Column<double> azimuth_per;  // radians
  DirectionBatch::Column<double> turn_per;     // radians, at most
};

class PlaneRays {
 public:
  // `null_time` is the observer's.
  PlaneRays(const PlaneView& view, double null_time, const PlaneRings& rings);

  // Finds where count <= DirectionBatch::kSize rays meet the plane.  Each stands for a pixel that is
  // `width` radians wide in the lens's frame.
  void locate(const DirectionBatch& n, const double* width, int count,
              PlaneCrossings& crossings) const;

  const PlaneImages& images() const { return images_; }
  // The normal's part along R is given without its sign, and by its length across R.
  double up() const { return std::abs(normal_up_); }
  double across() const { return normal_across_; }

  // Returns psi_0 at an azimuth, and its inverse for azimuths from 0 to pi.
  double turn_at(double azimuth) const;
  double azimuth_at(double turn) const;
  // Returns L of a ray, and the factor from it to the part along the plane's normal with the other
  // sign (L_n of sources/disc/disc_light.h).
  double momentum(double label, double energy) const;
  double about_normal(double azimuth_sine) const { return side_ * normal_across_ * azimuth_sine; }
  // Returns the direction from the hole, along R, Theta and Phi, of the place at psi.
  V3d place(double turn, double azimuth_cosine, double azimuth_sine) const;
  const PlaneClock& clock() const { return clock_; }

 private:
  PlaneImages images_;
  bool straight_;
  double r_;
  ViewEnergy energy_;  // those that make p and E of light that is not straight
  StaticTime still_;
  double lapse_squared_;  // of the observer's place
  double label_sign_;     // the sign of p = k^r/L against its form in the rain frame
  double energy_sign_;    // the sign that the frame gives E of light from region I
  PlaneClock clock_;
  // The normal is given by its part along R, by the length of its part across R, and by the cosine
  // and the sine of the angle from Theta to that part.
  double normal_up_, normal_across_, normal_cosine_, normal_sine_;
  double side_;  // -1 where the normal points up
};

}  // namespace domefall
