#include "trajectories/wormhole_path.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

#include "pipeline/spacetime/wormhole_leg.h"
#include "trajectories/flight_table.h"
#include "trajectories/orbit_bounds.h"
#include "trajectories/short_number.h"

namespace domefall {
namespace {

constexpr double kFarthestFall = 1e12;  // |l| of its beginning
constexpr double kFallEnds = 40;        // of u, beyond which r^2 - b^2 is r^2

OrbitPoint wormhole_point(const Wormhole& w, double l, double azimuth, double radial,
                          double tangential, const ProperTime& time) {
  OrbitPoint point;
  point.region = Wormhole::side(l);
  point.r = w.radius(l);
  point.azimuth = azimuth;
  point.celerity = {radial, 0, tangential};
  point.null_time = time + l;
  point.l = l;
  return point;
}

ProperTime times(double factor, const ProperTime& time) {
  return exact_product(factor, time.hi) + factor * time.lo;
}

}  // namespace

OrbitPoint WormholeCircle::at(const ProperTime& tau) const {
  const double gamma = 1 / std::sqrt((1 - speed) * (1 + speed)), celerity = gamma * speed;
  return wormhole_point(wormhole, l, double(tau) * celerity / wormhole.radius(l), 0, celerity,
                        times(gamma, tau));
}

// ---- free fall ----

// Lengths count along the path from where it turns, or from the middle of the throat, and are
// negative before.
struct WormholeFall::Tables {
  Wormhole wormhole;
  double celerity;  // sqrt(E^2 - 1)
  WormholeLeg leg;
  double last_u;
  FlightTable way;            // of the leg, in u over last_u, with the length as its proper time
  double straight;            // half of the length in the cylinder
  double from_side, heading;  // of the beginning: the sign of l, and that of dl
  double start = 0, start_azimuth = 0;

  struct Place {
    double l, azimuth, rise;  // |l|, azimuth from 0, |dl/ds|
  };
  Place place(double length) const;  // >= 0
  double length_of(double l) const;  // >= 0
};

WormholeFall::Tables::Place WormholeFall::Tables::place(double length) const {
  const double b = leg.impact();
  if (b == 0) return {length, 0, 1};
  if (length <= straight) {
    const double rise = 1 / leg.cylinder_rate();
    return {length * rise, b * length, rise};
  }
  const double beyond = length - straight, tabulated = way.whole().tau;
  const double q = beyond < tabulated ? way.parameter(beyond) : 1;
  const WormholeLeg::Place p = leg.at(q * last_u);
  return {wormhole.half_length() + p.y + std::max(0.0, beyond - tabulated),
          b * straight + way.to_go(q).azimuth, std::sqrt(p.rise)};
}

double WormholeFall::Tables::length_of(double l) const {
  const double b = leg.impact(), y = wormhole.beyond_mouth(l);
  if (b == 0) return std::abs(l);
  if (!leg.turns() && y == 0) return std::abs(l) * leg.cylinder_rate();
  const double r_less_b = std::max(0.0, wormhole.above_throat(l) + (1 - b));
  return straight + way.to_go(leg.parameter(y, r_less_b) / last_u).tau;
}

WormholeFall::WormholeFall(const Wormhole& wormhole, double from_l, double speed, double impact,
                           bool inward) {
  require_above("speed", "fraction of c", speed, 0, "what rests does not fall in a wormhole");
  require_below("speed", "fraction of c", speed, 1, "nothing outruns light");
  *this =
      with_celerity(wormhole, from_l, speed / std::sqrt((1 - speed) * (1 + speed)), impact, inward);
}

WormholeFall WormholeFall::thrown(const Wormhole& wormhole, double from_l, double along_l,
                                  double around) {
  const double celerity = std::hypot(along_l, around), r = wormhole.radius(from_l);
  require_above("speed", "gamma v", celerity, 0, "what rests does not fall in a wormhole");
  return with_celerity(wormhole, from_l, celerity, std::min(r, r * (around / celerity)),
                       (along_l < 0) == (from_l >= 0));
}

WormholeFall WormholeFall::with_celerity(const Wormhole& wormhole, double from_l, double celerity,
                                         double impact, bool inward) {
  require_at_least("impact_parameter", "radii of the throat", impact, 0, "the azimuth grows");
  if (!(std::abs(from_l) <= kFarthestFall))
    throw std::domain_error("from_l must be from -1e12 to 1e12 (radii of the throat), got " +
                            short_number(from_l));
  if (impact == 1)
    throw std::domain_error(
        "impact_parameter must not be 1 (radii of the throat), as that of a throw around the "
        "throat is: with it the path circles for ever");
  const double r = wormhole.radius(from_l);
  if (!(impact <= r))
    throw std::domain_error(fmt::format(
        "impact_parameter must be at most {} (radii of the throat), the r of from_l, got {}",
        short_number(r), short_number(impact)));
  const WormholeLeg leg(wormhole, impact, 1 - impact);
  const double far = 4 * kFarthestFall;
  const double last_u = leg.parameter(far, wormhole.above_throat(far) + (1 - impact)) + kFallEnds;
  const auto rates = [&leg, last_u](double q) {
    const WormholeLeg::Place p = leg.at(q * last_u);
    const double rate = p.rate * last_u;
    return FlightTable::Times{rate, 0, rate * leg.impact() / (p.r * p.r)};
  };
  const double side = from_l < 0 ? -1 : 1;
  const double straight = leg.turns() ? 0 : wormhole.half_length() * leg.cylinder_rate();
  Tables tables{wormhole,           celerity, leg,  last_u,
                FlightTable(rates), straight, side, inward ? -side : side};
  const double length = tables.length_of(from_l), swept = tables.place(length).azimuth;
  tables.start = inward ? -length : length;
  tables.start_azimuth = inward ? -swept : swept;
  WormholeFall fall;
  fall.tables_ = std::make_shared<const Tables>(std::move(tables));
  return fall;
}

bool WormholeFall::passes() const { return !tables_->leg.turns(); }

OrbitPoint WormholeFall::at(const ProperTime& tau) const {
  const Tables& t = *tables_;
  const auto length = double(times(t.celerity, tau) + t.start);
  const double sense = length < 0 ? -1 : 1;
  const Tables::Place place = t.place(std::abs(length));
  // Who passes goes on in the direction of l, and who turns stays on its side.
  const double side = passes() ? t.heading * sense : t.from_side;
  const double forward = passes() ? t.heading : t.from_side * sense;
  return wormhole_point(t.wormhole, side * place.l, sense * place.azimuth - t.start_azimuth,
                        forward * t.celerity * place.rise,
                        t.celerity * t.leg.impact() / t.wormhole.radius(place.l),
                        times(std::hypot(1, t.celerity), tau));
}

std::optional<ProperTime> WormholeFall::time_at(double r, Leg leg, const ProperTime& after) const {
  const Tables& t = *tables_;
  if (!(r >= reach().first && r <= kInfinity) || std::isinf(r)) return std::nullopt;
  const double length = t.length_of(t.wormhole.distance(r - 1));
  const ProperTime tau = ((leg == Leg::kInward ? -length : length) - t.start) / t.celerity;
  return tau >= after ? std::optional(tau) : std::nullopt;
}

std::optional<ProperTime> WormholeFall::time_at_l(double l, const ProperTime& after) const {
  const Tables& t = *tables_;
  const double r = t.wormhole.radius(l);
  if (!(r >= reach().first)) return std::nullopt;
  const bool beyond = l * t.from_side < 0;
  if (!passes() && beyond) return std::nullopt;
  for (const Leg leg : {Leg::kInward, Leg::kOutward}) {
    // Who passes is on each side on one leg alone.
    const bool inward = leg == Leg::kInward;
    if (passes() && inward != (l * t.heading < 0)) continue;
    const double length = t.length_of(l);
    const ProperTime tau = ((inward ? -length : length) - t.start) / t.celerity;
    if (tau >= after) return tau;
  }
  return std::nullopt;
}

std::pair<double, double> WormholeFall::reach() const {
  return {passes() ? 1 : tables_->leg.impact(), kInfinity};
}

// ---- keyframes ----

struct WormholeFlight::Tables {
  Wormhole wormhole;
  FlightTable times;
};

namespace {

// Returns the state with no null time yet.
OrbitPoint point_on(const Wormhole& w, const PathPiece& piece, double t) {
  const double l = piece.r.at(t);
  return wormhole_point(w, l, piece.azimuth.at(t), piece.r.slope(t) / piece.span(),
                        w.radius(l) * piece.azimuth.slope(t) / piece.span(), 0);
}

std::optional<ProperTime> earlier(const std::optional<ProperTime>& a,
                                  const std::optional<ProperTime>& b) {
  return !a || (b && *b < *a) ? b : a;
}

}  // namespace

WormholeFlight::WormholeFlight(const Wormhole& wormhole, const std::vector<PathKey>& keys)
    : KeyframePath(keys, "radii of the throat") {
  const auto rate = [&](std::size_t k, double t) {
    return gamma_of(point_on(wormhole, pieces()[k], t).celerity);
  };
  tables_ =
      std::make_shared<const Tables>(Tables{wormhole, null_times(rate, FlightTable::kTolerance)});
}

OrbitPoint WormholeFlight::at(const ProperTime& tau) const {
  const double time = on_path(tau);
  const PathPiece& piece = pieces()[piece_at(time)];
  OrbitPoint point = point_on(tables_->wormhole, piece, piece.part(time));
  point.null_time = point.null_time + null_time(tables_->times, time);
  return point;
}

std::optional<ProperTime> WormholeFlight::time_at(double r, Leg leg,
                                                  const ProperTime& after) const {
  if (!(r >= 1) || std::isinf(r)) return std::nullopt;
  const double far = tables_->wormhole.distance(r - 1);
  const Leg mirrored = leg == Leg::kInward ? Leg::kOutward : Leg::kInward;
  return earlier(KeyframePath::time_at(far, leg, after),
                 KeyframePath::time_at(-far, mirrored, after));
}

std::optional<ProperTime> WormholeFlight::time_at_l(double l, const ProperTime& after) const {
  return earlier(KeyframePath::time_at(l, Leg::kInward, after),
                 KeyframePath::time_at(l, Leg::kOutward, after));
}

std::pair<double, double> WormholeFlight::reach() const {
  const auto [low, high] = KeyframePath::reach();
  const Wormhole& w = tables_->wormhole;
  const double a = w.radius(low), b = w.radius(high);
  return {low * high <= 0 ? 1 : std::min(a, b), std::max(a, b)};
}

}  // namespace domefall
