// Finds how far the light of a whole sky is shifted for one observer.
#pragma once

#include <optional>

#include "pipeline/spacetime/regions.h"
#include "trajectories/observer_state.h"

namespace domefall {

// The bounds of a ShiftRange are frequency ratios, observed over emitted.
struct ShiftRange {
  double least, largest;
};

// Returns the range of g = observed/emitted frequency, for light from infinity, over all directions
// in which an observer sees the sky of region I or III.
//
// A view ray along the unit vector m of the rain frame has, with c = gamma v and s = sqrt(2/r),
//     g(m) = (gamma + c.m)/(1 + s m_R).
// The numerator is the Doppler factor ([Riazuelo] eq. nprime_aber and eq. omprime_aber).  The
// denominator is the conserved energy of light in the rain frame (null_ray.h).  At a given m_R the
// product c.m is extreme in the plane of R and c, so the extremes of g lie in this plane.  There m
// is (cos a, sin a) and c is (c_R, c_t), and dg/da = 0 leads to
//     c_t cos a + (s gamma - c_R) sin a + s c_t = 0.
// Where neither solution belongs to the sky, the extremes lie at its edges.
//
// `straight` is for a show without lensing, whose observers are at r > 2.  Nothing is returned
// where the sky is not seen, as in region IV.  The result is exact to rounding, except as 1 + s m_R
// approaches 0.
std::optional<ShiftRange> frequency_range(const ObserverState& observer, SkyRegion sky,
                                          bool straight);

}  // namespace domefall
