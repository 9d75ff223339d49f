#include "pipeline/report/reference_request.h"

#include <cmath>

namespace domefall {
namespace {

// Next to 2 and 3 the distance has the digits that r itself has lost.  A double near 2 is spaced by
// 4e-16, while the distance keeps 16 digits of its own, and cases of the report go down to 1e-15.
Wide exact_radius(const Radius& at) {
  if (std::abs(at.above_horizon) < 0.1) return 2 + Wide(at.above_horizon);
  if (std::abs(at.above_light_circle) < 0.1) return 3 + Wide(at.above_light_circle);
  return at.r;
}

ReferenceObserver observer_from(TraceObserver observer) {
  switch (observer) {
    case TraceObserver::kStatic:
      return ReferenceObserver::kStatic;
    case TraceObserver::kOutgoing:
      return ReferenceObserver::kOutgoing;
    case TraceObserver::kTwo:
      return ReferenceObserver::kTwo;
    case TraceObserver::kFour:
      return ReferenceObserver::kFour;
    case TraceObserver::kRain:
      break;
  }
  return ReferenceObserver::kRain;
}

}  // namespace

ReferenceRequest reference_request(const RayRequest& q) {
  ReferenceRequest exact{observer_from(q.observer), exact_radius(q.at), Wide(q.delta), std::nullopt,
                         q.offset};
  if (q.edge)
    exact.edge =
        *q.edge == Edge::kSilhouette ? ReferenceEdge::kSilhouette : ReferenceEdge::kRegionThree;
  return exact;
}

SkyRegion origin_from(ReferenceOrigin origin) {
  switch (origin) {
    case ReferenceOrigin::kSkyOne:
      return SkyRegion::kI;
    case ReferenceOrigin::kSkyThree:
      return SkyRegion::kIII;
    case ReferenceOrigin::kPastSingularity:
      break;
  }
  return SkyRegion::kIV;
}

}  // namespace domefall
