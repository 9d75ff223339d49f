#include "pipeline/render/render_time.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <future>
#include <map>
#include <numeric>
#include <optional>

#include "pipeline/base/stop_watch.h"
#include "pipeline/base/temporary_file.h"
#include "pipeline/image/graded_file.h"
#include "pipeline/render/reduced_frame.h"
#include "pipeline/render/rendered_frame.h"
#include "pipeline/render/renderer.h"
#include "pipeline/render/scene/frame_plan.h"
#include "pipeline/render/shutter.h"

namespace domefall {
namespace {

// This is the width in pixels of the largest of the three sizes.  The others have a half and a
// quarter of it.
constexpr int kLargestWidth = 1024;
constexpr int kFrames = 3;  // measured at each size
// This is the twentieth of is_worth_measuring().
constexpr double kWorth = 0.05;

int largest_width(const Show& show) { return std::min(columns(show.projection), kLargestWidth); }

// Returns the number of times that the width doubles from the largest measured size to the full
// one.
double doublings_of(const Show& show) {
  return std::log2(1.0 * columns(show.projection) / largest_width(show));
}

// Reads what a frame needs outside the clocks, once for all frames.
void load(Renderer& renderer, const Show& show, const FrameState& state) {
  renderer.load(plan_frame(show, state));
}

// Returns the state of one of the measured frames, k from 0 to kFrames.  The first is the show's
// first frame, which warms up what the others need, and the others stand in the middles of three
// equal parts of the show.
FrameState measured_state(const Show& show, int k) {
  const auto last = static_cast<long>(frame_count(show) - 1);
  return frame_state(show, static_cast<int>(last * std::max(0, 2 * k - 1) / (2 * kFrames)));
}

double mean_instants(const Show& show) {
  if (!(show.exposure.shutter > 0)) return 1;
  LensStore lenses;
  double sum = 0;
  for (int k = 1; k <= kFrames; ++k) sum += instants_for(show, measured_state(show, k), lenses);
  return sum / kFrames;
}

// A frame takes these seconds by the clock, and of all processors together.  Other programs hardly
// change the latter.
struct Cost {
  double wall = 0, processor = 0;
  double linear_bytes = 0, graded_bytes = 0;  // of its files
};

class Measurement {
 public:
  Measurement(const Show& show, Renderer& renderer, const Grader* grader)
      : show_(show), renderer_(renderer), grader_(grader) {
    for (int k = 1; k <= kFrames; ++k) load(renderer, show, measured_state(show, k));
  }

  // Returns the cost of a frame in a run in which one frame is written while the next is rendered.
  Cost of_frames(int width, bool stars = true) const {
    std::future<void> writing;
    StopWatch watch;
    double processor = 0;
    Cost cost;
    // One frame more is made, because the clocks run only from the writing of the first frame on.
    for (int k = 0; k <= kFrames; ++k) {
      auto frame = std::make_shared<RenderedFrame>(show_);
      render_for_files(renderer_, show_, state(k, width, stars), *frame);
      if (writing.valid()) {
        writing.get();
        add_sizes(cost);
      }
      if (k == 0) watch.lap(), processor = processor_seconds();
      if (k < kFrames) writing = std::async(std::launch::async, [this, frame] { write(*frame); });
    }
    cost.wall = watch.seconds() / kFrames;
    cost.processor = (processor_seconds() - processor) / kFrames;
    return cost;
  }

  // Returns the cost of a frame's light alone.
  Cost of_light(int width, bool stars = true) const {
    RenderedFrame frame(show_);
    render_for_files(renderer_, show_, state(0, width, stars), frame);
    const StopWatch watch;
    const double processor = processor_seconds();
    for (int k = 1; k <= kFrames; ++k)
      render_for_files(renderer_, show_, state(k, width, stars), frame);
    return {.wall = watch.seconds() / kFrames,
            .processor = (processor_seconds() - processor) / kFrames};
  }

 private:
  FrameState state(int k, int width, bool stars) const {
    const FrameState small = reduced(measured_state(show_, k), width);
    return stars ? small : without_stars(small);
  }

  std::filesystem::path linear() const { return folder_ / "linear"; }  // a folder
  std::filesystem::path graded() const { return folder_ / "graded"; }

  void add_sizes(Cost& cost) const {
    if (show_.output.linear)
      for (const auto& file : std::filesystem::directory_iterator(linear()))
        cost.linear_bytes += static_cast<double>(file.file_size()) / kFrames;
    if (grader_)
      cost.graded_bytes += static_cast<double>(std::filesystem::file_size(graded())) / kFrames;
  }

  void write_linear_files(RenderedFrame& frame) const {
    std::filesystem::create_directories(linear());
    write_linear(linear() / "frame.exr", show_, frame, FrameInfo{});
    if (!show_.output.layer_files) return;
    for (const Layer layer : show_.output.layers)
      write_layer_of(linear() / kind_of(layer).name, show_, layer, frame, FrameInfo{});
  }

  void write(RenderedFrame& frame) const {
    std::future<void> other;
    if (show_.output.linear)
      other = std::async(std::launch::async, [&] { write_linear_files(frame); });
    if (grader_) {
      const auto rows = [&](int first, int end, unsigned short* rgb) {
        grader_->grade_rows(frame.half.picture, first, end, rgb);
      };
      write_graded(graded(), {frame.half.picture.width, frame.half.picture.height, rows},
                   GradedInfo{}, *show_.output.graded);
    }
    if (other.valid()) other.get();
  }

  const Show& show_;
  Renderer& renderer_;
  const Grader* grader_;
  ScratchFolder folder_;
};

// Returns the processor time at a width that is `doublings` doublings above that of the last of
// three costs, each of twice the width of the one before.  A part of the work is proportional to
// the pixels, another to the length of edges, and another to the stars.  A doubling multiplies
// these by 4, 2 and 1.  With the last step d and its growth g, further doublings add d g + d g^2 +
// ..., which is summed as a geometric series.
double processor_at(const std::array<Cost, 3>& costs, double doublings) {
  const auto& [quarter, half, whole] = costs;
  const double step = std::max(0.0, whole.processor - half.processor);
  const double growth =
      std::clamp(step / std::max(half.processor - quarter.processor, 1e-9), 2.0, 4.0);
  return whole.processor + step * growth * (std::pow(growth, doublings) - 1) / (growth - 1);
}

// Returns a file's size at a width that is `doublings` doublings above `whole`'s.
double size_at(double half, double whole, double doublings) {
  const double growth = std::clamp(whole / std::max(half, 1.0), 2.0, 4.0);
  return whole * std::pow(growth, doublings);
}

// In smaller pictures stars are found one by one, which takes ten times as long as in large ones
// (StarImageFinder).
constexpr int kCostWidth = 512;
constexpr std::size_t kMostSegments = 8, kMostMeasured = 16;
// The cost between two samples can be interpolated unless half of their difference, times the
// frames between them, is more than this part of the cost of all frames.  Where costs rise or fall
// between the samples without a turn, interpolation errs by no more than that: their sum lies
// between that of the lower and that of the higher cost, and the interpolated sum is in the middle.
constexpr double kPreciseEnough = 5e-3;

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
      : show_(show),
        instant_(show),
        width_(std::min(columns(show.projection), kCostWidth)),
        frame_(show) {
    // Where a frame is the mean of many instants, one of them is measured by a renderer of its own.
    instant_.exposure.shutter = 0;
    if (show.exposure.shutter > 0) own_.emplace(instant_, renderer.threads());
    renderer_ = own_ ? &*own_ : &renderer;
  }

  // Returns the processor time (s) of the light of a frame at the reduced size, for all instants of
  // its shutter.
  double seconds(int number) {
    const FrameState small = reduced(frame_state(instant_, number), width_);
    load(*renderer_, instant_, small);
    // The first frame of all makes what the others need too, so it is rendered once before.
    if (!is_warm_) render_for_files(*renderer_, instant_, small, frame_);
    is_warm_ = true;
    const double start = processor_seconds();
    render_for_files(*renderer_, instant_, small, frame_);
    const double took = processor_seconds() - start;
    return show_.exposure.shutter > 0
               ? took * instants_for(show_, frame_state(show_, number), lenses_)
               : took;
  }

 private:
  const Show& show_;
  Show instant_;
  int width_;
  std::optional<Renderer> own_;
  Renderer* renderer_ = nullptr;
  LensStore lenses_;
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

bool is_worth_measuring(const Show& show) {
  const double part = std::pow(1.0 * largest_width(show) / columns(show.projection), 2);
  // Frames of a half and a quarter of the width have a quarter and a sixteenth of the pixels.
  const double sizes = doublings_of(show) > 0 ? 1 + 1.0 / 4 + 1.0 / 16 : 1;
  // The frames that are rendered again for their light alone are not counted.
  return (kFrames + 1) * part * sizes < kWorth * frame_count(show);
}

RenderTime estimate_render_time(const Show& show, Renderer& renderer, const Grader* grader) {
  set_file_threads(renderer.threads());
  // Where a frame is the mean of many instants, a show with a shutter of one instant is measured.
  const double instants = mean_instants(show);
  Show instant = show;
  instant.exposure.shutter /= instants;
  std::optional<Renderer> own;
  if (instants > 1) own.emplace(instant, renderer.threads());
  std::optional<Grader> as_at_full_size;
  if (grader) {
    as_at_full_size = grader->as_for(columns(show.projection), rows(show.projection));
    as_at_full_size->grade(HalfFrame(1, 1));  // makes the run's table outside the clocks
  }
  const Measurement measured(instant, own ? *own : renderer,
                             as_at_full_size ? &*as_at_full_size : nullptr);
  const int width = largest_width(show);
  const double doublings = doublings_of(show);
  const Cost whole = measured.of_frames(width), whole_light = measured.of_light(width);
  RenderTime time;
  time.threads = renderer.threads();
  double processor = whole.processor, light = whole_light.processor;
  time.linear_bytes = whole.linear_bytes, time.graded_bytes = whole.graded_bytes;
  if (doublings > 0) {
    const Cost half = measured.of_frames(width / 2), half_light = measured.of_light(width / 2);
    // In pictures of a quarter of kLargestWidth stars are found one by one, which takes ten times as long
    // as in large ones (StarImageFinder).  The time for stars is therefore taken from the larger
    // size.
    const double stars = half_light.processor - measured.of_light(width / 2, false).processor;
    Cost quarter = measured.of_frames(width / 4, false);
    Cost quarter_light = measured.of_light(width / 4, false);
    quarter.processor += stars, quarter_light.processor += stars;
    processor = processor_at({quarter, half, whole}, doublings);
    light = processor_at({quarter_light, half_light, whole_light}, doublings);
    time.linear_bytes = size_at(half.linear_bytes, whole.linear_bytes, doublings);
    time.graded_bytes = size_at(half.graded_bytes, whole.graded_bytes, doublings);
  }
  // The light is made for each instant, and the rest once for each frame.
  const double all_light = instants * light, all = processor + all_light - light;
  time.processor_s = all;
  time.light_part = std::clamp(all_light / std::max(all, 1e-9), 0.0, 1.0);
  // Seconds by the clock are processor seconds at the ratio that was found at the largest size, for
  // the frame with its files and for each further instant of its light.
  time.frame_s = whole.wall * processor / std::max(whole.processor, 1e-9) +
                 (instants - 1) * whole_light.wall * light / std::max(whole_light.processor, 1e-9);
  time.seconds = time.frame_s * frame_count(show);
  return time;
}

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
