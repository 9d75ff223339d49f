#include "pipeline/render/renderer.h"

#include <tbb/info.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <stdexcept>

#include "pipeline/render/pixel_light.h"
#include "pipeline/render/star_blobs.h"

namespace domefall {
namespace {

// Rows that one task shades, covers with stars and stores, while they are still in its cache.
constexpr int kBandRows = 16;
// Stars that one task turns into blobs.
constexpr std::size_t kStarBatch = 256;

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

bool shows_anything(const RegionSky& sky) {
  return !std::holds_alternative<BlackSky>(sky.background) && sky.background_gain > 0;
}

bool has_stars(const RegionSky& sky) { return sky.stars && sky.star_gain > 0; }

// More threads than processors gain nothing, and TBB would say so on the terminal.
int threads_of(int wanted) {
  const int processors = tbb::info::default_concurrency();
  return wanted > 0 ? std::min(wanted, processors) : processors;
}

// Stars in batches, each batch into its own list, the lists in order: the same blobs in the same
// order for any number of threads.
void append_blobs(const BlobMaker& maker, const std::vector<SceneStar>& stars,
                  std::vector<StarBlob>& blobs) {
  std::vector<std::vector<StarBlob>> batches((stars.size() + kStarBatch - 1) / kStarBatch);
  tbb::parallel_for(std::size_t{0}, batches.size(), [&](std::size_t b) {
    const std::size_t end = std::min(stars.size(), (b + 1) * kStarBatch);
    for (std::size_t k = b * kStarBatch; k < end; ++k) maker.append(stars[k], batches[b]);
  });
  for (const auto& batch : batches) blobs.insert(blobs.end(), batch.begin(), batch.end());
}

// For each band of rows, the blobs that touch it, in order.
std::vector<std::vector<std::uint32_t>> blobs_by_band(const std::vector<StarBlob>& blobs,
                                                      int bands) {
  std::vector<std::vector<std::uint32_t>> by_band(static_cast<std::size_t>(bands));
  for (std::size_t k = 0; k < blobs.size(); ++k)
    for (int band = blobs[k].first_row / kBandRows; band <= blobs[k].last_row / kBandRows; ++band)
      by_band[static_cast<std::size_t>(band)].push_back(static_cast<std::uint32_t>(k));
  return by_band;
}

void store_row(const float* rgb, int row, HalfFrame& frame) {
  constexpr float kLargest = 65504;
  Imath::half* out = frame.row(row);
  float sum = 0;
  for (int k = 0; k < 3 * frame.width; ++k) {
    sum += rgb[k] - rgb[k];  // NaN as soon as one value is not finite
    out[k] = std::min(rgb[k], kLargest);
  }
  if (sum == 0) return;
  for (int k = 0; k < 3 * frame.width; ++k)
    if (!std::isfinite(rgb[k]))
      throw std::runtime_error("pixel (" + std::to_string(k / 3 + 1) + ", " +
                               std::to_string(row + 1) + ") is not a finite number");
}

}  // namespace

FramePlan plan_frame(const Show& show, const FrameState& state) {
  const ObserverState& o = state.observer;
  const bool three = o.region == Region::kII && o.r < 2;
  FramePlan plan;
  plan.gravity = !is_flat(o);
  plan.background_one = shows_anything(show.sky_one);
  plan.background_three = three && shows_anything(show.sky_three);
  plan.stars_one = has_stars(show.sky_one);
  plan.stars_three = three && has_stars(show.sky_three);
  plan.table_one = plan.gravity && (plan.background_one || plan.stars_one);
  plan.table_three = plan.gravity && (plan.background_three || plan.stars_three);
  return plan;
}

struct Renderer::Arena {
  tbb::task_arena arena;
};

Renderer::Renderer(const Show& show, int threads)
    : show_(show), scene_(show), arena_(new Arena{tbb::task_arena(threads_of(threads))}) {
  arena_->arena.initialize();
}

Renderer::~Renderer() = default;

void Renderer::load_skies(bool three) {
  scene_.sky_one();
  if (three) scene_.sky_three();
}

int Renderer::threads() const { return arena_->arena.max_concurrency(); }

const HoleOptics& Renderer::optics_for(const FrameState& state, const FramePlan& plan) {
  const ObserverState& o = state.observer;
  const bool kept = optics_ && optics_->r == o.r && optics_->region == o.region &&
                    optics_->sky_one.has_value() == plan.table_one &&
                    optics_->sky_three.has_value() == plan.table_three;
  if (!kept) optics_ = make_hole_optics(o.region, o.r, {plan.table_one, plan.table_three});
  return *optics_;
}

HalfFrame Renderer::render(const FrameState& state, StageTimes* times) {
  StageTimes unused;
  StageTimes& t = times ? *times : unused;
  const FramePlan plan = plan_frame(show_, state);
  auto start = Clock::now();
  const auto lap = [&start] {
    const double s = seconds_since(start);
    start = Clock::now();
    return s;
  };
  const Sky* one = plan.background_one || plan.stars_one ? &scene_.sky_one() : nullptr;
  const Sky* three = plan.background_three || plan.stars_three ? &scene_.sky_three() : nullptr;
  t.load_s = lap();
  const HoleOptics& optics = optics_for(state, plan);
  const SkyTable* table_one = optics.sky_one ? &*optics.sky_one : nullptr;
  const SkyTable* table_three = optics.sky_three ? &*optics.sky_three : nullptr;
  t.table_nodes =
      (table_one ? table_one->node_count() : 0) + (table_three ? table_three->node_count() : 0);
  t.tables_s = lap();

  HalfFrame frame(columns(state.projection), rows(state.projection));
  arena_->arena.execute([&] {
    std::vector<StarBlob> blobs;
    if (plan.stars_one)
      append_blobs(BlobMaker(show_, state, optics, table_one), *one->stars, blobs);
    if (plan.stars_three)
      append_blobs(BlobMaker(show_, state, optics, table_three), *three->stars, blobs);
    t.images = blobs.size();
    const int bands = (frame.height + kBandRows - 1) / kBandRows;
    const auto by_band = blobs_by_band(blobs, bands);
    t.stars_s = lap();
    const PixelLight light(show_, state, optics, plan.background_one ? one : nullptr,
                           plan.background_three ? three : nullptr);
    const bool background = plan.background_one || plan.background_three;
    tbb::parallel_for(0, bands, [&](int band) {
      std::vector<float> rgb(static_cast<std::size_t>(frame.width) * 3);
      const int end = std::min(frame.height, (band + 1) * kBandRows);
      for (int row = band * kBandRows; row < end; ++row) {
        if (background)
          light.fill_row(row, rgb.data());
        else
          std::fill(rgb.begin(), rgb.end(), 0.0f);
        for (const std::uint32_t k : by_band[static_cast<std::size_t>(band)])
          if (row >= blobs[k].first_row && row <= blobs[k].last_row)
            draw_row(blobs[k], state.projection, row, rgb.data());
        store_row(rgb.data(), row, frame);
      }
    });
    t.pixels_s = lap();
  });
  return frame;
}

std::string describe(const FramePlan& plan, const StageTimes& t) {
  const auto sky = [](bool background, bool stars) {
    return std::string(background ? "background" : "no background") +
           (stars ? ", stars" : ", no stars");
  };
  char line[256];
  std::string text;
  std::snprintf(line, sizeof line, "load    %8.3f s  sky I: %s; sky III: %s\n", t.load_s,
                sky(plan.background_one, plan.stars_one).c_str(),
                sky(plan.background_three, plan.stars_three).c_str());
  text += line;
  std::snprintf(line, sizeof line, "tables  %8.5f s  %s, %zu nodes\n", t.tables_s,
                !plan.gravity                        ? "flat space: none"
                : plan.table_one && plan.table_three ? "sky I and sky III"
                : plan.table_one                     ? "sky I"
                : plan.table_three                   ? "sky III"
                                                     : "all skies black: none",
                t.table_nodes);
  text += line;
  std::snprintf(line, sizeof line, "stars   %8.4f s  %zu images\n", t.stars_s, t.images);
  text += line;
  std::snprintf(line, sizeof line, "pixels  %8.4f s\n", t.pixels_s);
  return text + line;
}

}  // namespace domefall
