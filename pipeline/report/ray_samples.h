// The report measures with random rays, each of which has its truth from reference_ray().  They are
// classed by the region of the observer and by a kind of difficulty.
#pragma once

#include <span>
#include <vector>

#include "pipeline/light/traced_ray.h"
#include "pipeline/report/reference/reference_ray.h"

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

struct RayClass {
  const char* region;  // of the observer: I, II or IV
  Difficulty difficulty;
  const char* name;  // of the difficulty
  double r_least, r_most;
};
std::span<const RayClass> ray_classes();

struct SampleRay {
  RayRequest request;
  SkyRegion origin;
  double phi, slope;  // the truth, rounded to double
};

// A RayGroup holds rays of one observer at one radius, as a frame does.
using RayGroup = std::vector<SampleRay>;

// Returns the same rays whenever and wherever it is called.  ln r is distributed evenly, and so is
// delta unless Difficulty says otherwise.  Offsets from an edge lie on both sides, and their
// logarithms are distributed evenly.
std::vector<RayGroup> sample_rays(const RayClass& of, int radii, int per_radius);

}  // namespace domefall
