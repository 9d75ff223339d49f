#include "pipeline/light/traced_rings.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace domefall {

// Newton's method, as |q| is least where q is at right angles to the line.
std::optional<TracedRings::Line> TracedRings::line(const V3d& e) const {
  constexpr double kEnough = 1e-7;  // of the outermost radius
  const V3d x(1, 0, 0);
  const SphereCentre centre(view.spacetime, motion.at(image.proper_time));
  V3d middle = x * centre.place.x + e * e.dot(centre.place);
  double tau = image.proper_time;
  for (int n = 0; n < 12; ++n) {
    const auto found = slope(e, middle, tau);
    if (!found) return std::nullopt;
    tau = found->at.tau;
    const V3d &a = found->along_r, &b = found->along_e, &q = found->at.q;
    const double an = a.dot(rings_.normal), bn = b.dot(rings_.normal), steep = std::hypot(an, bn);
    if (!(steep > 0)) return std::nullopt;
    const V3d across = (x * an + e * bn) / steep, onward = (e * an - x * bn) / steep,
              way = (b * an - a * bn) / steep;  // of q, onward
    const V3d off = across / steep;
    const double beyond = q.dot(rings_.normal),
                 ahead = (q - (a * across.x + b * across.dot(e)) * (beyond / steep)).dot(way) /
                         way.length2();
    const V3d step = off * beyond + onward * ahead;
    if (step.length() > kEnough * radius && n < 11) {
      middle -= step;
      continue;
    }
    const double rise = onward.dot(e), up = middle.dot(e);
    return Line{e,
                middle,
                onward * (radius / way.length()),
                off,
                1 - q.length2() / (radius * radius),
                rise == 0 ? centre.place.x : middle.x - onward.x * (up / rise)};
  }
  return std::nullopt;
}

std::optional<TracedRings::Met> TracedRings::met(const Line& line, double share) const {
  V3d place = line.middle + line.way * share;
  double tau = image.proper_time;
  for (int n = 0; n < 20; ++n) {
    auto at = meet(line.e, place, tau);
    if (!at) return std::nullopt;
    tau = at->tau;
    const double beyond = at->q.dot(rings_.normal);
    if (std::abs(beyond) < 1e-6 * radius || n == 19) return at;
    place -= line.off * beyond;
  }
  return std::nullopt;
}

// Returns the share at which a side of the line ends.
std::optional<double> TracedRings::rim(const Line& line, double side) const {
  constexpr double kEnough = 1e-6, kFarther = 1.2;
  bool is_seen = true;
  const auto within = [&](double share) {
    const auto at = met(line, share);
    is_seen = is_seen && at;
    return at ? 1 - at->q.length2() / (radius * radius) : -1;
  };
  double last = 0, left = line.clear, next = side * std::sqrt(line.clear);
  for (int n = 0; n < 30; ++n, next *= kFarther) {
    const double beyond = within(next);
    if (!is_seen) return std::nullopt;
    if (!(beyond > 0)) {
      const double found = root_between(last, left, next, beyond, kEnough, within);
      return is_seen ? std::optional(found) : std::nullopt;
    }
    last = next, left = beyond;
  }
  return std::nullopt;
}

std::optional<RingNode> TracedRings::node(const Line& line, double share) const {
  const auto at = met(line, share);
  const auto light = at ? leaving(line.e, *at) : std::nullopt;
  if (!light) return std::nullopt;
  Node seen;
  seen.angle = at->seen.from_hole;
  // Beyond the axis above or below the observer, angles go on.
  if (at->psi < 0) seen.angle = (line.axis > view.r ? 2 * std::numbers::pi : 0) - seen.angle;
  seen.ratio = light->ratio(*at);
  seen.place = at->q / sphere_;
  const V3d& v = light->velocity;
  const double gamma = 1 / std::sqrt(1 - v.length2());
  seen.leaving =
      (light->ray + v * (gamma * (gamma / (gamma + 1) * v.dot(light->ray) - 1))) / light->doppler;
  return seen;
}

std::optional<TracedRings::Row> TracedRings::row(double azimuth) const {
  const auto cut = line(plane(azimuth));
  if (!cut || !(cut->clear > 0)) return std::nullopt;
  const auto begin = rim(*cut, -1), end = rim(*cut, 1);
  if (!begin || !end) return std::nullopt;
  // Angles are even in flat space, where the rest is smooth however near the observer is.
  const V3d observer = V3d(view.r, 0, 0) - cut->middle;
  const double length = cut->way.length(), foot = observer.dot(cut->way) / (length * length),
               apart = (observer - cut->way * foot).length() / length,
               first = std::atan((*begin - foot) / apart), last = std::atan((*end - foot) / apart);
  Row row;
  for (std::size_t j = 0; j < kAlong; ++j) {
    const double w = std::sin(Chebyshev<kAlong>::node(static_cast<int>(j)));
    const double angle = (first + last) / 2 + (last - first) / 2 * w;
    const auto seen = node(*cut, foot + apart * std::tan(angle));
    if (!seen) return std::nullopt;
    row[j] = *seen;
  }
  return row;
}

// Interpolates in a range of azimuths.  Returns false where a chord is not seen, or where the image of a
// chord changes too fast from one to the next: about the axis, and next to the observer.
bool TracedRings::trace(const std::pair<double, double>& range) {
  constexpr double kError = 2e-5, kTried = 0.3;  // radians, and t
  azimuths_ = Azimuths(range);
  for (std::size_t i = 0; i < kChords; ++i) {
    const auto found = row(azimuths_(Chebyshev<kChords>::node(static_cast<int>(i))));
    if (!found) return false;
    nodes_[i] = *found;
  }
  const auto found = row(azimuths_(kTried));
  const auto between = chord(kTried);
  bool is_right = found.has_value();
  for (std::size_t j = 0; is_right && j < kAlong; ++j)
    is_right = std::abs((*found)[j].angle - between[j].angle) < kError;
  return is_right;
}

// What is left after some halvings is a sliver.
void TracedRings::add_parts(const std::pair<double, double>& range, int halvings,
                            std::vector<TracedRings>& parts) const {
  TracedRings part(*this);
  if (part.trace(range)) {
    parts.push_back(std::move(part));
  } else if (halvings > 0) {
    const double middle = (range.first + range.second) / 2;
    add_parts({range.first, middle}, halvings - 1, parts);
    add_parts({middle, range.second}, halvings - 1, parts);
  }
}

std::vector<TracedRings> TracedRings::parts() const {
  constexpr int kMostHalvings = 6;
  constexpr double kEdgeOn = 1e-9;  // of r
  std::vector<TracedRings> parts;
  // Who is in the plane of the rings together with the hole sees a line.
  const V3d centre = SphereCentre(view.spacetime, motion.at(image.proper_time)).place;
  if (std::abs(rings_.normal.x) < kEdgeOn &&
      std::abs(centre.dot(rings_.normal)) < kEdgeOn * centre.length())
    return parts;
  for (const auto& range : ranges([this](const V3d& e) {
         const auto found = line(e);
         return found ? found->clear : -1;
       }))
    add_parts(range, kMostHalvings, parts);
  return parts;
}

}  // namespace domefall
