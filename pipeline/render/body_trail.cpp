#include "pipeline/render/body_trail.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include "pipeline/render/stars/star_trail.h"

namespace domefall {
namespace {

using std::numbers::pi;

// A trail begins with so many parts, which are halved at most so often.
constexpr int kParts = 8, kMostHalvings = 14;
// The pieces of a trail are this far apart, in units of the least sigma, and their light differs by
// at most this part of it.
constexpr double kSpacing = 1.2, kFluxStep = 0.1;
// Images of a disc that the axis goes through are arcs, which overlap where the body has moved by
// this part of its radius.
constexpr double kRadiusStep = 1.0 / 8;

// Returns the component across the axis of the body's direction from the hole, in the tetrad.
V3d off_axis(const BodyImage& image) { return image.across * std::sin(image.psi); }

}  // namespace

BodyTrails::Moment::Moment(const FrameScene& scene, double frames, CameraMotion camera)
    : state(scene.state),
      sight((state.observer = scene.body_times.at(frames, camera), state), scene.effects,
            scene.least_star_radius) {}

double BodyTrails::Window::weight(double from, double to) const {
  const auto up_to = [this](double frames) {
    const double left = 1 - std::min(1.0, std::abs(frames) / half);
    const double beyond = std::pow(left, sharpness + 1) / 2;
    return frames < 0 ? beyond : 1 - beyond;
  };
  return up_to(to) - up_to(from);
}

// A shutter that is open for a shorter time lets all of its light in meanwhile.  For a passage, the
// time beyond the segment has the light of its mirror image about the passage, so that one near a
// segment's end gives a frame as much light as elsewhere.
double BodyTrails::Window::share_of(double from, double to) const {
  if (camera == CameraMotion::kMoves) return weight(from, to) / weight(begin, end);
  const double low = 2 * nearest - to, high = 2 * nearest - from;
  double share = weight(from, to);
  if (low < begin) share += weight(low, std::min(high, begin));
  if (high > end) share += weight(std::max(low, end), high);
  return share;
}

BodyTrails::BodyTrails(const FrameScene& scene)
    : scene_(scene), now_(scene.state, scene.effects, scene.least_star_radius) {}

const BodyTrails::Moment& BodyTrails::moment_at(double frames, CameraMotion camera) {
  auto& moment = moments_[{frames, camera}];
  if (!moment) moment = std::make_unique<const Moment>(scene_, frames, camera);
  return *moment;
}

// A camera that stays where it is needs directions against one tetrad.
BodyTrails::Node BodyTrails::node(const Body& body, int order, double frames, CameraMotion camera,
                                  const std::optional<double>& emitted) {
  const Moment& moment = moment_at(frames, camera);
  Node node{frames, &moment.sight, {}};
  const bool goes_on = camera == CameraMotion::kMoves ||
                       moment.state.observer.tetrad == scene_.state.observer.tetrad;
  if (goes_on && moment.sight.sees()) node.image = moment.sight.image(body, order, emitted);
  if (!node.image) return node;
  const BodySight::Seen seen = node.sight->seen(node.image->at);
  node.seen = seen.direction;
  node.flux = seen.brightening;
  node.off_axis = off_axis(node.image->traced);
  return node;
}

// The motion is measured over kStep frames.
std::optional<BodyTrails::Passage> BodyTrails::passage_of(const Body& body, int order) {
  constexpr double kStep = 0.25;
  const Node before = node_within(body, order, -kStep / 2, CameraMotion::kStays),
             now = node_within(body, order, 0, CameraMotion::kStays),
             after = node_within(body, order, kStep / 2, CameraMotion::kStays);
  const double passed = after.frames - before.frames;
  if (!before.image || !now.image || !after.image || !(passed > 0)) return std::nullopt;
  const V3d moved = (after.off_axis - before.off_axis) / passed;
  return Passage{now.off_axis.length(), moved.length(),
                 -now.off_axis.dot(moved) / std::max(moved.length2(), 1e-300)};
}

// The window is that of a star whose path from frame to frame and distance from the axis are the
// same.  The two orders whose images meet in a ring have one window, so that the ring has no seams.
std::optional<BodyTrails::Window> BodyTrails::passage_window_of(const Body& body, int order,
                                                                const BodyImage& image) {
  if (now_.lists_images()) return std::nullopt;
  const int half_turns = static_cast<int>(std::lround(image.psi / pi));
  if (half_turns < 1 || scene_.effects.amplification == Amplification::kNone ||
      !(off_axis(image).length() < kFarthestPassage))
    return std::nullopt;
  const auto own = passage_of(body, order),
             other = passage_of(body, order == half_turns ? order - 1 : order + 1);
  if (!own) return std::nullopt;
  const double sine = std::midpoint(own->sine, other.value_or(*own).sine),
               way = std::midpoint(own->way, other.value_or(*own).way),
               radius = now_.radius_of(body) / image.r;
  if (!(sine < kFarthestPassage && kWindow * way > radius)) return std::nullopt;
  const auto [half, sharpness] =
      passage_window(sine / way, std::min(kInstant, kFarthestPassage / way));
  const double window = std::min(half, kLongestWay / way);
  const BodyTimes& times = scene_.body_times;
  // The peak of the weight must not be higher than that of the open shutter.
  if (!(window * way > radius && window > (sharpness + 1) / 2 * times.open)) return std::nullopt;
  return Window{std::max(-window, times.begin),
                std::min(window, times.end),
                window,
                sharpness,
                CameraMotion::kStays,
                std::midpoint(own->nearest, other.value_or(*own).nearest)};
}

// The window of an open shutter is all of its time, if the image moves meanwhile.
std::optional<BodyTrails::Window> BodyTrails::open_window_of(const Body& body, int order) {
  const double half = scene_.body_times.open / 2;
  if (!(half > 0)) return std::nullopt;
  const Node first = node_within(body, order, -half, CameraMotion::kMoves),
             middle = node_within(body, order, 0, CameraMotion::kMoves),
             last = node_within(body, order, half, CameraMotion::kMoves);
  const double way =
      (middle.seen.v - first.seen.v).length() + (last.seen.v - middle.seen.v).length();
  if (!(last.frames > first.frames) ||
      !(way > kTrailPixels * largest_pixel_angle(scene_.projection())))
    return std::nullopt;
  return Window{first.frames, last.frames, half, 0, CameraMotion::kMoves};
}

BodyTrails::Node BodyTrails::node_within(const Body& body, int order, double frames,
                                         CameraMotion camera) {
  const BodyTimes& times = scene_.body_times;
  return node(body, order, std::clamp(frames, times.begin, times.end), camera);
}

// Says whether the image between two nodes is one piece.
bool BodyTrails::is_one(const Trail& trail, const Node& a, const Node& b) const {
  if (!a.image && !b.image) return true;
  if (!a.image || !b.image) return false;
  if (std::abs(a.flux - b.flux) > kFluxStep * std::max(a.flux, b.flux)) return false;
  return (a.seen.v - b.seen.v).length() < kSpacing * scene_.point_spread.least() ||
         (a.off_axis - b.off_axis).length() < trail.sources_step;
}

void BodyTrails::divide(Trail& trail, const Node& a, const Node& b, int depth) {
  // The light of both ends tells about when that of the middle left.
  std::optional<double> emitted;
  if (a.image && b.image)
    emitted = std::midpoint(a.image->traced.proper_time, b.image->traced.proper_time);
  const Node middle =
      node(trail.body, trail.order, (a.frames + b.frames) / 2, trail.window.camera, emitted);
  if (depth > 0 && !(is_one(trail, a, b) && is_one(trail, a, middle))) {
    divide(trail, a, middle, depth - 1);
    divide(trail, middle, b, depth - 1);
    return;
  }
  if (!middle.image) return;
  add_piece(trail, middle, trail.window.share_of(a.frames, b.frames));
}

// A node whose camera stays where it is has its place in the tetrad in common with the instant's.
void BodyTrails::add_piece(Trail& trail, const Node& node, double share) const {
  std::vector<BodySight::Piece> pieces =
      node.sight->pieces(trail.body, *node.image, scene_.point_spread.least(), true);
  if (pieces.empty()) pieces.push_back({node.image->at});
  for (const BodySight::Piece& piece : pieces) {
    SkyImage moved = trail.window.camera == CameraMotion::kMoves
                         ? node.sight->moved_to(now_, piece.at)
                         : piece.at;
    moved.amplification *= share;
    trail.pieces.push_back(
        {moved, node.image->traced.way(), share * piece.solid_angle, piece.tint});
  }
}

// Returns how far a body at r moves from frame to frame, M, against the caustics, which the observer
// moves.
double BodyTrails::way_of(const Body& body, double r) {
  constexpr double kStep = 0.25;
  const BodyTimes& times = scene_.body_times;
  const double begin = std::max(-kStep, times.begin), end = std::min(kStep, times.end);
  if (!(end > begin)) return 0;
  const ObserverState &from = moment_at(begin, CameraMotion::kStays).state.observer,
                      &to = moment_at(end, CameraMotion::kStays).state.observer;
  const V3d seen_from = column(from.sky_from_tetrad, 0), seen_to = column(to.sky_from_tetrad, 0);
  const BodyMotion motion = motion_of(from.spacetime, body, M33d());
  const double tau = now_.image(body, 0)->traced.proper_time;
  const BodyPoint at = motion.at(tau);
  const double speed = at.celerity().length() / at.gamma;
  return (r * (seen_to - seen_from).length() + speed * std::abs(to.null_time - from.null_time)) /
         (end - begin);
}

// The weights of a triangle add up to an even exposure from frame to frame.
std::vector<BodyTrails::Piece> BodyTrails::listed_trail(const Body& body) {
  constexpr double kBright = 10, kMostParts = 24;
  const BodyTimes& times = scene_.body_times;
  if (!times.at || scene_.effects.amplification == Amplification::kNone) return {};
  double fast = 0, r = 0;
  for (int order = 0; const auto image = now_.image(body, order); ++order) {
    const BodyImage& one = image->traced;
    const double stretch = one.solid_angle_per_area / one.angle_per_length,
                 apart = one.r + scene_.state.observer.r;
    // Both long and bright
    if (stretch > kBright * one.angle_per_length &&
        one.solid_angle_per_area * apart * apart > kBright)
      fast = std::max(fast, stretch), r = one.r;
  }
  if (!(fast > 0)) return {};
  const double parts =
      std::min(std::ceil(fast * way_of(body, r) / scene_.point_spread.least()), kMostParts);
  if (parts < 4) return {};
  const Window window{std::max(-1.0, times.begin), std::min(1.0, times.end), 1, 1,
                      CameraMotion::kStays};
  Trail trail{body, 0, window, 0};
  for (double k = -parts; k < parts; ++k) {
    const double begin = std::max(k / parts, window.begin),
                 end = std::min((k + 1) / parts, window.end);
    if (!(end > begin)) continue;
    for (int order = 0;; ++order) {
      const Node one = node(body, order, (begin + end) / 2, window.camera);
      if (!one.image) break;
      add_piece(trail, one, window.share_of(begin, end));
    }
  }
  return std::move(trail.pieces);
}

std::vector<BodyTrails::Piece> BodyTrails::trail(const Body& body, int order,
                                                 const BodySight::Image& image) {
  if (!scene_.body_times.at) return {};
  std::optional<Window> window = passage_window_of(body, order, image.traced);
  if (!window) window = open_window_of(body, order);
  if (!window) return {};
  Trail trail{body, order, *window, kRadiusStep * now_.radius_of(body) / image.traced.r};
  const auto at = [&](int k) {
    return node(body, order, window->begin + (window->end - window->begin) * k / kParts,
                window->camera);
  };
  const Node first = at(0);
  Node last = first;
  for (int k = 1; k <= kParts; ++k) {
    Node next = at(k);
    divide(trail, last, next, kMostHalvings);
    last = std::move(next);
  }
  // What is left lies beyond the segment, and so does its mirror image.  It has the light of the end
  // that is farther from a passage, so that a body which has none is no darker.
  const bool begins_fainter = first.image && (!last.image || first.flux < last.flux);
  const Node& beyond = begins_fainter ? first : last;
  const double left = 1 - window->share_of(window->begin, window->end);
  constexpr double kNothing = 1e-9;  // what rounding leaves
  if (left > kNothing && beyond.image) add_piece(trail, beyond, left);
  return std::move(trail.pieces);
}

}  // namespace domefall
