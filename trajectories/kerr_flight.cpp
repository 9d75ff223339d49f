#include "trajectories/kerr_flight.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>
#include <string>

#include "trajectories/flight_table.h"
#include "trajectories/monotone_cubic.h"
#include "trajectories/short_number.h"

namespace domefall {
namespace {

struct KerrPiece {
  double begin, end;  // proper time
  HermiteCubic r, theta, azimuth;
};

[[noreturn]] void refuse_kerr(std::size_t key, double tau, const std::string& why) {
  throw std::domain_error(
      fmt::format("key {}, at proper time {} (units of M): {}", key, short_number(tau), why));
}

void check_kerr_keys(const KerrHole& hole, const std::vector<KerrKey>& keys) {
  if (keys.size() < 2) throw std::domain_error("a path must have at least 2 keys");
  for (std::size_t k = 0; k < keys.size(); ++k) {
    const KerrKey& key = keys[k];
    if (!(key.r > static_cast<double>(hole.inner_horizon())))
      refuse_kerr(k + 1, key.tau, "r must exceed that of the inner horizon");
    if (k > 0 && !(key.tau > keys[k - 1].tau))
      refuse_kerr(k + 1, key.tau, "its proper time must exceed that of the key before");
  }
}

std::vector<KerrPiece> kerr_pieces(const std::vector<KerrKey>& keys) {
  std::vector<double> taus, radii, angles, azimuths;
  std::vector<std::optional<double>> radial, south, swept;
  for (const KerrKey& key : keys) {
    taus.push_back(key.tau), radii.push_back(key.r);
    angles.push_back(key.theta), azimuths.push_back(key.azimuth);
    const auto given = [&](double KerrKey::Rates::*rate) {
      return key.rates ? std::optional((*key.rates).*rate) : std::nullopt;
    };
    radial.push_back(given(&KerrKey::Rates::r)), south.push_back(given(&KerrKey::Rates::theta));
    swept.push_back(given(&KerrKey::Rates::azimuth));
  }
  const auto r = cubics_between(taus, radii, radial), theta = cubics_between(taus, angles, south),
             azimuth = cubics_between(taus, azimuths, swept);
  std::vector<KerrPiece> pieces;
  for (std::size_t k = 0; k < r.size(); ++k)
    pieces.push_back({taus[k], taus[k + 1], r[k], theta[k], azimuth[k]});
  return pieces;
}

// The place at an instant, its rates, and what they make of A's equation.
struct KerrInstant {
  double a, delta, sigma, sine, r, theta, azimuth;
  KerrKey::Rates rates;
  double f, b, lengths, square;  // the right side, and b^2 + f times it

  KerrInstant(const KerrHole& hole, const KerrPiece& piece, double t)
      : a(static_cast<double>(hole.spin)),
        r(piece.r.at(t)),
        theta(piece.theta.at(t)),
        azimuth(piece.azimuth.at(t)) {
    const double span = piece.end - piece.begin;
    rates = {piece.r.slope(t) / span, piece.theta.slope(t) / span, piece.azimuth.slope(t) / span};
    sine = std::sin(theta);
    const double cosine = std::cos(theta), across = sine * rates.azimuth;
    delta = static_cast<double>(hole.delta(r));
    sigma = r * r + a * a * cosine * cosine;
    f = (delta - a * a * sine * sine) / sigma;
    b = rates.r - a * sine * across;
    lengths = 1 + sigma * (rates.theta * rates.theta + across * across);
    square = b * b + f * lengths;
  }
  bool can_be() const { return f > 0 || (b < 0 && square >= 0); }
  double along() const {
    return b < 0 ? lengths / (std::sqrt(square) - b) : (b + std::sqrt(square)) / f;
  }
  double null_rate() const { return along() + a * sine * sine * rates.azimuth; }
};

void check_instant(const KerrHole& hole, const KerrPiece& piece, std::size_t key, double t) {
  const KerrInstant now(hole, piece, t);
  const double tau = piece.begin + t * (piece.end - piece.begin);
  const auto refuse = [&](const char* why) {
    refuse_kerr(key, tau, fmt::format("after it, at r = {}, {}", short_number(now.r), why));
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

KerrKey::Rates kerr_rates(const KerrHole& hole, double r, double theta,
                          const Celerity<ReferenceTetrad>& u) {
  const auto a = static_cast<double>(hole.spin);
  const double sine = std::sin(theta), cosine = std::cos(theta),
               sigma = r * r + a * a * cosine * cosine, root = std::sqrt(sigma);
  const double time = gamma_of(u), along = time + u.x;
  return {along * static_cast<double>(hole.delta(r)) / (2 * sigma) - (time - u.x) / 2, u.y / root,
          a * along / sigma + (sine > 0 ? u.z / (sine * root) : 0)};
}

struct KerrFlight::Tables {
  KerrHole hole;
  std::vector<KerrPiece> pieces;
  FlightTable times;

  Tables(const KerrHole& of, const std::vector<KerrPiece>& all)
      : hole(of), pieces(all), times(times_of(of, all)) {}

  static std::size_t piece_at(const std::vector<KerrPiece>& pieces, double tau) {
    const auto after =
        std::upper_bound(pieces.begin() + 1, pieces.end(), tau,
                         [](double value, const KerrPiece& p) { return value < p.begin; });
    return static_cast<std::size_t>(after - 1 - pieces.begin());
  }
  static double part_of(const KerrPiece& piece, double tau) {
    return std::clamp((tau - piece.begin) / (piece.end - piece.begin), 0.0, 1.0);
  }
  static FlightTable times_of(const KerrHole& hole, const std::vector<KerrPiece>& pieces);
};

FlightTable KerrFlight::Tables::times_of(const KerrHole& hole,
                                         const std::vector<KerrPiece>& pieces) {
  const double begin = pieces.front().begin, span = pieces.back().end - begin;
  const auto rates = [&](double q) {
    const double tau = begin + q * span;
    const std::size_t k = piece_at(pieces, tau);
    const double t = part_of(pieces[k], tau);
    check_instant(hole, pieces[k], k + 1, t);
    return FlightTable::Times{span, span * KerrInstant(hole, pieces[k], t).null_rate(), 0};
  };
  std::vector<double> kinks;
  for (std::size_t k = 1; k < pieces.size(); ++k) kinks.push_back((pieces[k].begin - begin) / span);
  return {rates, kinks, 1e-12};
}

KerrFlight::KerrFlight(const KerrHole& hole, const std::vector<KerrKey>& keys) {
  check_kerr_keys(hole, keys);
  const std::vector<KerrPiece> pieces = kerr_pieces(keys);
  constexpr int kSamples = 512;  // of a piece
  for (std::size_t k = 0; k < pieces.size(); ++k)
    for (int j = 0; j <= kSamples; ++j)
      check_instant(hole, pieces[k], k + 1, static_cast<double>(j) / kSamples);
  tables_ = std::make_shared<const Tables>(hole, pieces);
}

double KerrFlight::begin() const { return tables_->pieces.front().begin; }
double KerrFlight::end() const { return tables_->pieces.back().end; }
double KerrFlight::birth() const { return std::nextafter(begin(), -kInfinity); }
double KerrFlight::death() const { return std::nextafter(end(), kInfinity); }

OrbitPoint KerrFlight::at(const ProperTime& tau) const {
  const auto time = double(tau);
  const double span = end() - begin(), slack = 1e-12 * span;
  if (!(time >= begin() - slack && time <= end() + slack))
    throw std::domain_error("proper time " + short_number(time) +
                            " (units of M) is not on the path");
  const KerrPiece& piece = tables_->pieces[Tables::piece_at(tables_->pieces, time)];
  const KerrInstant now(tables_->hole, piece, Tables::part_of(piece, time));
  const double along = now.along(), root = std::sqrt(now.sigma);
  OrbitPoint point;
  point.region = now.r > static_cast<double>(tables_->hole.horizon()) ? Region::kI : Region::kII;
  point.r = now.r, point.theta = now.theta, point.azimuth = now.azimuth;
  point.celerity = {along / 2 - along * now.delta / (2 * now.sigma) + now.rates.r,
                    root * now.rates.theta,
                    now.sine * (root * now.rates.azimuth - now.a * along / root)};
  point.null_time = tables_->times.to_go(std::clamp((time - begin()) / span, 0.0, 1.0)).null_time;
  return point;
}

std::optional<ProperTime> KerrFlight::time_at(double r, Leg leg, const ProperTime& after) const {
  for (const KerrPiece& piece : tables_->pieces) {
    const std::vector<double> cuts = turns_of(piece.r);
    for (std::size_t k = 0; k + 1 < cuts.size(); ++k) {
      const double from = piece.r.at(cuts[k]), to = piece.r.at(cuts[k + 1]);
      if (from == to || (to < from) != (leg == Leg::kInward) || r < std::min(from, to) ||
          r > std::max(from, to))
        continue;
      const double t = where(piece.r, r, cuts[k], cuts[k + 1]);
      const ProperTime tau = piece.begin + t * (piece.end - piece.begin);
      if (tau >= after) return tau;
    }
  }
  return std::nullopt;
}

std::pair<double, double> KerrFlight::reach() const {
  double low = kInfinity, high = 0;
  for (const KerrPiece& piece : tables_->pieces)
    for (const double t : turns_of(piece.r))
      low = std::min(low, piece.r.at(t)), high = std::max(high, piece.r.at(t));
  return {low, high};
}

}  // namespace domefall
