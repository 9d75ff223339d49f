#include "pipeline/show/viewer.h"

namespace domefall {

Viewer viewer_of(const ObserverState& o, const Effects& effects) {
  Viewer viewer{.celerity = o.celerity};
  // On a horizon the tetrad stands in for the observer at rest.
  if (o.spacetime.lapse_squared(o.r) != 0) viewer.rest = resting_celerity(o);
  if (effects.aberration || o.celerity == viewer.rest) return viewer;
  viewer.celerity = viewer.rest;
  // Against the observer at rest the tetrad moves with -rest.
  viewer.measured = celerity_against(Celerity<RestFrame>(-viewer.rest), o.celerity);
  return viewer;
}

}  // namespace domefall
