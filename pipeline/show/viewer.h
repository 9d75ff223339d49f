// A Viewer holds the observers for whom a frame is drawn that leaves some effects out.
//
// Without aberration, directions are those of the observer at rest at the same place.  Outside a
// horizon and in flat space that observer rests in r, and inside in t (T_II and T_IV of [Riazuelo]
// eq. TR_IV).  On the horizon neither exists, and the reference tetrad stands in.  Frequencies stay those
// that the moving observer measures in the same light, so that a place on the sky keeps its colour
// and intensity and only stands elsewhere.
#pragma once

#include <optional>

#include "pipeline/show/show.h"
#include "trajectories/observer_state.h"

namespace domefall {

struct Viewer {
  // `celerity` is gamma v of the observer whose directions are drawn, and `rest` that of the
  // observer at rest, both against the reference tetrad.
  V3d celerity, rest;
  // `measured` is gamma v of the observer that measures frequencies, against the one whose
  // directions are drawn and along the axes of the latter (those of the tetrad, boosted).  There is
  // none if they are the same.
  std::optional<V3d> measured;
};

// Returns the two observers for a state under the effects that a show keeps.
Viewer viewer_of(const ObserverState& observer, const Effects& effects);

}  // namespace domefall
