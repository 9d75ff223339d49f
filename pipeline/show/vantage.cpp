#include "pipeline/show/vantage.h"

#include <cmath>

namespace domefall {

Vantage vantage_of(const ObserverState& o, const Effects& effects) {
  Vantage vantage{o.celerity, V3d(0, 0, 0), std::nullopt};
  // In flat space the tetrad itself rests, and at r = 2 it stands in for the observer at rest.
  if (!is_flat(o) && o.r != 2) vantage.rest = resting_celerity(o.r, o.tetrad);
  if (effects.aberration || o.celerity == vantage.rest) return vantage;
  vantage.celerity = vantage.rest;
  // Against the observer at rest the tetrad moves with -rest.  The observer's celerity against the
  // tetrad is composed with that.
  vantage.measured = celerity_against(-vantage.rest, o.celerity);
  return vantage;
}

// 1/sqrt(1 - 2/r) is written with r - 2, which is exact from r = 1 to 4, while 1 - 2/r cancels next
// to the horizon.
double gravitational_ratio(double r) { return r == kFlatSpace ? 1 : std::sqrt(r / (r - 2)); }

}  // namespace domefall
