#include "pipeline/light/traced_sphere.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace domefall {

// The middle is found by the method of Gauss and Newton.
std::optional<TracedSphere::Oval> TracedSphere::oval(const V3d& e) const {
  constexpr double kEnough = 1e-9;  // of a
  const V3d x(1, 0, 0);
  const SphereCentre centre(view.spacetime, motion.at(image.proper_time));
  V3d middle = x * centre.place.x + e * e.dot(centre.place);
  double tau = image.proper_time;
  for (int n = 0; n < 12; ++n) {
    const auto found = slope(e, middle, tau);
    if (!found) return std::nullopt;
    const Met& at = found->at;
    tau = at.tau;
    const V3d &a = found->along_r, &b = found->along_e;
    const double aa = a.length2(), ab = a.dot(b), bb = b.length2(), all = aa * bb - ab * ab;
    // Solves a s + b t = v as well as can be.
    const auto solved = [&](const V3d& v) {
      const double va = a.dot(v), vb = b.dot(v);
      return (x * (va * bb - vb * ab) + e * (vb * aa - va * ab)) / all;
    };
    const V3d step = solved(at.q);
    if (step.length() > kEnough * radius && n < 11) {
      middle -= step;
      continue;
    }
    const double clear = 1 - at.q.length2() / (radius * radius);
    const V3d normal = a.cross(b).normalized(), towards = leaving_in(image, e);
    const V3d b1 = (towards - normal * normal.dot(towards)).normalized();
    V3d b2 = normal.cross(b1);
    if (b2.dot(at.centre.contracted(x.cross(e)).cross(b1)) < 0) b2 = -b2;
    const double size = radius * std::sqrt(std::max(clear, 0.0));
    return Oval{e, middle, solved(b1) * size, solved(b2) * size, clear};
  }
  return std::nullopt;
}

// The covector N that is normal to the surface in spacetime is the gradient of q^2/2.  In the slice it
// is S L q, and along T it is a difference.
std::optional<SphereNode> TracedSphere::node(const Oval& oval, double u) const {
  const V3d& e = oval.e;
  const V3d way = oval.p1 * std::cos(u) + oval.p2 * std::sin(u);
  double share = 1, before = 0, depth_before = -oval.clear, tau = image.proper_time;
  std::optional<Met> met;
  for (int n = 0; n < 30; ++n) {
    met = meet(e, oval.middle + way * share, tau);
    if (!met) return std::nullopt;
    tau = met->tau;
    const double depth = met->q.length2() / (radius * radius) - 1;
    if (std::abs(depth) < 1e-8 * oval.clear || depth == depth_before) break;
    // It grows as the square of the share.
    const double next = std::sqrt(share * share - depth * (share * share - before * before) /
                                                      (depth - depth_before));
    before = share, depth_before = depth;
    if (!(std::abs(next - share) < share / 2)) return std::nullopt;
    share = next;
  }
  const auto light = leaving(e, *met);
  if (!light) return std::nullopt;
  const V3d stretched =
      met->centre.scaled(met->centre.stretched(met->q), 1 / met->centre.frame.e_r);
  const V3d normal = light->split(stretched, light->outwards.dot(stretched) * light->frame.e_r, 1);
  const double later = 1e-5 * radius;
  const V3d q_later =
      SphereCentre(view.spacetime, motion.at(met->tau + later)).own(oval.middle + way * share);
  const double by_time = met->q.dot(q_later - met->q) / (later * met->centre.time_rate()),
               along = light->frame.u_r * light->outwards.dot(stretched) + light->rate * by_time;
  Node seen;
  // Beyond the axis above or below the observer, angles go on.
  seen.angle = met->seen.from_hole;
  if (met->psi < 0)
    seen.angle = (met->centre.place.x > view.r ? 2 * std::numbers::pi : 0) - seen.angle;
  seen.ratio = light->ratio(*met);
  seen.cosine = (normal.dot(light->ray) + along) /
                (std::sqrt(normal.length2() - along * along) * light->doppler);
  seen.place = met->q / radius;
  return seen;
}

std::optional<double> TracedSphere::limb(const Oval& oval, double side) const {
  bool lit = true;
  const auto cosine = [&](double u) {
    const auto seen = node(oval, u);
    lit = lit && seen;
    return seen ? seen->cosine : -1;
  };
  const double front = cosine(0), back = cosine(side * std::numbers::pi);
  if (!(front > 0 && back < 0)) return std::nullopt;
  const double u = root_between(0.0, front, side * std::numbers::pi, back, 1e-6, cosine);
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
  azimuths_ = Azimuths(range);
  for (std::size_t i = 0; i < kChords; ++i) {
    const auto cut = oval(plane(azimuths_(Chebyshev<kChords>::node(static_cast<int>(i)))));
    if (!cut || !(cut->clear > 0)) return false;
    const auto begin = limb(*cut, -1), end = limb(*cut, 1);
    if (!begin || !end) return false;
    if (!set_nodes(*cut, *begin, *end, nodes_[i])) return false;
  }
  return true;
}

}  // namespace domefall
