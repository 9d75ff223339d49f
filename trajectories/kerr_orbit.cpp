#include "trajectories/kerr_orbit.h"

#include <algorithm>
#include <cmath>

#include "trajectories/kerr_latitude.h"
#include "trajectories/kerr_radius.h"

namespace domefall {
namespace {

double squared(double x) { return x * x; }

// Returns N' of a motion at its beginning.
V3d polar_speed(const KerrHole& hole, double r, double theta, const KerrMotion& motion) {
  const auto a = static_cast<double>(hole.spin);
  const double sine = std::sin(theta), cosine = std::cos(theta);
  const double root = std::sqrt(r * r + squared(a * cosine));
  const double south = root * motion.celerity.y,
               // Without angular momentum it goes over the axis, as no rounding may tell.
      around = motion.momentum == 0 && sine > 0
                   ? 0
                   : root * motion.celerity.z + a * motion.energy * sine;
  return {cosine * south, around, -sine * south};
}

// Returns r' of a motion at its beginning, by P - 2 Sigma B.
double radial_speed(const KerrHole& hole, double r, double theta, const KerrMotion& motion) {
  const auto a = static_cast<double>(hole.spin);
  const Celerity<ReferenceTetrad>& u = motion.celerity;
  const double sigma = r * r + squared(a * std::cos(theta)), time = gamma_of(u);
  const double p = (r * r + a * a) * motion.energy - a * motion.momentum;
  const double b = u.x > 0 ? (1 + u.y * u.y + u.z * u.z) / (2 * (time + u.x)) : (time - u.x) / 2;
  const double speed = p - 2 * sigma * b;
  // What is left of a motion that turns there is rounding.
  return std::abs(speed) < 1e-15 * (std::abs(p) + sigma) ? 0 : speed;
}

}  // namespace

struct KerrOrbit::Path {
  KerrHole hole;
  double a;
  KerrMotion motion;
  KerrRadius radius;
  KerrLatitude latitude;
  bool on_axis;  // where the azimuth has no meaning and stays

  Path(const KerrHole& of, double r, double theta, const KerrMotion& m)
      : hole(of),
        a(static_cast<double>(of.spin)),
        motion(m),
        radius(of, m, r, radial_speed(of, r, theta, m)),
        latitude(a * a * m.excess, V3d(std::sin(theta), 0, std::cos(theta)),
                 polar_speed(of, r, theta, m)),
        on_axis(std::sin(theta) < 1e-9 && polar_speed(of, r, theta, m).length() < 1e-9) {}

  DoubleDouble tau_at(const DoubleDouble& l) const {
    return radius.at(l).squares + a * a * latitude.at(double(l)).squares;
  }
  DoubleDouble mino_at(const DoubleDouble& tau) const;
  OrbitPoint point(const DoubleDouble& l) const;
};

// By Newton's method within bounds, since Sigma is above 0.
DoubleDouble KerrOrbit::Path::mino_at(const DoubleDouble& tau) const {
  DoubleDouble low = radius.first(), high = radius.last(), l = 0;
  if (low == -HUGE_VAL || high == HUGE_VAL) {
    const double period = radius.has_period() ? radius.period() : 1;
    l = double(tau) / ((double(radius.at(period).squares) + a * a / 2 * period) / period);
    const double wide = radius.has_period() ? period : std::abs(double(l));
    for (double by = wide + 1e-9; low == -HUGE_VAL; by *= 2)
      if (tau_at(l - by) <= tau) low = l - by;
    for (double by = wide + 1e-9; high == HUGE_VAL; by *= 2)
      if (tau_at(l + by) >= tau) high = l + by;
  } else {
    const auto& nodes = radius.nodes();
    const auto later = std::upper_bound(
        nodes.begin() + 1, nodes.end(), tau, [this](const auto& t, const KerrRadius::Node& node) {
          return t < node.squares + a * a * latitude.at(double(node.l)).squares;
        });
    l = low = (later - 1)->l;
    if (later != nodes.end()) high = later->l;
  }
  for (int step = 0; step < 100; ++step) {
    const KerrRadius::Node r = radius.at(l);
    const KerrLatitude::Node place = latitude.at(double(l));
    const auto over = double(r.squares + a * a * place.squares - tau);
    (over > 0 ? high : low) = l;
    const DoubleDouble next = l - over / (r.r * r.r + squared(a * place.n.z));
    const DoubleDouble taken = next > low && next < high ? next : low + double(high - low) / 2;
    const double change = std::abs(double(taken - l));
    l = taken;
    // What changes r by less than rounding.
    if (change * (1 + std::abs(r.speed) / r.r) <= 1e-16 * std::abs(double(l))) break;
  }
  return l;
}

OrbitPoint KerrOrbit::Path::point(const DoubleDouble& l) const {
  const KerrRadius::Node at = radius.at(l);
  const KerrLatitude::Node place = latitude.at(double(l));
  const auto passed = double(l);
  OrbitPoint point;
  const double across = std::hypot(place.n.x, place.n.y);
  const double cosine = place.n.z, sigma = at.r * at.r + a * a * cosine * cosine;
  const double along = std::atan2(place.n.y, place.n.x);
  const V3d round(-std::sin(along), std::cos(along), 0);
  const V3d south(cosine * std::cos(along), cosine * std::sin(along), -across);
  const double p = (at.r * at.r + a * a) * motion.energy - a * motion.momentum;
  const double outward = along_falling(hole, at.r, p, at.speed, motion.carter),
               b = (p - at.speed) / (2 * sigma);
  const double size = std::sqrt(sigma);
  point.region = at.r > static_cast<double>(hole.horizon()) ? Region::kI : Region::kII;
  point.r = at.r;
  point.theta = std::atan2(across, cosine);
  point.azimuth = on_axis ? 0 : place.turned + a * (at.angle - motion.energy * passed);
  point.celerity = {outward / 2 - b, place.speed.dot(south) / size,
                    (place.speed.dot(round) - a * motion.energy * across) / size};
  point.null_time =
      at.time + a * (motion.momentum * passed - a * motion.energy * (passed - place.squares));
  return point;
}

KerrOrbit::KerrOrbit(const KerrHole& hole, double r, double theta, const KerrMotion& motion)
    : path_(std::make_shared<const Path>(hole, r, theta, motion)) {}

OrbitPoint KerrOrbit::at(const ProperTime& tau) const {
  const DoubleDouble l = path_->mino_at(tau);
  return path_->point(std::clamp(l, path_->radius.first(), path_->radius.last()));
}

double KerrOrbit::birth() const {
  return path_->radius.comes_out() ? double(path_->tau_at(path_->radius.first())) : -kInfinity;
}
double KerrOrbit::death() const {
  return path_->radius.ends() ? double(path_->tau_at(path_->radius.last())) : kInfinity;
}
std::pair<double, double> KerrOrbit::reach() const {
  const KerrRadius& radius = path_->radius;
  return {radius.least(),
          radius.greatest() < KerrRadius::kFarthest ? radius.greatest() : kInfinity};
}

// Radii and latitudes have periods of their own, so that a period of tau is one on the average.
double KerrOrbit::radial_period() const {
  const KerrRadius& radius = path_->radius;
  return radius.has_period() ? double(path_->tau_at(radius.period())) : kInfinity;
}

namespace {

// Returns the Mino time from which on something is sought.
template <class Path>
DoubleDouble mino_after(const Path& path, const ProperTime& after) {
  return double(after) > -kInfinity ? path.mino_at(after) : DoubleDouble(-HUGE_VAL);
}

}  // namespace

std::optional<ProperTime> KerrOrbit::time_at(double r, Leg leg, const ProperTime& after) const {
  const auto l = path_->radius.passage(r, leg == Leg::kOutward, mino_after(*path_, after));
  return l ? std::optional<ProperTime>(path_->tau_at(*l)) : std::nullopt;
}

std::optional<ProperTime> KerrOrbit::next_periastron(const ProperTime& after) const {
  const auto l = path_->radius.next_least(mino_after(*path_, after));
  return l ? std::optional<ProperTime>(path_->tau_at(*l)) : std::nullopt;
}

OrbitPoint KerrCircling::at(const ProperTime& tau) const {
  const KerrMotion motion = kerr_circling(hole, r, theta, angular_velocity).value();
  const double time = double(tau) * circling_rate(hole, r, theta, angular_velocity);
  OrbitPoint point;
  point.r = r, point.theta = theta;
  point.azimuth = angular_velocity * time;
  point.null_time = time;
  point.celerity = motion.celerity;
  return point;
}

}  // namespace domefall
