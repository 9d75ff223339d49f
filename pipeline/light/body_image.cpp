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

// ---- what each kind of space has of its own ----

double horizon(const PlaceView&) { return Schwarzschild::horizon(); }
double horizon(const ChargedPlaceView& view) { return view.hole.horizon(); }
bool is_within(const PlaceView& view) { return view.at.above_horizon < 0; }
bool is_within(const ChargedPlaceView& view) { return view.r < view.hole.horizon(); }
double place_of(const PlaceView& view) { return view.at.r; }
double place_of(const ChargedPlaceView& view) { return view.r; }
bool is_outgoing(const PlaceView& view) { return view.outgoing; }
bool is_outgoing(const ChargedPlaceView&) { return false; }
double tortoise(const PlaceView&, double r) { return Schwarzschild::tortoise(r); }
double tortoise(const ChargedPlaceView& view, double r) { return view.hole.tortoise(r); }

// A wormhole has no horizon, and l tells its places apart.
double horizon(const WormholePlaceView&) { return Wormhole::horizon(); }
bool is_within(const WormholePlaceView&) { return false; }
double place_of(const WormholePlaceView& view) { return view.l; }
bool is_outgoing(const WormholePlaceView&) { return false; }
double tortoise(const WormholePlaceView&, double) { return 0; }
WormholePlaceView far_view(const WormholePlaceView& view) { return view; }

template <class View>
View far_view(View view) {
  view.far = true;
  return view;
}
template <class View>
double place_of(const View&, const BodyPoint& body) {
  return body.r;
}
double place_of(const WormholePlaceView&, const BodyPoint& body) { return body.l; }

// A Received is light in the frame of free fall at a place: its frequency, and against R the
// component of its motion.
struct Received {
  double frequency, along_r;
};

// With s = sqrt(2/r) the frequency is (E + s k^r)/(1 - s^2) in the rain.  For light that falls it is
// (E^2 + s^2 L^2/r^2)/(E - s k^r), where nothing cancels on the horizon.  `across` is L/r.
Received received(const PlaceView&, double r, double energy, double k_r, double across) {
  const double s = Schwarzschild::free_fall_speed(r);
  const double in_rain = energy > 0 && k_r < 0
                             ? (energy * energy + s * s * across * across) / (energy - s * k_r)
                             : (energy + s * k_r) / (1 - s * s);
  return {in_rain, k_r + s * in_rain};
}

// T has the frequency (E - k^r)/2 + (E + k^r)/(2 f), where (E + k^r)/f = (L/r)^2/(E - k^r).
Received received(const ChargedPlaceView& view, double r, double energy, double k_r,
                  double across) {
  const double half = energy > 0 && k_r < 0 ? across * across / (energy - k_r) / 2
                                            : (energy + k_r) / view.hole.lapse_squared(r) / 2;
  return {(energy - k_r) / 2 + half, half - (energy - k_r) / 2};
}

Received received(const WormholePlaceView&, double, double energy, double k_l, double) {
  return {energy, k_l};
}

// ---- light ----

// A Light is the light of one order that comes from a place on the body's way.
struct Light {
  PlaceLight place;
  V3d across;   // the direction to which the ray sweeps
  double late;  // by how much later it would have to leave to be seen now, by v or u
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

template <class View>
class Retardation {
 public:
  Retardation(const View& view, double null_time, const BodyMotion& motion, int order,
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
    if (body.r > horizon(view_)) {
      guess.light = light_by(view_, body, guess.psi, across);
      guess.is_past = guess.light && guess.light->late > 0;
    } else if (is_within(view_)) {
      // Within the hole light reaches the observer from both sides, with E > 0 and with E < 0.
      // What it has seen or sees lies between the two.
      const View other = far_view(view_);
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
  std::optional<Light> light_by(const View& view, const BodyPoint& body, double psi,
                                const V3d& across) const {
    const auto place = image_of_place(view, place_of(view, body), psi, radius_ / body.r);
    // A place of region II is on the ray before it has turned.
    if (!place || (body.r < horizon(view) && place->slope < 0)) return std::nullopt;
    const double own = body.null_time - (is_outgoing(view) ? 2 * tortoise(view, body.r) : 0);
    const PlaceLight& light = *place;
    return Light{light, across, null_time_ + light.null_time - own};
  }

  const View& view_;
  double null_time_;
  const BodyMotion& motion_;
  int order_;
  double radius_;
};

// Returns k^r of the light at the body.  It is away from the hole if the ray goes inwards when
// followed back.
template <class View>
double radial_momentum(const View& view, const BodyPoint& body, const PlaceLight& light) {
  if (light.angular_momentum > 0 && light.slope != 0)
    return -light.angular_momentum * light.slope / (body.r * body.r);
  return place_of(view, body) > place_of(view) ? -std::abs(light.energy) : std::abs(light.energy);
}

// Returns the frequency that the body gives to light that is one in the tetrad.
template <class View>
double emitted(const View& view, const BodyPoint& body, const Light& light) {
  const double across = light.place.angular_momentum / body.r;
  const double k_r = radial_momentum(view, body, light.place);
  const Received there = received(view, body.r, light.place.energy, k_r, across);
  // Light that comes back along the ray has the angular momentum -L about R x across.
  const V3d axis = V3d(1, 0, 0).cross(light.across);
  const double around = -across * axis.dot(body.angular_momentum) / body.r;
  return there.frequency * body.gamma - there.along_r * body.radial - around;
}

// Returns the direction in which the light left.
template <class View>
V3d ray_of(const View& view, const Guess& guess) {
  const BodyPoint& body = guess.body;
  const PlaceLight& light = guess.light->place;
  const double swept = light.angular_momentum / body.r;
  const Received there =
      received(view, body.r, light.energy, radial_momentum(view, body, light), swept);
  const V3d onward = guess.light->across * std::cos(guess.psi) - V3d(std::sin(guess.psi), 0, 0);
  return (body.direction * there.along_r - onward * swept) / there.frequency;
}

// Of the terms of the frequency only the last depends on the ray's plane: (R x e).L' = e.(L' x R).
V3d swing(const BodyPoint& body, const Light& light) {
  return body.angular_momentum.cross(V3d(1, 0, 0)) *
         (light.place.angular_momentum / (body.r * body.r));
}

V3d seen_direction(const Light& light, bool outgoing) {
  const PlaceLight& ray = light.place;
  const double sine = 2 * ray.sin_half * ray.cos_half;
  const double cosine = (ray.cos_half - ray.sin_half) * (ray.cos_half + ray.sin_half);
  return V3d(outgoing ? cosine : -cosine, 0, 0) + light.across * sine;
}

template <class View>
std::optional<BodyImage> body_image(const View& view, double null_time, const BodyMotion& motion,
                                    int order, double radius) {
  constexpr int kSteps = 200;
  constexpr double kEnough = 1e-10, kUsable = 1e-6;  // of r
  const Retardation<View> retardation(view, null_time, motion, order, radius);
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
      const double late = std::abs(guess.light->late),
                   least = best ? std::abs(best->second.light->late) : HUGE_VAL;
      if (late < least) best = {tau, guess};
      // The times of light that has gone around often are less exact.
      const bool settled = least <= kUsable * guess.body.r && late > least / 2;
      if (late <= kEnough * guess.body.r || settled) break;
      // The phase of light is the same along a ray: E dt = nu dtau.
      next = tau + guess.light->late * guess.light->place.energy /
                       emitted(view, guess.body, *guess.light);
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
  if (!(std::abs(light.late) <= kUsable * guess.body.r)) return std::nullopt;
  return BodyImage{seen_direction(light, is_outgoing(view)),
                   ratio,
                   guess.body.r,
                   at,
                   light.place.solid_angle_per_area,
                   guess.psi,
                   light.across,
                   swing(guess.body, light),
                   light.place.angle_per_length,
                   light.place.angle_per_psi,
                   ray_of(view, guess),
                   guess.body.celerity()};
}

template <class View>
std::optional<SeenPlace> place_seen(const View& view, double null_time, double r, double psi) {
  if (!(r > horizon(view))) return std::nullopt;
  const auto light = image_of_place(view, r, psi, 0);
  if (!light) return std::nullopt;
  BodyPoint body{};
  body.r = r;
  const double k_r = radial_momentum(view, body, *light);
  const Received there = received(view, r, light->energy, k_r, light->angular_momentum / r);
  const double angle = 2 * std::atan2(light->sin_half, light->cos_half);
  const PlaceLight& seen = *light;
  return SeenPlace{seen, is_outgoing(view) ? std::numbers::pi - angle : angle,
                   null_time + light->null_time + (is_outgoing(view) ? 2 * tortoise(view, r) : 0),
                   there.frequency, there.along_r};
}

}  // namespace

std::optional<SeenPlace> seen_place(const PlaceView& view, double null_time, double r, double psi) {
  return place_seen(view, null_time, r, psi);
}
std::optional<SeenPlace> seen_place(const ChargedPlaceView& view, double null_time, double r,
                                    double psi) {
  return place_seen(view, null_time, r, psi);
}

std::optional<BodyImage> image_of_body(const PlaceView& view, double null_time,
                                       const BodyMotion& motion, int order, double radius) {
  return body_image(view, null_time, motion, order, radius);
}
std::optional<BodyImage> image_of_body(const ChargedPlaceView& view, double null_time,
                                       const BodyMotion& motion, int order, double radius) {
  return body_image(view, null_time, motion, order, radius);
}
std::optional<BodyImage> image_of_body(const WormholePlaceView& view, double null_time,
                                       const BodyMotion& motion, int order, double radius) {
  return body_image(view, null_time, motion, order, radius);
}

}  // namespace domefall
