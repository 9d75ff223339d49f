#include "trajectories/flight_table.h"

#include <algorithm>
#include <stdexcept>

#include "trajectories/zero_between.h"

namespace domefall {
namespace {

constexpr int kFlightHalvings = 60;  // halvings of a panel
constexpr std::size_t kFlightPanels = 4000;

}  // namespace

FlightTable::FlightTable(const std::function<Times(double)>& rates, std::vector<double> kinks,
                         double tolerance)
    : tolerance_(tolerance) {
  kinks.push_back(1);
  double low = 0;
  for (const double high : kinks) {
    append(rates, low, high, 0);
    low = high;
  }
  for (Panel& panel : panels_) {
    panel.from = whole_;
    whole_.tau += panel_sum(panel.tau, 1);
    whole_.null_time += panel_sum(panel.null_time, 1);
    whole_.azimuth += panel_sum(panel.azimuth, 1);
  }
}

void FlightTable::append(const std::function<Times(double)>& rates, double low, double high,
                         int depth) {
  Panel panel{low, high, {}, {}, {}, {}};
  PanelValues tau{}, null_time{}, azimuth{};
  const double middle = (low + high) / 2, half = (high - low) / 2;
  for (std::size_t j = 0; j < kPanelTerms; ++j) {
    const Times rate = rates(middle + half * panel_node(j));
    tau[j] = rate.tau, null_time[j] = rate.null_time, azimuth[j] = rate.azimuth;
  }
  bool resolved = integrate_panel(tau, half, tolerance_, panel.tau);
  resolved &= integrate_panel(null_time, half, tolerance_, panel.null_time);
  resolved &= integrate_panel(azimuth, half, tolerance_, panel.azimuth);
  if (resolved || depth == kFlightHalvings) {
    panels_.push_back(panel);
    return;
  }
  if (panels_.size() > kFlightPanels)
    throw std::domain_error("a flight whose proper time double precision cannot tell");
  append(rates, low, middle, depth + 1);
  append(rates, middle, high, depth + 1);
}

template <class Begin>
const FlightTable::Panel& FlightTable::panel_at(double value, const Begin& begin) const {
  return *(std::upper_bound(panels_.begin() + 1, panels_.end(), value,
                            [&](double v, const Panel& p) { return v < begin(p); }) -
           1);
}

FlightTable::Times FlightTable::to_go(double q) const {
  const Panel& panel = panel_at(q, [](const Panel& p) { return p.low; });
  const double part = ((q - panel.low) - (panel.high - q)) / (panel.high - panel.low);
  return {panel.from.tau + panel_sum(panel.tau, part),
          panel.from.null_time + panel_sum(panel.null_time, part),
          panel.from.azimuth + panel_sum(panel.azimuth, part)};
}

double FlightTable::parameter(double tau_to_go) const {
  if (!(tau_to_go > 0)) return 0;
  if (!(tau_to_go < whole_.tau)) return 1;
  const Panel& panel = panel_at(tau_to_go, [](const Panel& p) { return p.from.tau; });
  const auto off = [&](double part) {
    return panel_sum(panel.tau, part) - (tau_to_go - panel.from.tau);
  };
  // Rounding of the sums may put a time next to a panel's end beyond it.
  const double part = off(-1) < 0 ? zero_between(off, -1, 1) : -1,
               half = (panel.high - panel.low) / 2;
  return part < 0 ? panel.low + half * (1 + part) : panel.high - half * (1 - part);
}

}  // namespace domefall
