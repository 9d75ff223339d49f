#include "pipeline/report/frame_errors.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <ctime>
#include <limits>
#include <numbers>

#include "pipeline/grade/grader.h"
#include "pipeline/render/renderer.h"
#include "pipeline/show/assets.h"

namespace domefall {
namespace {

constexpr double kDegree = std::numbers::pi / 180;
constexpr int kQuickSize = 256, kFullSize = 1024;
// Renderings of which the quickest counts: the others met a cold cache or a busy neighbour.
constexpr int kRepeats = 3;
constexpr double kWhite = 65535;  // of graded frames

// Process time, all threads.  It wraps after 71 minutes where clock_t has 32 bits.
double cpu_seconds() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

struct View {
  const char* name;
  Trajectory trajectory;
  Attitude attitude;
  bool grid;  // else the Milky Way; on both skies
  bool dome;  // else a flat picture that the silhouette at 30 M fills
};

std::vector<View> views(bool quick) {
  std::vector<View> all{
      {"30 M, grid", StaticObserver{30}, LookAtHole{}, true, true},
      {"30 M, Milky Way", StaticObserver{30}, LookAtHole{}, false, true},
      {"last stable orbit, Milky Way", CircularOrbit{6}, LookAlongMotion{}, false, true},
      {"0.5 M, two grids", RadialInfall{0.5}, LookAtHole{}, true, true},
      {"0.5 M, two Milky Ways", RadialInfall{0.5}, LookAtHole{}, false, true},
      {"silhouette seen from 30 M, grid", StaticObserver{30}, LookAtHole{}, true, false}};
  if (quick) all.resize(1);
  return all;
}

struct Setting {
  const char* name;
  AntiAliasing anti_aliasing;
};

std::vector<Setting> settings(bool quick) {
  std::vector<Setting> all{{"1 look", {1, false}},
                           {"2 x 2 in difficult pixels", {2, false}},
                           {"4 x 4 in difficult pixels (default)", {}},
                           {"8 x 8 in difficult pixels", {8, false}}};
  if (!quick) {
    all.push_back({"2 x 2 everywhere", {2, true}});
    all.push_back({"4 x 4 everywhere", {4, true}});
  }
  return all;
}

Show show_of(const View& view, int size) {
  // The silhouette has 18.4 degrees across.
  constexpr double kFlatView = 24 * kDegree;
  Show show;
  if (view.dome)
    show.projection = Domemaster{size};
  else
    show.projection = Stereographic{size, size, kFlatView};
  // Sagittarius A*, so that the Milky Way's heart is behind the hole.
  constexpr double kRa = 266.417 * kDegree, kDec = -29.008 * kDegree;
  show.hole_at = {
      V3d(std::cos(kDec) * std::cos(kRa), std::cos(kDec) * std::sin(kRa), std::sin(kDec))};
  Segment segment;
  segment.duration_s = 1;
  segment.trajectory = view.trajectory;
  segment.camera.attitude = view.attitude;
  if (view.dome) segment.camera.elevation = 45 * kDegree;
  show.timeline = {segment};
  if (view.grid)
    show.sky_one.background = GridSky{};
  else
    show.sky_one.background = PanoramaSky{shipped_asset(kMilkyWay)};
  show.sky_three = show.sky_one;
  show.grade.config = shipped_asset(kDomeConfig);
  return show;
}

struct TimedFrame {
  HalfFrame frame;
  double seconds;  // CPU
};

TimedFrame render(const Show& show, AntiAliasing anti_aliasing, int repeats) {
  Renderer renderer(show, 0, anti_aliasing);
  const FrameState state = frame_state(show, 0);
  for (const SeenSky sky : kEverySky)
    if (plan_frame(show, state)[sky].lit()) renderer.load_sky(sky);
  TimedFrame best{{}, std::numeric_limits<double>::infinity()};
  for (int k = 0; k < repeats; ++k) {
    const double start = cpu_seconds();
    best.frame = renderer.render(state);
    best.seconds = std::min(best.seconds, cpu_seconds() - start);
  }
  return best;
}

// CPU seconds of copying the frame, by the quickest of several rows of copies: the unit of `copies`.
double copy_seconds(const HalfFrame& frame) {
  constexpr std::size_t kRows = 7, kCopies = 64;  // a small frame's copy is shorter than a tick
  HalfFrame copy(frame.width, frame.height);
  [[maybe_unused]] volatile float seen = 0;  // what is read from a copy must have been written
  double best = std::numeric_limits<double>::infinity();
  for (std::size_t row = 0; row < kRows; ++row) {
    const double start = cpu_seconds();
    for (std::size_t k = 0; k < kCopies; ++k) {
      std::memcpy(copy.pixels.data(), frame.pixels.data(),
                  frame.pixels.size() * sizeof(Imath::half));
      seen = copy.pixels[k * 997 % copy.pixels.size()];
    }
    best = std::min(best, (cpu_seconds() - start) / kCopies);
  }
  return best;
}

struct Difference {
  double rms, worst;
};

Difference difference(const GradedFrame& a, const GradedFrame& b, const Projection& projection) {
  double squares = 0, worst = 0, values = 0;
  for (int row = 0; row < a.height; ++row) {
    const ColumnRange inside = inside_columns(projection, row);
    for (int k = 3 * inside.first; k < 3 * (inside.last + 1); ++k, ++values) {
      const double d = std::abs(a.row(row)[k] - b.row(row)[k]) / kWhite;
      squares += d * d, worst = std::max(worst, d);
    }
  }
  return {std::sqrt(squares / values), worst};
}

void append_rows(const View& view, bool quick, std::vector<FrameErrorRow>& rows) {
  const int size = quick ? kQuickSize : kFullSize;
  const Show show = show_of(view, size);
  const Grader grader(show.grade);
  const HalfFrame reference = render(show, kReferenceAntiAliasing, 1).frame;
  const GradedFrame graded_reference = grader.grade(reference);
  const double copy = copy_seconds(reference);
  for (const Setting& setting : settings(quick)) {
    const TimedFrame timed = render(show, setting.anti_aliasing, kRepeats);
    const Difference error =
        difference(grader.grade(timed.frame), graded_reference, show.projection);
    rows.push_back({view.name, setting.name, size, error.rms, error.worst, timed.seconds,
                    timed.seconds / copy});
  }
}

}  // namespace

std::vector<FrameErrorRow> measure_frames(bool quick) {
  std::vector<FrameErrorRow> rows;
  for (const View& view : views(quick)) append_rows(view, quick, rows);
  return rows;
}

}  // namespace domefall
