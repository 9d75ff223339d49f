// KerrPoints find the images of points of a sky near a hole that spins.  The cells of its chart are sorted
// by where they lie on the sky, and in each that may hold a point Newton's method finds its image.
#pragma once

#include <optional>
#include <vector>

#include "pipeline/light/kerr_chart.h"
#include "pipeline/light/kerr_ray.h"
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
  struct Cell {
    double row, column, size;       // of its middle, in cells of the chart
    float light;                    // the most of amplification * (frequency ratio)^4
    V3d middle, by_row, by_column;  // a place p is near row p.by_row, and column p.by_column, of it
    float off_row, off_column;      // how far from there
    float radius;                   // of a cap that holds it, as a chord
    bool folded = false;            // whether a caustic goes through it
    bool rough = false;             // whether polynomials are off there
  };
  struct Found {
    double row, column;
    KerrChart::Value value;
  };
  void add(double row, double column, double size);
  void set_box(Cell& cell) const;
  bool find(const V3d& place, const Cell& cell, Found& at) const;
  bool is_there(const V3d& place, const KerrChart::Direction& n) const;
  std::optional<TracedKerr> meet(const V3d& place, KerrChart::Direction& n) const;

  const KerrChart& chart_;
  double sine_, cosine_, most_light_ = 0;
  std::vector<Cell> cells_;
  std::vector<std::vector<int>> bins_;  // the cells that reach each, the brightest first
};

}  // namespace domefall
