// What a frame sees, on a coarse grid of exact looks between which most pixels are interpolated.
//
// Nodes stand every kStep pixels.  Between them sky directions and shifts follow the cubic through four
// nodes a side, at an error of at most kTolerance pixels, bounded in two ways: an edge of a sky, towards
// which the azimuth is -ln x, is kEdgeCells cells away at least; and at the nodes around, the cubic
// through their second next neighbours, 16 times worse, is right to 6 times the tolerance.  A cell that
// fails has every pixel looked at.  (And floats hold a place on the sky to 3e-7 radians, a thousandth of
// a texel of a map 16k wide.)
#pragma once

#include <array>
#include <cstdint>
#include <utility>
#include <vector>

#include "pipeline/render/sky/pixel_shader.h"
#include "pipeline/render/sky/sky_sampler.h"

namespace domefall {

class RayGrid {
 public:
  static constexpr int kStep = 8;
  static constexpr double kTolerance = 0.01;

  // Looks at all nodes, on all threads of the arena.  Memory is kept from frame to frame.
  // special: directions about which a grid may miss what there is.
  // The cells of skies that are no maps are exact.
  void make(const PixelShader& shader, const std::vector<CameraDirection>& special);

  enum class Kind : std::uint8_t {
    kNothing,  // dark, or out of the picture
    kSmooth,
    kExact
  };
  struct Cell {
    Kind kind = Kind::kNothing;
    SkyRegion sky = SkyRegion::kIV;
    bool plain = false;  // one look a pixel, at the finest level of a map, is enough

    bool operator==(const Cell&) const = default;
  };
  int cell_columns() const { return cell_columns_; }
  int cell_rows() const { return cell_rows_; }
  const Cell& cell(int row, int column) const {
    return cells_[static_cast<std::size_t>(row * cell_columns_ + column)];
  }

  // Of the pixels of all cells but those out of the picture or dark, 0 to 1.
  double traced_fraction() const;

  // Pixels of smooth cells [first, end) of one sky, kStep each, in row `row` of their row of cells; x, y, z,
  // gain and tone only.  (end - first) kStep <= FootprintBatch::kSize.
  void interpolate_row(int cell_row, int row, int first, int end, FootprintBatch& out) const;
  // All pixels of such cells: cell by cell, and kStep rows in each.
  static constexpr int kBlock = FootprintBatch::kSize / (kStep * kStep);  // the most of them
  void interpolate_block(int cell_row, int first, int end, FootprintBatch& out) const;

 private:
  enum Quantity {
    kX,
    kY,
    kZ,
    kGain,
    kTone,
    kWide,
    kNarrow,
    kAlongX,
    kAlongY,
    kAlongZ,
    kQuantities
  };
  static constexpr int kCubics = 5;  // so many of them vary as cubics, the others linearly
  // Beyond the last node: loops over nodes run on to whole registers.
  static constexpr std::size_t kPadding = 96;
  static constexpr int kMargin = 3;  // nodes beyond the first and the last cell

  std::pair<int, int> needed_nodes(int row) const;  // first, end
  void trace_row(int row);
  void check_row(int row);
  void classify_row(int row);
  bool in_picture(int row, int column) const;
  bool is_smooth(int row, int column) const;
  Cell classified(int row, int column) const;
  void store(std::size_t node, const ViewRayBatch& batch, const double* angle, int count);
  void choose_side(int cell_row, int cell, int count, FootprintBatch& out) const;
  const float* corner(Quantity q, int cell_row, int cell) const {
    return &nodes_[q][at(cell_row + kMargin - 1, cell + kMargin - 1)];
  }
  std::size_t at(int row, int column) const {
    return static_cast<std::size_t>(row) * static_cast<std::size_t>(node_columns_) +
           static_cast<std::size_t>(column);
  }

  Projection projection_;
  const PixelShader* shader_ = nullptr;
  int node_columns_ = 0, node_rows_ = 0, cell_columns_ = 0, cell_rows_ = 0;
  std::array<std::vector<float>, kQuantities> nodes_;
  std::vector<float> tolerance_;    // radians on the sky
  std::vector<float> edge_;         // cells to the nearest edge of a sky
  std::vector<std::uint8_t> sky_;   // SkyRegion, or dark, or none to interpolate
  std::vector<std::uint8_t> run_;   // of eight nodes from here on, if it is one
  std::vector<std::uint8_t> good_;  // whether the cubics hold at a node
  std::vector<SampleKind> kinds_;   // of a pixel there
  std::vector<Cell> cells_;
  float tone_floor_ = 0;                // smaller changes of kTone do not matter
  std::vector<PixelPosition> special_;  // pixels from 0
};

}  // namespace domefall
