// A Gyroscope is carried by an observer near a hole, and keeps its direction: it is transported
// parallel to itself in free fall, and after Fermi and Walker with engines.
//
// Along the axes of the reference tetrad (kerr_motion.h) u = gamma T + c, and the axes themselves
// change by T' = alpha, e_j' = alpha_j T + rho x e_j.  Those of the observer, boosted by c, turn against
// gyroscopes by
//
//     Omega = rho + c x (alpha + A)/(1 + gamma),     A = c' + gamma alpha + rho x c
//
// where A is the acceleration that is felt, 0 in free fall.
#pragma once

#include <functional>
#include <vector>

#include "trajectories/orbit_point.h"

namespace domefall {

class Gyroscope {
 public:
  // A hole without spin has its orbits in the plane theta = pi/2, and one without charge, too, the tetrad
  // of rain.
  struct Hole {
    double spin = 0, charge = 0;
    bool has_rain = false;
  };
  using Way = std::function<OrbitPoint(const ProperTime&)>;

  // Follows a way, in the rain tetrad, from one proper time to another.  Throws std::domain_error if it
  // turns too often.
  static Gyroscope along(const Hole& hole, const Way& way, bool free_fall, const ProperTime& begin,
                         const ProperTime& end);
  // Takes a point that stays but for an even dphi/dtau.
  static Gyroscope held(const Hole& hole, const OrbitPoint& point, double azimuth_rate,
                        const ProperTime& begin);

  // Returns the rotation by which it has turned since the beginning, along the observer's own axes: the
  // boosted R, Theta and Phi.
  M33d turn(const ProperTime& tau) const;

 private:
  struct Node {
    ProperTime tau;
    M33d turn;  // along axes that point to the stars
  };
  explicit Gyroscope(const Hole& hole) : hole_(hole) {}
  V3d rate(const ProperTime& tau, double step) const;
  M33d after(const Node& from, double step) const;
  void follow(const ProperTime& end);

  Hole hole_;
  Way way_;
  bool free_fall_ = true;
  std::vector<Node> nodes_;
  V3d even_rate_{0, 0, 0};  // without a way
};

}  // namespace domefall
