#include "pipeline/show/fades.h"

#include "pipeline/show/curve.h"

namespace domefall {

double light_left(const Fades& fades, double begin, double end, double t) {
  // The rate of a smooth step is 0 at both ends, so that neither end of a fade is seen as a kink.
  const auto part = [](double passed, double fade) {
    return fade > 0 ? smooth_step(passed / fade) : 1;
  };
  const double left = part(t - begin, fades.in_s) * part(end - t, fades.out_s);
  // `left` is the brightness that the eye sees, which goes as the square root of the light.
  return left * left;
}

}  // namespace domefall
