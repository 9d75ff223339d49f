#include "trajectories/geodesic.h"

#include <cmath>
#include <stdexcept>

#include "pipeline/spacetime/schwarzschild.h"
#include "trajectories/infinity.h"
#include "trajectories/orbit_table.h"
#include "trajectories/short_number.h"
#include "trajectories/static_observer.h"

namespace domefall {
namespace {

using PathKind = OrbitCurve::Kind;

constexpr double kApexParameter = 1e-6;  // E = 0: 1 - r/2 = tanh^2 of it

}  // namespace

struct Geodesic::Tables {
  OrbitCurve curve;
  double turn;
  OrbitTable table;

  bool is_born() const {
    return curve.kind() == PathKind::kReturning || curve.kind() == PathKind::kEscaping;
  }
  bool dies() const {
    return curve.kind() == PathKind::kReturning || curve.kind() == PathKind::kPlunging;
  }
  bool is_bound() const { return curve.kind() == PathKind::kBound; }
  double period() const { return table.end().tau - table.begin().tau; }
  OrbitPoint state(double s) const;
  OrbitPoint apex_state(double s) const;
};

// This is the state for E = 0, where the observer is at rest in t.
OrbitPoint Geodesic::Tables::apex_state(double s) const {
  if (std::abs(s) < kApexParameter) s = s < 0 ? -kApexParameter : kApexParameter;
  const bool outgoing = s < 0;
  const double r = curve.at(s).r, l = curve.constants().angular_momentum / r;
  const Tetrad tetrad = outgoing ? Tetrad::kOutgoing : Tetrad::kRain;
  const double still = resting_celerity(r, tetrad).x * std::sqrt(1 + l * l);
  const double rstar = r + 4 * std::log(std::abs(std::tanh(s)));
  return {outgoing ? Region::kIV : Region::kII,
          tetrad,
          r,
          table.at(s).azimuth,
          {still, 0, l},
          outgoing ? -rstar : rstar};
}

OrbitPoint Geodesic::Tables::state(double s) const {
  if (curve.constants().energy == 0) return apex_state(s);
  const OrbitCurve::Point p = curve.at(s);
  const OrbitTable::Place place = table.at(s);
  const OrbitConstants& c = curve.constants();
  const double l = c.angular_momentum / p.r;
  const bool outgoing = s < turn, inside = p.r <= 2;
  const Region region = !inside ? Region::kI : outgoing ? Region::kIV : Region::kII;
  return {region,
          outgoing ? Tetrad::kOutgoing : Tetrad::kRain,
          p.r,
          place.azimuth,
          {Schwarzschild::radial_celerity(p.r, p.radial_speed, c.energy, l * l - c.excess_energy,
                                          outgoing),
           0, l},
          place.null_time};
}

Geodesic::Geodesic(const OrbitCurve& curve, double origin, double turn, double tolerance)
    : tables_(std::make_shared<const Tables>(
          Tables{curve, turn, OrbitTable(curve, origin, turn, tolerance)})) {}

double Geodesic::energy() const { return tables_->curve.constants().energy; }
double Geodesic::angular_momentum() const { return tables_->curve.constants().angular_momentum; }
double Geodesic::birth() const {
  return tables_->is_born() ? tables_->table.begin().tau : -kInfinity;
}
double Geodesic::death() const { return tables_->dies() ? tables_->table.end().tau : kInfinity; }
double Geodesic::innermost() const { return tables_->curve.innermost(); }
double Geodesic::outermost() const { return tables_->curve.outermost(); }

double Geodesic::radial_period() const {
  return tables_->is_bound() ? tables_->period() : kInfinity;
}

double Geodesic::azimuth_per_period() const {
  const OrbitTable& table = tables_->table;
  return tables_->is_bound() ? table.end().azimuth - table.begin().azimuth : kInfinity;
}

OrbitPoint Geodesic::at(const ProperTime& tau) const {
  const OrbitTable& table = tables_->table;
  double turns = 0;
  if (tables_->is_bound() && std::isfinite(tau.hi)) {
    turns = std::floor(double(tau - table.begin().tau) / tables_->period());
  } else if (!(tau >= table.begin().tau && tau <= table.end().tau)) {
    throw std::domain_error("proper time " + short_number(double(tau)) +
                            " (units of M) is beyond the orbit's ends");
  }
  OrbitPoint p = tables_->state(table.parameter(tau - exact_product(turns, tables_->period())));
  if (turns != 0) {
    p.azimuth += turns * azimuth_per_period();
    p.null_time =
        p.null_time + exact_product(turns, table.end().null_time - table.begin().null_time);
  }
  if (mirrored_) p.region = mirror_of(p.region), p.tetrad = mirror_of(p.tetrad);
  return p;
}

std::optional<ProperTime> Geodesic::time_at(double r, Leg leg, const ProperTime& after) const {
  const double s = tables_->curve.parameter(r, leg == Leg::kOutward);
  if (std::isnan(s) || r > OrbitCurve::kFarthest || r < OrbitCurve::kDeepest) return std::nullopt;
  ProperTime tau = tables_->table.at(s).tau;
  if (tables_->is_bound()) {
    const ProperTime start = after == -kInfinity ? 0 : after;
    const double period = tables_->period();
    tau = tau + exact_product(std::ceil(double(start - tau) / period), period);
    if (tau < start) tau = tau + period;
    return tau;
  }
  if (tau < after) return std::nullopt;
  return tau;
}

std::optional<ProperTime> Geodesic::next_periastron(const ProperTime& after) const {
  return innermost() > 0 ? time_at(innermost(), Leg::kOutward, after) : std::nullopt;
}

Geodesic mirrored(Geodesic geodesic) {
  geodesic.mirrored_ = !geodesic.mirrored_;
  return geodesic;
}

}  // namespace domefall
