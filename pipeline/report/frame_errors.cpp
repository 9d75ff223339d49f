#include "pipeline/report/frame_errors.h"

#include <cmath>

#include "pipeline/report/frame_timing.h"
#include "pipeline/show/assets.h"
#include "trajectories/degree.h"

namespace domefall {
namespace {

constexpr int kQuickSize = 256, kFullSize = 1024;
constexpr Repeats kQuickRepeats{3, 1};

struct View {
  const char* name;
  Trajectory trajectory;
  Attitude attitude;
  bool grid;  // whether both skies show the grid; if not, the Milky Way
  bool dome;  // whether it is a dome; if not, the silhouette at 30 M fills a flat frame
};

std::vector<View> views(bool quick) {
  // A quick report has only the first two.
  std::vector<View> all{
      {"30 M, grid", StaticObserver{30}, LookAtHole{}, true, true},
      {"10 M, Milky Way", StaticObserver{10}, LookAtHole{}, false, true},
      {"last stable orbit, Milky Way", CircularOrbit{6}, LookAlongMotion{}, false, true},
      {"at rest at 2.5 M, Milky Way", StaticObserver{2.5}, LookAtHole{}, false, true},
      {"fall at 1 M, two Milky Ways", RadialInfall{1}, LookAtHole{}, false, true},
      {"fall at 0.5 M, two grids", RadialInfall{0.5}, LookAtHole{}, true, true},
      {"fall at 0.1 M, two Milky Ways", RadialInfall{0.1}, LookAtHole{}, false, true},
      {"silhouette seen from 30 M, grid", StaticObserver{30}, LookAtHole{}, true, false}};
  if (quick) all.resize(2);
  return all;
}

struct Setting {
  const char* name;
  AntiAliasing anti_aliasing;
};

// Returns the settings to compare.  Where a setting names difficult pixels, every other pixel has
// one view ray (anti_aliasing_settings.h).
std::vector<Setting> settings(bool quick) {
  std::vector<Setting> all{{"1 view ray", {1, false}},
                           {"2 x 2 in difficult pixels", {2, false}},
                           {"4 x 4 in difficult pixels (default)", {}},
                           {"4 x 4 in difficult pixels, none interpolated", {4, false, true}},
                           {"8 x 8 in difficult pixels", {8, false}}};
  if (!quick) {
    all.push_back({"2 x 2 everywhere", {2, true}});
    all.push_back({"4 x 4 everywhere", {4, true}});
    all.push_back({"8 x 8 everywhere", {8, true}});
  }
  return all;
}

Show show_of_view(const View& view, int size) {
  // The silhouette is 19.3 degrees wide for an observer at rest at 30 M.  There the sine of its
  // radius is L/r with L = sqrt(27) E and E = sqrt(1 - 2/r).
  constexpr double kFlatView = 24 * kDegree;
  Show show;
  show.spacetime = Schwarzschild{};
  if (view.dome)
    show.projection = Domemaster{size};
  else
    show.projection = Stereographic{size, size, kFlatView};
  // The hole stands where Sagittarius A* is, so that the centre of the Milky Way is behind it.
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
    show.sky[SkyRegion::kI].background = GridSky{};
  else
    show.sky[SkyRegion::kI].background = PanoramaSky{shipped_asset(kMilkyWay)};
  show.sky[SkyRegion::kIII] = show.sky[SkyRegion::kI];
  show.grade.config = shipped_asset(kDomeConfig);
  return show;
}

// Appends the rows of a view, whose settings all have the same reference and the same copy.  The
// times are those of all threads together (frame_errors.h).
void append_rows(const View& view, bool quick, std::vector<FrameErrorRow>& rows) {
  const int size = quick ? kQuickSize : kFullSize;
  const Show show = show_of_view(view, size);
  const Grader grader(show.grade);
  // The reference is rendered once, since its time is not used.
  const HalfFrame reference = time_frame(show, kReferenceAntiAliasing, 0, {1}).frame;
  const GradedFrame graded_reference = grader.grade(reference);
  const double copy = copy_seconds(reference);
  for (const Setting& setting : settings(quick)) {
    const TimedFrame timed =
        time_frame(show, setting.anti_aliasing, 0, quick ? kQuickRepeats : Repeats{});
    const FrameDifference error =
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
