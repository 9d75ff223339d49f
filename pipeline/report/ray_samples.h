// The rays that the report measures with: reproducible random ones of one region of the observer
// and one kind of difficulty, each with its truth from reference_ray.
#pragma once

#include <span>
#include <vector>

#include "pipeline/optics/traced_ray.h"

namespace domefall {

enum class Difficulty {
  kOrdinary,  // any angle; r from 0.1 to 100, not within 0.05 of the horizon
  kEdge,      // 1e-12 to 1e-3 radians beside an edge
  kDeep,      // r from 1e-6 to 0.1
  kFar,       // r from 1e3 to 1e8, half of the rays within a thousand edges' radii of the hole
};

struct RayClass {
  const char* region;  // of the observer: I, II, IV
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

// Rays of one observer at one radius, as a frame has them.
using RayGroup = std::vector<SampleRay>;

// The same rays whenever and wherever it is called.  r is spaced evenly in its logarithm, delta
// evenly but for what Difficulty says; offsets evenly in their logarithm, on both sides.
std::vector<RayGroup> sample_rays(const RayClass& of, int radii, int per_radius);

}  // namespace domefall
