#include "trajectories/orbit_table.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "pipeline/spacetime/schwarzschild.h"
#include "trajectories/short_number.h"

namespace domefall {
namespace {

constexpr int kDepth = 60;  // halvings of a panel
constexpr std::size_t kMostPanels = 4000;
constexpr double kMost = 1e15;  // E, L (M) and the innermost r (M) stay below it
constexpr double kWidest = 1;   // of a parameter in which tau grows like exp(3s)
constexpr double kNoise = 8 * std::numeric_limits<double>::epsilon();
constexpr int kNewtonSteps = 80;

// The integrand's noise is its slope times this rounding of the parameter.
double rounding_of(double low, double high) {
  return kNoise * std::max(std::abs(low), std::abs(high));
}

double steepness(const PanelValues& values) {
  double slope = 0, largest = std::abs(values[0]);
  for (std::size_t j = 1; j < kPanelTerms; ++j) {
    slope =
        std::max(slope, std::abs(values[j] - values[j - 1]) / (panel_node(j - 1) - panel_node(j)));
    largest = std::max(largest, std::abs(values[j]));
  }
  return largest > 0 ? slope / largest : 0;
}

}  // namespace

OrbitTable::OrbitTable(const OrbitCurve& curve, double origin, double turn, double tolerance)
    : curve_(curve), turn_(turn), tolerance_(tolerance) {
  const OrbitConstants& c = curve.constants();
  if (!(c.energy < kMost && c.angular_momentum < kMost && curve.innermost() < kMost &&
        curve.begin() <= origin && origin <= curve.end()))
    throw std::domain_error(
        "an orbit must have an energy, an angular momentum and a periastron below 1e15 (units of "
        "M) and start between r = 1e-16 and 1e30");
  std::vector<double> cuts{curve.begin(), 0, origin, curve.end()};
  if (std::isfinite(turn)) cuts.push_back(turn);
  std::sort(cuts.begin(), cuts.end());
  cuts.erase(std::unique(cuts.begin(), cuts.end()), cuts.end());
  for (std::size_t k = 0; k + 1 < cuts.size(); ++k) append(cuts[k], cuts[k + 1], 0);
  sum_up(origin);
}

// Here dv/dtau = (E + u^r)/(1 - 2/r) = (1 + L^2/r^2)/(E - u^r) and du/dtau = (E - u^r)/(1 - 2/r).
// Each is taken in the form that does not cancel, and is regular at r = 2 where the motion crosses
// it.  What is left to cancel is r - 2 where the motion leaves the other horizon.
OrbitTable::Sums OrbitTable::rates(double s, bool ingoing, double& noise) const {
  const OrbitCurve::Point p = curve_.at(s);
  const double e = curve_.constants().energy, l = curve_.constants().angular_momentum / p.r;
  const double inward = ingoing ? -p.radial_speed : p.radial_speed;
  const bool cancels = -inward > e / 2;
  if (cancels) noise = std::max(noise, kNoise / std::abs(Schwarzschild::lapse_squared(p.r)));
  const double null_rate = e == 0    ? 0
                           : cancels ? (e - inward) / Schwarzschild::lapse_squared(p.r)
                                     : (1 + l * l) / (e + inward);
  return {p.rate, p.rate * l / p.r, p.rate * null_rate};
}

bool OrbitTable::fill(Panel& panel) const {
  PanelValues tau{}, azimuth{}, null_time{};
  const double middle = (panel.low + panel.high) / 2, half = (panel.high - panel.low) / 2;
  double null_noise = 0;
  for (std::size_t j = 0; j < kPanelTerms; ++j) {
    const Sums rate = rates(middle + half * panel_node(j), middle > turn_, null_noise);
    tau[j] = rate.tau, azimuth[j] = rate.azimuth, null_time[j] = rate.null_time;
  }
  const double unit = rounding_of(panel.low, panel.high) / half;
  const auto integrated = [&](const PanelValues& values, double noise, PanelIntegral& integral) {
    return integrate_panel(values, half, tolerance_ + noise + unit * steepness(values), integral);
  };
  const bool a = integrated(tau, 0, panel.tau), b = integrated(azimuth, 0, panel.azimuth);
  return integrated(null_time, null_noise, panel.null_time) && a && b;
}

void OrbitTable::append(double low, double high, int depth) {
  Panel panel;
  panel.low = low, panel.high = high;
  if (panels_.size() > kMostPanels)
    throw std::domain_error("an orbit of energy " + short_number(curve_.constants().energy) +
                            " and angular momentum " +
                            short_number(curve_.constants().angular_momentum) +
                            ", whose proper time double precision cannot tell");
  const double middle = (low + high) / 2;
  const bool wide = curve_.kind() != OrbitCurve::Kind::kBound && high - low > kWidest;
  const bool splits = depth < kDepth && middle > low && middle < high;
  if ((fill(panel) && !wide) || !splits) {
    panels_.push_back(panel);
    return;
  }
  append(low, middle, depth + 1);
  append(middle, high, depth + 1);
}

// Returns the singularities, the periastron and the origin, in the order of the parameter.
std::vector<double> OrbitTable::anchors(double origin) const {
  using Kind = OrbitCurve::Kind;
  const Kind kind = curve_.kind();
  std::vector<double> found{origin};
  if (kind == Kind::kScattered || kind == Kind::kBound) found.push_back(0);
  if (kind == Kind::kReturning || kind == Kind::kEscaping) found.push_back(curve_.begin());
  if (kind == Kind::kReturning || kind == Kind::kPlunging) found.push_back(curve_.end());
  std::sort(found.begin(), found.end());
  found.erase(std::unique(found.begin(), found.end()), found.end());
  return found;
}

OrbitTable::Panels OrbitTable::from_parameter(double s) {
  return std::lower_bound(panels_.begin(), panels_.end(), s,
                          [](const Panel& p, double value) { return p.low < value; });
}

// Returns the sums at the panel's upper end, of what is `from` at its lower end and before it was
// shifted.
OrbitTable::Sums OrbitTable::risen(const Sums& from, const Panel& panel) const {
  return {from.tau + panel_sum(panel.tau, 1), from.azimuth + panel_sum(panel.azimuth, 1),
          from.null_time + panel_sum(panel.null_time, 1) + (panel.high == turn_ ? jump_ : 0)};
}

// Lets the panels count from their first one's lower end.  Returns the sums at the last one's upper
// end.
OrbitTable::Sums OrbitTable::count_up(Panels first, Panels last, const Sums& anchor) const {
  Sums sums;
  for (auto p = first; p != last; ++p) {
    p->anchor = anchor, p->from = sums, p->begin_tau = ProperTime(anchor.tau) + sums.tau;
    sums = risen(sums, *p);
  }
  return sums;
}

// Lets the panels count from their last one's upper end.  Returns the sums at the first one's lower
// end.
OrbitTable::Sums OrbitTable::count_down(Panels first, Panels last, const Sums& anchor) const {
  Sums sums;
  for (auto p = std::make_reverse_iterator(last); p != std::make_reverse_iterator(first); ++p) {
    if (p->high == turn_) sums.null_time -= jump_;
    p->anchor = anchor, p->from = sums;
    const Sums rise{panel_sum(p->tau, 1), panel_sum(p->azimuth, 1), panel_sum(p->null_time, 1)};
    p->tau[0] -= rise.tau, p->azimuth[0] -= rise.azimuth, p->null_time[0] -= rise.null_time;
    sums.tau -= rise.tau, sums.azimuth -= rise.azimuth, sums.null_time -= rise.null_time;
    p->begin_tau = ProperTime(anchor.tau) + sums.tau;
  }
  return sums;
}

// Lets the panels between two anchors count from that which is the nearer in time.  One of the two
// is known, and the other is returned.
OrbitTable::Sums OrbitTable::count_between(Panels first, Panels last, const Sums& known,
                                           bool known_is_first) {
  Sums span;
  for (auto p = first; p != last; ++p) span = risen(span, *p);
  const double way = known_is_first ? 1 : -1;
  const Sums found{known.tau + way * span.tau, known.azimuth + way * span.azimuth,
                   known.null_time + way * span.null_time};
  auto middle = first;
  for (Sums sums; middle != last; ++middle) {
    const double begin = sums.tau;
    sums = risen(sums, *middle);
    if (begin + sums.tau > span.tau) break;
  }
  count_up(first, middle, known_is_first ? known : found);
  count_down(middle, last, known_is_first ? found : known);
  return found;
}

void OrbitTable::sum_up(double origin) {
  if (std::isfinite(turn_) && curve_.constants().energy > 0) {
    Radius at(curve_.at(turn_).r);
    if (turn_ == 0) at.above_horizon = curve_.outermost_over_two();
    jump_ = 2 * Schwarzschild::tortoise(at);
  }
  const std::vector<double> places = anchors(origin);
  const auto start = std::find(places.begin(), places.end(), origin);
  const auto absolute = [](const Sums& anchor, const Sums& since) {
    return Sums{anchor.tau + since.tau, anchor.azimuth + since.azimuth,
                anchor.null_time + since.null_time};
  };
  Sums anchor;
  for (auto s = start; s + 1 != places.end(); ++s)
    anchor = count_between(from_parameter(*s), from_parameter(*(s + 1)), anchor, true);
  end_ = absolute(anchor, count_up(from_parameter(places.back()), panels_.end(), anchor));
  anchor = {};
  for (auto s = start; s != places.begin(); --s)
    anchor = count_between(from_parameter(*(s - 1)), from_parameter(*s), anchor, false);
  begin_ = absolute(anchor, count_down(panels_.begin(), from_parameter(places.front()), anchor));
}

OrbitTable::Place OrbitTable::at(double s) const {
  const auto after = std::upper_bound(panels_.begin(), panels_.end(), s,
                                      [](double value, const Panel& p) { return value < p.low; });
  const Panel& panel = after == panels_.begin() ? *after : *(after - 1);
  const double x =
      std::clamp(((s - panel.low) - (panel.high - s)) / (panel.high - panel.low), -1.0, 1.0);
  return {ProperTime(panel.anchor.tau) + (panel.from.tau + panel_sum(panel.tau, x)),
          panel.anchor.azimuth + (panel.from.azimuth + panel_sum(panel.azimuth, x)),
          DoubleDouble(panel.anchor.null_time) +
              (panel.from.null_time + panel_sum(panel.null_time, x))};
}

double OrbitTable::parameter(const ProperTime& tau) const {
  const auto after =
      std::upper_bound(panels_.begin(), panels_.end(), tau,
                       [](const ProperTime& value, const Panel& p) { return value < p.begin_tau; });
  const Panel& panel = after == panels_.begin() ? *after : *(after - 1);
  const double half = (panel.high - panel.low) / 2,
               wanted = double(tau - panel.anchor.tau) - panel.from.tau;
  const double at_low = panel_sum(panel.tau, -1), at_high = panel_sum(panel.tau, 1);
  double low = -1, high = 1, x = 2 * (wanted - at_low) / (at_high - at_low) - 1;
  if (!(x > low)) return panel.low;
  if (!(x < high)) return panel.high;
  for (int k = 0; k < kNewtonSteps; ++k) {
    const double off = panel_sum(panel.tau, x) - wanted;
    (off > 0 ? high : low) = x;
    const double slope = curve_.at(panel.low + half * (1 + x)).rate * half;
    double next = x - off / slope;
    if (!(next > low && next < high)) next = (low + high) / 2;
    const bool done = std::abs(next - x) <= std::numeric_limits<double>::epsilon();
    x = next;
    if (done) break;
  }
  return x < 0 ? panel.low + half * (1 + x) : panel.high - half * (1 - x);
}

}  // namespace domefall
