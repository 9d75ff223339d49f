// How far the light of a whole sky is shifted for one observer.
#pragma once

#include <optional>

#include "trajectories/observer_state.h"

namespace domefall {

// Observed over emitted frequency.
struct ShiftRange {
  double least, largest;
};

// The range of g = observed/emitted frequency, for light from infinity, over all directions in
// which an observer sees a sky.  With `far` that is the sky of the other side, which is seen only
// inside the horizon; else that of the observer's own side.
//
// A view ray along the unit vector m of the rain frame has, with c = gamma v and s = sqrt(2/r),
//     g(m) = (gamma + c.m)/(1 + s m_R):
// the Doppler factor, and the conserved energy of light in rain ([Riazuelo] eq. nprime_aber and eq.
// omprime_aber).  The extremes lie in the plane of R and c.  With m = (cos a, sin a) there, dg/da =
// 0 leads to
//     c_t cos a + (s gamma - c_R) sin a + s c_t = 0.
// Where neither solution belongs to the sky, the extremes lie at its edges.
//
// `straight` is for a show without lensing, whose observers are at r > 2.  Nothing is returned
// where the sky is not seen, as in region IV.  The result is exact to rounding, except as 1 + s m_R
// approaches 0.
std::optional<ShiftRange> frequency_range(const ObserverState& observer, bool far, bool straight);

// gamma v against the static observer of the same r > 2, or against flat space: components along R,
// Theta and Phi of the state's tetrad, R growing with r.
V3d static_celerity(const ObserverState& observer);

}  // namespace domefall
