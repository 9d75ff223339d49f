#include "pipeline/light/kerr_cone.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <mutex>
#include <numbers>

#include "pipeline/light/kerr_path.h"
#include "pipeline/light/kerr_sphere.h"
#include "pipeline/light/kerr_view.h"

namespace domefall {
namespace {

using std::numbers::pi;

// The offsets of rows on one side of the edge: by equal factors next to it, and then evenly.
std::vector<double> offsets_beside_edge(int even) {
  constexpr double kNearest = -10, kNear = -5, kEven = -1.6, kWide = 0.25, kStep = 0.2;
  std::vector<double> offsets;
  for (double log = kNearest; log < kEven; log += log < kNear ? kWide : kStep)
    offsets.push_back(std::exp(log));
  const double first = std::exp(kEven);
  for (int k = 0; k <= even; ++k) offsets.push_back(first + (1 - first) * k / even);
  return offsets;
}

// The parts of a ray's Mino time at which it has nodes: growing first, since the observer may be far away
// or next to a body, and shrinking towards its end, at the horizon or far away.
std::vector<double> shares_of(double r) {
  constexpr double kEven = 0.03, kGrowth = 1.35, kLast = 0.1, kShrink = 0.7;
  std::vector<double> shares{0};
  const double first = std::min(0.3 / r, 0.002);
  for (double share = first; share < kEven; share = share * kGrowth + first)
    shares.push_back(share);
  for (double share = kEven; share < 1 - kLast; share += kEven) shares.push_back(share);
  for (double left = kLast; left > 1e-3; left *= kShrink) shares.push_back(1 - left);
  return shares;
}

// A ray that is followed back in time over |E| times the Mino time: w, w', N, N', the angle by which N
// is turned, and v.
class SteppedRay {
 public:
  using State = std::array<double, 10>;

  explicit SteppedRay(const KerrStart& start)
      : a_(static_cast<double>(start.at.hole.spin)),
        squares_(static_cast<double>(start.at.hole.squares())),
        inner_(static_cast<double>(start.at.sigma() - start.mu.v)),
        kappa_(static_cast<double>(start.kappa.v)),
        sign_(start.mirrored ? -1 : 1) {
    const KerrSphere<double> sphere = kerr_sphere_of<double>(start);
    const auto sine = static_cast<double>(std::sin(start.at.theta));
    c_ = sphere.c;
    side_ = static_cast<double>(start.mu.v) + sign_ * a_ * a_ * sine * sine;
    const auto w = static_cast<double>(1 / start.at.r);
    const auto& [n, speed] = std::pair(sphere.place, sphere.speed);
    state_ = {w,        static_cast<double>(start.speed.v) * w * w,
              n[0],     n[1],
              n[2],     speed[0],
              speed[1], speed[2],
              0,        0};
  }

  double kappa() const { return kappa_; }
  void step(double length) {
    const State& s = state_;
    const State k1 = rates(s), k2 = rates(moved(s, k1, length / 2)),
                k3 = rates(moved(s, k2, length / 2)), k4 = rates(moved(s, k3, length));
    for (std::size_t i = 0; i < s.size(); ++i)
      state_[i] += length / 6 * (k1[i] + 2 * k2[i] + 2 * k3[i] + k4[i]);
  }
  KerrCone::Node node(double mino) const {
    const State& s = state_;
    const double c = std::cos(s[8]), sine = std::sin(s[8]), y = sign_ * s[3];
    return {static_cast<float>(s[0]),
            static_cast<float>(mino),
            s[9],
            static_cast<float>(s[2] * c - y * sine),
            static_cast<float>(s[2] * sine + y * c),
            static_cast<float>(s[4])};
  }
  double w() const { return state_[0]; }
  bool mirrored() const { return sign_ < 0; }

 private:
  static State moved(State s, const State& rate, double by) {
    for (std::size_t i = 0; i < s.size(); ++i) s[i] += by * rate[i];
    return s;
  }
  // (dw/dl)^2 = p^2 - kappa^2 w^2 (1 - 2w + (a^2 + q^2) w^2), p = 1 + (sigma - mu) w^2.
  State rates(const State& s) const {
    const double w = s[0], w2 = w * w, p = 1 + inner_ * w2, delta = 1 - 2 * w + squares_ * w2,
                 kappa2 = kappa_ * kappa_, z2 = s[4] * s[4];
    const double pull = 2 * p * inner_ * w - kappa2 * w * (1 - 3 * w + 2 * squares_ * w2);
    const double level = -(c_ + 2 * a_ * a_ * z2), signed_p = sign_ * p, over = signed_p - s[1];
    const bool differ = (signed_p > 0) != (s[1] > 0);
    const double a = differ ? kappa2 * w2 / over : (signed_p + s[1]) / delta,
                 r2 = differ ? kappa2 / over : a / w2;
    return {s[1],
            pull,
            s[5],
            s[6],
            s[7],
            level * s[2],
            level * s[3],
            (level + a_ * a_) * s[4],
            a_ * (sign_ - a),
            -(r2 + a_ * a_ * a) - side_ + sign_ * a_ * a_ * (1 - z2)};
  }

  double a_, squares_, inner_, kappa_, sign_, c_ = 0, side_ = 0;
  State state_{};
};

}  // namespace

KerrCone::KerrCone(const KerrPlace& at) : at_(at), shares_(shares_of(static_cast<double>(at.r))) {
  constexpr int kOutside = 18, kInside = 6;
  offsets_ = offsets_beside_edge(kInside);
  for (double& offset : offsets_) offset = -offset;
  std::ranges::reverse(offsets_);
  for (const double offset : offsets_beside_edge(kOutside)) offsets_.push_back(offset);
  nodes_.reserve(offsets_.size() * kColumns * shares_.size());
  for (int row = 0; row < rows(); ++row)
    for (int column = 0; column < kColumns; ++column) follow(row, column);
}

void KerrCone::follow(int row, int column) {
  const Direction n = direction(row, column);
  const KerrStart start = kerr_start(at_, {n.delta, n.eta});
  const KerrPath<double> path(start, kerr_roots(start));
  SteppedRay ray(start);
  constexpr double kStep = 0.08;  // radians
  const double whole = std::min(path.mino_between(path.first(), path.last()),
                                kFarthest / std::max(ray.kappa(), 1e-9));
  const auto horizon = static_cast<float>(1 / at_.hole.horizon());
  double mino = 0;
  bool over = false;
  for (int k = 0; k < samples(); ++k) {
    const double length = shares_[static_cast<std::size_t>(k)] * whole - mino;
    const int steps = std::max(2, static_cast<int>(std::ceil(ray.kappa() * length / kStep)));
    for (int i = 0; i < steps && length > 0; ++i) ray.step(length / steps);
    mino += length;
    Node node = ray.node(mino);
    over = over || !(node.w > 0) || !std::isfinite(node.null_time) || !std::isfinite(node.x) ||
           (ray.mirrored() && node.w <= horizon);
    if (over) node.w = -1;
    nodes_.push_back(node);
  }
}

KerrCone::Direction KerrCone::direction(double row, double column) const {
  const int k = std::clamp(static_cast<int>(std::floor(row)), 0, rows() - 2);
  const double part = row - k, low = offsets_[static_cast<std::size_t>(k)],
               high = offsets_[static_cast<std::size_t>(k + 1)];
  const double offset =
      low * high > 0 ? low * std::pow(high / low, part) : low + (high - low) * part;
  const double eta = 2 * pi * column / kColumns;
  const double edge = kerr_edge_delta(at_, eta);
  return {std::clamp(edge + offset * (offset > 0 ? pi - edge : edge), 0.0, pi), eta};
}

std::shared_ptr<const KerrCone> kerr_cone(const KerrPlace& at) {
  constexpr std::size_t kKept = 4;
  static std::mutex mutex;
  static std::vector<std::shared_ptr<const KerrCone>> kept;
  const auto find = [&]() -> std::shared_ptr<const KerrCone> {
    for (const auto& cone : kept)
      if (cone->at() == at) return cone;
    return nullptr;
  };
  {
    const std::scoped_lock lock(mutex);
    if (auto cone = find()) return cone;
  }
  auto made = std::make_shared<const KerrCone>(at);
  const std::scoped_lock lock(mutex);
  if (auto cone = find()) return cone;
  if (kept.size() >= kKept) kept.erase(kept.begin());
  kept.push_back(made);
  return made;
}

}  // namespace domefall
