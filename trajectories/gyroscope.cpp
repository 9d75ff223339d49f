#include "trajectories/gyroscope.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace domefall {
namespace {

// Returns the axes of the tetrad along ones that point to the stars.
M33d star_axes(const OrbitPoint& p) {
  const double s = std::sin(p.theta), c = std::cos(p.theta), x = std::cos(p.azimuth),
               y = std::sin(p.azimuth);
  return from_columns({s * x, s * y, c}, {c * x, c * y, -s}, {-y, x, 0});
}

// How the tetrad's axes change by proper time.  The rotation is that against axes which point to the
// stars, without which nothing is singular on the axis.
struct TetradChange {
  V3d boost, rotation;  // alpha, rho
};
TetradChange change_of(const Gyroscope::Hole& hole, const OrbitPoint& p) {
  if (hole.has_rain) {
    // Rain falls with the speed sqrt(2/r) through space that is flat to it, and does not turn.
    const V3d falls = p.celerity * (std::sqrt(2 / p.r) / p.r);
    return {{falls.x / 2, -falls.y, -falls.z}, {0, 0, 0}};
  }
  const double a = hole.spin, s = std::sin(p.theta), c = std::cos(p.theta), r = p.r;
  const double sigma = r * r + a * a * c * c, root = std::sqrt(sigma), square = sigma * sigma,
               cube = sigma * root;
  const double m = r - (hole.charge * hole.charge + a * a * s * s) / 2,
               w = sigma - m;  // half of Sigma -+ Delta
  const auto& [x, y, z] = p.celerity;
  const double t = gamma_of(p.celerity), out = t + x;
  return {{(2 * r * m - sigma) / square * out + a * s * (a * c * y - r * z) / cube,
           -a * a * s * c * t / cube - (r * m * y + a * w * c * z) / square,
           -a * r * s * x / cube + (a * w * c * y - r * m * z) / square},
          {a * c * ((w * t - m * x) / square + a * s * z / cube - out / sigma),
           -a * r * s * t / cube + (a * m * c * y - r * w * z) / square + a * s * out / sigma +
               z / root,
           a * a * s * c * x / cube + (r * w * y + a * m * c * z) / square - y / root}};
}

V3d turn_rate(const TetradChange& change, const V3d& celerity, const V3d& felt) {
  return change.rotation + celerity.cross(change.boost + felt) / (1 + gamma_of(celerity));
}

M33d turned(const M33d& axes, const V3d& rotation) {
  const double angle = rotation.length();
  if (!(angle > 0)) return axes;
  const V3d n = rotation / angle;
  const double c = std::cos(angle), s = std::sin(angle);
  const auto one = [&](int k) {
    const V3d v = column(axes, k);
    return v * c + n.cross(v) * s + n * (n.dot(v) * (1 - c));
  };
  return from_columns(one(0), one(1), one(2));
}

const M33d kNoTurn;

}  // namespace

V3d Gyroscope::rate(const ProperTime& tau, double step) const {
  const OrbitPoint p = way_(tau);
  const M33d axes = star_axes(p);
  const TetradChange here = change_of(hole_, p);
  const TetradChange change{apply(axes, here.boost), apply(axes, here.rotation)};
  const V3d celerity = apply(axes, p.celerity);
  if (free_fall_) return turn_rate(change, celerity, {0, 0, 0});
  const auto celerity_at = [&](double later) {
    const OrbitPoint q = way_(tau + later);
    return apply(star_axes(q), q.celerity);
  };
  const double h = 1e-3 * step;
  const V3d gained = (celerity_at(h) - celerity_at(-h)) / (2 * h);
  return turn_rate(change, celerity,
                   gained + change.boost * gamma_of(celerity) + change.rotation.cross(celerity));
}

// By Magnus' series of the fourth order.
M33d Gyroscope::after(const Node& from, double step) const {
  const double apart = std::sqrt(3.0) / 6;
  const V3d one = rate(from.tau + step * (0.5 - apart), step),
            two = rate(from.tau + step * (0.5 + apart), step);
  return turned(from.turn, (one + two) * (-step / 2) - one.cross(two) * (step * step * apart / 2));
}

void Gyroscope::follow(const ProperTime& end) {
  constexpr double kTolerance = 1e-10,
                   kPart = 0.45;  // the parts differ, so that no period fits both
  constexpr std::size_t kMostNodes = 40000;
  const double r = way_(nodes_.front().tau).r, whole = double(end - nodes_.front().tau);
  double step = std::min(whole, 0.1 * r * std::sqrt(r));
  while (nodes_.back().tau < end) {
    const Node now = nodes_.back();
    step = std::min(step, double(end - now.tau));
    const Node middle{now.tau + step * kPart, after(now, step * kPart)};
    const M33d fine = after(middle, step * (1 - kPart)), rough = after(now, step);
    double error = 0;
    for (int k = 0; k < 3; ++k)
      error = std::max(error, (column(fine, k) - column(rough, k)).length());
    if (error < kTolerance || step < 1e-12 * whole) {
      nodes_.push_back(middle);
      nodes_.push_back({now.tau + step, fine});
    }
    if (nodes_.size() > kMostNodes)
      throw std::domain_error("the observer turns more often than is followed");
    step *= std::clamp(0.8 * std::pow(kTolerance / (error + 1e-20), 0.2), 0.2, 3.0);
  }
}

Gyroscope Gyroscope::along(const Hole& hole, const Way& way, bool free_fall,
                           const ProperTime& begin, const ProperTime& end) {
  Gyroscope gyroscope(hole);
  gyroscope.way_ = way;
  gyroscope.free_fall_ = free_fall;
  gyroscope.nodes_.push_back({begin, kNoTurn});
  gyroscope.follow(end);
  return gyroscope;
}

Gyroscope Gyroscope::held(const Hole& hole, const OrbitPoint& point, double azimuth_rate,
                          const ProperTime& begin) {
  Gyroscope gyroscope(hole);
  gyroscope.nodes_.push_back({begin, kNoTurn});
  TetradChange change = change_of(hole, point);
  // The axes turn about that of the hole, too.
  change.rotation += V3d(std::cos(point.theta), -std::sin(point.theta), 0) * azimuth_rate;
  const V3d& c = point.celerity;
  gyroscope.even_rate_ =
      turn_rate(change, c, change.boost * gamma_of(c) + change.rotation.cross(c));
  return gyroscope;
}

M33d Gyroscope::turn(const ProperTime& tau) const {
  const Node& first = nodes_.front();
  if (!way_) return turned(kNoTurn, even_rate_ * -double(tau - first.tau));
  const auto later =
      std::upper_bound(nodes_.begin() + 1, nodes_.end(), tau,
                       [](const ProperTime& t, const Node& node) { return t < node.tau; });
  const Node& from = *(later - 1);
  const M33d there = tau > from.tau ? after(from, double(tau - from.tau)) : from.turn;
  return star_axes(way_(tau)).transposed() * there * star_axes(way_(first.tau));
}

}  // namespace domefall
