#include "trajectories/accelerated_path.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>

#include "trajectories/chebyshev_panel.h"
#include "trajectories/infinity.h"
#include "trajectories/monotone_cubic.h"
#include "trajectories/short_number.h"

namespace domefall {
namespace {

constexpr int kSamples = 512;  // of a piece, where it is examined
constexpr double kTolerance = 1e-13;
constexpr int kMostHalvings = 40;      // halvings of a panel
constexpr std::size_t kPanels = 4000;  // of a piece
constexpr double kIntegrandNoise = 8 * std::numeric_limits<double>::epsilon();
constexpr double kEndRounding =
    1e-12;  // of the path's duration, by which a proper time may miss its ends

struct Piece {
  double begin, end;  // proper time
  HermiteCubic r, azimuth;
};

struct Rates {
  double r, radial, tangential, lapse2, energy2;  // dr/dtau, r dphi/dtau, f, E^2
};

Rates rates_of(const Piece& piece, double t, const Spacetime& spacetime) {
  const double span = piece.end - piece.begin, r = piece.r.at(t);
  const double u = piece.r.slope(t) / span, l = r * piece.azimuth.slope(t) / span;
  const double f = spacetime.lapse_squared(r);
  return {r, u, l, f, u * u + f * (1 + l * l)};
}

double null_rate(const Rates& p, bool outgoing) {
  const double energy = std::sqrt(p.energy2), inward = outgoing ? p.radial : -p.radial;
  return inward >= 0 ? (1 + p.tangential * p.tangential) / (energy + inward)
                     : (energy - inward) / p.lapse2;
}

// Returns, relative to null_rate, what rounding of r and its slope does to 1 - 2/r and to E.
double null_noise(const Piece& piece, const Rates& p, bool outgoing) {
  const double inward = outgoing ? p.radial : -p.radial,
               sum = std::sqrt(p.energy2) + std::abs(inward);
  const double place = kIntegrandNoise * piece.r.size() / p.r;
  const double rate = kIntegrandNoise * piece.r.size() / (piece.end - piece.begin);
  return (inward >= 0 ? place / (sum * sum) : place / std::abs(p.lapse2)) + rate / sum;
}

[[noreturn]] void refuse(std::size_t key, double tau, const std::string& why) {
  throw std::domain_error(
      fmt::format("key {}, at proper time {} (units of M): {}", key, short_number(tau), why));
}

// Says whether double precision does not hold the squares of the rates well.
bool is_too_fast(const PathKey& from, const PathKey& to) {
  constexpr double kFastest = 1e100;
  const double span = to.tau - from.tau;
  return !(std::abs(to.r - from.r) < kFastest * span) ||
         !(std::abs(to.azimuth - from.azimuth) * std::max(from.r, to.r) < kFastest * span);
}

void check_keys(const std::vector<PathKey>& keys) {
  if (keys.size() < 2) throw std::domain_error("a path must have at least 2 keys");
  for (std::size_t k = 0; k < keys.size(); ++k) {
    const PathKey& key = keys[k];
    if (!(key.r > 0) || !std::isfinite(key.r) || !std::isfinite(key.azimuth))
      refuse(k + 1, key.tau, "r must exceed 0 (units of M), got " + short_number(key.r));
    if (!std::isfinite(key.radial_rate.value_or(0)) || !std::isfinite(key.azimuth_rate.value_or(0)))
      refuse(k + 1, key.tau, "its rates must be finite numbers");
    if (!std::isfinite(key.tau) || (k > 0 && !(key.tau > keys[k - 1].tau)))
      refuse(k + 1, key.tau, "its proper time must exceed that of the key before");
    if (k > 0 && is_too_fast(keys[k - 1], key))
      refuse(k + 1, key.tau, "it is too close in proper time to the key before");
  }
}

std::vector<Piece> pieces_of(const std::vector<PathKey>& keys) {
  std::vector<double> taus, radii, azimuths;
  std::vector<std::optional<double>> radial, swept;
  for (const PathKey& key : keys) {
    taus.push_back(key.tau), radii.push_back(key.r), azimuths.push_back(key.azimuth);
    radial.push_back(key.radial_rate), swept.push_back(key.azimuth_rate);
  }
  const auto r = cubics_between(taus, radii, radial),
             azimuth = cubics_between(taus, azimuths, swept);
  std::vector<Piece> pieces;
  for (std::size_t k = 0; k < r.size(); ++k)
    pieces.push_back({taus[k], taus[k + 1], r[k], azimuth[k]});
  return pieces;
}

void check_instant(const Piece& piece, std::size_t key, double t, bool outgoing,
                   const Spacetime& spacetime) {
  const double tau = piece.begin + t * (piece.end - piece.begin), r = piece.r.at(t);
  if (!(r > 0)) refuse(key, tau, "after it the path meets the singularity");
  const Rates p = rates_of(piece, t, spacetime);
  if (r > spacetime.horizon() || r < spacetime.inner_horizon()) return;
  const std::string place = "after it, at r = " + short_number(r) + ", ";
  if (!((outgoing ? p.radial : -p.radial) > 0))
    refuse(key, tau,
           place + (outgoing ? "nothing stops rising in region IV"
                             : "nothing stops falling inside the hole"));
  if (!(p.energy2 >= 0))
    refuse(key, tau, place + "the path is faster than light: it must cross r faster, or turn less");
}

void check_piece(const Piece& piece, std::size_t key, bool outgoing, const Spacetime& spacetime) {
  for (int k = 0; k <= kSamples; ++k)
    check_instant(piece, key, static_cast<double>(k) / kSamples, outgoing, spacetime);
  // The path may touch the horizon between two samples.
  for (const double t : turns_of(piece.r)) check_instant(piece, key, t, outgoing, spacetime);
}

struct NullPanel {
  std::size_t piece;
  double low, high;  // of the piece
  double from;
  PanelIntegral sum;
};

}  // namespace

struct AcceleratedPath::Tables {
  Spacetime spacetime;
  Tetrad tetrad;
  std::vector<Piece> pieces;
  std::vector<NullPanel> panels;

  void append(std::size_t piece, double low, double high, int depth, std::size_t most);
  void sum_up();
  double null_time(std::size_t piece, double t) const;
  OrbitPoint state(std::size_t piece, double t) const;
};

void AcceleratedPath::Tables::append(std::size_t piece, double low, double high, int depth,
                                     std::size_t most) {
  const Piece& p = pieces[piece];
  const bool outgoing = is_outgoing(tetrad);
  NullPanel panel{piece, low, high, 0, {}};
  PanelValues values{};
  double noise = 0;
  const double middle = (low + high) / 2, half = (high - low) / 2;
  for (std::size_t j = 0; j < kPanelTerms; ++j) {
    const double t = middle + half * panel_node(j);
    const Rates rates = rates_of(p, t, spacetime);
    check_instant(p, piece + 1, t, outgoing, spacetime);
    values[j] = null_rate(rates, outgoing);
    noise = std::max(noise, null_noise(p, rates, outgoing));
  }
  const double span = p.end - p.begin;
  if (integrate_panel(values, half * span, kTolerance + noise, panel.sum) ||
      depth == kMostHalvings || panels.size() >= most) {
    panels.push_back(panel);
    return;
  }
  append(piece, low, middle, depth + 1, most);
  append(piece, middle, high, depth + 1, most);
}

void AcceleratedPath::Tables::sum_up() {
  double total = 0;
  for (NullPanel& panel : panels) {
    panel.from = total;
    total += panel_sum(panel.sum, 1);
  }
}

double AcceleratedPath::Tables::null_time(std::size_t piece, double t) const {
  const auto after = std::upper_bound(
      panels.begin(), panels.end(), std::pair(piece, t),
      [](const auto& at, const NullPanel& p) { return at < std::pair(p.piece, p.low); });
  const NullPanel& panel = after == panels.begin() ? *after : *(after - 1);
  return panel.from +
         panel_sum(panel.sum, ((t - panel.low) - (panel.high - t)) / (panel.high - panel.low));
}

OrbitPoint AcceleratedPath::Tables::state(std::size_t piece, double t) const {
  const Rates p = rates_of(pieces[piece], t, spacetime);
  const bool outgoing = is_outgoing(tetrad), mirrored = is_mirrored(tetrad);
  Region region = mirrored ? Region::kIII : Region::kI;
  if (p.r < spacetime.inner_horizon())
    region = mirrored ? Region::kVI : Region::kV;
  else if (p.r <= spacetime.horizon())
    region = outgoing ? Region::kIV : Region::kII;
  return {region,
          tetrad,
          p.r,
          pieces[piece].azimuth.at(t),
          {spacetime.moving_celerity(p.r, p.radial, p.tangential, outgoing), 0, p.tangential},
          null_time(piece, t)};
}

AcceleratedPath::AcceleratedPath(const std::vector<PathKey>& keys, Tetrad tetrad,
                                 const Spacetime& spacetime) {
  check_keys(keys);
  const auto tables = std::make_shared<Tables>(Tables{spacetime, tetrad, pieces_of(keys), {}});
  for (std::size_t k = 0; k < tables->pieces.size(); ++k) {
    check_piece(tables->pieces[k], k + 1, is_outgoing(tetrad), spacetime);
    tables->append(k, 0, 1, 0, tables->panels.size() + kPanels);
  }
  tables->sum_up();
  tables_ = tables;
}

double AcceleratedPath::begin() const { return tables_->pieces.front().begin; }
double AcceleratedPath::end() const { return tables_->pieces.back().end; }

double AcceleratedPath::birth() const { return std::nextafter(begin(), -kInfinity); }
double AcceleratedPath::death() const { return std::nextafter(end(), kInfinity); }

OrbitPoint AcceleratedPath::at(const ProperTime& tau) const {
  const auto time = double(tau);
  const double slack = kEndRounding * (end() - begin());
  if (!(time >= begin() - slack && time <= end() + slack))
    throw std::domain_error("proper time " + short_number(time) +
                            " (units of M) is not on the path");
  const std::vector<Piece>& pieces = tables_->pieces;
  const auto after = std::upper_bound(pieces.begin() + 1, pieces.end(), time,
                                      [](double value, const Piece& p) { return value < p.begin; });
  const auto& piece = *(after - 1);
  const double t = std::clamp((time - piece.begin) / (piece.end - piece.begin), 0.0, 1.0);
  return tables_->state(static_cast<std::size_t>(after - 1 - pieces.begin()), t);
}

std::pair<double, double> AcceleratedPath::reach() const {
  constexpr int kSteps = 1000;
  double low = at(begin()).r, high = low;
  for (int k = 0; k <= kSteps; ++k) {
    const double r = at(std::lerp(begin(), end(), static_cast<double>(k) / kSteps)).r;
    low = std::min(low, r), high = std::max(high, r);
  }
  return {low, high};
}

std::optional<ProperTime> AcceleratedPath::time_at(double r, Leg leg,
                                                   const ProperTime& after) const {
  for (const Piece& piece : tables_->pieces) {
    const std::vector<double> cuts = turns_of(piece.r);
    for (std::size_t k = 0; k + 1 < cuts.size(); ++k) {
      const double from = piece.r.at(cuts[k]), to = piece.r.at(cuts[k + 1]);
      const bool falls = to < from;
      if (from == to || falls != (leg == Leg::kInward) || r < std::min(from, to) ||
          r > std::max(from, to))
        continue;
      const double t = where(piece.r, r, cuts[k], cuts[k + 1]);
      const double tau = piece.begin + t * (piece.end - piece.begin);
      if (tau >= double(after)) return tau;
    }
  }
  return std::nullopt;
}

}  // namespace domefall
