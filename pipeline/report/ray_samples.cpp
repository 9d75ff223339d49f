#include "pipeline/report/ray_samples.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <random>
#include <string_view>

#include "pipeline/light/kerr_ray.h"

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
    RayClass{RayKind::kHole, "I", Difficulty::kOrdinary, "ordinary", 2.05, 100},
    RayClass{RayKind::kHole, "I", Difficulty::kEdge, "edge", 2.05, 100},
    RayClass{RayKind::kHole, "I", Difficulty::kFar, "far", 1e3, 1e8},
    RayClass{RayKind::kHole, "II", Difficulty::kOrdinary, "ordinary", 0.1, 1.95},
    RayClass{RayKind::kHole, "II", Difficulty::kEdge, "edge", 0.1, 1.95},
    RayClass{RayKind::kHole, "II", Difficulty::kDeep, "deep", 1e-6, 0.1},
    RayClass{RayKind::kHole, "IV", Difficulty::kOrdinary, "ordinary", 0.1, 1.95},
    RayClass{RayKind::kHole, "IV", Difficulty::kDeep, "deep", 1e-6, 0.1},
    RayClass{RayKind::kCharge, "charge_I", Difficulty::kOrdinary, "ordinary", 0.025, 50},
    RayClass{RayKind::kCharge, "charge_I", Difficulty::kEdge, "edge", 0.025, 50},
    RayClass{RayKind::kCharge, "charge_II", Difficulty::kOrdinary, "ordinary", 0.02, 0.98},
    RayClass{RayKind::kCharge, "charge_II", Difficulty::kEdge, "edge", 0.02, 0.98},
    RayClass{RayKind::kWormhole, "ellis", Difficulty::kOrdinary, "ordinary", 1e-3, 1e3},
    RayClass{RayKind::kWormhole, "ellis", Difficulty::kEdge, "edge", 1e-3, 1e3},
    RayClass{RayKind::kWormhole, "dngr", Difficulty::kOrdinary, "ordinary", 1e-3, 1e3},
    RayClass{RayKind::kWormhole, "dngr", Difficulty::kEdge, "edge", 1e-3, 1e3},
    RayClass{RayKind::kSpin, "spin_I", Difficulty::kOrdinary, "ordinary", 0.025, 50},
    RayClass{RayKind::kSpin, "spin_I", Difficulty::kEdge, "edge", 0.025, 50},
    RayClass{RayKind::kSpin, "spin_II", Difficulty::kOrdinary, "ordinary", 0.02, 0.98},
    RayClass{RayKind::kSpin, "spin_II", Difficulty::kEdge, "edge", 0.02, 0.98},
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

WormholeShape shape_of(const Wormhole& wormhole) {
  WormholeShape shape{wormhole.half_length()};
  if (wormhole.profile == Wormhole::Profile::kDngr) shape.mass = wormhole.lensing_mass();
  return shape;
}

// Next to a horizon the distance has the digits that r has lost.
Real50 exact_radius(const ChargedRequest& ray) {
  if (ray.hole.is_naked()) return ray.at.r;
  const Real50 q = ray.hole.charge_long(), apart = sqrt(Real50((1 - q) * (1 + q)));
  if (std::abs(ray.at.above_outer) < 0.1) return 1 + apart + ray.at.above_outer;
  if (std::abs(ray.at.above_inner) < 0.1) return 1 - apart + ray.at.above_inner;
  return ray.at.r;
}

Real50 exact_delta(const AnyRay& ray) {
  if (const auto* within = std::get_if<WormholeRequest>(&ray))
    return throat_angle(shape_of(within->wormhole), abs(Real50(within->l))) + within->offset;
  const auto& charged = std::get<ChargedRequest>(ray);
  if (!charged.edge) return charged.delta;
  const ChargedEdges edges = charged_edges(charged.hole.charge_long(), exact_radius(charged));
  return 2 * atan(abs(charged.edge == Critical::kFirst ? edges.first : edges.second)) +
         charged.offset;
}

SweptAzimuth swept_at(const AnyRay& ray, const Real50& delta) {
  if (const auto* within = std::get_if<WormholeRequest>(&ray))
    return reference_wormhole_ray(shape_of(within->wormhole), abs(Real50(within->l)), delta);
  const auto& charged = std::get<ChargedRequest>(ray);
  return reference_charged_ray(charged.hole.charge_long(), exact_radius(charged), delta);
}

// Returns a ray with its truth, and the slope by a difference.  `off` is how far it is from an edge.
SampleRay with_swept_truth(const AnyRay& ray, double off) {
  const Real50 delta = exact_delta(ray), h = 1e-10 * std::abs(off);
  const SweptAzimuth truth = swept_at(ray, delta);
  return {ray, truth.sky == ReferenceSky::kOwn ? SkyRegion::kI : SkyRegion::kIII,
          static_cast<double>(truth.azimuth),
          static_cast<double>((swept_at(ray, delta + h).azimuth - truth.azimuth) / h)};
}

// Returns how far a ray is from the edge of a sky, whose other end is at `most`.
double random_offset(const RayClass& of, double most, Dice& dice) {
  return of.difficulty == Difficulty::kEdge
             ? dice.even_log(kLeastOffset, std::min(kMostOffset, most / 2))
             : dice.even(0, most);
}

// Returns a random ray from one of the skies of an observer near a charge.
SampleRay throw_charged_ray(const RayClass& of, const ChargedHole& hole, double r, Dice& dice) {
  const bool third = of.region == std::string_view("charge_II") && dice.heads();
  ChargedRequest request{hole, hole.at(r), 0, third ? Critical::kSecond : Critical::kFirst, 0};
  const auto edge = static_cast<double>(exact_delta(request));
  const double off = random_offset(of, third ? edge : std::numbers::pi - edge, dice);
  request.offset = third ? -off : off;
  request.delta = edge + request.offset;
  if (of.difficulty == Difficulty::kOrdinary) request.edge.reset();
  return with_swept_truth(request, off);
}

SampleRay throw_wormhole_ray(const RayClass& of, const Wormhole& wormhole, double l, Dice& dice) {
  WormholeRequest request{wormhole, l, 0, 0};
  const auto edge = static_cast<double>(exact_delta(request));
  request.offset = of.difficulty == Difficulty::kEdge
                       ? dice.even_log(kLeastOffset, kMostOffset) * (dice.heads() ? 1 : -edge)
                       : dice.even(-edge, std::numbers::pi - edge);
  request.delta = edge + request.offset;
  return with_swept_truth(request, request.offset);
}

SpinView spin_view(const SpinRequest& ray) {
  const KerrHole& hole = ray.at.hole;
  SpinView view{Real50(hole.spin) + hole.spin_rest,
                hole.charge,
                ray.at.r,
                ray.at.theta,
                ray.direction.delta,
                ray.direction.eta};
  if (ray.direction.edge) {
    const CriticalRay near = critical_ray(ray.at, ray.direction.eta, *ray.direction.edge);
    view.delta = near.delta;
    view.delta = spin_edge(view, near.x) + ray.direction.offset;
  }
  return view;
}

V3d rounded(const std::array<Real50, 3>& v) {
  return {static_cast<double>(v[0]), static_cast<double>(v[1]), static_cast<double>(v[2])};
}

// The slope, by which errors are only scaled, is that of the exact ray.
SampleRay with_spin_truth(const SpinRequest& ray) {
  const SpinTruth truth = reference_spin_ray(spin_view(ray));
  const TracedKerr traced = trace_kerr(ray.at, ray.direction);
  const V3d &u = traced.by_delta, &v = traced.across;
  const double sum = u.dot(u) + v.dot(v), apart = u.dot(u) - v.dot(v);
  const double most = std::sqrt((sum + std::hypot(apart, 2 * u.dot(v))) / 2);
  return {ray, truth.sky == ReferenceSky::kOwn ? SkyRegion::kI : SkyRegion::kIII, 0, most,
          rounded(truth.place)};
}

// Returns a random ray from one of the skies of an observer about a spin.
SampleRay throw_spin_ray(const RayClass& of, const KerrPlace& at, Dice& dice) {
  const bool third = at.delta() < 0 && dice.heads();
  SpinRequest ray{at, {}};
  KerrDirection& to = ray.direction;
  to.edge = third ? KerrEdge::kRegionThree : KerrEdge::kSilhouette;
  to.eta = dice.even(0, 2 * std::numbers::pi);
  const auto edge = static_cast<double>(critical_ray(at, to.eta, *to.edge).delta);
  const double off = random_offset(of, third ? edge : std::numbers::pi - edge, dice);
  to.offset = third ? -off : off;
  to.delta = edge + to.offset;
  return with_spin_truth(ray);
}

KerrPlace random_place(const RayClass& of, std::size_t group, Dice& dice) {
  const double spin = 1 - dice.even_log(1e-6, 0.95), most = std::sqrt((1 - spin) * (1 + spin));
  const double charge = most * dice.even(0, 0.9);
  const KerrHole hole{spin, group % 2 == 0 ? 0 : charge};
  const auto out = static_cast<double>(hole.horizon());
  const auto in = static_cast<double>(hole.inner_horizon());
  const double r = of.region == std::string_view("spin_I")
                       ? out * (1 + dice.even_log(of.r_least, of.r_most))
                       : in + (out - in) * dice.even(of.r_least, of.r_most);
  return {hole, r, std::acos(dice.even(-1, 1))};
}

RayGroup throw_group(const RayClass& of, std::size_t group, int rays, Dice& dice) {
  RayGroup thrown;
  const auto repeat = [&](const auto& ray) {
    for (int k = 0; k < rays; ++k) thrown.push_back(ray());
    return thrown;
  };
  if (of.kind == RayKind::kSpin) {
    const KerrPlace at = random_place(of, group, dice);
    return repeat([&] { return throw_spin_ray(of, at, dice); });
  }
  if (of.kind == RayKind::kCharge) {
    const ChargedHole hole(1, 1 - dice.even_log(1e-12, 0.9));
    const double out = hole.horizon(), in = hole.inner_horizon();
    const double r = of.region == std::string_view("charge_I")
                         ? out * (1 + dice.even_log(of.r_least, of.r_most))
                         : in + (out - in) * dice.even(of.r_least, of.r_most);
    return repeat([&] { return throw_charged_ray(of, hole, r, dice); });
  }
  const double r = dice.even_log(of.r_least, of.r_most);
  if (of.kind == RayKind::kHole) {
    const std::vector<TraceObserver> observers = observers_in(of.region);
    const TraceObserver observer = observers[group % observers.size()];
    return repeat([&] { return with_truth(throw_ray(observer, of.difficulty, r, dice)); });
  }
  Wormhole wormhole;
  if (of.region == std::string_view("dngr"))
    wormhole = {.profile = Wormhole::Profile::kDngr,
                .length = dice.even_log(1e-2, 1e2),
                .lensing_width = dice.even_log(1e-2, 1e2)};
  return repeat([&] { return throw_wormhole_ray(of, wormhole, r, dice); });
}

}  // namespace

std::span<const RayClass> ray_classes() { return kClasses; }

std::string place_of(const RayClass& of) {
  const std::string region = of.region;
  const auto near = [&](const char* what) {
    return "region " + region.substr(region.find('_') + 1) + what;
  };
  if (of.kind == RayKind::kCharge) return near(" near a charge");
  if (of.kind == RayKind::kSpin) return near(" about a spin");
  return (of.kind == RayKind::kHole ? "region " : "a wormhole of the profile ") + region;
}

std::vector<RayGroup> sample_rays(const RayClass& of, int radii, int per_radius) {
  constexpr std::uint64_t kSeed = 1511'06025;  // arXiv:1511.06025 is the paper
  // Each kind of difficulty has numbers of its own.
  Dice dice(kSeed + static_cast<std::uint64_t>(of.difficulty));
  std::vector<RayGroup> groups;
  groups.reserve(static_cast<std::size_t>(radii));
  for (int g = 0; g < radii; ++g)
    groups.push_back(throw_group(of, static_cast<std::size_t>(g), per_radius, dice));
  return groups;
}

SpinTruth spin_truth(const SpinRequest& ray) { return reference_spin_ray(spin_view(ray)); }

SweptAzimuth swept_truth(const AnyRay& ray) { return swept_at(ray, exact_delta(ray)); }

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
