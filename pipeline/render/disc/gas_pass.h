// A GasPass draws gas that light goes through, which is smooth, into bands of pixel rows, and dims the
// light behind it.
//
// The gas is looked at along a grid of rays about the axis R: rows of equal alpha, the angle from the
// hole, and columns of equal azimuth.  On either side of the edge at which light winds around the hole
// rows are even in
//
//     x = a ln(1 + d/e) + b d,    d = |alpha - edge|,
//
// so that they become ever closer towards it.  About a hole that spins the edge is one for each azimuth.  Pixels interpolate between these rays, by cubics whose
// slopes go on from cell to cell.  What a pattern makes of a disc's light is found at each pixel.
#pragma once

#include <atomic>
#include <optional>
#include <vector>

#include "pipeline/render/disc/gas_rays.h"

namespace domefall {

class GasPass {
 public:
  // The scene must outlive this pass, whose rays are followed by all threads of the arena that calls.
  // Once `stop` is set they are followed no further, and nothing may be drawn.
  explicit GasPass(const FrameScene& scene, const std::atomic<bool>* stop = nullptr);

  // As DiscPass::draw_rows.
  void draw_rows(int first, int end, float* rgb, float* left = nullptr) const;

  const GasRays& rays() const { return rays_; }

 private:
  // The values of a ray in the grid are blocks of eight.  The first has light and what is left.  Those of
  // a pattern's looks have light, place and time, and by how much the place changes along r and about
  // the axis in one radian of view.  All of a look but its light are multiplied by it.
  static constexpr std::size_t kBlock = 8, kMostBlocks = 1 + GasSight::kLooks;
  using Block = std::array<float, kBlock>;
  using Values = std::array<Block, kMostBlocks>;
  // A Side is the view on one side of the edge.
  struct Side {
    double sign = 1, reach = 0, last = 0;  // of alpha - edge; its greatest d, and the x of that
    int rows = 0;
    std::size_t first_row = 0;  // in the grid
  };
  void add_side(double sign, double reach);
  double x_of(double d) const;
  double d_of(double x) const;
  void follow_row(const Side& side, int row);
  void mark_lit();
  void find_widths(const Side& side);
  std::size_t ray_at(const Side& side, int row, int column) const {
    return (side.first_row + static_cast<std::size_t>(row)) * static_cast<std::size_t>(columns_) +
           static_cast<std::size_t>(column);
  }
  Block* blocks_of(std::size_t ray) { return grid_.data() + ray * blocks_; }

  void draw_pixels(int row, int column, int count, float* rgb, float* left) const;
  // Finds the values of a pixel, and returns which blocks are lit.
  unsigned find_values(double alpha, double x, double azimuth, double width, Values& values) const;
  unsigned add_values(const Side& side, double x, double azimuth, float weight,
                      Values& values) const;

  GasRays rays_;
  const DiscPattern* pattern_ = nullptr;
  double exposure_;
  const GasView& view_;
  bool bent_;                            // light
  double log_rows_, even_rows_, least_;  // a, b, e
  int columns_;
  std::size_t blocks_;
  std::vector<Side> sides_;
  std::vector<Block> grid_;
  // The blocks, by their bits, that are lit in the rays about a cell of the grid.
  std::vector<unsigned char> lit_;
};

}  // namespace domefall
