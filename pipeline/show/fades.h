// A show, a segment or a title can fade from and to black.
#pragma once

namespace domefall {

// The light rises from black in the first `in_s` seconds of show, and sinks to it in the last
// `out_s`.
struct Fades {
  double in_s = 0, out_s = 0;
};

// Returns the part of its light, 0 to 1, that something which lasts from `begin` to `end` (seconds)
// has left at t.  The light changes evenly to the eye, which sees a quarter of it as half.
double light_left(const Fades& fades, double begin, double end, double t);

}  // namespace domefall
