#include "pipeline/light/kerr_grid.h"

#include <cmath>
#include <numbers>

#include "pipeline/light/kerr_view.h"
#include "pipeline/light/lagrange.h"

namespace domefall {
namespace {

constexpr int kEdges = 4096;
constexpr std::size_t kEdgePoints = 8;
constexpr double kTurn = 2 * std::numbers::pi;

}  // namespace

// A dome of 1k has pixels of 0.003.  Polynomials of eight err by 2^8 times as much in cells twice as wide,
// and where that is too much exact rays are followed.
int kerr_stride(double pixel) { return pixel < 0.004 ? 1 : pixel < 0.016 ? 2 : 4; }

KerrEdgeCurve::KerrEdgeCurve(const KerrPlace& at, KerrEdge edge) {
  deltas_.reserve(kEdges);
  for (int k = 0; k < kEdges; ++k) deltas_.push_back(kerr_edge_delta(at, kTurn * k / kEdges, edge));
}

KerrEdgeCurve::Point KerrEdgeCurve::at(double eta) const {
  const double place = eta / kTurn * kEdges, whole = std::floor(place);
  const LagrangeWeights<kEdgePoints> weights(place - whole);
  Point point{0, 0};
  for (std::size_t k = 0; k < kEdgePoints; ++k) {
    const int node =
        static_cast<int>(whole) + static_cast<int>(k) + 1 - static_cast<int>(kEdgePoints) / 2;
    const double delta = deltas_[static_cast<std::size_t>((node % kEdges + kEdges) % kEdges)];
    point.delta += weights.w[k] * delta;
    point.slope += weights.slope[k] * delta * (kEdges / kTurn);
  }
  return point;
}

KerrGrid::KerrGrid(const KerrPlace& at, KerrEdge edge, double end, int rows, int columns)
    : at_(at),
      kind_(edge),
      end_(end),
      step_(-kLeast / rows),
      rows_(rows),
      columns_(columns),
      edge_(at, edge) {}

KerrDirection KerrGrid::direction(int row, int column) const {
  const long double eta = kTurn * column / columns_;
  if (row == rows_) return {end_, eta};
  const long double part = 2 / (1 + std::exp(-static_cast<long double>(kLeast + step_ * row)));
  const long double whole = end_ - critical_ray(at_, eta, kind_).delta;
  if (row < rows_) return {0, eta, kind_, part * whole};
  // Beyond the end the direction is one of the other side.
  return {end_ - (part - 1) * whole, eta + std::numbers::pi};
}

double KerrGrid::column_by_eta() const { return columns_ / kTurn; }

KerrGrid::Place KerrGrid::place(double delta, double eta, const Edge& edge) const {
  const double way = delta - edge.delta, rest = 2 * (end_ - edge.delta) - way;
  return {(std::log(way / rest) - kLeast) / step_, eta * column_by_eta(),
          (1 / way + 1 / rest) / step_, edge.slope * (1 / rest - 1 / way) / step_};
}

KerrGrid::Direction KerrGrid::direction(double row, double column) const {
  const double eta = column / column_by_eta(), from = edge(eta).delta;
  const double part = 2 / (1 + std::exp(-kLeast - step_ * row)), way = part * (end_ - from);
  return {from + way, eta, step_ * way * (1 - part / 2)};
}

}  // namespace domefall
