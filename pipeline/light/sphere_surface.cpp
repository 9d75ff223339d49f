#include "pipeline/light/sphere_surface.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <utility>

#include "pipeline/light/traced_rings.h"
#include "pipeline/light/traced_sphere.h"

namespace domefall {
namespace {

using std::numbers::pi;

// Returns how many pieces, of the spacing at their places, a line through these directions has.
double pieces_along(const std::vector<V3d>& line,
                    const std::function<double(const V3d&)>& spacing) {
  double most = 0;
  for (std::size_t k = 0; k + 1 < line.size(); ++k)
    most = std::max(most, (line[k + 1] - line[k]).length() / spacing(line[k]));
  return most * static_cast<double>(line.size() - 1);
}

constexpr int kSamples = 12;  // of the length of a line

int count_of(double pieces) {
  constexpr double kLeast = 16, kMost = 4096;
  return static_cast<int>(std::clamp(std::ceil(pieces), kLeast, kMost));
}

// Returns the number of chords for pieces of this spacing.
template <class Traced>
int chords_of(const Traced& traced, const std::function<double(const V3d&)>& spacing) {
  std::array<std::vector<V3d>, kSamples + 1> lines;
  for (int i = 0; i <= kSamples; ++i) {
    const double t = pi * (double(i) / kSamples - 0.5);
    const auto chord = traced.chord(t);
    for (std::size_t j = 0; j <= kSamples; ++j)
      lines[j].push_back(
          traced.direction(traced.azimuths()(t), along(chord, 2 * double(j) / kSamples - 1).angle));
  }
  double most = 0;
  for (const std::vector<V3d>& line : lines) most = std::max(most, pieces_along(line, spacing));
  return count_of(most);
}

// A Chord is that of a traced sphere, or of rings, from t_begin to t_end.
template <class Traced>
struct Chord {
  using Node = typename Traced::Node;

  Chord(const Traced& traced, double t_begin, double t_end)
      : e(traced.plane(traced.azimuths()((t_begin + t_end) / 2))),
        width(traced.azimuths()(t_end) - traced.azimuths()(t_begin)),
        nodes(traced.chord((t_begin + t_end) / 2)) {
    const auto first = traced.chord(t_begin), last = traced.chord(t_end);
    for (int j = 0; j <= kSamples; ++j) {
      const double w = 2.0 * j / kSamples - 1;
      const Node node = at(w);
      line.push_back(direction(node.angle));
      // Chords lie closer where the image ends.
      const double thick = width * std::abs(std::sin(node.angle));
      across.push_back((along(last, w).place - along(first, w).place).length() / thick);
    }
  }

  Node at(double w) const { return along(nodes, w); }
  V3d direction(double angle) const { return e * std::sin(angle) - V3d(std::cos(angle), 0, 0); }
  // A Part is what is from one w to another.
  struct Part {
    Node middle;
    SkyImage image;
    double width;  // SpherePiece's
  };
  Part part(double from, double to, const std::function<double(const V3d&)>& spacing) const {
    const Node middle = at((from + to) / 2), first = at(from), last = at(to);
    const SkyImage image{{direction(middle.angle)},
                         middle.ratio,
                         width * std::abs(area_up_to(last.angle) - area_up_to(first.angle))};
    const double share = (from + to + 2) / 4 * kSamples;
    const auto k = static_cast<std::size_t>(share);
    const double lengthwise =
        (last.place - first.place).length() / std::abs(last.angle - first.angle);
    return {middle, image,
            std::max(std::lerp(across[k], across[k + 1], share - double(k)), lengthwise) *
                spacing(image.direction.v)};
  }
  // Returns where a function of what is along the chord changes its sign.
  template <class F>
  void add_roots(const F& f, std::vector<double>& roots) const {
    constexpr int kSteps = 48;
    const auto of = [&](double w) { return f(at(w)); };
    double before = -1, value_before = of(before);
    for (int k = 1; k <= kSteps; ++k) {
      const double w = std::sin(pi * (double(k) / kSteps - 0.5)), value = of(w);
      if (value > 0 && !(value_before > 0))
        roots.push_back(root_between(w, value, before, value_before, 1e-7, of));
      else if (value_before > 0 && !(value > 0))
        roots.push_back(root_between(before, value_before, w, value, 1e-7, of));
      before = w, value_before = value;
    }
  }

  V3d e;
  double width;  // in azimuth
  std::array<Node, Traced::kAlong> nodes;
  std::vector<V3d> line;
  std::vector<double> across;  // by the angle at which it is seen
};

using SphereChord = Chord<TracedSphere>;
using RingChord = Chord<TracedRings>;

// Calls use(from, to) for so many pieces from one w to another.
template <class Use>
void divide(double from, double to, double pieces, const Use& use) {
  const int parts = std::max(1, static_cast<int>(std::ceil(pieces * (to - from) / 2)));
  for (int j = 0; j < parts; ++j)
    use(std::lerp(from, to, double(j) / parts), std::lerp(from, to, (j + 1.0) / parts));
}

// Returns the chord of the others in the plane of R and e.
template <class Traced>
std::optional<Chord<Traced>> chord_in(const std::vector<Traced>& traced, const V3d& e) {
  for (const Traced& part : traced)
    if (const auto t = part.azimuths().t_of(part.azimuth_of(e))) return Chord<Traced>(part, *t, *t);
  return std::nullopt;
}

// Returns the ring through which the light of a sphere comes at this angle from the hole.
RingCrossing crossing_at(const RingChord& chord, const RingPlane& rings, double angle) {
  std::vector<double> found;
  chord.add_roots([angle](const RingNode& node) { return node.angle - angle; }, found);
  for (const double w : found) {
    const RingNode node = chord.at(w);
    const int ring = rings.ring_at(node.place);
    if (ring >= 0 && node.place.dot(node.leaving) > 0)
      return {ring, std::abs(node.leaving.dot(rings.normal))};
  }
  return {};
}

// Appends where rings begin and end along a chord.
void add_edges(const RingChord& chord, const RingPlane& rings, std::vector<double>& edges) {
  for (const auto& ring : rings.edges)
    for (const double radius : {ring.first, ring.second})
      chord.add_roots([radius](const RingNode& node) { return node.place.length() - radius; },
                      edges);
}

// Appends what is seen of a sphere along a chord of its own, beside and through a chord of rings.
void append_sphere(const SphereChord& chord, const std::optional<RingChord>& front,
                   const RingPlane& rings, const std::function<double(const V3d&)>& spacing,
                   std::vector<SpherePiece>& pieces) {
  std::vector<double> cuts{-1, 1};
  if (front) {
    std::vector<double> edges{-1, 1};
    add_edges(*front, rings, edges);
    for (const double w : edges)
      chord.add_roots(
          [angle = front->at(w).angle](const SphereNode& node) { return node.angle - angle; },
          cuts);
  }
  std::ranges::sort(cuts);
  const double count = count_of(pieces_along(chord.line, spacing));
  for (std::size_t k = 0; k + 1 < cuts.size(); ++k) {
    RingCrossing through;
    if (front) through = crossing_at(*front, rings, chord.at((cuts[k] + cuts[k + 1]) / 2).angle);
    divide(cuts[k], cuts[k + 1], count, [&](double from, double to) {
      const auto [node, image, width] = chord.part(from, to, spacing);
      if (image.amplification > 0)
        pieces.push_back({image, std::clamp(node.cosine, 0.0, 1.0), node.place, width, through});
    });
  }
}

// Appends what is seen of rings along a chord of theirs, before and beside a chord of the sphere.
void append_rings(const RingChord& chord, const std::optional<SphereChord>& sphere,
                  const RingPlane& rings, const std::function<double(const V3d&)>& spacing,
                  std::vector<RingPiece>& pieces) {
  std::vector<double> cuts{-1, 1};
  for (const auto& [inner, outer] : rings.edges)
    for (const double radius : {inner, outer})
      chord.add_roots([radius](const RingNode& node) { return node.place.length() - radius; },
                      cuts);
  double low = 0, high = 0;  // of the sphere
  if (sphere) {
    low = sphere->at(-1).angle, high = sphere->at(1).angle;
    if (low > high) std::swap(low, high);
    for (const double limb : {low, high})
      chord.add_roots([limb](const RingNode& node) { return node.angle - limb; }, cuts);
  }
  std::ranges::sort(cuts);
  const double count = pieces_along(chord.line, spacing);
  for (std::size_t k = 0; k + 1 < cuts.size(); ++k) {
    const RingNode middle = chord.at((cuts[k] + cuts[k + 1]) / 2);
    const int ring = rings.ring_at(middle.place);
    const bool is_behind =
        middle.angle > low && middle.angle < high && middle.place.dot(middle.leaving) < 0;
    if (ring < 0 || is_behind) continue;
    divide(cuts[k], cuts[k + 1], count, [&](double from, double to) {
      const auto [node, image, width] = chord.part(from, to, spacing);
      if (image.amplification > 0)
        pieces.push_back({image, ring, node.place, node.leaving.normalized(), width});
    });
  }
}

// Calls use(chord) for the chords of what is traced.
template <class Traced, class Use>
void for_each_chord(const std::vector<Traced>& traced,
                    const std::function<double(const V3d&)>& spacing, const Use& use) {
  for (const Traced& part : traced) {
    const int chords = chords_of(part, spacing);
    const auto t = [&](int edge) { return pi * (double(edge) / chords - 0.5); };
    for (int k = 0; k < chords; ++k) use(Chord<Traced>(part, t(k), t(k + 1)));
  }
}

// Returns each range of azimuths at which a sphere is seen, traced, or none where one cannot be.
std::vector<TracedSphere> traced_parts(const TracedSphere& whole) {
  std::vector<TracedSphere> parts;
  for (const auto& range : whole.seen_ranges()) {
    parts.push_back(whole);
    if (!parts.back().trace(range)) return {};
  }
  return parts;
}

}  // namespace

std::optional<std::vector<SpherePiece>> traced_sphere(
    const SphereView& view, const BodyMotion& motion, const BodyImage& image, double radius,
    const std::function<double(const V3d&)>& spacing) {
  std::vector<SpherePiece> pieces;
  for_each_chord(
      traced_parts(TracedSphere(view, motion, image, radius)), spacing,
      [&](const SphereChord& chord) { append_sphere(chord, std::nullopt, {}, spacing, pieces); });
  if (pieces.empty()) return std::nullopt;
  return pieces;
}

std::optional<RingedSphere> traced_with_rings(const SphereView& view, const BodyMotion& motion,
                                              const BodyImage& image, double radius,
                                              const RingPlane& rings,
                                              const std::function<double(const V3d&)>& spacing) {
  const auto sphere = traced_parts(TracedSphere(view, motion, image, radius));
  const auto around = TracedRings(view, motion, image, radius, rings).parts();
  RingedSphere pieces;
  for_each_chord(sphere, spacing, [&](const SphereChord& chord) {
    append_sphere(chord, chord_in(around, chord.e), rings, spacing, pieces.sphere);
  });
  if (pieces.sphere.empty()) return std::nullopt;
  for_each_chord(around, spacing, [&](const RingChord& chord) {
    append_rings(chord, chord_in(sphere, chord.e), rings, spacing, pieces.rings);
  });
  return pieces;
}

bool is_within_sphere(const Spacetime& spacetime, double r, double v, const BodyMotion& motion,
                      double tau, double radius) {
  constexpr int kSteps = 60;
  for (int n = 0; n < kSteps; ++n) {
    if (!(tau > motion.begin && tau < motion.end)) return false;
    const BodyPoint point = motion.at(tau);
    if (point.r == 0) return false;
    const SphereCentre centre(spacetime, point);
    const double late = v - point.null_time - slice_of_v(spacetime, point.r, r);
    if (std::abs(late) < 1e-9 * r || n == kSteps - 1) {
      return centre.own(V3d(r, 0, 0)).length() < radius;
    }
    tau += late / centre.time_rate();
  }
  return false;
}

}  // namespace domefall
