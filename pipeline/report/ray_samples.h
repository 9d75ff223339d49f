// The report measures with random rays, each of which has its truth from reference_ray() or, near a
// charge and in a wormhole, from reference_swept.h, and about a spin from reference_spin.h.  They are
// classed by where the observer is and by a kind of difficulty.
#pragma once

#include <span>
#include <variant>
#include <vector>

#include "pipeline/light/traced_charge.h"
#include "pipeline/light/traced_ray.h"
#include "pipeline/light/traced_wormhole.h"
#include "pipeline/report/reference/reference_ray.h"
#include "pipeline/report/reference/reference_spin.h"
#include "pipeline/report/reference/reference_swept.h"
#include "pipeline/report/stepped_light.h"

namespace domefall {

// Returns a request for the same ray, whose numbers have the exact values of the doubles.  Where
// the distance from the horizon or from the light circle gives r more finely, r is taken from that.
ReferenceRequest reference_request(const RayRequest& q);

SkyRegion origin_from(ReferenceOrigin origin);

enum class Difficulty {
  kOrdinary,  // any angle; r from 0.1 to 100 M, but not within 0.05 M of the horizon
  kEdge,      // 1e-12 to 1e-3 radians beside an edge between skies
  kDeep,      // r from 1e-6 to 0.1 M
  kFar,       // r from 1e3 to 1e8 M; half of the rays within a thousand radii of the silhouette
};

// What the rays go around.
enum class RayKind { kHole, kCharge, kWormhole, kSpin };

struct RayClass {
  RayKind kind;
  // Of the observer: I, II, IV, charge_I, charge_II, spin_I, spin_II; or a profile: ellis, dngr.
  const char* region;
  Difficulty difficulty;
  const char* name;  // of the difficulty
  // Of r or, in a wormhole, of l.  Near a charge and about a spin it is the distance from the outer
  // horizon over its r, or between the horizons the part of the way from the inner one.
  double r_least, r_most;
};
std::span<const RayClass> ray_classes();
// Returns "region II near a charge" and the like.
std::string place_of(const RayClass& of);

using AnyRay = std::variant<RayRequest, ChargedRequest, WormholeRequest, SpinRequest>;

// Returns the truth of a ray near a charge or in a wormhole, for the very numbers of the request.
SweptAzimuth swept_truth(const AnyRay& ray);
SpinTruth spin_truth(const SpinRequest& ray);

struct SampleRay {
  AnyRay request;
  SkyRegion origin;
  double phi, slope;  // the truth, rounded to double
  // About a spin: the place on the sky, and as slope the most that it moves by an angle of view.
  V3d place{0, 0, 0};
};

// A RayGroup holds rays of one observer at one radius, as a frame does.
using RayGroup = std::vector<SampleRay>;

// Returns the same rays whenever and wherever it is called.  ln r is distributed evenly, and so is
// delta unless Difficulty says otherwise.  Offsets from an edge lie on both sides, and their
// logarithms are distributed evenly.  Near a charge, of which ln(1 - q) is distributed evenly from 1e-12
// on, only rays from a sky count.  The widths and lengths of throats lie between 1e-2 and 1e2 radii.  Of
// spins ln(1 - a) is distributed evenly from 1e-6 on, every other hole is charged, and observers and
// eta are anywhere about it.
std::vector<RayGroup> sample_rays(const RayClass& of, int radii, int per_radius);

}  // namespace domefall
