#include "pipeline/light/body_image.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <utility>

#include "pipeline/light/emission_time.h"
#include "pipeline/spacetime/schwarzschild.h"

namespace domefall {
namespace {

// A Light is the light of one order that comes from a place on the body's way.
struct Light {
  PlaceImage place;
  V3d across;     // the direction to which the ray sweeps
  double energy;  // E, signed, of light that is one in the tetrad
  double late;    // by how much later it would have to leave to be seen now, by v or u
};

// A Guess is one of when the light left the body, and what it leads to.
struct Guess {
  BodyPoint body;
  double psi;
  // This says whether a signal from there reaches the observer before now, so that the light left
  // later.
  bool is_past;
  std::optional<Light> light;  // none where none of that order comes from there
};

class Retardation {
 public:
  Retardation(const PlaceView& view, double null_time, const BodyMotion& motion, int order,
              double radius)
      : view_(view), null_time_(null_time), motion_(motion), order_(order), radius_(radius) {}

  Guess guess(double tau) const {
    using std::numbers::pi;
    Guess guess{motion_.at(tau), 0, false, {}};
    const BodyPoint& body = guess.body;
    if (body.r == 0) {
      guess.is_past = true;
      return guess;
    }
    const V3d& n = body.direction;
    const double sine = std::hypot(n.y, n.z), angle = std::atan2(sine, n.x);
    const bool same_side = order_ % 2 == 0;
    guess.psi = same_side ? angle + order_ * pi : (order_ + 1) * pi - angle;
    // On the axis two orders must not take opposite sides, to within what the time of emission is
    // found to.
    constexpr double kOnAxis = 1e-9;
    const V3d towards = sine > kOnAxis ? V3d(0, n.y, n.z) / sine : V3d(0, 1, 0);
    const V3d across = towards * (same_side ? 1.0 : -1.0);
    if (body.r > 2) {
      guess.light = light_by(view_, body, guess.psi, across);
      guess.is_past = guess.light && guess.light->late > 0;
    } else if (view_.at.above_horizon < 0) {
      // Within the hole light reaches the observer from both sides, with E > 0 and with E < 0.
      // What it has seen or sees lies between the two.
      PlaceView other = view_;
      other.far = true;
      const auto falling = light_by(view_, body, guess.psi, across),
                 rising = light_by(other, body, guess.psi, across);
      if (!falling || !rising) return guess;
      guess.is_past = falling->late > 0 && rising->late < 0;
      guess.light = std::abs(falling->late) < std::abs(rising->late) ? falling : rising;
    }
    // Nothing that is within the hole is seen from outside.
    return guess;
  }

 private:
  std::optional<Light> light_by(const PlaceView& view, const BodyPoint& body, double psi,
                                const V3d& across) const {
    const auto place = image_of_place(view, body.r, psi, radius_ / body.r);
    // A place of region II is on the ray before it has turned.
    if (!place || (body.r < 2 && place->slope < 0)) return std::nullopt;
    const double own = body.null_time - (view.outgoing ? 2 * Schwarzschild::tortoise(body.r) : 0);
    return Light{*place, across, invariants(place->ray).energy,
                 null_time_ + place->null_time - own};
  }

  const PlaceView& view_;
  double null_time_;
  const BodyMotion& motion_;
  int order_;
  double radius_;
};

// Returns k^r of the light at the body.  It is away from the hole if the ray goes inwards when
// followed back.
double radial_momentum(const PlaceView& view, const BodyPoint& body, const Light& light,
                       double momentum) {
  if (momentum > 0 && light.place.slope != 0)
    return -momentum * light.place.slope / (body.r * body.r);
  return body.r > view.at.r ? -std::abs(light.energy) : std::abs(light.energy);
}

// Returns the frequency that the body gives to light that is one in the tetrad.  With s = sqrt(2/r)
// it is (E + s k^r)/(1 - s^2) in the rain at the body.  For light that falls it is (E^2 + 2
// L^2/r^3)/(E - s k^r), where nothing cancels on the horizon.
double emitted(const PlaceView& view, const BodyPoint& body, const Light& light) {
  const double momentum = invariants(light.place.ray).angular_momentum, energy = light.energy;
  const double k_r = radial_momentum(view, body, light, momentum);
  const double s = Schwarzschild::free_fall_speed(body.r), across = momentum / body.r;
  const double in_rain = energy > 0 && k_r < 0
                             ? (energy * energy + s * s * across * across) / (energy - s * k_r)
                             : (energy + s * k_r) / (1 - s * s);
  // Light that comes back along the ray has the angular momentum -L about R x across.
  const V3d axis = V3d(1, 0, 0).cross(light.across);
  const double around = -across * axis.dot(body.angular_momentum) / body.r;
  return in_rain * body.gamma - (k_r + s * in_rain) * body.radial - around;
}

// Of the terms of the frequency only the last depends on the ray's plane: (R x e).L' = e.(L' x R).
V3d swing(const BodyPoint& body, const Light& light) {
  const double momentum = invariants(light.place.ray).angular_momentum;
  return body.angular_momentum.cross(V3d(1, 0, 0)) * (momentum / (body.r * body.r));
}

V3d seen_direction(const Light& light) {
  const NullRay& ray = light.place.ray;
  const double sine = 2 * ray.sin_half * ray.cos_half;
  const double cosine = (ray.cos_half - ray.sin_half) * (ray.cos_half + ray.sin_half);
  return V3d(ray.outgoing ? cosine : -cosine, 0, 0) + light.across * sine;
}

}  // namespace

std::optional<BodyImage> image_of_body(const PlaceView& view, double null_time,
                                       const BodyMotion& motion, int order, double radius) {
  constexpr int kSteps = 200;
  constexpr double kEnough = 1e-10;
  const Retardation retardation(view, null_time, motion, order, radius);
  // The instant lies between one whose light has come before and one whose light has yet to come.
  // Until both are found the steps grow.
  double low = motion.begin, high = motion.end, step = 1,
         tau = std::clamp(motion.guess.value_or(null_time), low, high);
  bool has_low = false, has_high = false;
  std::optional<std::pair<double, Guess>> best;
  for (int n = 0; n < kSteps; ++n) {
    if (tau <= low)
      tau = has_low || std::isfinite(low) ? std::midpoint(low, std::min(high, low + 2)) : tau;
    if (tau >= high) tau = std::isfinite(high) ? std::midpoint(std::max(low, high - 2), high) : tau;
    if (tau <= low || tau >= high) break;
    const Guess guess = retardation.guess(tau);
    std::optional<double> next;
    if (guess.light) {
      if (!best || std::abs(guess.light->late) < std::abs(best->second.light->late))
        best = {tau, guess};
      if (std::abs(guess.light->late) <= kEnough * guess.body.r) break;
      // The phase of light is the same along a ray: E dt = nu dtau.
      next =
          tau + guess.light->late * guess.light->energy / emitted(view, guess.body, *guess.light);
    }
    (guess.is_past ? low : high) = tau;
    (guess.is_past ? has_low : has_high) = true;
    if (next && *next > low && *next < high)
      tau = *next;
    else if (has_low && has_high)
      tau = std::midpoint(low, high);
    else
      tau += (has_low ? 1 : -1) * (step *= 2);
  }
  if (!best) return std::nullopt;
  const auto& [at, guess] = *best;
  const Light& light = *guess.light;
  const double ratio = 1 / emitted(view, guess.body, light);
  if (!(std::abs(light.late) <= 1e-6 * guess.body.r)) return std::nullopt;
  return BodyImage{seen_direction(light),
                   ratio,
                   guess.body.r,
                   at,
                   light.place.solid_angle_per_area,
                   guess.psi,
                   light.across,
                   swing(guess.body, light),
                   light.place.angle_per_length,
                   light.place.angle_per_psi};
}

}  // namespace domefall
