// A Row draws a disc over one row of pixels.
//
// Between rims the light of a disc is as smooth as its images.  So it is computed at every eighth
// pixel, the nodes of the row, and interpolated by cubics between them.  Only where a rim is near,
// or where the cubics would be too far off, is each pixel computed by itself.  Two neighbouring
// nodes have no rim between them if their distances to the rims are large against how fast these
// can change.
#pragma once

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
    // For each order two bits say where the ray lies.  Orders behind an opaque image have none set.
    unsigned sight = 0;
    bool lit = false;      // whether it is in an image
    double clearance = 0;  // pixels to the nearest rim, at least; 0 where that cannot be told
    WorkingRgb light{0, 0, 0};
    float left = 1;  // the part of the light from behind that passes
  };

  template <class ColumnOf>
  void locate(int row, int count, const ColumnOf& column_of);
  void find_nodes(int row, int first, int count);
  Node sighted(const Crossings& crossings, int k) const;
  bool joined(const Node& a, const Node& b) const;
  void draw_run(std::size_t first, std::size_t last, float* rgb);
  bool draw_cell(std::size_t cell, std::size_t first, std::size_t last, float* rgb) const;
  void draw_singly(int row, float* rgb);

  const DiscPass& pass_;
  float exposure_;
  bool with_nodes_;
  Strip strip_;
  Crossings crossings_;
  float* left_ = nullptr;
  int first_ = 0;  // column of the first node
  std::vector<Node> nodes_;
  std::vector<int> single_;  // columns of pixels that are computed one by one
};

}  // namespace domefall
