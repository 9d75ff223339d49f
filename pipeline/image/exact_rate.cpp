#include "pipeline/image/exact_rate.h"

#include <OpenEXR/ImfFramesPerSecond.h>

namespace domefall {

ExactRate exact_rate(double frames_per_second) {
  const Imf::Rational rate = Imf::guessExactFps(frames_per_second);
  return {rate.n, rate.d};
}

}  // namespace domefall
