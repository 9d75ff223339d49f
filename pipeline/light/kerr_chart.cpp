#include "pipeline/light/kerr_chart.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstring>
#include <numbers>

#include "pipeline/base/simd/dispatch.h"
#include "pipeline/light/lagrange.h"

namespace domefall {
namespace {

using std::numbers::pi;

// Between the horizons the sky is crowded away from the edge, too.
constexpr int kRows = 96, kRowsInside = 144;
// The silhouette of a hole that spins nearly as fast as it can has corners, next to which the sky changes
// from column to column.
constexpr int kColumns = 192, kColumnsOfFast = 512;
constexpr long double kFast = 0.25;  // half of r_+ - r_-
constexpr std::size_t kPoints = 8;

using Four = double __attribute__((vector_size(32)));

// A CellNodes has Lagrange's nodes around a cell, and their weights.
template <std::size_t kCount>
struct CellNodes {
  const std::array<double, 4>* nodes;
  std::array<std::size_t, kCount> row, column;  // the nodes are at their sums
  LagrangeWeights<kCount> down, on;
};

// Finds the value and its derivatives by row and by column.
template <std::size_t kCount>
[[gnu::always_inline]] inline void interpolate_loop(const CellNodes<kCount>& cell, Four* out) {
  Four value{}, by_row{}, by_column{};
  for (std::size_t k = 0; k < kCount; ++k) {
    Four sum{}, slope{};
    for (std::size_t m = 0; m < kCount; ++m) {
      Four v;
      std::memcpy(&v, &cell.nodes[cell.row[k] + cell.column[m]], sizeof v);
      sum += v * cell.on.w[m];
      slope += v * cell.on.slope[m];
    }
    value += sum * cell.down.w[k];
    by_row += sum * cell.down.slope[k];
    by_column += slope * cell.down.w[k];
  }
  out[0] = value, out[1] = by_row, out[2] = by_column;
}
template <std::size_t kCount>
Dispatched<interpolate_loop<kCount>> interpolate;

// The part of a derivative across a unit vector.
V3d across(const V3d& v, const V3d& unit) { return v - unit * v.dot(unit); }

}  // namespace

KerrChart::KerrChart(const KerrPlace& at, KerrEdge sky, int stride)
    : stride_(stride),
      grid_(at, sky, sky == KerrEdge::kSilhouette ? pi : 0,
            (at.delta() < 0 ? kRowsInside : kRows) / stride,
            (at.hole.horizon_distance() < kFast ? kColumnsOfFast : kColumns) / stride),
      energy_(at) {
  constexpr int kGuard = KerrGrid::kGuard;
  nodes_.resize(grid_.nodes());
  tbb::parallel_for(-kGuard, rows() + kGuard + 1, [&](int row) {
    for (int column = 0; column < columns(); ++column) {
      const TracedKerr ray = trace_kerr_without_area(at, grid_.direction(row, column));
      const V3d& there = ray.undragged;
      nodes_[grid_.node(row, column)] = {there.x, there.y, there.z, ray.dragged};
    }
  });
  std::vector<float> middles;
  middles.reserve(grid_.nodes());
  for (int row = 0; row < rows(); ++row)
    for (int column = 0; column < columns(); ++column)
      middles.push_back(static_cast<float>((value_of<kPoints>(row + 0.5, column + 0.5).sky -
                                            value_of<kPoints - 2>(row + 0.5, column + 0.5).sky)
                                               .length()));
  // In the middle of a cell both may happen to agree, so that those around it count, too.
  const auto around = [&](int row, int column) {
    float most = 0;
    for (int i = std::max(row - 1, 0); i <= std::min(row + 1, rows() - 1); ++i)
      for (int j = column - 1; j <= column + 1; ++j)
        most = std::max(
            most, middles[static_cast<std::size_t>(i * columns() + (j + columns()) % columns())]);
    return most;
  };
  errors_.reserve(middles.size());
  for (int row = 0; row < rows(); ++row)
    for (int column = 0; column < columns(); ++column) errors_.push_back(around(row, column));
}

template <std::size_t kCount>
KerrChart::Value KerrChart::value_of(double row, double column) const {
  const double i = std::clamp(std::floor(row), 0.0, rows() - 1.0), j = std::floor(column);
  const int top = static_cast<int>(i) + 1 - static_cast<int>(kCount) / 2,
            left = static_cast<int>(j) + 1 - static_cast<int>(kCount) / 2;
  CellNodes<kCount> cell{
      nodes_.data(), {}, {}, LagrangeWeights<kCount>(row - i), LagrangeWeights<kCount>(column - j)};
  std::size_t at = grid_.node(0, left) - grid_.node(0, 0);
  const auto around = static_cast<std::size_t>(columns());
  for (std::size_t k = 0; k < kCount; ++k) {
    cell.row[k] = grid_.node(top + static_cast<int>(k), 0);
    cell.column[k] = at;
    at = at + 1 == around ? 0 : at + 1;
  }
  std::array<Four, 3> found;
  interpolate<kCount>(cell, found.data());
  const double c = std::cos(found[0][3]), s = std::sin(found[0][3]);
  const auto turned = [&](double x, double y, double z) {
    return V3d(x * c - y * s, x * s + y * c, z);
  };
  const Four &n = found[0], &d = found[1], &e = found[2];
  Value value{turned(n[0], n[1], n[2]), turned(d[0] - d[3] * n[1], d[1] + d[3] * n[0], d[2]),
              turned(e[0] - e[3] * n[1], e[1] + e[3] * n[0], e[2])};
  value.sky.normalize();
  value.by_row = across(value.by_row, value.sky);
  value.by_column = across(value.by_column, value.sky);
  return value;
}

KerrChart::Value KerrChart::value(double row, double column) const {
  return value_of<kPoints>(row, column);
}

double KerrChart::error(double row, double column) const {
  const int i = std::clamp(static_cast<int>(row), 0, rows() - 1),
            j = static_cast<int>(std::floor(column)), on = (j % columns() + columns()) % columns();
  return double{errors_[static_cast<std::size_t>(i * columns() + on)]};
}

KerrChart::Place KerrChart::place(double delta, double eta, const Edge& edge) const {
  const KerrGrid::Place in = grid_.place(delta, eta, edge);
  if (!(in.row >= 0) || error(in.row, in.column) > rough()) return exact(delta, eta, edge);
  const Value at = value(std::min(in.row, static_cast<double>(rows())), in.column);
  Place place{at.sky, at.by_row * in.row_by_delta, {}};
  const double sine = std::sin(delta);
  // Next to the end, where all eta meet, the derivative across is that by delta a quarter turn on.
  if (std::abs(delta - end()) < 5e-4) {
    const double quarter = eta + (end() > 0 ? -pi / 2 : pi / 2);
    const KerrGrid::Place there = grid_.place(delta, quarter, this->edge(quarter));
    const double row = std::min(there.row, rows() - 1e-9);
    // Where sky III is no larger than this, there may be none of it a quarter turn on.
    if (!(row >= 0) || error(row, there.column) > rough()) return exact(delta, eta, edge);
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
