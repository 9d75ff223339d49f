// Which observers a frame that leaves some effects out is drawn for.
//
// Directions without aberration are those of the observer at rest at the same place: in r outside a
// horizon and in flat space, in t inside (T_II and T_IV of [Riazuelo] eq. TR_IV); at r = 2, where there
// is neither, those of the reference tetrad.  Frequencies stay those that the moving observer
// measures in the same light: a place on the sky has the colour and intensity that it has with
// aberration, and only stands elsewhere.
#pragma once

#include <optional>

#include "pipeline/show/show.h"
#include "trajectories/observer_state.h"

namespace domefall {

struct Vantage {
  // gamma v of the observer whose directions are drawn, and of the one at rest, against the
  // reference tetrad.
  V3d celerity, rest;
  // gamma v of the observer that measures frequencies against the one whose directions are drawn, along
  // the axes of the latter (those of the tetrad, boosted); nothing if they are the same.
  std::optional<V3d> measured;
};

Vantage vantage_of(const ObserverState& observer, const Effects& effects);

// Frequency of light from infinity for the observer at rest, over that at infinity:
// 1/(1 + z_grav) = 1/sqrt(1 - 2/r), [Riazuelo] eq. zgrav.  r > 2 or kFlatSpace.
double gravitational_ratio(double r);

}  // namespace domefall
