// These benchmarks measure what a dome frame costs, as multiples of copying it.  The frame is first
// light at r = 7 M, with the Milky Way and every image that matters of the 131,085 standard stars.
// Grading is measured apart, at 4k; what files cost, bench_files measures.
//
//     build/release/tests/bench_frame
#include <benchmark/benchmark.h>

#include <array>
#include <cstdlib>
#include <fstream>
#include <string>

#include "pipeline/base/stop_watch.h"
#include "pipeline/base/temporary_file.h"
#include "pipeline/grade/grader.h"
#include "pipeline/render/renderer.h"
#include "pipeline/report/frame_timing.h"
#include "pipeline/show/file/read_show.h"
#include "tests/source_tree.h"

namespace domefall {
namespace {

// r = 6.9 M; and inside, where both skies are seen: the dearest of the show.
constexpr int kFrame = 136, kInside = 300;

// From here on the peak is that of the benchmark at hand.
void reset_peak_memory() { std::ofstream("/proc/self/clear_refs") << "5"; }

double peak_mib() {
  std::ifstream status("/proc/self/status");
  for (std::string word; status >> word;)
    if (double kib = 0; word == "VmHWM:" && status >> kib) return kib / 1024;
  return 0;
}

Show first_light(int size) {
  Show show = read_show(source_file("shows/first_light.yaml"));
  show.projection = Domemaster{size};
  return show;
}

// What the iterations of a benchmark took: the quickest one's time, since a machine may be busy
// with other things, and the CPU time of all.
class Stopwatch {
 public:
  template <class F>
  void time(F&& f) {
    const StopWatch watch;
    f();
    best_ = std::min(best_, watch.seconds());
  }

  // Both as multiples of copying the frame, too.
  void report(benchmark::State& state, const HalfFrame& frame) const {
    const double cpu = (processor_seconds() - start_) / static_cast<double>(state.iterations());
    const double copy = copy_seconds(frame);
    state.counters["best_ms"] = 1e3 * best_;
    state.counters["copies"] = best_ / copy;
    state.counters["cpu_ms"] = 1e3 * cpu;
    state.counters["cpu_copies"] = cpu / copy;
    state.counters["peak_MiB"] = peak_mib();
  }

 private:
  double best_ = 1e9, start_ = processor_seconds();
};

void render_again(benchmark::State& state, const Show& show) {
  reset_peak_memory();
  Renderer renderer(show, 0);
  const FrameState at = frame_state(show, static_cast<int>(state.range(1)));
  HalfFrame frame = renderer.render(at);  // loads the sky
  StageTimes stages;
  Stopwatch watch;
  for (auto _ : state) watch.time([&] { renderer.render(at, frame, &stages); });
  watch.report(state, frame);
  state.counters["stars_ms"] = 1e3 * stages.stars_s;
  state.counters["grid_ms"] = 1e3 * stages.grid_s;
  state.counters["pixels_ms"] = 1e3 * stages.pixels_s;
}

void render_frame(benchmark::State& state) {
  render_again(state, first_light(static_cast<int>(state.range(0))));
}

// With all stars of the catalogue that DOMEFALL_STARS names, such as one of
// shows/assets/fetch_stars.
void render_catalogue(benchmark::State& state) {
  const char* catalogue = std::getenv("DOMEFALL_STARS");
  if (catalogue == nullptr) return state.SkipWithError("DOMEFALL_STARS names no catalogue");
  Show show = first_light(static_cast<int>(state.range(0)));
  show.sky[SkyRegion::kI].stars = StarField{catalogue, 40};
  show.sky[SkyRegion::kIII].stars = show.sky[SkyRegion::kI].stars;
  render_again(state, show);
}

// The sky alone, without a star.
void render_sky(benchmark::State& state) {
  Show show = first_light(static_cast<int>(state.range(0)));
  show.sky[SkyRegion::kI].stars.reset(), show.sky[SkyRegion::kIII].stars.reset();
  render_again(state, show);
}

// A fall from rest about a hole that spins, with so many thousandths of what it can.  Each frame is another
// one, since who stays at a place has its chart once.
void render_spin(benchmark::State& state) {
  reset_peak_memory();
  const ScratchFolder folder;
  const auto path = folder / "fall.yaml";
  std::ofstream(path)
      << "size: " << state.range(0)
      << "\nblack_hole: {mass_solar: 1e6, spin: " << static_cast<double>(state.range(1)) / 1e3
      << "}\ntimeline: [{duration_s: 10, trajectory: {type: infall, from_r: 7.5, to_r: 6.5}}]\n";
  Show show = read_show(path);
  if (state.range(2) == 0) show.sky[SkyRegion::kI].stars.reset();
  Renderer renderer(show, 0);
  HalfFrame frame = renderer.render(frame_state(show, 0));  // loads the sky
  Stopwatch watch;
  for (int k = 1; auto _ : state) {
    const FrameState at = frame_state(show, k++ % 300);
    watch.time([&] { renderer.render(at, frame); });
  }
  watch.report(state, frame);
}

void load_and_render_frame(benchmark::State& state) {
  reset_peak_memory();
  const Show show = first_light(static_cast<int>(state.range(0)));
  const FrameState at = frame_state(show, kFrame);
  HalfFrame frame;
  Stopwatch watch;
  for (auto _ : state) watch.time([&] { frame = Renderer(show, 0).render(at); });
  watch.report(state, frame);
}

HalfFrame rendered(const Show& show) { return Renderer(show, 0).render(frame_state(show, kFrame)); }

// A view of the shipped configuration, without and with a CDL.
Grader grader_of(const Show& show, const benchmark::State& state) {
  GradeSettings settings = show.grade;
  settings.view = std::array{"Dome", "ACES SDR", "Star field",
                             "Un-tone-mapped"}[static_cast<std::size_t>(state.range(0))];
  if (state.range(1) != 0) settings.cdl.slope = {1.05, 1, 0.95}, settings.cdl.saturation = 0.9;
  return Grader(settings);
}

void grade_frame(benchmark::State& state) {
  const Show show = first_light(4096);
  const HalfFrame frame = rendered(show);
  const Grader grader = grader_of(show, state);
  GradedFrame out;
  Stopwatch watch;
  for (auto _ : state) watch.time([&] { out = grader.grade(frame); });
  watch.report(state, frame);
}

// The same pixels in frames so small that they are graded by the formulas: the ratio to the
// benchmark above is what the table saves.
void grade_by_formulas(benchmark::State& state) {
  const Show show = first_light(4096);
  const HalfFrame frame = rendered(show);
  const Grader grader = grader_of(show, state);
  constexpr int kRows = 256;
  HalfFrame part(frame.width, kRows);
  GradedFrame out(frame.width, kRows);
  Stopwatch watch;
  for (auto _ : state)
    watch.time([&] {
      for (int y = 0; y < frame.height; y += kRows) {
        std::copy_n(frame.row(y), static_cast<std::size_t>(3 * frame.width) * kRows, part.row(0));
        grader.grade_rows(part, 0, kRows, out.row(0));
      }
    });
  watch.report(state, frame);
}

// By the wall clock, in milliseconds.
void timed(benchmark::internal::Benchmark* of) { of->UseRealTime()->Unit(benchmark::kMillisecond); }

BENCHMARK(render_frame)
    ->ArgNames({"size", "frame"})
    ->Args({1024, kFrame})
    ->Args({4096, kFrame})
    ->Args({4096, kInside})
    ->Args({8192, kFrame})
    ->Args({8192, kInside})
    ->Apply(timed);
BENCHMARK(render_catalogue)
    ->ArgNames({"size", "frame"})
    ->Args({4096, 0})
    ->Args({4096, kFrame})
    ->Args({4096, kInside})
    ->Args({8192, kFrame})
    ->Apply(timed);
BENCHMARK(render_sky)
    ->ArgNames({"size", "frame"})
    ->Args({1024, kFrame})
    ->Args({4096, 0})
    ->Args({4096, kFrame})
    ->Args({4096, kInside})
    ->Args({8192, kFrame})
    ->Args({8192, kInside})
    ->Apply(timed);
BENCHMARK(render_spin)
    ->ArgNames({"size", "thousandths", "stars"})
    ->ArgsProduct({{4096}, {0, 500, 900, 998}, {0, 1}})
    ->Apply(timed);
BENCHMARK(load_and_render_frame)->Arg(4096)->Apply(timed);
void of_each_view(benchmark::internal::Benchmark* of) {
  timed(of->ArgNames({"view", "cdl"})->ArgsProduct({{0, 1, 2, 3}, {0, 1}}));
}
BENCHMARK(grade_frame)->Apply(of_each_view);
BENCHMARK(grade_by_formulas)->Apply(of_each_view);

}  // namespace
}  // namespace domefall
