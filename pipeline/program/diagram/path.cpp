#include "pipeline/program/diagram/path.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <span>
#include <tuple>
#include <utility>

#include "pipeline/show/observer_track.h"
#include "pipeline/show/placement.h"
#include "pipeline/spacetime/conformal.h"
#include "trajectories/degree.h"

namespace domefall {

std::optional<ChargedHole> two_horizons(const Spacetime& spacetime) {
  if (const auto* charged = std::get_if<ChargedHole>(&spacetime.kind())) return *charged;
  if (const auto* spinning = std::get_if<SpinningHole>(&spacetime.kind()))
    return ChargedHole(spinning->mass_solar, std::sqrt(spinning->kerr.squares()));
  return std::nullopt;
}

namespace {

// A segment has this many ticks.
constexpr int kTicks = 1 << 30;
constexpr int kEvenly = 2000, kLeastOfSegment = 48;
constexpr std::size_t kMostPoints = 100'000;
constexpr double kTurn = 2 * std::numbers::pi;

// A Tick is an instant of a segment.  Where segments dissolve, two ticks are the same instant of
// the show.
struct Tick {
  int segment = 0, tick = 0;

  bool operator==(const Tick&) const = default;
  bool operator<(const Tick& other) const {
    return std::tie(segment, tick) < std::tie(other.segment, other.tick);
  }
};

// An Instant is the state of the observer at a tick.
struct Instant {
  PathPoint point;
  Tetrad tetrad = Tetrad::kRain;
  double null_time = 0;
  double l = 0;  // of a wormhole
};

// Returns axes of which R and Phi are in the plane that is seen from above.
M33d seen_from_above(const Show& show) {
  const M33d axes = place_tetrad(show.hole_at, show.heading, 0);
  const auto* hole = std::get_if<SpinningHole>(&show.spacetime.kind());
  return hole ? moved_about(axis_of(*hole), axes, std::numbers::pi / 2, 0) : axes;
}

// Instants give the state of the observer at any tick, between the frames too.  It does not depend
// on the camera.
class Instants {
 public:
  explicit Instants(const Show& show)
      : show_(show), origin_(seen_from_above(show)), times_(segment_times(show)) {}

  Instant at(const Tick& tick) const {
    const Segment& segment = show_.timeline[static_cast<std::size_t>(tick.segment)];
    const double part = static_cast<double>(tick.tick) / kTicks;
    const ObserverState o = observer_at(show_, tick.segment, part);
    const V3d place = column(o.sky_from_tetrad, 0);
    Instant i;
    i.tetrad = o.tetrad;
    i.null_time = o.null_time;
    i.l = o.l;
    i.point.time_s = times_[static_cast<std::size_t>(tick.segment)] + part * segment.duration_s;
    i.point.segment = tick.segment;
    i.point.region = o.region;
    i.point.universe = o.universe;
    i.point.r = o.r;
    i.point.azimuth = std::atan2(place.dot(column(origin_, 2)), place.dot(column(origin_, 0)));
    if (const auto* hole = std::get_if<SpinningHole>(&show_.spacetime.kind())) {
      const double theta = polar_angle(o, *hole);
      i.point.sine = std::sin(theta), i.point.cosine = std::cos(theta);
    }
    i.point.swept = point_at(segment.trajectory, proper_time_at(segment, part)).azimuth;
    const double celerity = o.celerity.length();
    i.point.speed = speed_of(celerity);
    return i;
  }

  const Spacetime& spacetime() const { return show_.spacetime; }
  double seconds() const { return times_.back(); }
  int segments() const { return static_cast<int>(show_.timeline.size()); }
  double part_of_show(int segment) const {
    return show_.timeline[static_cast<std::size_t>(segment)].duration_s / seconds();
  }

  // Returns the tick of the segment that a frame at that time shows.  While two segments dissolve,
  // it is that of the later one.
  Tick tick_at(double time_s) const {
    const int segment = segment_at(show_, time_s);
    return {segment, static_cast<int>(std::lround(part_at(show_, segment, time_s) * kTicks))};
  }

  // Returns the last tick of a segment.  It is just before the end, unless the segment is the last,
  // because the end belongs to the next one.
  int last_tick(int segment) const { return segment + 1 < segments() ? kTicks - 1 : kTicks; }

 private:
  const Show& show_;
  M33d origin_;
  std::vector<double> times_;
};

// ---- the origin of t ----

double sense_of_t(Tetrad t) { return is_mirrored(t) ? -1 : 1; }

// Returns t of an instant away from the horizons, from v = t + r* or u = t - r*.  On a horizon, where
// r* is infinite, it returns v or u itself.
double killing_time(const Spacetime& spacetime, const Instant& i) {
  if (spacetime.is<Wormhole>()) return i.null_time - i.l;
  const double r_star = spacetime.tortoise(i.point.r), star = std::isfinite(r_star) ? r_star : 0;
  return sense_of_t(i.tetrad) * (is_outgoing(i.tetrad) ? i.null_time + star : i.null_time - star);
}

// These are the points of the diagrams of each kind of spacetime.
PenrosePoint place_in(const FlatSpace&, const Instant&, double) { return {}; }
PenrosePoint place_in(const Schwarzschild&, const Instant& i, double time_shift) {
  return penrose_point(i.point.region, i.tetrad, i.point.r,
                       i.null_time + sense_of_t(i.tetrad) * time_shift);
}
PenrosePoint place_in(const ChargedHole& hole, const Instant& i, double time_shift) {
  return penrose_point(hole, i.point.region, i.point.universe, i.tetrad, i.point.r,
                       i.null_time + sense_of_t(i.tetrad) * time_shift);
}
PenrosePoint place_in(const SpinningHole& hole, const Instant& i, double time_shift) {
  return place_in(*two_horizons(Spacetime(hole)), i, time_shift);
}
PenrosePoint place_in(const Wormhole& wormhole, const Instant& i, double time_shift) {
  return penrose_point(wormhole, i.null_time - i.l + time_shift, i.l);
}

// Returns the v or u at which the outer horizon is crossed between two ticks of a segment, of which
// one is outside.  It is found by bisection.
double crossing_time(const Instants& show, Tick a, Tick b) {
  const Region before = show.at(a).point.region;
  while (b.tick - a.tick > 1) {
    const Tick middle{a.segment, a.tick + (b.tick - a.tick) / 2};
    (show.at(middle).point.region == before ? a : b) = middle;
  }
  const Instant inner = show.at(is_outside(before) ? b : a);
  return sense_of_t(inner.tetrad) * inner.null_time;
}

std::vector<double> crossings_of(const Instants& show, std::span<const Tick> run) {
  std::vector<double> times;
  for (std::size_t k = 1; k < run.size(); ++k)
    if (run[k - 1].segment == run[k].segment &&
        is_outside(show.at(run[k - 1]).point.region) != is_outside(show.at(run[k]).point.region))
      times.push_back(crossing_time(show, run[k - 1], run[k]));
  return times;
}

Origin kruskal_origin(const Instants& show, std::span<const Tick> run) {
  constexpr double kBothVisible = 16;  // M; U at one crossing is then e^4 times U at the other
  std::vector<double> crossings;
  // All of a wormhole is outside, on either side.
  if (!show.spacetime().is<Wormhole>()) crossings = crossings_of(show, run);
  // Where universes follow each other, the first passage counts.
  if (crossings.size() > 2) crossings.resize(2);
  if (crossings.empty())
    return {-killing_time(show.spacetime(), show.at(run[run.size() / 2])), Origin::Centre::kMiddle};
  if (crossings.size() > 1 && std::abs(crossings.back() - crossings.front()) < kBothVisible)
    return {-(crossings.front() + crossings.back()) / 2, Origin::Centre::kTwoCrossings};
  return {-crossings.back(), Origin::Centre::kCrossing};
}

// Returns the origin for each segment, which is that of its run.
std::vector<Origin> origins_of_time(const Instants& show, const std::vector<Tick>& ticks) {
  std::vector<Origin> origins(static_cast<std::size_t>(show.segments()));
  std::size_t first = 0;
  for (std::size_t k = 1; k <= ticks.size(); ++k) {
    const bool goes_on =
        k < ticks.size() && !is_jump(show.at(ticks[k - 1]).point, show.at(ticks[k]).point);
    if (goes_on) continue;
    const Origin origin = kruskal_origin(show, std::span(ticks).subspan(first, k - first));
    for (int segment = ticks[first].segment; segment <= ticks[k - 1].segment; ++segment)
      origins[static_cast<std::size_t>(segment)] = origin;
    first = k;
  }
  return origins;
}

// ---- sampling ----

std::vector<Tick> even_ticks(const Instants& show) {
  std::vector<Tick> ticks;
  for (int segment = 0; segment < show.segments(); ++segment) {
    const int last = show.last_tick(segment);
    const int steps =
        std::max(kLeastOfSegment, static_cast<int>(show.part_of_show(segment) * kEvenly));
    for (int i = 0; i <= steps; ++i) {
      // Multiples of the golden ratio are out of step with any period that the orbit has.
      const double turns = i * std::numbers::phi;
      const double aside = i == 0 || i == steps ? 0 : turns - std::floor(turns) - 0.5;
      ticks.push_back({segment, static_cast<int>(std::lround((i + aside) / steps * last))});
    }
  }
  std::sort(ticks.begin(), ticks.end());
  ticks.erase(std::unique(ticks.begin(), ticks.end()), ticks.end());
  return ticks;
}

// A Sampler adds to a path the points that smooth curves need.
class Sampler {
 public:
  Sampler(const Instants& show, Path& path) : show_(show), path_(path) {}

  PathPoint at(const Tick& tick) const {
    const Instant i = show_.at(tick);
    PathPoint p = i.point;
    p.is_in_drawn_turn = p.swept < begin_ || p.swept > end_;
    if (p.r != kFlatSpace)
      p.penrose =
          std::visit([&](const auto& kind) { return place_in(kind, i, shift_of(p.segment)); },
                     show_.spacetime().kind());
    return p;
  }

  void begin_segment(double swept_first, double swept_last) {
    begin_ = swept_first + kTurnsDrawn * kTurn;
    end_ = swept_last - kTurnsDrawn * kTurn;
    if (begin_ < end_) path_.has_gaps_in_plane = true;
  }

  void add(const Tick& tick_a, const PathPoint& a, const Tick& tick_b, const PathPoint& b) {
    if (tick_b.tick - tick_a.tick > 1 && path_.points.size() < kMostPoints && is_coarse(a, b)) {
      const Tick middle{tick_a.segment, tick_a.tick + (tick_b.tick - tick_a.tick) / 2};
      const PathPoint m = at(middle);
      add(tick_a, a, middle, m);
      add(middle, m, tick_b, b);
    } else {
      path_.points.push_back(b);
    }
  }

 private:
  double shift_of(int segment) const {
    return path_.origins[static_cast<std::size_t>(segment)].time_shift;
  }

  bool is_coarse(const PathPoint& a, const PathPoint& b) const {
    if (a.r == kFlatSpace) return false;
    const bool bends =
        std::abs(b.swept - a.swept) > 2.5 * kDegree || std::abs(std::log(b.r / a.r)) > 0.04;
    return (bends && (a.is_in_drawn_turn || b.is_in_drawn_turn)) ||
           std::hypot(b.penrose.x - a.penrose.x, b.penrose.up - a.penrose.up) > 1.0 / 150;
  }

  const Instants& show_;
  Path& path_;
  double begin_ = 0, end_ = 0;  // turns between these are not drawn
};

void sample_finely(const Instants& show, const std::vector<Tick>& ticks, Path& path) {
  Sampler sampler(show, path);
  PathPoint before;
  for (std::size_t k = 0; k < ticks.size(); ++k) {
    const PathPoint now = sampler.at(ticks[k]);
    const PathPoint last_one = std::exchange(before, now);
    if (k > 0 && last_one.segment == now.segment) {
      sampler.add(ticks[k - 1], last_one, ticks[k], now);
      continue;
    }
    const Tick last{now.segment, show.last_tick(now.segment)};
    sampler.begin_segment(now.swept, show.at(last).point.swept);
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

}  // namespace

bool is_jump(const PathPoint& a, const PathPoint& b) {
  if (a.segment == b.segment) return false;
  if (a.region != b.region && !are_apart(a.region, b.region)) return true;
  return a.r != b.r && std::abs(b.r - a.r) > 1e-6 * a.r;
}

bool is_joined(const PathPoint& a, const PathPoint& b) { return !is_jump(a, b); }

bool is_joined_in_plane(const PathPoint& a, const PathPoint& b) {
  constexpr double kWidest = 10 * kDegree;
  return a.is_in_drawn_turn && b.is_in_drawn_turn && is_joined(a, b) &&
         (a.segment != b.segment || std::abs(b.swept - a.swept) < kWidest);
}

Path sample_path(const Show& show) {
  const Instants instants(show);
  const std::vector<Tick> ticks = even_ticks(instants);
  Path path;
  if (!show.spacetime.is_flat()) path.origins = origins_of_time(instants, ticks);
  sample_finely(instants, ticks, path);
  mark_instants(instants, path);
  return path;
}

double round_step(double least) {
  const double power = std::pow(10, std::floor(std::log10(least)));
  for (const double factor : {1.0, 2.0, 5.0})
    if (factor * power >= least * (1 - 1e-9)) return factor * power;
  return 10 * power;
}

}  // namespace domefall
