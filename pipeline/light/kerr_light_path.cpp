#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "pipeline/base/simd/vector_math.h"
#include "pipeline/light/kerr_clock.h"
#include "pipeline/light/kerr_view.h"
#include "pipeline/light/light_path.h"

namespace domefall {
namespace {

using std::numbers::pi;

// The longest steps: in the angle that N and its plane turn by (less where r is small), and as a part
// of w; and where a path ends.
constexpr double kMostStep = 0.05, kMostTurning = 0.2, kMostChange = 0.08;
constexpr double kMostTurn = 3.5 * pi, kLeastDelta = 1e-4;

double geometric_mean_limit(double a, double b) {
  for (int k = 0; k < 30 && std::abs(a - b) > 1e-15 * a; ++k) {
    const double mean = (a + b) / 2;
    b = std::sqrt(a * b), a = mean;
  }
  return a;
}

// w, N, and by Mino's time back from the observer their derivatives; the angle of the plane of N, and v.
// Where the photon moves outwards, angle and time lack twice what r# and r* grow by.
struct State {
  double w, speed;
  V3d n, turning;
  double angle, time;

  State moved(const State& by, double h) const {
    return {w + h * by.w,         speed + h * by.speed, n + by.n * h, turning + by.turning * h,
            angle + h * by.angle, time + h * by.time};
  }
};

class Motion {
 public:
  Motion(const KerrPlace& at, double delta, double eta) {
    const auto r = static_cast<double>(at.r), theta = static_cast<double>(at.theta);
    a_ = static_cast<double>(at.hole.spin), squares_ = static_cast<double>(at.hole.squares());
    const double sine = std::sin(theta), cosine = std::cos(theta);
    const double sigma = r * r + static_cast<double>(at.sigma());
    const double s = std::sin(delta / 2), c = std::cos(delta / 2);
    const auto above = static_cast<double>(at.delta());
    const KerrConstants of(at, delta, eta);
    const double across = of.momentum;
    energy = of.energy, carter = across * across, momentum = of.about_axis;
    c_ = a_ * (a_ * energy - momentum);
    const double polar = across * std::cos(eta),
                 azimuthal = across * std::sin(eta) + a_ * energy * sine;
    start = {1 / r,
             (above * c * c - sigma * s * s) / (r * r),
             V3d(sine, 0, cosine),
             V3d(-cosine * polar, -azimuthal, sine * polar),
             0,
             0};
  }

  double rate_of_psi() const {
    const double l = momentum - a_ * energy, ae2 = a_ * a_ * energy * energy;
    const double linear = carter + 2 * a_ * energy * l, free = carter - l * l;
    if (free < 0) return std::sqrt(carter + ae2);
    const double d = std::sqrt(linear * linear + 4 * ae2 * free);
    return std::max(geometric_mean_limit(std::sqrt(d), std::sqrt(std::max(0.0, (linear + d) / 2))),
                    1e-3 * std::sqrt(carter + ae2));
  }

  // Says whether light that moves inwards, back in time, gets from far away to w.
  bool reaches(double w) const {
    const double p = energy + c_ * w * w;
    return p * p > carter * w * w * delta(w);
  }

  double delta(double w) const { return 1 - 2 * w + squares_ * w * w; }  // over r^2

  // By how much the angle grows in all.
  double turning(const State& at) const {
    const double rest = rates(at).angle;
    return at.speed > 0 ? rest - 2 * a_ * at.speed / delta(at.w) : rest;
  }

  State rates(const State& at) const {
    const double w = at.w, w2 = w * w, p = energy + c_ * w2, ae = a_ * energy;
    const double acceleration = 2 * c_ * w * p - carter * w * (1 - 3 * w + 2 * squares_ * w2);
    const double z = at.n.z;
    const V3d pull = at.n * -(carter + 2 * ae * momentum - ae * ae + 2 * ae * ae * z * z) +
                     V3d(0, 0, ae * ae * z);
    // A, or where the photon moves outwards A - 2r'/Delta, which is that of (P - r')/Delta.
    const double over = carter / (p + std::abs(at.speed));  // A r^2
    const double sine2 = std::max(0.0, (1 - z) * (1 + z));
    return {at.speed,
            acceleration,
            at.turning,
            pull,
            ae - a_ * over * w2,
            -(over + a_ * a_ * over * w2) - a_ * (momentum - ae * sine2)};
  }

  State step(const State& at, double h) const {
    const State k1 = rates(at), k2 = rates(at.moved(k1, h / 2)), k3 = rates(at.moved(k2, h / 2)),
                k4 = rates(at.moved(k3, h));
    return at.moved(k1, h / 6).moved(k2, h / 3).moved(k3, h / 3).moved(k4, h / 6);
  }

  double energy, carter, momentum;
  State start;

 private:
  double a_, squares_, c_;
};

}  // namespace

LightPath kerr_light_path(const KerrPlace& at, double delta, double eta, double outer) {
  const Motion motion(at, delta, eta);
  LightPath path;
  path.energy = motion.energy;
  if (!KerrConstants(at, delta, eta).comes_from_region_one(at)) return path;
  const double least = 1 / outer;
  if (motion.start.w < least && !(motion.start.speed > 0 && motion.reaches(least))) return path;
  path.momentum = std::sqrt(motion.carter);
  path.rate = motion.rate_of_psi();
  const double sine = std::sin(static_cast<double>(at.theta)),
               cosine = std::cos(static_cast<double>(at.theta));
  const V3d x(sine, cosine, 0), y(0, 0, 1), z(cosine, -sine, 0);
  path.about = z * motion.momentum;
  constexpr std::size_t kManyPlaces = 160;
  path.places.reserve(kManyPlaces);
  State state = motion.start;
  const KerrClock clock(at.hole);
  double psi = 0;
  const auto place = [&] {
    const SineCosine turned = sin_cos(state.angle);
    const auto in_lens = [&](const V3d& v) {
      return x * (v.x * turned.cosine - v.y * turned.sine) +
             y * (v.x * turned.sine + v.y * turned.cosine) + z * v.z;
    };
    const V3d there = in_lens(state.n);
    const V3d turning = in_lens(state.turning) + z.cross(there) * motion.turning(state);
    path.places.push_back(
        {psi, state.w, state.speed / path.rate, there, turning / path.rate, state.time});
  };
  place();
  while (psi < kMostTurn) {
    if (state.speed < 0 ? state.w < least : motion.delta(state.w) < kLeastDelta) break;
    const double fast = state.turning.length();
    const double h =
        std::min({kMostStep / (std::max(1.0, 3 * state.w) * std::max(fast, 1e-9)),
                  kMostTurning / std::max(std::abs(motion.turning(state)), 1e-9),
                  kMostChange * state.w / std::max(std::abs(state.speed), 1e-9 * state.w)});
    const bool outgoing = state.speed > 0;
    const double before = state.w;
    state = motion.step(state, h);
    if (!(state.w > 0)) state.w = 1e-9 * least;
    psi += path.rate * h;
    if (outgoing) {
      state.angle -= 2 * std::abs(clock.twist(1 / state.w) - clock.twist(1 / before));
      state.time -= 2 * std::abs(clock.tortoise(1 / state.w) - clock.tortoise(1 / before));
    }
    place();
  }
  if (path.places.size() == 1) path.places.clear();
  return path;
}

}  // namespace domefall
