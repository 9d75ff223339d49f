#include "pipeline/show/viewer.h"

namespace domefall {

Viewer viewer_of(const ObserverState& o, const Effects& effects) {
  Viewer viewer{o.celerity, V3d(0, 0, 0), std::nullopt};
  // On a horizon the tetrad stands in for the observer at rest.
  if (o.r != o.spacetime.horizon()) viewer.rest = resting_celerity(o.spacetime, o.r, o.tetrad);
  if (effects.aberration || o.celerity == viewer.rest) return viewer;
  viewer.celerity = viewer.rest;
  // Against the observer at rest the tetrad moves with -rest.  The observer's celerity against the
  // tetrad is composed with that.
  viewer.measured = celerity_against(-viewer.rest, o.celerity);
  return viewer;
}

}  // namespace domefall
