// Tests that the productions in shows/ move so that a dome's audience can follow, frame by frame
// and across every joint that is not a dissolve.
//
// They bound what the audience sees.  26 places all around the sky and the hole's two poles (the
// directions to its centre and away from it) are followed to where they appear on the dome, bent,
// aberrated and through the camera.  So they find a leap of the camera, of the place, of the
// velocity or of the clock, but not what cancels, such as an orbit and the camera that follows it.
// Places nearly behind the hole are left out, since their images swing fast around it.
#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <vector>

#include "pipeline/light/aberration.h"
#include "pipeline/light/lens_store.h"
#include "pipeline/show/frame_state.h"
#include "pipeline/show/observer_track.h"
#include "tests/pipeline/show/show_file.h"
#include "tests/source_tree.h"
#include "trajectories/degree.h"

namespace domefall {
namespace {

constexpr double kFramesPerSecond = 30;

// Bounds of a step from one frame to the next, and of its change from one step to the next.
struct Bounds {
  double change, change_of_change;
};
// A dome whose whole image turns by more than 25 degrees per second makes people ill, and a change
// of speed is felt as a jerk from about 2 degrees per second on.
constexpr Bounds kOnDome{25 * kDegree / kFramesPerSecond, 2 * kDegree / kFramesPerSecond};
constexpr Bounds kOnSky = kOnDome;
// The hole grows or shrinks by less than a third in a second.
constexpr Bounds kLogRadius{0.33 / kFramesPerSecond, 0.04 / kFramesPerSecond};
constexpr Bounds kStops{0.15, 0.01};
constexpr double kDark = -10;  // stops: the brightest star is below the last step of 8 bits
// Sources nearer than this to the point behind the hole are not followed.
constexpr double kBehindHole = 50 * kDegree;

struct Mark {
  V3d at{0, 0, 0};  // on the dome, camera axes
  bool seen = false;
};

struct View {
  std::vector<Mark> marks;  // the two poles first
  SkyRegion sky{};          // whose places the others are
  V3d place;
  double log_r = 0, ev = 0;
};

Mark on_dome(const ObserverState& o, const V3d& in_tetrad) {
  return {apply_transposed(o.tetrad_from_camera, to_observer(o.celerity, in_tetrad).direction),
          true};
}

View view_of(const FrameState& s) {
  const ObserverState& o = s.observer;
  View view;
  view.place = column(o.sky_from_tetrad, 0);
  view.log_r = std::log(o.r);
  view.ev = s.settings.ev;
  view.marks = {on_dome(o, {-1, 0, 0}), on_dome(o, {1, 0, 0})};
  const auto lens = LensStore().lens(o, {{false, false, false}});
  const bool sky = !(is_outgoing(o.tetrad) && o.r <= 2);
  view.sky = own_sky(o);
  for (int k = 0; k < 27; ++k) {
    const int row = k / 3 % 3, layer = k / 9;
    const V3d corner(k % 3 - 1, row - 1, layer - 1);
    if (!(corner.length() > 0)) continue;
    const V3d source = apply_transposed(sky_axes(o, view.sky), corner.normalized());
    const bool behind = std::acos(std::clamp(-source.x, -1.0, 1.0)) < kBehindHole;
    view.marks.push_back(sky && !behind ? on_dome(o, lens->primary_image(source)) : Mark{});
  }
  return view;
}

double angle(const V3d& a, const V3d& b) { return 2 * std::asin((a - b).length() / 2); }

struct Worst {
  double change = 0, change_of_change = 0;
  int frame = 0, frame_of_change = 0;
  void take(int n, double first, double second) {
    if (!(first <= change)) change = first, frame = n;
    if (!(second <= change_of_change)) change_of_change = second, frame_of_change = n;
  }
};

struct Motion {
  Worst dome, sky, log_r, stops;
};

// Compares what three frames in a row show.
void compare(const View& a, const View& b, const View& c, int n, Motion& motion) {
  const auto turn = [](const V3d& x, const V3d& y, const V3d& z) {
    return (x - y * 2 + z).length();
  };
  // In the throat of a wormhole the observer's own sky becomes another.
  const std::size_t marks = a.sky == b.sky && b.sky == c.sky ? b.marks.size() : 2;
  for (std::size_t k = 0; k < marks; ++k) {
    const Mark &x = a.marks[k], &y = b.marks[k], &z = c.marks[k];
    if (x.seen && y.seen && z.seen) motion.dome.take(n, angle(y.at, z.at), turn(x.at, y.at, z.at));
  }
  motion.sky.take(n, angle(b.place, c.place), turn(a.place, b.place, c.place));
  const auto numbers = [n](Worst& worst, double x, double y, double z) {
    worst.take(n, std::abs(z - y), std::abs(x - 2 * y + z));
  };
  numbers(motion.log_r, a.log_r, b.log_r, c.log_r);
  numbers(motion.stops, a.ev, b.ev, c.ev);
}

bool dissolves_between(const Show& show, int from, int to) {
  for (int k = from + 1; k <= to; ++k)
    if (show.timeline[static_cast<std::size_t>(k)].dissolve_s > 0) return true;
  return false;
}

bool begins_or_ends(const Curve& curve, double t, double near) {
  return std::any_of(curve.keys.begin(), curve.keys.end(),
                     [&](const auto& key) { return std::abs(key.at_s - t) < near; });
}

// Whether something may begin or end at a frame, which is within three frames of a joint or a
// keyframe.
bool is_critical(const Show& show, double t) {
  const double near = 3.5 / kFramesPerSecond;
  for (const double join : segment_times(show))
    if (std::abs(join - t) < near) return true;
  const Segment& s = show.timeline[static_cast<std::size_t>(segment_at(show, t))];
  for (const auto& curve : s.curves.values)
    if (curve && begins_or_ends(*curve, t, near)) return true;
  return std::any_of(s.attitudes.begin(), s.attitudes.end(),
                     [&](const auto& key) { return std::abs(key.at_s - t) < near; });
}

// All frames where something may begin or end, and four of each twelve in between.
Motion camera_motion(const Show& show, int first = 0, int end = 1 << 30) {
  Motion motion;
  std::vector<View> last;
  int segment = 0;
  for (int n = first; n < std::min(end, frame_count(show)); ++n) {
    if (n % 12 >= 4 && !is_critical(show, n / kFramesPerSecond)) {
      last.clear();
      continue;
    }
    const FrameState s = frame_state(show, n);
    if (dissolves_between(show, segment, s.segment)) last.clear();
    segment = s.segment;
    last.push_back(view_of(s));
    if (last.size() > 3) last.erase(last.begin());
    if (last.size() == 3) compare(last[0], last[1], last[2], n, motion);
  }
  return motion;
}

std::string text_of(const std::string& name) {
  std::ifstream in(source_file("shows/") + name + ".yaml");
  return {std::istreambuf_iterator<char>(in), {}};
}

Show production(const std::string& name) {
  return read_show(source_file("shows/") + name + ".yaml");
}

class SmoothShows : public ShowFile, public testing::WithParamInterface<const char*> {
 protected:
  SmoothShows() { unsetenv("DOMEFALL_ASSETS"); }
};

void expect_within(const char* what, const Worst& worst, const Bounds& bounds) {
  EXPECT_LE(worst.change, bounds.change) << what << " at frame " << worst.frame;
  EXPECT_LE(worst.change_of_change, bounds.change_of_change)
      << what << " jerks at frame " << worst.frame_of_change;
}

TEST_P(SmoothShows, NothingLeapsOrJerks) {
  const Motion motion = camera_motion(production(GetParam()));
  expect_within("the scene on the dome", motion.dome, kOnDome);
  expect_within("the place on the sky", motion.sky, kOnSky);
  expect_within("log r", motion.log_r, kLogRadius);
  expect_within("the exposure", motion.stops, kStops);
}

TEST_P(SmoothShows, LastsOneToThreeMinutesBetweenDarkAndDark) {
  const Show show = production(GetParam());
  EXPECT_EQ(show.frames_per_second, kFramesPerSecond);
  const int frames = frame_count(show);
  EXPECT_GE(frames, 60 * kFramesPerSecond);
  EXPECT_LE(frames, 180 * kFramesPerSecond);
  for (const int frame : {0, frames - 1}) {
    const FrameState state = frame_state(show, frame);
    EXPECT_LE(state.settings.ev + std::log2(state.fade), kDark) << frame;
  }
}

INSTANTIATE_TEST_SUITE_P(Productions, SmoothShows,
                         testing::Values("into_the_dark", "flyby", "kruskal_journey",
                                         "there_and_back"),
                         [](const auto& show) { return std::string(show.param); });

// From beyond the camera looks back at the mouth, in the middle of the front half way up the dome.
using ThereAndBack = SmoothShows;
TEST_F(ThereAndBack, LooksBackAtTheMouth) {
  const Show show = production("there_and_back");
  for (const double at_s : {92.0, 97.0, 102.0}) {
    const FrameState state = frame_state(show, static_cast<int>(at_s * kFramesPerSecond));
    EXPECT_EQ(state.observer.region, Region::kIII);
    const V3d mouth = on_dome(state.observer, {1, 0, 0}).at;
    EXPECT_LT(angle(mouth, {0, std::cos(45 * kDegree), std::sin(45 * kDegree)}), 0.01) << at_s;
  }
}

using AJumpEditedIn = SmoothShows;

std::string edited(std::string text, const std::string& from, const std::string& to) {
  const auto at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  return at == std::string::npos ? text : text.replace(at, from.size(), to);
}

// A leap of each kind is found near the place where it was made.
TEST_F(AJumpEditedIn, IsFound) {
  const std::string text = text_of("into_the_dark");
  const auto motion = [&](const char* from, const char* to, int second) {
    const int n = second * static_cast<int>(kFramesPerSecond);
    return camera_motion(read(edited(text, from, to)), n - 60, n + 60);
  };
  const Motion clock = motion("rate_m_per_s: [4.1, 1.6]", "rate_m_per_s: [2.85, 2.85]", 57);
  EXPECT_GT(clock.dome.change_of_change, kOnDome.change_of_change);
  const Motion speed =
      motion("azimuth_deg: 0, speed: 0.4472135955", "azimuth_deg: 0, speed: 0.25", 36);
  EXPECT_GT(speed.dome.change_of_change, kOnDome.change_of_change);
  const Motion radius = motion("rest_r: 6", "rest_r: 5.8", 107);
  EXPECT_GT(radius.log_r.change, kLogRadius.change);
  const Motion flash = motion("elevation_deg: -20}}", "elevation_deg: -20}, ease: hold}", 136);
  EXPECT_GT(flash.stops.change, kStops.change);
  const Motion camera =
      motion("camera: {look_at: motion}}", "camera: {look_at: motion}, ease: hold}", 77);
  EXPECT_GT(camera.dome.change, kOnDome.change);
}

}  // namespace
}  // namespace domefall
