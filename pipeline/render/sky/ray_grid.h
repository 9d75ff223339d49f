// A RayGrid is a coarse grid of view rays that are traced exactly.  Most pixels of a frame are
// interpolated from it.
//
// The nodes are kStep pixels apart.  Between them, directions on the sky and shifts follow the
// cubic through four nodes along each axis, with an error of at most kTolerance pixels.  Two
// conditions bound the error of a cell:
// - The nearest edge of a sky, towards which the azimuth goes like -ln x, is at least kEdgeCells
//   away.
// - At the nodes around it, the cubic through the nodes 1 and 3 steps away on both sides errs by
//   less than kCoarser tolerances.  Its nodes are twice as far apart, so its error is 2^4 times as
//   large.
//
// If a cell fails, all of its pixels are traced.  Directions are stored as floats, which are right
// to 3e-7 radians.  This is a thousandth of a texel of a map 16k wide.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include "pipeline/render/sky/pixel_shader.h"
#include "pipeline/render/sky/sky_sampler.h"

namespace domefall {

class RayGrid {
 public:
  static constexpr int kStep = 8;
  static constexpr double kTolerance = 0.01;

  // Traces all nodes, on all threads of the arena, and classifies the cells.  Cells near the
  // special directions, around which a grid may miss detail, become exact.  Memory is kept from
  // frame to frame.
  void make(const PixelShader& shader, const std::vector<CameraDirection>& special);

  enum class Kind : std::uint8_t {
    kNothing,  // dark, or outside the image
    kSmooth,   // pixels are interpolated
    kExact     // pixels are traced
  };
  struct Cell {
    Kind kind = Kind::kNothing;
    SkyRegion sky = SkyRegion::kIV;
    bool plain = false;  // one sample per pixel, at the finest level of a map, is enough

    bool operator==(const Cell&) const = default;
  };
  int cell_columns() const { return cell_columns_; }
  int cell_rows() const { return cell_rows_; }
  const Cell& cell(int row, int column) const {
    return cells_[static_cast<std::size_t>(row * cell_columns_ + column)];
  }

  // Returns the part (0 to 1) of the pixels that are traced.  Pixels of cells that are dark or
  // outside the image do not count.
  double traced_fraction() const;

  // Interpolates one row of pixels (0 to kStep - 1) of the smooth cells [first, end) of a row of
  // cells.  The cells must see one sky, and (end - first) kStep <= SampleBatch::kSize.  The
  // function writes directions and shifts only.
  void interpolate_row(int cell_row, int row, int first, int end, SampleBatch& out) const;
  // Interpolates all pixels of such cells, cell by cell, each in kStep rows.
  // end - first <= kBlock.
  static constexpr int kBlock = SampleBatch::kSize / (kStep * kStep);
  void interpolate_block(int cell_row, int first, int end, SampleBatch& out) const;

 private:
  // The quantities at the nodes are the columns of SampleBatch.  For a panorama kGain and kTone
  // hold the two sides of its shift (SkyLight::shift_sides) until a side is chosen.  For the grid
  // they hold SkyLight::grid_shift.  On rings kX is the phase, and kWide says how much of it a
  // pixel covers.
  enum Quantity { kX, kY, kZ, kGain, kTone, kWide, kNarrow, kAxisX, kAxisY, kAxisZ, kQuantities };
  // Loops over nodes process whole registers and so run on beyond the last node.
  static constexpr std::size_t kPadding = 96;
  static constexpr int kMargin = 3;  // nodes before the first cell, and behind the last
  // sky_ and run_ hold these marks besides the skies.
  static constexpr std::uint8_t kMixed = 0xff, kDark = 0xfe;

  void resize(const Projection& projection);
  std::pair<int, int> needed_nodes(int row) const;  // first, end
  void trace_row(int row);
  void store_nodes(std::size_t first, const ViewRayBatch& rays, const double* angle, int count);
  void store_rings(std::size_t first, const ViewRayBatch& rays, const double* angle, int count);
  void store_shifts(std::size_t first, const ViewRayBatch& rays, int count);
  void check_row(int row);
  void classify_row(int row);
  bool is_in_image(int row, int column) const;  // says whether any pixel of a cell is
  bool is_smooth(int row, int column) const;
  bool is_near_special(int row, int column) const;
  Cell classified(int row, int column) const;
  void choose_side(int cell_row, int cell, int count, SampleBatch& out) const;
  // Returns the node above and to the left of a cell's first corner.
  const float* first_node(Quantity q, int cell_row, int cell) const {
    return &nodes_[q][at(cell_row + kMargin - 1, cell + kMargin - 1)];
  }
  std::size_t at(int row, int column) const {
    return static_cast<std::size_t>(row) * static_cast<std::size_t>(node_columns_) +
           static_cast<std::size_t>(column);
  }

  Projection projection_;
  std::optional<PixelPosition> circle_;  // the middle of a fisheye's circle, in pixels from 0
  const PixelShader* shader_ = nullptr;
  int node_columns_ = 0, node_rows_ = 0, cell_columns_ = 0, cell_rows_ = 0;
  std::array<std::vector<float>, kQuantities> nodes_;
  std::vector<float> tolerance_;       // radians on the sky
  std::vector<float> edge_;            // cells to the nearest edge of a sky
  std::vector<std::uint8_t> sky_;      // SkyRegion, or kDark
  std::vector<std::uint8_t> run_;      // the sky of a node and the seven after it, or kMixed
  std::vector<std::uint8_t> cubic_;    // says whether the cubics are right at a node
  std::vector<SampleFilter> filters_;  // of a pixel at a node
  std::vector<Cell> cells_;
  float tone_floor_ = 0;  // an error of kTone below this does not matter
  std::vector<CameraDirection> special_;
  std::vector<PixelPosition> special_pixels_;  // their places in the image, in pixels from 0
};

}  // namespace domefall
