#include "pipeline/report/position_errors.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>

#include "pipeline/base/stop_watch.h"
#include "pipeline/light/ray_times.h"
#include "pipeline/report/ray_samples.h"
#include "pipeline/report/reference/reference_position.h"

namespace domefall {
namespace {

// A SamplePlace is a place to be found on the ray of a request, with the truth.
struct SamplePlace {
  RayRequest request;
  double psi;
  ReferenceRayPlace place;
};

// Returns places on the rays of all classes of a hole beside an edge, or on those of its others.  At
// the ends of a path r is infinite or 0 and has no relative error, so a place keeps a fiftieth of
// the azimuth from both.
std::vector<SamplePlace> sample_places(bool quick, bool at_edge) {
  const int radii = quick ? 3 : 12, per_radius = quick ? 4 : 16;
  constexpr double kFirst = 0.02, kRange = 0.96, kGolden = 0.6180339887498949;
  // Multiples of the golden ratio, modulo 1, fill the range evenly, however many they are.
  std::vector<SamplePlace> places;
  double part = 0;
  for (const RayClass& of : ray_classes()) {
    if (of.kind != RayKind::kHole || (of.difficulty == Difficulty::kEdge) != at_edge) continue;
    for (const RayGroup& group : sample_rays(of, radii, per_radius))
      for (const SampleRay& ray : group) {
        part = std::fmod(part + kGolden, 1.0);
        const double psi = ray.phi * (kFirst + kRange * part);
        const auto& request = std::get<RayRequest>(ray.request);
        places.push_back({request, psi, reference_position(reference_request(request), psi)});
      }
  }
  return places;
}

// Returns the largest error, and the least one that 99 of 100 do not exceed.
PositionErrorRow::Errors summary(std::vector<double> errors) {
  if (errors.empty()) return {0, 0};
  std::sort(errors.begin(), errors.end());
  const auto count = static_cast<double>(errors.size());
  return {errors.back(), errors[static_cast<std::size_t>(std::ceil(0.99 * count)) - 1]};
}

// Returns the row of one method.  All places are found in one go by the wall clock, one ray at a
// time, so the time is that of a single ray and not of a batch.
PositionErrorRow measured_errors(bool at_edge, const std::vector<SamplePlace>& places,
                                 const NamedTraceMethod& by, double tolerance) {
  TraceOptions options;
  if (tolerance > 0) options.tolerance = tolerance;
  std::vector<std::optional<TracedPlace>> found;
  found.reserve(places.size());
  const StopWatch watch;
  for (const SamplePlace& place : places)
    found.push_back(trace_place(place.request, place.psi, by.method, options));
  const double seconds = watch.seconds();
  std::vector<double> of_r, of_time;
  for (std::size_t k = 0; k < places.size(); ++k) {
    // A place that is not found has no error and is counted as missing.
    if (!found[k]) continue;
    const ReferenceRayPlace& truth = places[k].place;
    of_r.push_back(std::abs(found[k]->r / truth.r - 1));
    of_time.push_back(std::abs(found[k]->null_time - truth.null_time) /
                      std::max(1.0, std::abs(truth.null_time)));
  }
  return {at_edge,
          by.name,
          tolerance,
          static_cast<int>(places.size()),
          static_cast<int>(places.size() - of_r.size()),
          summary(of_r),
          summary(of_time),
          1e9 * seconds / static_cast<double>(places.size())};
}

// Returns the wall-clock time of `work` for one ray of a full batch, by the best of several passes.
template <class Work>
double best_ns_of_a_ray(Work work) {
  // A pass traces 200 batches of 128 rays.  The clock is read only before and after.
  constexpr int kRounds = 200, kPasses = 7;
  double best = std::numeric_limits<double>::infinity();
  for (int pass = 0; pass < kPasses; ++pass) {
    const StopWatch watch;
    for (int round = 0; round < kRounds; ++round) work();
    best = std::min(best, watch.seconds());
  }
  return 1e9 * best / (kRounds * RayOrbits::kSize);
}

}  // namespace

std::vector<PositionErrorRow> measure_positions(bool quick) {
  std::vector<PositionErrorRow> rows;
  for (const bool at_edge : {false, true}) {
    const std::vector<SamplePlace> places = sample_places(quick, at_edge);
    for (const NamedTraceMethod& by : kTraceMethods) {
      if (!is_integrator(by.method)) {
        rows.push_back(measured_errors(at_edge, places, by, 0));
        continue;
      }
      for (const double tolerance : {1e-6, 1e-9, 1e-12})
        rows.push_back(measured_errors(at_edge, places, by, tolerance));
    }
  }
  return rows;
}

PositionSpeed measure_position_speed() {
  constexpr double kRadius = 10, kPsi = 1;
  // The angles of the rays, of which the columns hold the halves, are spread over the whole view.
  RayPlaces::Column sine, cosine, psi, times;
  for (int k = 0; k < RayOrbits::kSize; ++k) {
    const double half = std::numbers::pi / 2 * (k + 0.5) / RayOrbits::kSize;
    sine[k] = std::sin(half);
    cosine[k] = std::cos(half);
    psi[k] = kPsi;
  }
  RayOrbits orbits;
  RayPlaces places;
  PositionSpeed speed{};
  speed.ray = best_ns_of_a_ray([&] {
    orbits.set(kRadius, false, {sine.data(), cosine.data()}, RayOrbits::kSize);
  });
  speed.place = best_ns_of_a_ray([&] { orbits.find(psi.data(), places); });
  speed.ray_time = best_ns_of_a_ray([&] { RayTimes of(orbits); });
  const RayTimes of(orbits);
  speed.place_time = best_ns_of_a_ray([&] { of.find(psi.data(), places, times.data()); });
  return speed;
}

}  // namespace domefall
