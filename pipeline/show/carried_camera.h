// Cameras that keep their direction: as gyroscopes that the observer carries, or against the far stars.
// They are turned to their target where a motion begins, and hold on while it goes on, also through
// segments whose cameras name no direction of their own.
#pragma once

#include <memory>
#include <string>

#include "pipeline/show/show.h"
#include "trajectories/gyroscope.h"
#include "trajectories/observer_state.h"

namespace domefall {

// Says why no gyroscope is carried through a segment.  Empty: one is.
std::string why_no_gyroscope(const Spacetime& spacetime, const Segment& segment);

// Returns the gyroscope of a segment that has one.
std::shared_ptr<const Gyroscope> gyroscope_of(const Spacetime& spacetime, const Segment& segment);

// A CarriedTurn is the segment where a camera was turned to its target, and the rotation since then,
// along the observer's own axes.
struct CarriedTurn {
  int since = 0;
  M33d turn;
};
CarriedTurn carried_turn(const Show& show, int segment, double t, const ObserverState& observer);

}  // namespace domefall
