#include "pipeline/survey/frame_costs.h"

#include <algorithm>
#include <cmath>
#include <ctime>
#include <map>
#include <numeric>
#include <optional>

#include "pipeline/render/rendered_frame.h"
#include "pipeline/render/shutter.h"
#include "pipeline/survey/reduced_frame.h"

namespace domefall {
namespace {

// In smaller pictures stars are found one by one, which takes ten times as long as in large ones
// (StarImageFinder).
constexpr int kCostWidth = 512;
constexpr std::size_t kMostSegments = 8, kMostMeasured = 16;
// The cost between two samples can be interpolated unless half of their difference, times the
// frames between them, is more than this part of the cost of all frames.  Where costs rise or fall
// between the samples without a turn, interpolation errs by no more than that: their sum lies
// between that of the lower and that of the higher cost, and the interpolated sum is in the middle.
constexpr double kPreciseEnough = 5e-3;

double processor_time() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

// Returns the indices in `frames` at which a segment begins, from 0 on, and then the end.  A show
// of more than kMostSegments segments counts as one segment.
std::vector<std::size_t> segment_bounds(const Show& show, const std::vector<int>& frames) {
  std::vector<std::size_t> bounds{0};
  while (bounds.back() < frames.size() && bounds.size() <= kMostSegments) {
    const int segment = frame_state(show, frames[bounds.back()]).segment;
    const auto end = std::partition_point(
        frames.begin() + static_cast<std::ptrdiff_t>(bounds.back()), frames.end(),
        [&](int frame) { return frame_state(show, frame).segment <= segment; });
    bounds.push_back(static_cast<std::size_t>(end - frames.begin()));
  }
  if (bounds.back() < frames.size()) return {0, frames.size()};
  return bounds;
}

// A LightClock measures the time that the light of single frames takes.
class LightClock {
 public:
  LightClock(const Show& show, Renderer& renderer)
      : show_(show), instant_(show), width_(std::min(columns(show.projection), kCostWidth)) {
    // Where a frame is the mean of many instants, one of them is measured by a renderer of its own.
    instant_.exposure.shutter = 0;
    if (show.exposure.shutter > 0) own_.emplace(instant_, renderer.threads());
    renderer_ = own_ ? &*own_ : &renderer;
  }

  // Returns the processor time (s) of the light of a frame at the reduced size, for all instants of
  // its shutter.
  double seconds(int number) {
    const FrameState small = reduced(frame_state(instant_, number), width_);
    // The first frame of all loads the skies and the stars, so it is rendered once before.
    if (!is_warm_) render_for_files(*renderer_, instant_, small, frame_);
    is_warm_ = true;
    const double start = processor_time();
    render_for_files(*renderer_, instant_, small, frame_);
    const double took = processor_time() - start;
    return show_.exposure.shutter > 0
               ? took * instants_for(show_, frame_state(show_, number), optics_)
               : took;
  }

 private:
  const Show& show_;
  Show instant_;
  int width_;
  std::optional<Renderer> own_;
  Renderer* renderer_ = nullptr;
  OpticsStore optics_;
  RenderedFrame frame_;
  bool is_warm_ = false;
};

// Samples are measured costs by their indices in a list of frames.
using Samples = std::map<std::size_t, double>;

// A gap lies between two samples of one segment.  Its doubt is half of their difference times the
// frames between them.
struct Gap {
  std::size_t first = 0, last = 0;
  double doubt = 0;
};

Gap most_doubtful(const Samples& samples, const std::vector<std::size_t>& bounds) {
  Gap most;
  for (auto b = samples.begin(), a = b++; b != samples.end(); a = b++) {
    if (std::ranges::binary_search(bounds, b->first)) continue;  // a segment ends between them
    const std::size_t length = b->first - a->first;
    const double doubt = std::abs(b->second - a->second) / 2 * static_cast<double>(length);
    if (length > 1 && doubt > most.doubt) most = {a->first, b->first, doubt};
  }
  return most;
}

// Returns a cost for each of `count` frames, linear between samples.  The first and the last frame
// have samples of their own.
std::vector<double> interpolated(const Samples& samples, std::size_t count) {
  std::vector<double> costs(count, 0);
  auto before = samples.begin();
  for (const auto& [at, cost] : samples) {
    for (std::size_t k = before->first; k < at; ++k)
      costs[k] = std::lerp(
          before->second, cost,
          static_cast<double>(k - before->first) / static_cast<double>(at - before->first));
    costs[at] = cost;
    before = samples.find(at);
  }
  return costs;
}

}  // namespace

std::vector<double> relative_light_costs(const Show& show, const std::vector<int>& frames,
                                         Renderer& renderer) {
  if (frames.empty()) return {};
  LightClock clock(show, renderer);
  const std::vector<std::size_t> bounds = segment_bounds(show, frames);
  Samples samples;
  const auto sample = [&](std::size_t at) {
    if (!samples.contains(at)) samples[at] = clock.seconds(frames[at]);
  };
  for (std::size_t k = 1; k < bounds.size(); ++k)
    for (const std::size_t at : {bounds[k - 1], (bounds[k - 1] + bounds[k]) / 2, bounds[k] - 1})
      sample(at);
  // The middle of the most doubtful gap is measured next, until no gap matters or kMostMeasured
  // frames are measured.
  for (;;) {
    std::vector<double> costs = interpolated(samples, frames.size());
    const double sum = std::accumulate(costs.begin(), costs.end(), 0.0);
    const Gap gap = most_doubtful(samples, bounds);
    if (gap.doubt > kPreciseEnough * sum && samples.size() < kMostMeasured) {
      sample((gap.first + gap.last) / 2);
      continue;
    }
    for (double& cost : costs) cost *= sum > 0 ? static_cast<double>(costs.size()) / sum : 0;
    return costs;
  }
}

}  // namespace domefall
