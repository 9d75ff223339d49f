#include "pipeline/light/kerr_chart.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "pipeline/light/lagrange.h"

namespace domefall {
namespace {

using std::numbers::pi;

constexpr int kRows = 144, kColumns = 192;
constexpr int kPoints = 8;
// Where polynomials of six points differ so much from those of eight (radians), the chart is not used.
constexpr double kRough = 3e-5;

// The part of a derivative across a unit vector.
V3d across(const V3d& v, const V3d& unit) { return v - unit * v.dot(unit); }

}  // namespace

double kerr_frequency_ratio(const KerrPlace& at, double delta, double eta) {
  const auto r = static_cast<double>(at.r), theta = static_cast<double>(at.theta);
  const double sigma = r * r + static_cast<double>(at.sigma());
  const double side =
      static_cast<double>(at.hole.spin) * std::sin(theta) * std::sqrt(sigma) * std::sin(eta);
  const double s = std::sin(delta / 2), c = std::cos(delta / 2);
  return sigma /
         std::abs(sigma * s * s + static_cast<double>(at.delta()) * c * c + 2 * side * s * c);
}

KerrChart::KerrChart(const KerrPlace& at, KerrEdge sky)
    : grid_(at, sky, sky == KerrEdge::kSilhouette ? pi : 0, kRows, kColumns) {
  constexpr int kGuard = KerrGrid::kGuard;
  nodes_.resize(grid_.nodes());
  for (int row = -kGuard; row <= kRows + kGuard; ++row)
    for (int column = 0; column < kColumns; ++column)
      nodes_[grid_.node(row, column)] =
          trace_kerr_without_area(at, grid_.direction(row, column)).sky;
  errors_.reserve(static_cast<std::size_t>(kRows * kColumns));
  for (int row = 0; row < kRows; ++row)
    for (int column = 0; column < kColumns; ++column)
      errors_.push_back(static_cast<float>((value_of<kPoints>(row + 0.5, column + 0.5).sky -
                                            value_of<kPoints - 2>(row + 0.5, column + 0.5).sky)
                                               .length()));
}

template <int kCount>
KerrChart::Value KerrChart::value_of(double row, double column) const {
  const double i = std::clamp(std::floor(row), 0.0, kRows - 1.0), j = std::floor(column);
  const LagrangeWeights<kCount> down(row - i), on(column - j);
  const int top = static_cast<int>(i) + 1 - kCount / 2, left = static_cast<int>(j) + 1 - kCount / 2;
  Value value{V3d(0, 0, 0), V3d(0, 0, 0), V3d(0, 0, 0)};
  for (int k = 0; k < kCount; ++k) {
    V3d sum(0, 0, 0), slope(0, 0, 0);
    for (int m = 0; m < kCount; ++m) {
      const V3d& v = nodes_[grid_.node(top + k, left + m)];
      sum += v * on.w[static_cast<std::size_t>(m)];
      slope += v * on.slope[static_cast<std::size_t>(m)];
    }
    value.sky += sum * down.w[static_cast<std::size_t>(k)];
    value.by_row += sum * down.slope[static_cast<std::size_t>(k)];
    value.by_column += slope * down.w[static_cast<std::size_t>(k)];
  }
  value.sky.normalize();
  value.by_row = across(value.by_row, value.sky);
  value.by_column = across(value.by_column, value.sky);
  return value;
}

KerrChart::Value KerrChart::value(double row, double column) const {
  return value_of<kPoints>(row, column);
}

double KerrChart::error(double row, double column) const {
  const int i = std::clamp(static_cast<int>(row), 0, kRows - 1),
            j = static_cast<int>(std::floor(column)), on = (j % kColumns + kColumns) % kColumns;
  return double{errors_[static_cast<std::size_t>(i * kColumns + on)]};
}

KerrChart::Place KerrChart::place(double delta, double eta, const Edge& edge) const {
  const KerrGrid::Place in = grid_.place(delta, eta, edge);
  if (!(in.row >= 0) || error(in.row, in.column) > kRough) return exact(delta, eta, edge);
  const Value at = value(std::min(in.row, static_cast<double>(kRows)), in.column);
  Place place{at.sky, at.by_row * in.row_by_delta, {}};
  const double sine = std::sin(delta);
  // Next to the end, where all eta meet, the derivative across is that by delta a quarter turn on.
  if (std::abs(delta - end()) < 5e-4) {
    const double quarter = eta + (end() > 0 ? -pi / 2 : pi / 2);
    const KerrGrid::Place there = grid_.place(delta, quarter, this->edge(quarter));
    const double row = std::min(there.row, kRows - 1e-9);
    if (error(row, there.column) > kRough) return exact(delta, eta, edge);
    place.across = this->value(row, there.column).by_row * there.row_by_delta;
    return place;
  }
  place.across = (at.by_row * in.row_by_eta + at.by_column * grid_.column_by_eta()) / sine;
  return place;
}

KerrChart::Place KerrChart::exact(double delta, double eta, const Edge& edge) const {
  const double way = delta - edge.delta;
  const TracedKerr ray = trace_kerr(at(), {delta, eta, sky(), static_cast<long double>(way)});
  return {ray.sky, ray.by_delta, ray.across};
}

}  // namespace domefall
