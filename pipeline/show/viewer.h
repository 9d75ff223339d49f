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
  // Of the observer whose directions are drawn, and of the one at rest.
  Celerity<ReferenceTetrad> celerity{}, rest{};
  // Of the observer that measures frequencies, if directions are drawn for the one at rest and the
  // two are not the same.
  std::optional<Celerity<RestFrame>> measured{};
};

// Returns the two observers for a state under the effects that a show keeps.
Viewer viewer_of(const ObserverState& observer, const Effects& effects);

}  // namespace domefall
