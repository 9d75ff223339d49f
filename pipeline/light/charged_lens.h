// The optics of a charge, for an observer in the tetrad T of spacetime/charged.h or in T', in any
// region and universe.
#pragma once

#include <optional>

#include "pipeline/light/charged_azimuth.h"
#include "pipeline/light/hole_optics.h"
#include "trajectories/observer_state.h"

namespace domefall {

// Returns the sky in which an observer sees light that started there, if it is known: before the
// first universe there is none.
std::optional<SkyRegion> sky_of(ChargedOrigin origin, const ObserverState& observer);

// Makes the optics without tables.  The view has at most two zones, each of which reaches from an
// edge to the axis:
//
//     outside             the own sky, and within the silhouette that of the universe before
//     II, IV              I and III, in IV those of the universe before
//     inside r_-, naked   the own sky twice: straight from it, and by way of the core
//
// Between them is light that circled for ever, or nothing.  Inside r_x, and where light cannot
// circle, they meet where the azimuth is greatest.  On a horizon the observer's region says on which
// side its place counts.
//
// As an observer comes to an inner horizon, the whole future of a sky shrinks to a point, ever bluer.
// Its light is drawn no bluer than 1e9 times, which no frame tells from more.
HoleOptics make_charged_optics(const ChargedHole& hole, const ObserverState& observer);

}  // namespace domefall
