#include "pipeline/render/renderer.h"

#include <tbb/blocked_range.h>
#include <tbb/enumerable_thread_specific.h>
#include <tbb/info.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <optional>
#include <stdexcept>
#include <utility>

#include "pipeline/image/errors.h"
#include "pipeline/render/frame_stars.h"
#include "pipeline/render/shutter.h"
#include "pipeline/render/sky/pixel_shader.h"
#include "pipeline/render/sky/sky_pass.h"
#include "pipeline/render/sky/unresolved_sky.h"
#include "pipeline/simd/dispatch.h"
#include "pipeline/simd/half_row.h"

namespace domefall {
namespace {

// That one thread makes one after another, if that is a gain: a thread should have some turns, but a
// turn's first and last dots are dropped by its neighbours too.
constexpr int kTurns = 8, kLeastInARow = 8;

int bands_in_a_row(int bands) {
  const int threads = tbb::this_task_arena::max_concurrency();
  return threads == 1 ? bands : std::max(bands / (kTurns * threads), kLeastInARow);
}

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

// More threads than processors gain nothing, and TBB would say so on the terminal.
int threads_of(int wanted) {
  const int processors = tbb::info::default_concurrency();
  return wanted > 0 ? std::min(wanted, processors) : processors;
}

int table_count(const HoleOptics& optics) {
  return int{optics.home_sky.has_value()} + int{optics.far_sky.has_value()} +
         int{optics.white_hole.has_value()} + int{optics.emission_times.has_value()};
}

std::size_t node_count(const HoleOptics& optics) {
  return (optics.home_sky ? optics.home_sky->node_count() : 0) +
         (optics.far_sky ? optics.far_sky->node_count() : 0) +
         (optics.white_hole ? optics.white_hole->node_count() : 0) +
         (optics.emission_times ? optics.emission_times->node_count() : 0);
}

// Only pixels inside are lit.
void store_row(const float* rgb, int row, ColumnRange inside, HalfFrame& frame) {
  static_assert(sizeof(Imath::half) == sizeof(std::uint16_t));
  auto* out = reinterpret_cast<std::uint16_t*>(frame.row(row));
  const int first = 3 * inside.first, end = 3 * (inside.last + 1);
  if (first >= end) {
    std::fill_n(out, 3 * frame.width, std::uint16_t{0});
    return;
  }
  std::fill(out, out + first, std::uint16_t{0});
  std::fill(out + end, out + 3 * frame.width, std::uint16_t{0});
  if (to_half(rgb + first, end - first, out + first)) return;
  for (int k = 0; k < 3 * frame.width; ++k)
    if (!std::isfinite(rgb[k]))
      throw std::runtime_error("pixel (" + std::to_string(k / 3 + 1) + ", " +
                               std::to_string(row + 1) + ") is not a finite number");
}

}  // namespace

namespace {

// The part of the light that is the vanishing picture's, the rest the other's.
void dissolve(HalfFrame& frame, const HalfFrame& vanishing, double part) {
  const auto of_other = static_cast<float>(part), of_own = 1 - of_other;
  for (int row = 0; row < frame.height; ++row) {
    Imath::half* own = frame.row(row);
    const Imath::half* other = vanishing.row(row);
    for (int k = 0; k < 3 * frame.width; ++k)
      own[k] = of_own * static_cast<float>(own[k]) + of_other * static_cast<float>(other[k]);
  }
}

}  // namespace

struct Renderer::Arena {
  tbb::task_arena arena;
  // Kept from frame to frame: new memory costs more than what is written into it.
  RayGrid grid{};
  BlobLayer stars{Domemaster{1}};
  ImageLists images{};
  tbb::enumerable_thread_specific<SplatCanvas> dots{};
  tbb::enumerable_thread_specific<std::vector<float>> bands{};
};

Renderer::Renderer(const Show& show, int threads, AntiAliasing anti_aliasing)
    : show_(show),
      sky_store_(show),
      anti_aliasing_(anti_aliasing),
      arena_(new Arena{tbb::task_arena(threads_of(threads))}) {
  if (anti_aliasing.samples < 1 || anti_aliasing.samples > kMostSamples)
    throw InputError("anti-aliasing takes 1 to " + std::to_string(kMostSamples) +
                     " samples along each axis of a pixel, got " +
                     std::to_string(anti_aliasing.samples));
  arena_->arena.initialize();
}

Renderer::~Renderer() = default;

void Renderer::load(const FramePlan& plan) {
  for (const SkyRegion which : kEverySky)
    if (plan[which].lit()) sky_store_.sky(which, plan[which].background, plan[which].stars);
}

void Renderer::load_sky(SkyRegion which) { sky_store_.sky(which); }

int Renderer::threads() const { return arena_->arena.max_concurrency(); }

const HoleOptics& Renderer::optics_for(const FrameState& state, const FramePlan& plan, int* made) {
  const ObserverState& o = state.observer;
  WantedSkies wanted;
  for (const SkyRegion which : kEverySky) wanted.sky[which] = plan[which].lit();
  wanted.emission_times = plan[SkyRegion::kIV].lit() && plan[SkyRegion::kIV].rings;
  const double r = plan.gravity ? o.r : kFlatSpace;
  const bool kept = optics_ && optics_->at.r == r && optics_->tetrad == o.tetrad;
  const int before = kept ? table_count(*optics_) : 0;
  if (kept)
    add_tables(*optics_, wanted);
  else
    optics_ = make_hole_optics(r, o.tetrad, wanted);
  if (made) *made = table_count(*optics_) - before;
  return *optics_;
}

HalfFrame Renderer::render(const FrameState& state, StageTimes* times) {
  HalfFrame frame;
  render(state, frame, times);
  return frame;
}

namespace {

void add_times(const StageTimes& more, StageTimes& sum) {
  sum.load_s += more.load_s, sum.tables_s += more.tables_s;
  sum.stars_s += more.stars_s, sum.grid_s += more.grid_s, sum.pixels_s += more.pixels_s;
  sum.traced_fraction = std::max(sum.traced_fraction, more.traced_fraction);
  sum.table_nodes = std::max(sum.table_nodes, more.table_nodes);
  sum.images += more.images, sum.tables_made += more.tables_made;
}

}  // namespace

double Renderer::motion_between(const FrameState& from, const FrameState& to) {
  const HoleOptics first = optics_for(from, plan_frame(show_, from));
  const HoleOptics& second = optics_for(to, plan_frame(show_, to));
  return motion_in_pixels(from, ViewTracer(from, first, show_.effects), to,
                          ViewTracer(to, second, show_.effects));
}

// The way through the middles of the quarters of the exposure, three quarters of the whole; of a dissolve
// the longer of both.
int Renderer::instants_for(const FrameState& state) {
  constexpr int kParts = 4;
  std::vector<FrameState> states = exposure_states(show_, state.frame, kParts);
  for (FrameState& exposed : states) take_size(state, exposed);
  double way = 0, vanishing_way = 0;
  for (std::size_t k = 1; k < states.size(); ++k) {
    way += motion_between(states[k - 1], states[k]);
    if (states[k - 1].vanishing && states[k].vanishing)
      vanishing_way += motion_between(*states[k - 1].vanishing, *states[k].vanishing);
  }
  return instants_for_motion(std::max(way, vanishing_way) * kParts / (kParts - 1));
}

void Renderer::render(const FrameState& state, HalfFrame& frame, StageTimes* times) {
  StageTimes sum;
  const int pictures = show_.exposure.shutter > 0 ? instants_for(state) : 1;
  if (pictures == 1) {
    render_instant(state, frame, sum);
  } else {
    MeanFrame mean;
    for (FrameState& exposed : exposure_states(show_, state.frame, pictures)) {
      take_size(state, exposed);
      StageTimes own;
      render_instant(exposed, frame, own);
      arena_->arena.execute([&] { mean.add(frame); });
      add_times(own, sum);
    }
    arena_->arena.execute([&] { mean.store(frame); });
  }
  sum.pictures = pictures;
  if (times) *times = sum;
}

void Renderer::render_instant(const FrameState& state, HalfFrame& frame, StageTimes& times) {
  render_one(state, frame, times);
  if (!state.vanishing) return;
  StageTimes others;
  HalfFrame vanishing;
  render_one(*state.vanishing, vanishing, others);
  dissolve(frame, vanishing, state.vanishing_part);
  add_times(others, times);
}

// pass: null where there is nothing behind the stars.
void Renderer::make_bands(const SkyPass* pass, const Projection& projection, HalfFrame& frame) {
  const BlobLayer& stars = arena_->stars;
  const auto stride = static_cast<std::size_t>(frame.width) * 3;
  const auto make_band = [&](int band, SplatCanvas& dots) {
    const int first = band * kBandRows, end = std::min(frame.height, first + kBandRows);
    std::vector<float>& rgb = arena_->bands.local();
    rgb.resize(stride * kBandRows + 1);
    if (pass)
      pass->fill_band(band, rgb.data());
    else
      std::fill(rgb.begin(), rgb.end(), 0.0f);
    stars.draw_band(band, dots, rgb.data());
    for (int row = first; row < end; ++row)
      store_row(rgb.data() + static_cast<std::size_t>(row - first) * stride, row,
                inside_columns(projection, row), frame);
  };
  // Dots are dropped once for bands that follow one another.
  const int bands = (frame.height + kBandRows - 1) / kBandRows;
  tbb::parallel_for(
      tbb::blocked_range<int>(0, bands, stars.has_splats() ? bands_in_a_row(bands) : 1),
      [&](const tbb::blocked_range<int>& some) {
        SplatCanvas& dots = arena_->dots.local();
        stars.start_canvas(dots);
        for (int band = some.begin(); band < some.end(); ++band) make_band(band, dots);
      },
      tbb::simple_partitioner());
}

void Renderer::render_one(const FrameState& state, HalfFrame& frame, StageTimes& t) {
  const FramePlan plan = plan_frame(show_, state);
  auto start = Clock::now();
  const auto lap = [&start] {
    const double s = seconds_since(start);
    start = Clock::now();
    return s;
  };
  PerSky<const Sky*> skies{};
  for (const SkyRegion which : kEverySky)
    if (plan[which].lit())
      skies[which] = &sky_store_.sky(which, plan[which].background, plan[which].stars);
  t.load_s = lap();
  const HoleOptics& optics = optics_for(state, plan, &t.tables_made);
  t.table_nodes = node_count(optics);
  t.tables_s = lap();

  if (frame.width != columns(state.projection) || frame.height != rows(state.projection))
    frame = HalfFrame(columns(state.projection), rows(state.projection));
  arena_->arena.execute([&] {
    BlobLayer& stars = arena_->stars;
    stars.start(state.projection);
    lay_stars(show_, state, plan, optics, skies, arena_->images, stars);
    for (const SkyRegion which : kEverySky)
      if (!plan[which].background) skies[which] = nullptr;
    UnresolvedSkies spots = find_unresolved_skies(show_, state, optics, skies);
    stars.add(spots.blobs);
    const std::size_t bright_spots = spots.blobs.size();
    stars.sort_into_bands();
    t.images = stars.size() - bright_spots;
    t.stars_s = lap();
    const PixelShader light(show_, state, optics, skies, anti_aliasing_, std::move(spots.darkened));
    const SkyPass pass(show_, state, optics, anti_aliasing_, light, arena_->grid);
    t.grid_s = lap();
    t.traced_fraction = pass.traced_fraction();
    make_bands(plan.background() ? &pass : nullptr, state.projection, frame);
    t.pixels_s = lap();
  });
}

std::string describe(const FramePlan& plan, const StageTimes& t) {
  char line[256];
  std::string text, skies, tables;
  for (const SkyRegion which : kEverySky) {
    const FramePlan::Sky& sky = plan[which];
    const std::string name = std::string("sky ") + name_of(which);
    skies += (skies.empty() ? "" : "; ") + name + ": " +
             (sky.background ? "background" : "no background") +
             (sky.stars ? ", stars" : ", no stars");
    if (sky.lit()) tables += (tables.empty() ? "" : " and ") + name;
  }
  if (tables.empty()) tables = "all skies black: none";
  if (!plan.gravity) tables = "straight light: none";
  std::snprintf(line, sizeof line, "load    %8.3f s  %s\n", t.load_s, skies.c_str());
  text += line;
  std::snprintf(line, sizeof line, "tables  %8.5f s  %s, %zu nodes, %d made\n", t.tables_s,
                tables.c_str(), t.table_nodes, t.tables_made);
  text += line;
  std::snprintf(line, sizeof line, "stars   %8.4f s  %zu images\n", t.stars_s, t.images);
  text += line;
  if (t.pictures > 1) {
    std::snprintf(line, sizeof line, "shutter open: the mean of %d instants\n", t.pictures);
    text += line;
  }
  std::snprintf(line, sizeof line, "grid    %8.4f s\n", t.grid_s);
  text += line;
  std::snprintf(line, sizeof line, "pixels  %8.4f s  %.1f %% looked at one by one; loops: %s\n",
                t.pixels_s, 100 * t.traced_fraction, name_of(simd_in_use()));
  return text + line;
}

}  // namespace domefall
