#include "pipeline/show/vantage.h"

#include <cmath>

namespace domefall {

Vantage vantage_of(const ObserverState& o, const Effects& effects) {
  Vantage vantage{o.celerity, V3d(0, 0, 0), std::nullopt};
  if (!is_flat(o) && o.r != 2) vantage.rest = resting_celerity(o.r, o.tetrad);
  if (effects.aberration || o.celerity == vantage.rest) return vantage;
  vantage.celerity = vantage.rest;
  vantage.measured = celerity_against(-vantage.rest, o.celerity);
  return vantage;
}

double gravitational_ratio(double r) { return r == kFlatSpace ? 1 : std::sqrt(r / (r - 2)); }

}  // namespace domefall
