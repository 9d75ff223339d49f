#include "pipeline/light/kerr_plane.h"

#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <span>

#include "pipeline/light/kerr_ray.h"
#include "pipeline/light/kerr_request.h"
#include "pipeline/light/kerr_view.h"
#include "pipeline/light/lagrange.h"
#include "pipeline/light/light_path.h"
#include "pipeline/light/plane_rays.h"
#include "pipeline/light/sphere_rays.h"

namespace domefall {
namespace {

using std::numbers::pi;

constexpr int kPlaneRows = 128, kPlaneColumns = 192;
constexpr int kPlanePoints = 6;
// Cells are rough where polynomials of four and of six nodes differ by this part of w.
constexpr double kMostOff = 1e-4;
// Light with less of its own energy, which kerr_passages() count by, is followed in steps.
constexpr double kLeastEnergy = 1e-3;

// Finds where a ray crosses the equator, as the nodes have it.
void step_along(const KerrPlace& at, double delta, double eta, double outer,
                std::span<std::array<double, 4>> nodes) {
  constexpr double kEnough = 1e-12;
  const LightPath path = kerr_light_path(at, delta, eta, outer);
  const double sine = std::sin(static_cast<double>(at.theta)),
               cosine = std::cos(static_cast<double>(at.theta));
  const V3d axis(cosine, -sine, 0), outwards(sine, cosine, 0);
  std::size_t order = 0;
  for (std::size_t k = 1; k < path.places.size() && order < nodes.size(); ++k) {
    const LightPath::Place &a = path.places[k - 1], &b = path.places[k];
    const double from = a.at.dot(axis), to = b.at.dot(axis);
    // Who is in the plane crosses it later at the earliest.
    if ((from > 0) == (to > 0) || std::abs(from) < kInPlane) continue;
    const V3d side = axis * (from > 0 ? 1 : -1);
    const double t = root_between(0, std::abs(from), 1, -std::abs(to), kEnough, [&](double part) {
      return LightPath::direction(a, b, part).dot(side);
    });
    const V3d place = LightPath::direction(a, b, t);
    nodes[order++] = {LightPath::inverse_radius(a, b, t), std::atan2(place.z, place.dot(outwards)),
                      std::lerp(a.time, b.time, t), std::lerp(a.slope, b.slope, t) * path.rate};
  }
}

}  // namespace

KerrPlane::KerrPlane(const KerrPlace& at, const KerrRings& rings, int stride)
    : rings_(rings),
      rows_(kPlaneRows / stride),
      columns_(kPlaneColumns / stride),
      most_off_(kMostOff * stride * stride) {
  for (const double end : {pi, 0.0}) {
    sides_.push_back({KerrGrid(at, KerrEdge::kSilhouette, end, rows_, columns_), {}, {}});
    fill(sides_.back());
    judge(sides_.back());
  }
}

std::shared_ptr<const KerrPlane> KerrPlaneKeeper::plane(const KerrPlace& at, const KerrRings& rings,
                                                        int stride) {
  const std::lock_guard lock(mutex_);
  if (!plane_ || rings_ != rings)
    // A thread that waits here for others must not take up work that waits for the mutex.
    tbb::this_task_arena::isolate(
        [&] { plane_ = std::make_shared<const KerrPlane>(at, rings, stride), rings_ = rings; });
  return plane_;
}

// Returns E, L and K of a ray, and where it is from the edge.
KerrPlane::Sight KerrPlane::beginning(double delta, double eta, const KerrGrid::Edge& edge) const {
  const KerrConstants of(at(), delta, eta);
  Sight sight{};
  sight.from_region_one = of.comes_from_region_one(at());
  sight.energy = of.energy, sight.momentum = of.momentum, sight.about_axis = of.about_axis;
  sight.to_edge = delta - edge.delta;
  sight.edge_slope = edge.slope / std::max(std::sin(edge.delta), 1e-9);
  return sight;
}

// Returns whether an order is there at all.
bool KerrPlane::exact_nodes(const KerrDirection& n, std::array<Node, kOrders>& nodes) const {
  for (Node& node : nodes) node.fill(std::nan(""));
  const auto delta = static_cast<double>(kerr_delta(at(), n));
  const auto eta = static_cast<double>(n.eta);
  const Sight ray = beginning(delta, eta, sides_[0].grid.edge(eta));
  if (!ray.from_region_one) return false;
  if (ray.energy > kLeastEnergy) {
    std::size_t order = 0;
    for (const KerrPassage& passage : kerr_passages(at(), n, nodes.size()))
      nodes[order++] = {1 / passage.r, passage.phi, passage.null_time, passage.speed * ray.energy};
  } else {
    step_along(at(), delta, eta, rings_.outer, nodes);
  }
  return std::isfinite(nodes[0][0]);
}

void KerrPlane::fill(Side& side) {
  constexpr int kGuard = KerrGrid::kGuard;
  const std::size_t count = side.grid.nodes();
  side.nodes.resize(count * kOrders);
  tbb::parallel_for(-kGuard, rows_ + kGuard + 1, [&](int row) {
    for (int column = 0; column < columns_; ++column) {
      std::array<Node, kOrders> nodes;
      exact_nodes(side.grid.direction(row, column), nodes);
      for (std::size_t order = 0; order < nodes.size(); ++order)
        side.nodes[order * count + side.grid.node(row, column)] = nodes[order];
    }
  });
  tbb::parallel_for(0, columns_, [&](int column) {
    for (int order = 0; order < kOrders; ++order) continue_column(side, column, order);
  });
}

// Beyond the rows in which rays cross the plane, the values go on a little as they did, if that leads to
// the horizon, or far out on the edge's other side.  Next to the plane rows may be too far apart for that.
void KerrPlane::continue_column(Side& side, int column, int order) const {
  constexpr int kGuard = KerrGrid::kGuard, kOn = 4;
  const std::size_t begin = static_cast<std::size_t>(order) * side.grid.nodes();
  const auto node = [&](int row) -> Node& {
    return side.nodes[begin + side.grid.node(row, column)];
  };
  const auto horizon = static_cast<double>(at().hole.horizon());
  int there = -kGuard;
  while (there <= rows_ + kGuard && std::isfinite(node(there)[0])) ++there;
  if (there < 3 - kGuard) return;
  for (int on = 0; on < kOn && there + on <= rows_ + kGuard; ++on) {
    const Node &a = node(there + on - 3), &b = node(there + on - 2), &c = node(there + on - 1);
    Node& next = node(there + on);
    if (std::isfinite(next[0])) return;
    const double w = 3 * c[0] - 3 * b[0] + a[0];
    if (on == 0 && !(side.grid.end() > 0 ? w < 0.5 / rings_.outer : w > 0.8 / horizon)) return;
    for (std::size_t k = 0; k < next.size(); ++k) {
      const auto near = [&](double angle) {
        return k == 1 ? c[k] + std::remainder(angle - c[k], 2 * pi) : angle;
      };
      next[k] = 3 * c[k] - 3 * near(b[k]) + near(a[k]);
    }
  }
}

template <int kCount>
KerrPlane::Node KerrPlane::interpolated(const Side& side, int order, double row, double column,
                                        Node* by_row, Node* by_column) const {
  const double i = std::clamp(std::floor(row), 0.0, rows_ - 1.0), j = std::floor(column);
  const LagrangeWeights<kCount> down(row - i), on(column - j);
  const int top = static_cast<int>(i) + 1 - kCount / 2, left = static_cast<int>(j) + 1 - kCount / 2;
  const Node* const nodes = side.nodes.data() + static_cast<std::size_t>(order) * side.grid.nodes();
  const double whole = nodes[side.grid.node(static_cast<int>(i), static_cast<int>(j))][1];
  Node value{};
  if (by_row) by_row->fill(0), by_column->fill(0);
  for (int k = 0; k < kCount; ++k) {
    Node sum{}, slope{};
    for (int m = 0; m < kCount; ++m) {
      Node v = nodes[side.grid.node(top + k, left + m)];
      v[1] -= 2 * pi * std::round((v[1] - whole) / (2 * pi));
      for (std::size_t n = 0; n < v.size(); ++n) {
        sum[n] += v[n] * on.w[static_cast<std::size_t>(m)];
        if (by_row) slope[n] += v[n] * on.slope[static_cast<std::size_t>(m)];
      }
    }
    for (std::size_t n = 0; n < value.size(); ++n) {
      value[n] += sum[n] * down.w[static_cast<std::size_t>(k)];
      if (!by_row) continue;
      (*by_row)[n] += sum[n] * down.slope[static_cast<std::size_t>(k)];
      (*by_column)[n] += slope[n] * down.w[static_cast<std::size_t>(k)];
    }
  }
  return value;
}

// Cells are outside or inside if no ring may be seen in them, even if w changes from node to node as much
// again.  Where rays go by the plane they cross it at the horizon, or on the edge's other side in the sky:
// all rings may lie between one node and the next.
void KerrPlane::judge(Side& side) const {
  side.cells.resize(static_cast<std::size_t>(kOrders * rows_ * columns_));
  tbb::parallel_for(0, rows_, [&](int row) {
    for (int order = 0; order < kOrders; ++order)
      for (int column = 0; column < columns_; ++column) {
        const std::size_t begin = static_cast<std::size_t>(order) * side.grid.nodes();
        double low = HUGE_VAL, high = -HUGE_VAL;
        for (int down = -1; down <= 2; ++down)
          for (int on = -1; on <= 2; ++on) {
            const double w = side.nodes[begin + side.grid.node(row + down, column + on)][0];
            const double there = std::isfinite(w) ? w : side.grid.end() > 0 ? 0 : HUGE_VAL;
            low = std::min(low, there), high = std::max(high, there);
          }
        const auto six = interpolated<kPlanePoints>(side, order, row + 0.5, column + 0.5, nullptr,
                                                    nullptr),
                   four = interpolated<kPlanePoints - 2>(side, order, row + 0.5, column + 0.5,
                                                         nullptr, nullptr);
        const bool smooth = std::abs(six[0] - four[0]) < most_off_ * std::abs(six[0]);
        side.cells[static_cast<std::size_t>((order * rows_ + row) * columns_ + column)] =
            high < 1 / rings_.outer  ? Cell::kOutside
            : low > 1 / rings_.inner ? Cell::kInside
            : smooth                 ? Cell::kSmooth
                                     : Cell::kRough;
      }
  });
}

KerrPlane::Sight KerrPlane::sight(double delta, double eta) const {
  const KerrGrid::Edge edge = sides_[0].grid.edge(eta);
  Sight sight = beginning(delta, eta, edge);
  if (!sight.from_region_one) return sight;
  const Side& side = sides_[sight.to_edge > 0 ? 0 : 1];
  KerrGrid::Place in = side.grid.place(delta, eta, edge);
  // Next to the edge the first images are as in the first row.
  if (!(in.row >= 0)) in = side.grid.place(side.grid.direction(0.0, in.column).delta, eta, edge);
  const double row = std::clamp(in.row, 0.0, static_cast<double>(rows_)),
               sine = std::max(std::sin(delta), 1e-9);
  const int i = std::min(static_cast<int>(row), rows_ - 1),
            j = static_cast<int>(std::floor(in.column)), on = (j % columns_ + columns_) % columns_;
  for (int order = 0; order < kOrders; ++order) {
    const Cell cell = side.cells[static_cast<std::size_t>((order * rows_ + i) * columns_ + on)];
    const auto k = static_cast<std::size_t>(order);
    sight.within[k] = cell == Cell::kInside;
    if (cell == Cell::kOutside || cell == Cell::kInside) continue;
    if (cell == Cell::kRough) return exact_sight(delta, eta);
    Node by_row, by_column;
    const Node at = interpolated<kPlanePoints>(side, order, row, in.column, &by_row, &by_column);
    const auto value = [&](std::size_t n) {
      return Value{at[n], by_row[n] * in.row_by_delta,
                   (by_row[n] * in.row_by_eta + by_column[n] * side.grid.column_by_eta()) / sine};
    };
    sight.crosses[k] = true;
    sight.at[k] = {value(0), value(1), value(2), value(3)};
  }
  return sight;
}

KerrPlane::Sight KerrPlane::exact_sight(double delta, double eta) const {
  constexpr double kStep = 1e-5;
  Sight sight = beginning(delta, eta, sides_[0].grid.edge(eta));
  const double sine = std::max(std::sin(delta), 1e-9);
  std::array<Node, kOrders> here, beyond, beside;
  if (!exact_nodes({delta, eta}, here)) return sight;
  // Away from the edge, so that the order of the images stays.
  const double step = std::copysign(std::min(kStep, std::abs(sight.to_edge) / 8), sight.to_edge);
  exact_nodes({delta + step, eta}, beyond);
  exact_nodes({delta, eta + std::abs(step) / sine}, beside);
  for (std::size_t k = 0; k < here.size(); ++k) {
    sight.crosses[k] = std::isfinite(here[k][0]);
    if (!sight.crosses[k]) break;
    const auto value = [&](std::size_t n) {
      const auto change = [&](const Node& there) {
        const double by = there[n] - here[k][n];
        return std::isfinite(by) ? (n == 1 ? std::remainder(by, 2 * pi) : by) : 0;
      };
      return Value{here[k][n], change(beyond[k]) / step, change(beside[k]) / std::abs(step)};
    };
    sight.at[k] = {value(0), value(1), value(2), value(3)};
  }
  return sight;
}

}  // namespace domefall
