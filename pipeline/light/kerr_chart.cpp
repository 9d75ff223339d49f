#include "pipeline/light/kerr_chart.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace domefall {
namespace {

using std::numbers::pi;

constexpr int kRows = 144, kColumns = 192, kEdges = 4096;
constexpr double kTurn = 2 * pi;
constexpr int kPoints = 8;
// Where polynomials of six points differ so much from those of eight (radians), the chart is not used.
constexpr double kRough = 3e-5;

// The weights of Lagrange's polynomial through 2n nodes at 1 - n to n for a place from 0 to 1, and their
// derivatives.
template <std::size_t kCount>
struct Weights {
  std::array<double, kCount> w, slope;

  explicit Weights(double t) {
    static constexpr std::array<double, kCount> kScale = [] {
      std::array<double, kCount> scale{};
      for (std::size_t i = 0; i < kCount; ++i) {
        double product = 1;
        for (std::size_t j = 0; j < kCount; ++j)
          if (j != i) product *= static_cast<double>(i) - static_cast<double>(j);
        scale[i] = 1 / product;
      }
      return scale;
    }();
    // The products of the factors before and after each, and their derivatives.
    std::array<double, kCount + 1> before{1}, before_slope{0}, after{}, after_slope{};
    after[kCount] = 1;
    const auto factor = [t](std::size_t k) {
      return t + (kCount / 2.0 - 1) - static_cast<double>(k);
    };
    for (std::size_t k = 0; k < kCount; ++k) {
      before[k + 1] = before[k] * factor(k);
      before_slope[k + 1] = before_slope[k] * factor(k) + before[k];
      const std::size_t m = kCount - 1 - k;
      after[m] = after[m + 1] * factor(m);
      after_slope[m] = after_slope[m + 1] * factor(m) + after[m + 1];
    }
    for (std::size_t k = 0; k < kCount; ++k) {
      w[k] = kScale[k] * before[k] * after[k + 1];
      slope[k] = kScale[k] * (before_slope[k] * after[k + 1] + before[k] * after_slope[k + 1]);
    }
  }
};

// The part of a derivative across a unit vector.
V3d across(const V3d& v, const V3d& unit) { return v - unit * v.dot(unit); }

int wrapped(int k, int count) { return (k % count + count) % count; }

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
    : at_(at),
      kind_(sky),
      end_(sky == KerrEdge::kSilhouette ? pi : 0),
      rows_(kRows),
      columns_(kColumns) {
  step_ = -kLeast / rows_;
  edges_.reserve(kEdges);
  for (int k = 0; k < kEdges; ++k)
    edges_.push_back(static_cast<double>(critical_ray(at, kTurn * k / kEdges, sky).delta));
  nodes_.resize(static_cast<std::size_t>(rows_ + 1 + 2 * kGuard) *
                static_cast<std::size_t>(columns_));
  for (int row = -kGuard; row <= rows_ + kGuard; ++row)
    for (int column = 0; column < columns_; ++column) {
      const long double eta = kTurn * column / columns_;
      const long double part = std::exp(static_cast<long double>(kLeast + step_ * row));
      const long double whole = end_ - critical_ray(at, eta, sky).delta;
      KerrDirection n{0, eta, sky, part * whole};
      if (part >= 1) {
        // Beyond the end the direction is one of the other side.
        n = {part == 1 ? end_ : end_ - (part - 1) * whole, part == 1 ? eta : eta + pi};
      }
      nodes_[static_cast<std::size_t>(row + kGuard) * static_cast<std::size_t>(columns_) +
             static_cast<std::size_t>(column)] = trace_kerr_without_area(at, n).sky;
    }
  errors_.reserve(static_cast<std::size_t>(rows_ * columns_));
  for (int row = 0; row < rows_; ++row)
    for (int column = 0; column < columns_; ++column)
      errors_.push_back(static_cast<float>((value_of<kPoints>(row + 0.5, column + 0.5).sky -
                                            value_of<kPoints - 2>(row + 0.5, column + 0.5).sky)
                                               .length()));
}

const V3d& KerrChart::node(int row, int column) const {
  return nodes_[static_cast<std::size_t>(row + kGuard) * static_cast<std::size_t>(columns_) +
                static_cast<std::size_t>(wrapped(column, columns_))];
}

KerrChart::Edge KerrChart::edge(double eta) const {
  const double place = eta / kTurn * kEdges, whole = std::floor(place);
  const Weights<kPoints> weights(place - whole);
  Edge edge{0, 0};
  for (int k = 0; k < kPoints; ++k) {
    const double delta = edges_[static_cast<std::size_t>(
        wrapped(static_cast<int>(whole) + k + 1 - kPoints / 2, kEdges))];
    edge.delta += weights.w[static_cast<std::size_t>(k)] * delta;
    edge.slope += weights.slope[static_cast<std::size_t>(k)] * delta * (kEdges / kTurn);
  }
  return edge;
}

template <int kCount>
KerrChart::Value KerrChart::value_of(double row, double column) const {
  const double i = std::clamp(std::floor(row), 0.0, rows_ - 1.0), j = std::floor(column);
  const Weights<kCount> down(row - i), on(column - j);
  const int top = static_cast<int>(i) + 1 - kCount / 2, left = static_cast<int>(j) + 1 - kCount / 2;
  Value value{V3d(0, 0, 0), V3d(0, 0, 0), V3d(0, 0, 0)};
  for (int k = 0; k < kCount; ++k) {
    V3d sum(0, 0, 0), slope(0, 0, 0);
    for (int m = 0; m < kCount; ++m) {
      const V3d& v = node(top + k, left + m);
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
  const int i = std::clamp(static_cast<int>(row), 0, rows_ - 1),
            j = wrapped(static_cast<int>(std::floor(column)), columns_);
  return double{errors_[static_cast<std::size_t>(i * columns_ + j)]};
}

KerrChart::Direction KerrChart::direction(double row, double column) const {
  const double eta = kTurn * column / columns_, from = edge(eta).delta;
  const double way = std::exp(kLeast + step_ * row) * (end_ - from);
  return {from + way, eta, step_ * way};
}

KerrChart::Place KerrChart::place(double delta, double eta, const Edge& edge) const {
  const double way = delta - edge.delta, whole = end_ - edge.delta;
  const double row = (std::log(way / whole) - kLeast) / step_;
  const double column = eta / kTurn * columns_;
  if (!(row >= 0) || error(row, column) > kRough) return exact(delta, eta, edge);
  const Value at = value(std::min(row, static_cast<double>(rows_)), column);
  Place place{at.sky, at.by_row / (step_ * way), {}};
  const double sine = std::sin(delta);
  // Next to the end, where all eta meet, the derivative across is that by delta a quarter turn on.
  if (std::abs(delta - end_) < 5e-4) {
    const double quarter = eta + (end_ > 0 ? -pi / 2 : pi / 2), other = this->edge(quarter).delta;
    const double there =
        std::min((std::log((delta - other) / (end_ - other)) - kLeast) / step_, rows_ - 1e-9);
    if (error(there, quarter / kTurn * columns_) > kRough) return exact(delta, eta, edge);
    place.across =
        this->value(there, quarter / kTurn * columns_).by_row / (step_ * (delta - other));
    return place;
  }
  const double row_by_eta = -edge.slope * (end_ - delta) / (whole * way) / step_;
  place.across = (at.by_row * row_by_eta + at.by_column * (columns_ / kTurn)) / sine;
  return place;
}

KerrChart::Place KerrChart::exact(double delta, double eta, const Edge& edge) const {
  const double way = delta - edge.delta;
  const TracedKerr ray = trace_kerr(at_, {delta, eta, kind_, static_cast<long double>(way)});
  return {ray.sky, ray.by_delta, ray.across};
}

}  // namespace domefall
