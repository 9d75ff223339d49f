#include "pipeline/report/ray_samples.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <random>
#include <string_view>

namespace domefall {
namespace {

// These are the observers of trace_ray() by the region that they stand in.  One of them may stand
// in two regions, as rain does.
struct SampleObserver {
  const char* region;
  TraceObserver observer;
};
constexpr std::array kSampleObservers{
    SampleObserver{"I", TraceObserver::kRain},     SampleObserver{"I", TraceObserver::kStatic},
    SampleObserver{"I", TraceObserver::kOutgoing}, SampleObserver{"II", TraceObserver::kRain},
    SampleObserver{"II", TraceObserver::kTwo},     SampleObserver{"IV", TraceObserver::kOutgoing},
    SampleObserver{"IV", TraceObserver::kFour},
};

// The ranges keep 0.05 M off the horizon, which extreme_rays.cpp tries on its own.  Region IV sees
// no sky, so it has no edge between skies.
constexpr std::array kClasses{
    RayClass{"I", Difficulty::kOrdinary, "ordinary", 2.05, 100},
    RayClass{"I", Difficulty::kEdge, "edge", 2.05, 100},
    RayClass{"I", Difficulty::kFar, "far", 1e3, 1e8},
    RayClass{"II", Difficulty::kOrdinary, "ordinary", 0.1, 1.95},
    RayClass{"II", Difficulty::kEdge, "edge", 0.1, 1.95},
    RayClass{"II", Difficulty::kDeep, "deep", 1e-6, 0.1},
    RayClass{"IV", Difficulty::kOrdinary, "ordinary", 0.1, 1.95},
    RayClass{"IV", Difficulty::kDeep, "deep", 1e-6, 0.1},
};

std::vector<TraceObserver> observers_in(std::string_view region) {
  std::vector<TraceObserver> found;
  for (const SampleObserver& o : kSampleObservers)
    if (o.region == region) found.push_back(o.observer);
  return found;
}

// Dice makes evenly distributed numbers from the generator's bits itself, because the distributions
// of the standard library differ from library to library.
class Dice {
 public:
  explicit Dice(std::uint64_t seed) : bits_(seed) {}
  double even(double least, double most) {
    // The upper 53 bits choose one of 2^53 equal steps, and the number lies in its middle.
    constexpr double kStep = 0x1p-53;
    return least + (most - least) * (static_cast<double>(bits_() >> 11) + 0.5) * kStep;
  }
  double even_log(double least, double most) {
    return std::exp(even(std::log(least), std::log(most)));
  }
  bool heads() { return even(0, 1) < 0.5; }

 private:
  std::mt19937_64 bits_;
};

// The least offset is still resolved when a double adds it to an angle.  The largest is smaller
// than the distance of every edge from the axis.
constexpr double kLeastOffset = 1e-12, kMostOffset = 1e-3;
constexpr double kFarReach = 1000;  // in radii of the silhouette

// Returns a random ray of an observer at r.  Far away the silhouette has a radius of 3 sqrt(3)/r,
// 5e-3 to 5e-8 radians, which an angle that is even over the view would hardly ever come near.  So
// half of the far rays are thrown at multiples of that radius.
RayRequest throw_ray(TraceObserver observer, Difficulty difficulty, double r, Dice& dice) {
  RayRequest q;
  q.observer = observer;
  q.at = Radius(r);
  if (difficulty == Difficulty::kEdge) {
    const bool third = q.at.above_horizon < 0 && dice.heads();
    q.edge = third ? Edge::kRegionThree : Edge::kSilhouette;
    q.offset = dice.even_log(kLeastOffset, kMostOffset) * (dice.heads() ? 1 : -1);
  } else if (difficulty == Difficulty::kFar && dice.heads()) {
    q.delta =
        std::min(edge_delta(observer, q.at, Edge::kSilhouette) * dice.even_log(1.0 / 2, kFarReach),
                 std::numbers::pi);
  } else {
    q.delta = static_cast<double>(dice.even(0, std::numbers::pi));
  }
  return q;
}

// Returns a ray with its truth.  It is computed for the very doubles of the request, so that their
// rounding is no error of a method.
SampleRay with_truth(const RayRequest& q) {
  const ReferenceRay ray = reference_ray(reference_request(q));
  return {q, origin_from(ray.origin), static_cast<double>(ray.phi), static_cast<double>(ray.slope)};
}

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

std::span<const RayClass> ray_classes() { return kClasses; }

std::vector<RayGroup> sample_rays(const RayClass& of, int radii, int per_radius) {
  const std::vector<TraceObserver> observers = observers_in(of.region);
  constexpr std::uint64_t kSeed = 1511'06025;  // arXiv:1511.06025 is the paper
  // Each kind of difficulty has numbers of its own.
  Dice dice(kSeed + static_cast<std::uint64_t>(of.difficulty));
  std::vector<RayGroup> groups(static_cast<std::size_t>(radii));
  for (std::size_t g = 0; g < groups.size(); ++g) {
    const TraceObserver observer = observers[g % observers.size()];
    const double r = dice.even_log(of.r_least, of.r_most);
    for (int k = 0; k < per_radius; ++k)
      groups[g].push_back(with_truth(throw_ray(observer, of.difficulty, r, dice)));
  }
  return groups;
}

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
