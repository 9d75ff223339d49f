#include "pipeline/diagram/path.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "pipeline/show/frame_state.h"
#include "pipeline/show/placement.h"

namespace domefall {
namespace {

// A show's length in ticks.  A power of two above any number of frames and below the greatest int.
constexpr int kTicks = 1 << 30;
constexpr int kEvenly = 2000, kLeastOfSegment = 48;
constexpr std::size_t kMostPoints = 100'000;
constexpr double kTurn = 2 * std::numbers::pi, kDegree = std::numbers::pi / 180;

double seconds_of(const Show& show) {
  double sum = 0;
  for (const Segment& s : show.timeline) sum += s.duration_s;
  return sum;
}

// What a tick of a show is like.
struct Instant {
  PathPoint point;
  Tetrad tetrad = Tetrad::kRain;
  double null_time = 0;
};

// Answers for instants between the frames: the same show at a frame rate of one frame per tick.  No
// camera target is sought.
class Instants {
 public:
  explicit Instants(const Show& show)
      : show_(show),
        origin_(place_tetrad(show.hole_at, show.heading, 0)),
        seconds_(seconds_of(show)) {
    show_.frames_per_second = kTicks / seconds_;
    for (Segment& s : show_.timeline) s.camera.attitude = EulerAngles{};
  }

  Instant at(int tick) const {
    const FrameState state = frame_state(show_, tick);
    const ObserverState& o = state.observer;
    const Segment& segment = show_.timeline[static_cast<std::size_t>(state.segment)];
    const V3d place = column(o.sky_from_tetrad, 0);
    Instant i;
    i.tetrad = o.tetrad;
    i.null_time = o.null_time;
    i.point.time_s = state.show_time_s;
    i.point.segment = state.segment;
    i.point.region = o.region;
    i.point.r = o.r;
    i.point.azimuth = std::atan2(place.dot(column(origin_, 2)), place.dot(column(origin_, 0)));
    i.point.swept = point_at(segment.trajectory, o.proper_time).azimuth;
    const double celerity = o.celerity.length();
    i.point.speed = celerity / std::hypot(1.0, celerity);
    return i;
  }

  double seconds() const { return seconds_; }

  int tick_at(double time_s) const {
    return static_cast<int>(std::llround(std::clamp(time_s / seconds_, 0.0, 1.0) * kTicks));
  }

  // The first tick of each segment, and one behind the last.
  std::vector<int> segment_starts() const {
    std::vector<int> starts{0};
    double end = 0;
    for (const Segment& s : show_.timeline) {
      end += s.duration_s;
      starts.push_back(static_cast<int>(std::ceil(end / seconds_ * kTicks - 0.5)));
    }
    starts.back() = kTicks + 1;
    return starts;
  }

 private:
  Show show_;
  M33d origin_;
  double seconds_;
};

// ---- the origin of t ----

double sense_of_t(Tetrad t) { return is_mirrored(t) ? -1 : 1; }

// t of an instant away from the horizon; on it v or u itself.
double killing_time(const Instant& i) {
  const double star = i.point.r == 2 ? 0 : tortoise(i.point.r);
  return sense_of_t(i.tetrad) * (is_outgoing(i.tetrad) ? i.null_time + star : i.null_time - star);
}

bool is_inside(Region region) { return region == Region::kII || region == Region::kIV; }

// v or u at which a horizon is crossed between two ticks, one of them inside, by bisection.
double crossing_time(const Instants& show, int a, int b) {
  const Region before = show.at(a).point.region;
  while (b - a > 1) {
    const int middle = a + (b - a) / 2;
    (show.at(middle).point.region == before ? a : b) = middle;
  }
  const Instant inner = show.at(is_inside(before) ? a : b);
  return sense_of_t(inner.tetrad) * inner.null_time;
}

// The crossings of the first uncut run of segments that has any, in order.
std::vector<double> first_crossings(const Instants& show, const std::vector<int>& ticks) {
  std::vector<double> times;
  Instant before = show.at(ticks[0]);
  for (std::size_t k = 1; k < ticks.size(); ++k) {
    const Instant now = show.at(ticks[k]);
    if (is_jump(before.point, now.point)) {
      if (!times.empty()) break;
    } else if (is_inside(before.point.region) != is_inside(now.point.region)) {
      times.push_back(crossing_time(show, ticks[k - 1], ticks[k]));
    }
    before = now;
  }
  return times;
}

void choose_origin_of_time(const Instants& show, const std::vector<int>& ticks, Path& path) {
  constexpr double kBothVisible = 16;  // U of one is e^4 times that of the other
  const std::vector<double> crossings = first_crossings(show, ticks);
  double centre = 0;
  if (crossings.empty()) {
    centre = killing_time(show.at(kTicks / 2));
  } else if (crossings.size() > 1 &&
             std::abs(crossings.back() - crossings.front()) < kBothVisible) {
    path.centre = Path::Centre::kTwoCrossings;
    centre = (crossings.front() + crossings.back()) / 2;
  } else {
    path.centre = Path::Centre::kCrossing;
    centre = crossings.back();
  }
  path.time_shift = -centre;
}

// ---- sampling ----

std::vector<int> even_ticks(const Instants& show) {
  const std::vector<int> starts = show.segment_starts();
  std::vector<int> ticks;
  for (std::size_t k = 0; k + 1 < starts.size(); ++k) {
    const long first = starts[k], last = std::max(starts[k + 1] - 1, starts[k]);
    const long steps = std::max<long>(kLeastOfSegment, (last - first) * kEvenly / kTicks);
    for (long i = 0; i <= steps; ++i) {
      // Out of step with any period that the orbit has: multiples of the golden ratio.
      const double turns = static_cast<double>(i) * std::numbers::phi;
      const double aside = i == 0 || i == steps ? 0 : turns - std::floor(turns) - 0.5;
      const double part = (static_cast<double>(i) + aside) / static_cast<double>(steps);
      ticks.push_back(
          static_cast<int>(first + std::lround(part * static_cast<double>(last - first))));
    }
  }
  std::sort(ticks.begin(), ticks.end());
  ticks.erase(std::unique(ticks.begin(), ticks.end()), ticks.end());
  return ticks;
}

// Adds the instants from a (excluded) to b (included) that a smooth curve needs.
class Sampler {
 public:
  Sampler(const Instants& show, Path& path) : show_(show), path_(path) {}

  PathPoint at(int tick) const {
    const Instant i = show_.at(tick);
    PathPoint p = i.point;
    p.is_in_drawn_turn = p.swept < begin_ || p.swept > end_;
    if (p.r != kFlatSpace)
      p.penrose = penrose_point(p.region, i.tetrad, p.r,
                                i.null_time + sense_of_t(i.tetrad) * path_.time_shift);
    return p;
  }

  void begin_segment(double swept_first, double swept_last) {
    begin_ = swept_first + kTurnsDrawn * kTurn;
    end_ = swept_last - kTurnsDrawn * kTurn;
    if (begin_ < end_) path_.has_gaps_in_plane = true;
  }

  void add(int tick_a, const PathPoint& a, int tick_b, const PathPoint& b) {
    if (tick_b - tick_a > 1 && path_.points.size() < kMostPoints && is_coarse(a, b)) {
      const int middle = tick_a + (tick_b - tick_a) / 2;
      const PathPoint m = at(middle);
      add(tick_a, a, middle, m);
      add(middle, m, tick_b, b);
    } else {
      path_.points.push_back(b);
    }
  }

 private:
  bool is_coarse(const PathPoint& a, const PathPoint& b) const {
    if (a.r == kFlatSpace) return false;
    const bool bends =
        std::abs(b.swept - a.swept) > 2.5 * kDegree || std::abs(std::log(b.r / a.r)) > 0.04;
    return (bends && (a.is_in_drawn_turn || b.is_in_drawn_turn)) ||
           std::hypot(b.penrose.x - a.penrose.x, b.penrose.up - a.penrose.up) > 1.0 / 150;
  }

  const Instants& show_;
  Path& path_;
  double begin_ = 0, end_ = 0;  // between them turns are not drawn
};

void sample_finely(const Instants& show, const std::vector<int>& ticks, Path& path) {
  Sampler sampler(show, path);
  PathPoint before;
  for (std::size_t k = 0; k < ticks.size(); ++k) {
    const PathPoint now = sampler.at(ticks[k]);
    const PathPoint last_one = std::exchange(before, now);
    if (k > 0 && last_one.segment == now.segment) {
      sampler.add(ticks[k - 1], last_one, ticks[k], now);
      continue;
    }
    std::size_t last = k;
    while (last + 1 < ticks.size() && show.at(ticks[last + 1]).point.segment == now.segment) ++last;
    sampler.begin_segment(now.swept, show.at(ticks[last]).point.swept);
    path.points.push_back(now);
    path.points.back().is_in_drawn_turn = before.is_in_drawn_turn = true;
  }
}

void mark_instants(const Instants& show, Path& path) {
  constexpr int kMost = 16;
  const Sampler sampler(show, path);
  path.instant_step_s = round_step(show.seconds() / kMost);
  for (int i = 0; i * path.instant_step_s < show.seconds(); ++i)
    path.instants.push_back(sampler.at(show.tick_at(i * path.instant_step_s)));
}

struct KindName {
  std::string operator()(const StaticObserver&) const { return "static"; }
  std::string operator()(const CircularOrbit&) const { return "circular"; }
  std::string operator()(const RadialInfall&) const { return "infall"; }
  std::string operator()(const GivenVelocity&) const { return "velocity"; }
  std::string operator()(const SpeedRamp&) const { return "velocity"; }
  std::string operator()(const AcceleratedPath&) const { return "keyframes"; }
  template <class Other>
  std::string operator()(const Other&) const {
    return "orbit";
  }
};

}  // namespace

bool is_jump(const PathPoint& a, const PathPoint& b) {
  if (a.segment == b.segment || a.r == b.r) return a.region != b.region && a.segment != b.segment;
  return a.region != b.region || std::abs(b.r - a.r) > 1e-6 * a.r;
}

bool is_joined(const PathPoint& a, const PathPoint& b) { return !is_jump(a, b); }

bool is_joined_in_plane(const PathPoint& a, const PathPoint& b) {
  constexpr double kWidest = 10 * kDegree;
  return a.is_in_drawn_turn && b.is_in_drawn_turn && is_joined(a, b) &&
         (a.segment != b.segment || std::abs(b.swept - a.swept) < kWidest);
}

Path sample_path(const Show& show) {
  const Instants instants(show);
  const std::vector<int> ticks = even_ticks(instants);
  Path path;
  if (show.mass_solar) choose_origin_of_time(instants, ticks, path);
  sample_finely(instants, ticks, path);
  mark_instants(instants, path);
  return path;
}

std::string trajectory_kind(const Segment& segment) {
  return std::visit(KindName{}, segment.trajectory);
}

double round_step(double least) {
  const double power = std::pow(10, std::floor(std::log10(least)));
  for (const double factor : {1.0, 2.0, 5.0})
    if (factor * power >= least * (1 - 1e-9)) return factor * power;
  return 10 * power;
}

}  // namespace domefall
