#include "pipeline/light/sphere_surface.h"

#include <algorithm>
#include <array>
#include <boost/math/tools/toms748_solve.hpp>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <utility>

#include "pipeline/light/chebyshev.h"
#include "pipeline/light/sphere_centre.h"

namespace domefall {
namespace {

// Returns the root of f between a, where f > 0, and b, where it is not, to a part of that range.
template <class F>
double root_between(double a, double fa, double b, double fb, double part, const F& f) {
  if (!(fa > 0)) return a;
  if (!(fb < 0)) return b;
  const double enough = part * std::abs(b - a);
  if (a > b) std::swap(a, b), std::swap(fa, fb);
  std::uintmax_t steps = 60;
  const auto [from, to] = boost::math::tools::toms748_solve(
      f, a, b, fa, fb, [enough](double x, double y) { return y - x < enough; }, steps);
  return (from + to) / 2;
}

using std::numbers::pi;

// A Node is what is seen of a place of the sphere.
struct Node {
  double angle = 0, ratio = 0, cosine = 0;  // from the hole, of frequencies, of emission
  V3d place{0, 0, 0};                       // q/a

  void add(double weight, const Node& node) {
    angle += weight * node.angle;
    ratio += weight * node.ratio;
    cosine += weight * node.cosine;
    place += node.place * weight;
  }
};

// In the plane of R and e the observer sees places at the times at which their light left, and those
// that were within the sphere then are a small oval.  q is nearly linear in the place, so that the
// oval is found from the place in its middle, where |q| is least, and from the derivatives there:
// cos(u) p1 + sin(u) p2 is close to its rim, where p1 points to the observer.  The angle from the hole
// grows with u over what is visible.
class TracedSphere {
 public:
  static constexpr int kChords = 16, kAlong = 12;

  TracedSphere(const SphereView& view, const BodyMotion& motion, const BodyImage& image,
               double radius)
      : view_(view), motion_(motion), image_(image), radius_(radius), across_(image.across) {
    const double half_turn = std::round(image.psi / pi);
    if (const auto centre = half_turn > 0 ? centre_if_on_axis() : std::nullopt) {
      const bool own_side = (image.psi < half_turn * pi) == (std::fmod(half_turn, 2) == 1);
      across_ = own_side ? *centre : -*centre;
    }
    beside_ = V3d(1, 0, 0).cross(across_);
  }

  // Returns the ranges of azimuths at which the sphere is seen.
  std::vector<std::pair<double, double>> ranges() const;
  // Traces the nodes of one.  Returns false where one is not seen.
  bool trace(const std::pair<double, double>& range);

  double azimuth(double t) const { return middle_ + std::asin(widest_ * std::sin(t)); }
  V3d direction(double azimuth, double angle) const {
    return plane(azimuth) * std::sin(angle) - V3d(std::cos(angle), 0, 0);
  }
  // Returns the nodes along the chord of t.
  std::array<Node, kAlong> chord(double t) const {
    const auto weights = Chebyshev<kChords>::weights(t);
    std::array<Node, kAlong> row;
    for (std::size_t i = 0; i < kChords; ++i)
      for (std::size_t j = 0; j < kAlong; ++j) row[j].add(weights[i], nodes_[i][j]);
    return row;
  }

 private:
  // A Met is a place and what was there when its light left.
  struct Met {
    double tau;
    SphereCentre centre;
    V3d q;
    double r, psi;
    SeenPlace seen;
  };
  struct Oval {
    V3d e, middle, p1, p2;
    double clear;  // 1 - |q/a|^2 in the middle
  };

  V3d plane(double azimuth) const {
    return across_ * std::cos(azimuth) + beside_ * std::sin(azimuth);
  }
  std::optional<Met> meet(const V3d& e, const V3d& place, double tau) const;
  std::optional<Oval> oval(const V3d& e) const;
  std::optional<Node> node(const Oval& oval, double u) const;
  double clear(const V3d& e) const {
    const auto found = oval(e);
    return found ? found->clear : -1;
  }
  std::optional<V3d> centre_if_on_axis() const;
  std::optional<double> limb(const Oval& oval, double side) const;
  bool set_nodes(const Oval& oval, double begin, double end, std::array<Node, kAlong>& nodes) const;

  const SphereView& view_;
  const BodyMotion& motion_;
  const BodyImage& image_;
  double radius_;
  V3d across_, beside_{0, 0, 0};    // e of azimuths 0 and pi/2
  double middle_ = 0, widest_ = 0;  // of the azimuths: middle, and sine of half of their range
  std::array<std::array<Node, kAlong>, kChords> nodes_;
};

// Finds what is at a place of the plane.  T grows along the body's way at a nearly steady rate.
std::optional<TracedSphere::Met> TracedSphere::meet(const V3d& e, const V3d& place,
                                                    double tau) const {
  const double above = place.dot(e), r = std::hypot(above, place.x),
               angle = std::atan2(above, place.x);
  const double psi = angle + 2 * pi * std::round((image_.psi - angle) / (2 * pi));
  const auto seen = view_.place(r, std::abs(psi));
  if (!seen) return std::nullopt;
  for (int n = 0; n < 40; ++n) {
    if (!(tau > motion_.begin && tau < motion_.end)) return std::nullopt;
    const SphereCentre centre(view_.spacetime, motion_.at(tau));
    const double late =
        seen->null_time - centre.at.null_time - slice_of_v(view_.spacetime, centre.at.r, r);
    if (std::abs(late) < 1e-11 * r) return Met{tau, centre, centre.own(place), r, psi, *seen};
    tau += late / centre.time_rate();
  }
  return std::nullopt;
}

// The middle is found by the method of Gauss and Newton.
std::optional<TracedSphere::Oval> TracedSphere::oval(const V3d& e) const {
  constexpr double kStep = 1e-4, kEnough = 1e-9;  // of a
  const V3d x(1, 0, 0);
  const SphereCentre centre(view_.spacetime, motion_.at(image_.proper_time));
  V3d middle = x * centre.place.x + e * e.dot(centre.place);
  double tau = image_.proper_time;
  for (int n = 0; n < 12; ++n) {
    const double h = kStep * radius_;
    const auto at = meet(e, middle, tau), by_x = meet(e, middle + x * h, tau),
               by_e = meet(e, middle + e * h, tau);
    if (!at || !by_x || !by_e) return std::nullopt;
    tau = at->tau;
    const V3d a = (by_x->q - at->q) / h, b = (by_e->q - at->q) / h;
    const double aa = a.length2(), ab = a.dot(b), bb = b.length2(), all = aa * bb - ab * ab;
    // Solves a s + b t = v as well as can be.
    const auto solved = [&](const V3d& v) {
      const double va = a.dot(v), vb = b.dot(v);
      return (x * (va * bb - vb * ab) + e * (vb * aa - va * ab)) / all;
    };
    const V3d step = solved(at->q);
    if (step.length() > kEnough * radius_ && n < 11) {
      middle -= step;
      continue;
    }
    const double clear = 1 - at->q.length2() / (radius_ * radius_);
    const V3d normal = a.cross(b).normalized(), towards = leaving_in(image_, e);
    const V3d b1 = (towards - normal * normal.dot(towards)).normalized();
    V3d b2 = normal.cross(b1);
    if (b2.dot(at->centre.contracted(x.cross(e)).cross(b1)) < 0) b2 = -b2;
    const double size = radius_ * std::sqrt(std::max(clear, 0.0));
    return Oval{e, middle, solved(b1) * size, solved(b2) * size, clear};
  }
  return std::nullopt;
}

// The covector N that is normal to the surface in spacetime is the gradient of q^2/2.  In the slice it
// is S L q, and along T it is a difference.
std::optional<Node> TracedSphere::node(const Oval& oval, double u) const {
  const V3d& e = oval.e;
  const V3d way = oval.p1 * std::cos(u) + oval.p2 * std::sin(u);
  double share = 1, before = 0, depth_before = -oval.clear, tau = image_.proper_time;
  std::optional<Met> met;
  for (int n = 0; n < 30; ++n) {
    met = meet(e, oval.middle + way * share, tau);
    if (!met) return std::nullopt;
    tau = met->tau;
    const double depth = met->q.length2() / (radius_ * radius_) - 1;
    if (std::abs(depth) < 1e-8 * oval.clear || depth == depth_before) break;
    // It grows as the square of the share.
    const double next = std::sqrt(share * share - depth * (share * share - before * before) /
                                                      (depth - depth_before));
    before = share, depth_before = depth;
    if (!(std::abs(next - share) < share / 2)) return std::nullopt;
    share = next;
  }
  const double sine = std::sin(met->psi), cosine = std::cos(met->psi);
  const V3d outwards = V3d(cosine, 0, 0) + e * sine, onward = e * cosine - V3d(sine, 0, 0);
  const FallFrame frame = fall_frame(view_.spacetime, met->r);
  const auto split = [&](const V3d& v, double radial, double across) {
    return (v - outwards * outwards.dot(v)) * across + outwards * radial;
  };
  // The surface's velocity, the light's direction and N in the frame of free fall of the place.
  const V3d motion = met->centre.motion();
  const double rate = frame.time_along_u();
  const V3d velocity = split(motion, (outwards.dot(motion) * rate - frame.u_r) / frame.e_r, rate);
  const V3d stretched =
      met->centre.scaled(met->centre.stretched(met->q), 1 / met->centre.frame.e_r);
  const V3d normal = split(stretched, outwards.dot(stretched) * frame.e_r, 1);
  const double later = 1e-5 * radius_;
  const V3d q_later =
      SphereCentre(view_.spacetime, motion_.at(met->tau + later)).own(oval.middle + way * share);
  const double by_time = met->q.dot(q_later - met->q) / (later * met->centre.time_rate()),
               along = frame.u_r * outwards.dot(stretched) + rate * by_time;
  const PlaceLight& light = met->seen.light;
  const double swept = light.angular_momentum / met->r * (met->psi < 0 ? -1 : 1);
  const V3d ray = (outwards * met->seen.along_r - onward * swept) / met->seen.frequency;
  const double speed2 = velocity.length2();
  if (!(speed2 < 1)) return std::nullopt;
  const double doppler = (1 - velocity.dot(ray)) / std::sqrt(1 - speed2);
  Node seen;
  // Beyond the axis above or below the observer, angles go on.
  seen.angle = met->seen.from_hole;
  if (met->psi < 0) seen.angle = (met->centre.place.x > view_.r ? 2 * pi : 0) - seen.angle;
  seen.ratio = 1 / (met->seen.frequency * doppler);
  seen.cosine = (normal.dot(ray) + along) / (std::sqrt(normal.length2() - along * along) * doppler);
  seen.place = met->q / radius_;
  return seen;
}

// Returns the direction from the axis to the centre when the light of the axis left, if the sphere
// held the axis then.  The two orders that meet in a ring get the same, and divide the ring by it.
std::optional<V3d> TracedSphere::centre_if_on_axis() const {
  const V3d x(1, 0, 0);
  double along = SphereCentre(view_.spacetime, motion_.at(image_.proper_time)).place.x;
  const double h = 1e-4 * radius_;
  for (int n = 0; n < 8; ++n) {
    const auto at = meet(across_, x * along, image_.proper_time),
               by = meet(across_, x * (along + h), image_.proper_time);
    if (!at || !by) return std::nullopt;
    const V3d slope = (by->q - at->q) / h;
    const double step = slope.dot(at->q) / slope.length2();
    along -= step;
    if (std::abs(step) > 1e-9 * radius_ && n < 7) continue;
    if (at->q.length() > radius_) return std::nullopt;
    const V3d centre(0, at->centre.place.y, at->centre.place.z);
    // Of a centre on the axis itself both orders know the opposite sides (image_of_body).
    return centre.length() > 1e-6 * radius_ ? std::optional(centre.normalized()) : std::nullopt;
  }
  return std::nullopt;
}

// Next to the axis a sphere that moves across may be seen in several parts.
std::vector<std::pair<double, double>> TracedSphere::ranges() const {
  constexpr double kEnough = 1e-7;
  constexpr int kSteps = 8;  // to each side, the first of which is half as wide as the image
  const double beside = image_.r * std::abs(std::sin(image_.psi)),
               wide = beside > radius_ ? std::asin(radius_ / beside) : pi / 2,
               power = std::max(std::log(wide / pi) / std::log(1.0 / kSteps), 1.0);
  const auto clear_at = [&](double azimuth) { return clear(plane(azimuth)); };
  std::vector<std::pair<double, double>> found;
  double before = -pi / 2, clear_before = 0;
  for (int k = -kSteps; k <= kSteps; ++k) {
    const double azimuth = std::copysign(pi / 2 * std::pow(std::abs(double(k)) / kSteps, power), k),
                 clear_now = clear_at(azimuth);
    if (clear_now > 0) {
      if (k == -kSteps) found.emplace_back(azimuth, azimuth);
      if (!(clear_before > 0) && k > -kSteps)
        found.emplace_back(
            root_between(azimuth, clear_now, before, clear_before, kEnough, clear_at), 0);
      found.back().second = azimuth;
    } else if (clear_before > 0) {
      found.back().second =
          root_between(before, clear_before, azimuth, clear_now, kEnough, clear_at);
    }
    before = azimuth, clear_before = clear_now;
  }
  return found;
}

std::optional<double> TracedSphere::limb(const Oval& oval, double side) const {
  bool lit = true;
  const auto cosine = [&](double u) {
    const auto seen = node(oval, u);
    lit = lit && seen;
    return seen ? seen->cosine : -1;
  };
  const double front = cosine(0), back = cosine(side * pi);
  if (!(front > 0 && back < 0)) return std::nullopt;
  const double u = root_between(0.0, front, side * pi, back, 1e-6, cosine);
  return lit ? std::optional(u) : std::nullopt;
}

// The nodes are about at angles mean + half sin(v), where the rest is smooth in v however near the observer is.
bool TracedSphere::set_nodes(const Oval& oval, double begin, double end,
                             std::array<Node, kAlong>& nodes) const {
  const auto first = node(oval, begin), last = node(oval, end);
  if (!first || !last) return false;
  const double mean = (first->angle + last->angle) / 2, half = (last->angle - first->angle) / 2;
  bool lit = true;
  double from = begin;
  for (std::size_t j = 0; j < kAlong; ++j) {
    const double angle = mean + half * std::sin(Chebyshev<kAlong>::node(static_cast<int>(j)));
    const auto below = [&](double u) {
      const auto seen = node(oval, u);
      lit = lit && seen;
      return seen ? angle - seen->angle : 0;
    };
    from = root_between(from, below(from), end, angle - last->angle, 1e-6, below);
    const auto seen = node(oval, from);
    if (!lit || !seen) return false;
    nodes[j] = *seen;
  }
  return true;
}

bool TracedSphere::trace(const std::pair<double, double>& range) {
  middle_ = (range.first + range.second) / 2;
  widest_ = std::sin((range.second - range.first) / 2);
  for (std::size_t i = 0; i < kChords; ++i) {
    const auto cut = oval(plane(azimuth(Chebyshev<kChords>::node(static_cast<int>(i)))));
    if (!cut || !(cut->clear > 0)) return false;
    const auto begin = limb(*cut, -1), end = limb(*cut, 1);
    if (!begin || !end) return false;
    if (!set_nodes(*cut, *begin, *end, nodes_[i])) return false;
  }
  return true;
}

// The places along a chord are even in w = sin(v), as they nearly are in the image.
template <std::size_t n>
Node along(const std::array<Node, n>& chord, double w) {
  const auto weights = Chebyshev<static_cast<int>(n)>::weights(std::asin(std::clamp(w, -1.0, 1.0)));
  Node node;
  for (std::size_t j = 0; j < n; ++j) node.add(weights[j], chord[j]);
  return node;
}

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
int chords_of(const TracedSphere& sphere, const std::function<double(const V3d&)>& spacing) {
  std::array<std::vector<V3d>, kSamples + 1> lines;
  for (int i = 0; i <= kSamples; ++i) {
    const double t = pi * (double(i) / kSamples - 0.5);
    const auto chord = sphere.chord(t);
    for (std::size_t j = 0; j <= kSamples; ++j)
      lines[j].push_back(
          sphere.direction(sphere.azimuth(t), along(chord, 2 * double(j) / kSamples - 1).angle));
  }
  double most = 0;
  for (const std::vector<V3d>& line : lines) most = std::max(most, pieces_along(line, spacing));
  return count_of(most);
}

// Appends the pieces of the chord between two azimuths, whose middle is at t.
void append_chord(const TracedSphere& sphere, double t, double width,
                  const std::function<double(const V3d&)>& spacing,
                  std::vector<SpherePiece>& pieces) {
  const double azimuth = sphere.azimuth(t);
  const auto chord = sphere.chord(t);
  std::vector<V3d> line;
  for (int j = 0; j <= kSamples; ++j)
    line.push_back(sphere.direction(azimuth, along(chord, 2.0 * j / kSamples - 1).angle));
  const int parts = count_of(pieces_along(line, spacing));
  double from = along(chord, -1).angle;
  for (int j = 0; j < parts; ++j) {
    const double to = along(chord, 2.0 * (j + 1) / parts - 1).angle;
    const Node node = along(chord, 2 * (j + 0.5) / parts - 1);
    const double solid_angle = width * std::abs(area_up_to(to) - area_up_to(from));
    from = to;
    if (solid_angle > 0)
      pieces.push_back({{{sphere.direction(azimuth, node.angle)}, node.ratio, solid_angle},
                        std::clamp(node.cosine, 0.0, 1.0),
                        node.place});
  }
}

}  // namespace

std::optional<std::vector<SpherePiece>> traced_sphere(
    const SphereView& view, const BodyMotion& motion, const BodyImage& image, double radius,
    const std::function<double(const V3d&)>& spacing) {
  TracedSphere sphere(view, motion, image, radius);
  std::vector<SpherePiece> pieces;
  for (const auto& range : sphere.ranges()) {
    if (!sphere.trace(range)) return std::nullopt;
    const int chords = chords_of(sphere, spacing);
    for (int k = 0; k < chords; ++k) {
      const auto t = [&](double share) { return pi * (share / chords - 0.5); };
      append_chord(sphere, t(k + 0.5), sphere.azimuth(t(k + 1)) - sphere.azimuth(t(k)), spacing,
                   pieces);
    }
  }
  if (pieces.empty()) return std::nullopt;
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
