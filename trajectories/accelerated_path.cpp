#include "trajectories/accelerated_path.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "trajectories/chebyshev_panel.h"
#include "trajectories/short_number.h"

namespace domefall {
namespace {

constexpr int kSamples = 512;  // of a piece, where it is examined
constexpr double kTolerance = 1e-13;
constexpr int kMostHalvings = 40;      // halvings of a panel
constexpr std::size_t kPanels = 4000;  // of a piece
constexpr double kIntegrandNoise = 8 * std::numeric_limits<double>::epsilon();

struct Rates {
  double r, radial, tangential, lapse2, energy2;  // dr/dtau, r dphi/dtau, f, E^2
};

Rates rates_of(const PathPiece& piece, double t, const Spacetime& spacetime) {
  const double span = piece.span(), r = piece.r.at(t);
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
double null_noise(const PathPiece& piece, const Rates& p, bool outgoing) {
  const double inward = outgoing ? p.radial : -p.radial,
               sum = std::sqrt(p.energy2) + std::abs(inward);
  const double place = kIntegrandNoise * piece.r.size() / p.r;
  const double rate = kIntegrandNoise * piece.r.size() / piece.span();
  return (inward >= 0 ? place / (sum * sum) : place / std::abs(p.lapse2)) + rate / sum;
}

void check_instant(const PathPiece& piece, std::size_t key, double t, bool outgoing,
                   const Spacetime& spacetime) {
  const double tau = piece.time(t), r = piece.r.at(t);
  if (!(r > 0)) refuse_key(key, tau, "after it the path meets the singularity");
  const Rates p = rates_of(piece, t, spacetime);
  if (r > spacetime.horizon() || r < spacetime.inner_horizon()) return;
  const std::string place = "after it, at r = " + short_number(r) + ", ";
  if (!((outgoing ? p.radial : -p.radial) > 0))
    refuse_key(key, tau,
               place + (outgoing ? "nothing stops rising in region IV"
                                 : "nothing stops falling inside the hole"));
  if (!(p.energy2 >= 0))
    refuse_key(key, tau,
               place + "the path is faster than light: it must cross r faster, or turn less");
}

void check_piece(const PathPiece& piece, std::size_t key, bool outgoing,
                 const Spacetime& spacetime) {
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
  std::vector<NullPanel> panels;

  void append(const PathPiece& p, std::size_t piece, double low, double high, int depth,
              std::size_t most);
  void sum_up();
  double null_time(std::size_t piece, double t) const;
  OrbitPoint state(const PathPiece& piece, std::size_t number, double t) const;
};

void AcceleratedPath::Tables::append(const PathPiece& p, std::size_t piece, double low, double high,
                                     int depth, std::size_t most) {
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
  if (integrate_panel(values, half * p.span(), kTolerance + noise, panel.sum) ||
      depth == kMostHalvings || panels.size() >= most) {
    panels.push_back(panel);
    return;
  }
  append(p, piece, low, middle, depth + 1, most);
  append(p, piece, middle, high, depth + 1, most);
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

OrbitPoint AcceleratedPath::Tables::state(const PathPiece& piece, std::size_t number,
                                          double t) const {
  const Rates p = rates_of(piece, t, spacetime);
  const bool outgoing = is_outgoing(tetrad), mirrored = is_mirrored(tetrad);
  Region region = mirrored ? Region::kIII : Region::kI;
  if (p.r < spacetime.inner_horizon())
    region = mirrored ? Region::kVI : Region::kV;
  else if (p.r <= spacetime.horizon())
    region = outgoing ? Region::kIV : Region::kII;
  return {region,
          tetrad,
          p.r,
          piece.azimuth.at(t),
          {spacetime.moving_celerity(p.r, p.radial, p.tangential, outgoing), 0, p.tangential},
          null_time(number, t)};
}

AcceleratedPath::AcceleratedPath(const std::vector<PathKey>& keys, Tetrad tetrad,
                                 const Spacetime& spacetime)
    : KeyframePath(keys) {
  for (std::size_t k = 0; k < keys.size(); ++k)
    if (!(keys[k].r > 0))
      refuse_key(k + 1, keys[k].tau,
                 "r must exceed 0 (units of M), got " + short_number(keys[k].r));
  const auto tables = std::make_shared<Tables>(Tables{spacetime, tetrad, {}});
  for (std::size_t k = 0; k < pieces().size(); ++k) {
    check_piece(pieces()[k], k + 1, is_outgoing(tetrad), spacetime);
    tables->append(pieces()[k], k, 0, 1, 0, tables->panels.size() + kPanels);
  }
  tables->sum_up();
  tables_ = tables;
}

OrbitPoint AcceleratedPath::at(const ProperTime& tau) const {
  const double time = on_path(tau);
  const std::size_t k = piece_at(time);
  return tables_->state(pieces()[k], k, pieces()[k].part(time));
}

}  // namespace domefall
