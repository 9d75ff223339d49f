// reference_ray() follows one light ray in 100-digit arithmetic, as the truth that the report's
// errors are measured against.  It is written plainly, so that its accuracy comes from the digits
// and not from a clever form.  It shares no code with pipeline/light, whose methods it judges.
//
// M = 1.  The ray's wave vector is k = u - N, where N is the direction of the view ray, at the
// angle delta from -R, which points to the hole from outside.  Every observer has L = r sin(delta).
// With s = sqrt(2/r),
//     rain      E = 1 - s cos(delta)            k^r = cos(delta) - s
//     static    E = sqrt(1 - 2/r)               k^r = sqrt(1 - 2/r) cos(delta)
//     outgoing  E = 1 + s cos(delta)            k^r = cos(delta) + s
//     T_II      E = -sqrt(2/r - 1) cos(delta)   k^r = -sqrt(2/r - 1)
//     T_IV      E = -sqrt(2/r - 1) cos(delta)   k^r = +sqrt(2/r - 1)
// These are [Riazuelo] eq. def_k_prec and TR_IV.  The origins and the azimuth follow app. app_geod.
// The azimuth is int dw/sqrt(1/b^2 - w^2 + 2 w^3) with w = 1/r and b = L/|E|.  The cubic's roots
// bring it to Legendre's form.
#pragma once

#include <boost/multiprecision/cpp_bin_float.hpp>
#include <optional>

namespace domefall {

using Wide = boost::multiprecision::cpp_bin_float_100;

enum class ReferenceObserver { kRain, kStatic, kOutgoing, kTwo, kFour };
enum class ReferenceEdge { kSilhouette, kRegionThree };
enum class ReferenceOrigin { kSkyOne, kSkyThree, kPastSingularity };

// delta lies in [0, pi], or is edge + offset where an edge is given.  r must be positive, above 2
// if static, and below 2 for T_II and T_IV.  r = 2 is the future horizon for rain, and the inside
// of the past horizon for outgoing.
struct ReferenceRequest {
  ReferenceObserver observer = ReferenceObserver::kRain;
  Wide r = 0, delta = 0;
  std::optional<ReferenceEdge> edge;
  Wide offset = 0;
};

struct ReferenceRay {
  Wide delta;
  ReferenceOrigin origin;
  Wide phi;            // swept azimuth, radians; 0 for a radial ray
  Wide one_plus_z;     // |E|: emitted / observed frequency; no meaning for kPastSingularity
  Wide slope;          // d phi/d delta, signed, by a central difference of step 1e-40
  Wide amplification;  // sin(delta)/|sin(phi) slope|; 1/slope^2 where phi = 0 on a sky
};

// Follows the ray.  Throws std::domain_error for an r or an edge that the observer does not have.
// A ray exactly on an edge has no azimuth, and its result must not be relied on.  Measured: phi is
// within 1e-15 of every row of tests/reference/rays.csv, and within 1e-18 of a quadrature beside
// the edge at r = 3.  A ray takes 1.5 ms.
ReferenceRay reference_ray(const ReferenceRequest& q);

// Returns E, L and k^r as above, at the request's delta, or edge and offset.
struct ReferenceInvariants {
  Wide energy, angular_momentum, radial;
};
ReferenceInvariants reference_invariants(const ReferenceRequest& q);

// Returns the edge as an angle delta.  For rain it is [Riazuelo] eq. tan_delta_final, and for
// outgoing that formula with the other root.  For static and at rest in t, it is where
// L/|E| = sqrt(27).
Wide reference_edge(ReferenceObserver observer, const Wide& r, ReferenceEdge edge);

}  // namespace domefall
