#include "pipeline/report/view_ray_speed.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <limits>

#include "pipeline/render/rays/view_tracer.h"

namespace domefall {
namespace {

struct Observer {
  const char* name;
  Region region;
  Tetrad tetrad;
  double r;
};
constexpr std::array kObservers{
    Observer{"region I, free fall at 10 M", Region::kI, Tetrad::kRain, 10},
    Observer{"region II, free fall at 0.5 M", Region::kII, Tetrad::kRain, 0.5},
    Observer{"region IV, outward at 1 M", Region::kIV, Tetrad::kOutgoing, 1}};

// A dome of this size has some 51,000 pixels, pi/4 of its square, which are 400 full batches.  Each
// pass traces all of them.
constexpr int kSize = 256, kPasses = 7;

// Returns the time of one view ray.  The quickest pass counts, because whatever else the machine
// does can only lengthen a pass.
double nanoseconds(const Observer& observer) {
  FrameState state;
  state.projection = Domemaster{kSize};
  state.observer.region = observer.region;
  state.observer.tetrad = observer.tetrad;
  state.observer.r = observer.r;
  // Every sky that the observer sees has a table, so every view ray is looked up in one.
  const HoleOptics optics = make_hole_optics(observer.r, observer.tetrad, {true, true, true});
  const ViewTracer tracer(state, optics);
  // The directions are collected first, so that tracing alone is timed.
  std::vector<CameraDirection> directions;
  for (int row = 0; row < kSize; ++row) {
    const ColumnRange inside = inside_columns(state.projection, row);
    const std::size_t before = directions.size();
    directions.resize(before +
                      static_cast<std::size_t>(std::max(0, inside.last - inside.first + 1)));
    inside_directions(state.projection, row, inside, directions.data() + before);
  }
  ViewRayBatch batch;
  double best = std::numeric_limits<double>::infinity();
  for (int pass = 0; pass < kPasses; ++pass) {
    const auto start = std::chrono::steady_clock::now();
    for (std::size_t k = 0; k < directions.size(); k += ViewRayBatch::kSize) {
      const auto count =
          static_cast<int>(std::min<std::size_t>(ViewRayBatch::kSize, directions.size() - k));
      tracer.trace(directions.data() + k, count, batch);
    }
    const auto passed = std::chrono::steady_clock::now() - start;
    best = std::min(best, std::chrono::duration<double, std::nano>(passed).count());
  }
  return best / static_cast<double>(directions.size());
}

}  // namespace

std::vector<ViewRaySpeedRow> measure_view_ray_speed() {
  std::vector<ViewRaySpeedRow> rows;
  rows.reserve(kObservers.size());
  for (const Observer& observer : kObservers)
    rows.push_back({observer.name, nanoseconds(observer)});
  return rows;
}

}  // namespace domefall
