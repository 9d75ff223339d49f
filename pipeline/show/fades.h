// Fades from and to black.
#pragma once

namespace domefall {

// Seconds of show in which the light rises from black at a beginning, and sinks to it at an end.
struct Fades {
  double in_s = 0, out_s = 0;
};

// The part of its light, 0 to 1, that is left at t of what lasts from `begin` to `end` (seconds).
// To the eye, which sees a quarter of the light as half, it changes evenly.
double light_left(const Fades& fades, double begin, double end, double t);

}  // namespace domefall
