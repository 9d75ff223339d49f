#include "trajectories/kerr_flight.h"

#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "trajectories/short_number.h"

namespace domefall {
namespace {

// The place at an instant, its rates, and what they make of A's equation.
struct KerrInstant {
  double a, delta, sigma, sine, r, theta;
  double radial_rate, theta_rate, azimuth_rate;
  double f, b, lengths, square;  // the right side, and b^2 + f times it

  KerrInstant(const KerrHole& hole, const PathPiece& piece, double t)
      : a(static_cast<double>(hole.spin)),
        r(piece.r.at(t)),
        theta(piece.theta.at(t)),
        radial_rate(piece.r.slope(t) / piece.span()),
        theta_rate(piece.theta.slope(t) / piece.span()),
        azimuth_rate(piece.azimuth.slope(t) / piece.span()) {
    sine = std::sin(theta);
    const double cosine = std::cos(theta), across = sine * azimuth_rate;
    delta = static_cast<double>(hole.delta(r));
    sigma = r * r + a * a * cosine * cosine;
    f = (delta - a * a * sine * sine) / sigma;
    b = radial_rate - a * sine * across;
    lengths = 1 + sigma * (theta_rate * theta_rate + across * across);
    square = b * b + f * lengths;
  }
  bool can_be() const { return f > 0 || (b < 0 && square >= 0); }
  double along() const {
    return b < 0 ? lengths / (std::sqrt(square) - b) : (b + std::sqrt(square)) / f;
  }
  double null_rate() const { return along() + a * sine * sine * azimuth_rate; }
};

void check_instant(const KerrHole& hole, const PathPiece& piece, std::size_t key, double t) {
  const KerrInstant now(hole, piece, t);
  const auto refuse = [&](const char* why) {
    refuse_key(key, piece.time(t),
               fmt::format("after it, at r = {}, {}", short_number(now.r), why));
  };
  if (!(now.r > static_cast<double>(hole.inner_horizon()))) refuse("it passes the inner horizon");
  if (!(now.theta >= 0 && now.theta <= std::numbers::pi)) refuse("it goes over the axis");
  if (now.can_be()) return;
  if (now.r <= static_cast<double>(hole.horizon()))
    refuse("nothing stops falling inside the hole, and it must fall faster or turn less");
  refuse(
      "it is within the ergosphere, where nothing rests against the stars: azimuth_deg must grow "
      "faster, with the hole, or r fall faster");
}

}  // namespace

void set_kerr_rates(const KerrHole& hole, PathKey& key, const Celerity<ReferenceTetrad>& u) {
  const auto a = static_cast<double>(hole.spin);
  const double sine = std::sin(key.theta), cosine = std::cos(key.theta),
               sigma = key.r * key.r + a * a * cosine * cosine, root = std::sqrt(sigma);
  const double time = gamma_of(u), along = time + u.x;
  key.radial_rate = along * static_cast<double>(hole.delta(key.r)) / (2 * sigma) - (time - u.x) / 2;
  key.theta_rate = u.y / root;
  key.azimuth_rate = a * along / sigma + (sine > 0 ? u.z / (sine * root) : 0);
}

struct KerrFlight::Tables {
  KerrHole hole;
  FlightTable times;
};

KerrFlight::KerrFlight(const KerrHole& hole, const std::vector<PathKey>& keys)
    : KeyframePath(keys) {
  for (std::size_t k = 0; k < keys.size(); ++k)
    if (!(keys[k].r > static_cast<double>(hole.inner_horizon())))
      refuse_key(k + 1, keys[k].tau, "r must exceed that of the inner horizon");
  constexpr int kSamples = 512;  // of a piece
  for (std::size_t k = 0; k < pieces().size(); ++k)
    for (int j = 0; j <= kSamples; ++j)
      check_instant(hole, pieces()[k], k + 1, static_cast<double>(j) / kSamples);
  const auto rate = [&](std::size_t k, double t) {
    check_instant(hole, pieces()[k], k + 1, t);
    return KerrInstant(hole, pieces()[k], t).null_rate();
  };
  tables_ = std::make_shared<const Tables>(Tables{hole, null_times(rate, 1e-12)});
}

OrbitPoint KerrFlight::at(const ProperTime& tau) const {
  const double time = on_path(tau);
  const PathPiece& piece = pieces()[piece_at(time)];
  const KerrInstant now(tables_->hole, piece, piece.part(time));
  const double along = now.along(), root = std::sqrt(now.sigma);
  OrbitPoint point;
  point.region = now.r > static_cast<double>(tables_->hole.horizon()) ? Region::kI : Region::kII;
  point.r = now.r, point.theta = now.theta, point.azimuth = piece.azimuth.at(piece.part(time));
  point.celerity = {along / 2 - along * now.delta / (2 * now.sigma) + now.radial_rate,
                    root * now.theta_rate,
                    now.sine * (root * now.azimuth_rate - now.a * along / root)};
  point.null_time = null_time(tables_->times, time);
  return point;
}

}  // namespace domefall
