#include "pipeline/survey/frame_costs.h"

#include <algorithm>
#include <ctime>
#include <numeric>
#include <optional>

#include "pipeline/render/rendered_frame.h"
#include "pipeline/render/shutter.h"
#include "pipeline/survey/reduced_frame.h"

namespace domefall {
namespace {

constexpr int kCostWidth = 256;
constexpr std::size_t kMostCostSamples = 9;
// No frame is taken to cost less than this part of the mean: its files are written in any case.
constexpr double kLeastCost = 0.2;

double processor_time() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

}  // namespace

std::vector<double> relative_costs(const Show& show, const std::vector<int>& frames,
                                   Renderer& renderer) {
  if (frames.empty()) return {};
  Show instant = show;
  instant.exposure.shutter = 0;
  std::optional<Renderer> own;
  if (show.exposure.shutter > 0) own.emplace(instant, renderer.threads());
  Renderer& used = own ? *own : renderer;
  OpticsStore optics;
  const int width = std::min(columns(show.projection), kCostWidth);
  const std::size_t samples = std::min(frames.size(), kMostCostSamples), last = frames.size() - 1;
  const auto index = [&](std::size_t k) { return samples > 1 ? k * last / (samples - 1) : 0; };
  std::vector<double> sampled;
  RenderedFrame frame;
  for (std::size_t k = 0; k < samples; ++k) {
    const FrameState state = frame_state(instant, frames[index(k)]);
    // The first frame of all loads the skies and the stars.
    for (int tries = k == 0 ? 0 : 1; tries < 2; ++tries) {
      const double start = processor_time();
      render_for_files(used, instant, reduced(state, width), frame);
      if (tries == 1) sampled.push_back(processor_time() - start);
    }
    if (show.exposure.shutter > 0)
      sampled.back() *= instants_for(show, frame_state(show, frames[index(k)]), optics);
  }
  const double mean = std::max(
      1e-9, std::accumulate(sampled.begin(), sampled.end(), 0.0) / static_cast<double>(samples));
  for (double& cost : sampled) cost = std::max(kLeastCost, cost / mean);
  std::vector<double> costs(frames.size(), sampled.front());
  for (std::size_t k = 1; k < samples; ++k) {
    const std::size_t from = index(k - 1), to = index(k);
    for (std::size_t i = from; i <= to; ++i) {
      const double part = static_cast<double>(i - from) / static_cast<double>(to - from);
      costs[i] = (1 - part) * sampled[k - 1] + part * sampled[k];
    }
  }
  const double sum = std::accumulate(costs.begin(), costs.end(), 0.0);
  for (double& cost : costs) cost *= static_cast<double>(costs.size()) / sum;
  return costs;
}

}  // namespace domefall
