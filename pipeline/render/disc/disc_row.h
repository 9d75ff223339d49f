// A Row draws a disc over one row of pixels.
//
// Between rims the light of a disc is as smooth as its images.  So it is computed at every eighth
// pixel, the nodes of the row, and interpolated by cubics between them.  Only where a rim is near,
// or where the cubics would be too far off, is each pixel computed by itself.  Two neighbouring
// nodes have no rim between them if their distances to the rims are large against how fast these
// can change.
//
// A pattern is too fine for cubics, but the places at which a pixel sees it are as smooth as the light
// without it.  So these are interpolated, and the pattern is found at each pixel.
#pragma once

#include <memory>
#include <vector>

#include "pipeline/render/disc/disc_strip.h"

namespace domefall {

class DiscPass::Row {
 public:
  // Says whether the view changes slowly enough from node to node for cubics.
  static bool is_steady(const FrameScene& scene);

  // Without nodes, each pixel is computed by itself.
  Row(const DiscPass& pass, bool with_nodes);

  // Lays the disc over the row's pixels, rgb[3 columns].  `left` is null or has one value a column
  // (DiscPass::draw_rows).
  void draw(int row, float* rgb, float* left);
  // As DiscPass::fill_orders.
  void fill_orders(int row, std::span<float* const> orders);

 private:
  static constexpr int kStep = 8;  // pixels from node to node

  struct Node {
    Strip::Sighting seen;
    // What the pixel sees: light, and the place for the pattern.
    int count = 0;
    std::array<std::array<double, 8>, Strip::kMostLooks> looks;
    double left = 1;  // the part of the light from behind that passes
  };
  // A Cell lies between two nodes.  Its cubics go through four nodes of the five by which they are
  // judged.
  static constexpr std::size_t kJudges = 5;
  struct Cell {
    const Node* judges;
    std::size_t from, within;  // the first of the four, and the cell's number between them
    int column;                // of its first pixel
    bool next_to_rim;
  };

  template <class ColumnOf>
  void locate(int row, int count, const ColumnOf& column_of);
  void find_nodes(int row, int first, int count);
  bool joined(const Node& a, const Node& b) const;
  void draw_run(std::size_t first, std::size_t last, float* rgb);
  void note_looks(Node& node, const Node& before, int k);
  bool trusted(const Cell& cell) const;
  void draw_cell(const Cell& cell, float* rgb);
  void draw_patterns(float* rgb);
  void draw_singly(int row, float* rgb);

  const DiscPass& pass_;
  float exposure_;
  bool with_nodes_;
  std::unique_ptr<Strip> strip_;
  float* left_ = nullptr;
  int first_ = 0;  // column of the first node
  std::vector<Node> nodes_;
  // What pixels of cells see of a pattern, with their columns.
  std::vector<std::array<float, 3>> lights_;
  std::vector<PatternPlace> places_;
  std::vector<float> factors_;
  std::vector<int> columns_;
  std::vector<int> single_;  // columns of pixels that are computed one by one
};

}  // namespace domefall
