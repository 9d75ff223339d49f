// KerrPoints find the images of points of a sky near a hole that spins.  The cells of its chart are sorted
// by where they lie on the sky, and in each that may hold a point Newton's method finds its image.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <vector>

#include "pipeline/light/kerr_chart.h"
#include "pipeline/light/sky_points.h"

namespace domefall {

class KerrPoints : public SkyPoints {
 public:
  // The chart must outlive this object.  theta, whose sine and cosine are given, is the observer's.
  KerrPoints(const KerrChart& chart, double sine, double cosine);

  bool lists_images() const override { return true; }
  void list_images(const V3d& source, double blur, double least_light,
                   std::vector<SkyImage>& images) const override;

  // Returns the images by their light, the brightest first, and light 0 for those that are not.
  int orders() const override { return 12; }
  SkyImage image(const V3d& source, int order, double blur) const override;
  double most_light(int) const override { return most_light_; }
  void images(int, const PointBatch&, int, PointImageBatch&) const override {}

 private:
  // A rectangle of the chart.  What is looked at first stands first.
  struct Cell {
    // A place p is near row p.by_row, and column p.by_column, of it.
    V3d by_row{0, 0, 0}, by_column{0, 0, 0};
    float off_row = 0, off_column = 0;  // how far from there
    float light = 0;                    // the most of amplification * (frequency ratio)^4
    float radius = 0;                   // of a cap that holds it, as a chord
    V3d middle{0, 0, 0};
    double row, column;              // of its middle, in cells of the chart
    double half_rows, half_columns;  // of its sides
    bool folded = false;             // whether a caustic goes through it
    // Its corners and middles, by row and by column, from the middle on.
    std::array<std::array<Imath::V3f, 3>, 3> places{};

    KerrChart::Value value(double at_row, double at_column) const;  // by the parabolas through them
    // Returns how far from its middle a place is, in halves of its sides.
    double from_middle(double at_row, double at_column) const {
      return std::max(std::abs(at_row - row) / half_rows,
                      std::abs(at_column - column) / half_columns);
    }
  };
  struct Found {
    double row, column;
    KerrChart::Value value;
  };
  struct Sample;
  struct Net;
  Sample sample(double row, double column) const;
  void add(const Net& net);
  void split(const Net& net, bool by_rows);
  void set_inverse(Cell& cell, const Net& net) const;
  void set_box(Cell& cell) const;
  void put_in_bins(const Net& net);
  static std::optional<std::array<double, 2>> step(const V3d& place, const Cell& cell, Found& at);
  static bool approach(const V3d& place, const Cell& cell, Found& at);
  bool find(const V3d& place, const Cell& cell, Found& at) const;

  const KerrChart& chart_;
  double sine_, cosine_, most_light_ = 0;
  std::vector<Cell> cells_;
  std::vector<std::vector<int>> bins_;  // the cells that reach each, the brightest first
};

}  // namespace domefall
