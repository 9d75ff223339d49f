// The radius of a geodesic about a hole that spins, over Mino time l (kerr_orbit.h):
//
//     r'' = R'(r)/2,      R = P^2 - Delta (r^2 + K),      P = (r^2 + a^2) E - a L
#pragma once

#include <optional>
#include <vector>

#include "trajectories/double_double.h"
#include "trajectories/kerr_motion.h"
#include "trajectories/taylor_series.h"

namespace domefall {

class KerrRadius {
 public:
  static constexpr double kFarthest = 1e10;

  // It has the r and nearly the r' at l = 0.  Throws std::domain_error for what comes out of a horizon.
  KerrRadius(const KerrHole& hole, const KerrMotion& motion, double r, double speed);

  struct Node {
    // What is fast and far away is so within a small part of all Mino time.
    DoubleDouble l;
    double r, speed;
    // The integrals of r^2, (r^2 + a^2) A and A.
    DoubleDouble squares{}, time{};
    double angle = 0;
  };
  Node at(const DoubleDouble& l) const;
  const std::vector<Node>& nodes() const { return nodes_; }

  bool has_period() const { return period_ < HUGE_VAL; }
  double period() const { return period_; }
  // Where it begins and ends: far away, at the past horizon, at the inner one, or never.
  const DoubleDouble& first() const { return first_; }
  const DoubleDouble& last() const { return last_; }
  bool comes_out() const { return comes_out_; }  // of the past horizon
  bool ends() const { return ends_; }            // at the inner one
  double least() const { return least_; }
  double greatest() const { return greatest_; }
  // Returns the first l >= after_l at which r is passed on that leg.
  std::optional<DoubleDouble> passage(double r, bool outward, const DoubleDouble& after_l) const;
  // Returns the first l >= after_l at which r is least.
  std::optional<DoubleDouble> next_least(const DoubleDouble& after_l) const;

 private:
  struct NodeSeries {
    Series r, square, along, time;  // along is A
    double unit, reach;             // the series go by l/unit, and are right up to l = reach

    double radius(double l) const { return value(r, l / unit); }
    double speed(double l) const { return slope(r, l / unit) / unit; }
  };
  NodeSeries series(const Node& at) const;
  NodeSeries series_of(const Node& node) const;
  Node after(const Node& at, const NodeSeries& s, double h) const;
  // Returns r' of a radius, with the sign of a value that is nearly right, which is kept next to a turn.
  double speed_at(double r, double nearly) const;
  // Returns the first l >= after_l of an instant that comes back with the period, if any does.
  std::optional<DoubleDouble> first_after(DoubleDouble l, const DoubleDouble& after_l) const;
  void follow(const Node& start);
  void follow_back(const Node& start);

  KerrHole hole_;
  double spin_, energy_, excess_, carter_, charges_, constant_;  // excess is E^2 - 1; P - E r^2
  std::vector<Node> nodes_;
  std::vector<NodeSeries> series_;  // of the nodes, once all are there
  bool circles_ = false;            // whether r stays
  double period_ = HUGE_VAL;
  Node sums_{};  // of a period
  DoubleDouble first_ = -HUGE_VAL, last_ = HUGE_VAL;
  bool comes_out_ = false, ends_ = false;
  double least_, greatest_;
};

}  // namespace domefall
