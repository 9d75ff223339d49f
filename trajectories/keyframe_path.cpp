#include "trajectories/keyframe_path.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "trajectories/short_number.h"

namespace domefall {
namespace {

// Says whether double precision does not hold the squares of the rates well.
bool is_too_fast(const PathKey& from, const PathKey& to) {
  constexpr double kFastest = 1e100;
  const double span = to.tau - from.tau, far = 1 + std::max(std::abs(from.r), std::abs(to.r));
  return !(std::abs(to.r - from.r) < kFastest * span) ||
         !(std::abs(to.azimuth - from.azimuth) * far < kFastest * span);
}

void check_keys(const std::vector<PathKey>& keys, const char* unit) {
  if (keys.size() < 2) throw std::domain_error("a path must have at least 2 keys");
  for (std::size_t k = 0; k < keys.size(); ++k) {
    const PathKey& key = keys[k];
    for (const double value : {key.tau, key.r, key.azimuth, key.theta, key.radial_rate.value_or(0),
                               key.azimuth_rate.value_or(0), key.theta_rate.value_or(0)})
      if (!std::isfinite(value))
        refuse_key(k + 1, key.tau, "its values must be finite numbers", unit);
    if (k == 0) continue;
    if (!(key.tau > keys[k - 1].tau))
      refuse_key(k + 1, key.tau, "its proper time must exceed that of the key before", unit);
    if (is_too_fast(keys[k - 1], key))
      refuse_key(k + 1, key.tau, "it is too close in proper time to the key before", unit);
  }
}

std::vector<PathPiece> pieces_of(const std::vector<PathKey>& keys) {
  std::vector<double> taus(keys.size());
  std::ranges::transform(keys, taus.begin(), &PathKey::tau);
  const auto cubics = [&](double PathKey::*value, std::optional<double> PathKey::*rate) {
    std::vector<double> values;
    std::vector<std::optional<double>> rates;
    for (const PathKey& key : keys) values.push_back(key.*value), rates.push_back(key.*rate);
    return cubics_between(taus, values, rates);
  };
  const auto r = cubics(&PathKey::r, &PathKey::radial_rate),
             azimuth = cubics(&PathKey::azimuth, &PathKey::azimuth_rate),
             theta = cubics(&PathKey::theta, &PathKey::theta_rate);
  std::vector<PathPiece> pieces;
  for (std::size_t k = 0; k < r.size(); ++k)
    pieces.push_back({taus[k], taus[k + 1], r[k], azimuth[k], theta[k]});
  return pieces;
}

}  // namespace

double PathPiece::part(double tau) const { return std::clamp((tau - begin) / span(), 0.0, 1.0); }

void refuse_key(std::size_t key, double tau, const std::string& why, const char* unit) {
  throw std::domain_error(
      fmt::format("key {}, at proper time {} ({}): {}", key, short_number(tau), unit, why));
}

KeyframePath::KeyframePath(const std::vector<PathKey>& keys, const char* unit) : unit_(unit) {
  check_keys(keys, unit);
  pieces_ = std::make_shared<const std::vector<PathPiece>>(pieces_of(keys));
}

double KeyframePath::birth() const { return std::nextafter(begin(), -kInfinity); }
double KeyframePath::death() const { return std::nextafter(end(), kInfinity); }

std::optional<ProperTime> KeyframePath::time_at(double r, Leg leg, const ProperTime& after) const {
  for (const PathPiece& piece : pieces()) {
    const std::vector<double> cuts = turns_of(piece.r);
    for (std::size_t k = 0; k + 1 < cuts.size(); ++k) {
      const double from = piece.r.at(cuts[k]), to = piece.r.at(cuts[k + 1]);
      if (from == to || (to < from) != (leg == Leg::kInward) || r < std::min(from, to) ||
          r > std::max(from, to))
        continue;
      const ProperTime tau = piece.time(where(piece.r, r, cuts[k], cuts[k + 1]));
      if (tau >= after) return tau;
    }
  }
  return std::nullopt;
}

std::pair<double, double> KeyframePath::reach() const {
  double low = kInfinity, high = -kInfinity;
  for (const PathPiece& piece : pieces())
    for (const double t : turns_of(piece.r))
      low = std::min(low, piece.r.at(t)), high = std::max(high, piece.r.at(t));
  return {low, high};
}

std::size_t KeyframePath::piece_at(double tau) const {
  const auto after =
      std::upper_bound(pieces().begin() + 1, pieces().end(), tau,
                       [](double value, const PathPiece& p) { return value < p.begin; });
  return static_cast<std::size_t>(after - 1 - pieces().begin());
}

double KeyframePath::on_path(const ProperTime& tau) const {
  const auto time = double(tau);
  const double slack = 1e-12 * (end() - begin());
  if (!(time >= begin() - slack && time <= end() + slack))
    throw std::domain_error(
        fmt::format("proper time {} ({}) is not on the path", short_number(time), unit_));
  return time;
}

FlightTable KeyframePath::null_times(const std::function<double(std::size_t piece, double t)>& rate,
                                     double tolerance) const {
  const double span = end() - begin();
  const auto rates = [&](double q) {
    const double tau = begin() + q * span;
    const std::size_t k = piece_at(tau);
    return FlightTable::Times{span, span * rate(k, pieces()[k].part(tau)), 0};
  };
  std::vector<double> kinks;
  for (std::size_t k = 1; k < pieces().size(); ++k)
    kinks.push_back((pieces()[k].begin - begin()) / span);
  return {rates, kinks, tolerance};
}

double KeyframePath::null_time(const FlightTable& times, double tau) const {
  return times.to_go(std::clamp((tau - begin()) / (end() - begin()), 0.0, 1.0)).null_time;
}

}  // namespace domefall
