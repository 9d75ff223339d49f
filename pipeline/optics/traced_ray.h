// One ray by numbers, for an observer in the rain or the static frame: what `domefall trace` prints
// and what the reference rays are compared with.
#pragma once

#include <optional>

#include "pipeline/optics/null_ray.h"

namespace domefall {

enum class TraceObserver { kRain, kStatic };
enum class TraceMethod { kTable, kExact };

// delta (radians) from the direction of the hole in the observer's own frame; or, where an edge of
// that frame is given, delta = edge + offset to full accuracy.
struct RayRequest {
  TraceObserver observer = TraceObserver::kRain;
  Radius at = 0.0;  // r > 0; > 2 for the static observer
  double delta = 0;
  std::optional<Edge> edge;
  double offset = 0;
};

// For rays from the past singularity only `delta` and `origin` are set; the rest is NaN.
struct TracedRay {
  double delta;
  Origin origin;
  double phi;            // swept azimuth, radians
  double one_plus_z;     // emitted / observed frequency
  double slope;          // d phi / d delta, signed, in the observer's frame
  double amplification;  // sin(delta)/|sin(phi) slope|
};

TracedRay trace_ray(const RayRequest& q, TraceMethod method);

}  // namespace domefall
