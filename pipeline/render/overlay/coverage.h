// How much of each pixel lies within outlines, by exact areas.
#pragma once

#include <span>
#include <vector>

#include "projections/projection.h"

namespace domefall {

// A place in a picture, in pixels to the right and down from its top left corner: the middle of the
// first pixel is (0.5, 0.5).
struct PicturePoint {
  double x, y;
};

inline PicturePoint picture_point(const PixelPosition& pixel) {
  return {pixel.i - 0.5, pixel.j - 0.5};
}

// Whether that place is in the picture and the projection shows something there.
inline bool is_in_picture(const Projection& p, const PixelPosition& pixel) {
  return is_inside(p, pixel) && pixel.i > 0.5 && pixel.j > 0.5 && pixel.i < columns(p) + 0.5 &&
         pixel.j < rows(p) + 0.5;
}

// A closed polygon.
using PicturePolygon = std::vector<PicturePoint>;

class Coverage {
 public:
  // For a picture of that size.
  Coverage(int width, int height) : width_(width), height_(height) {}

  // Corners are rounded to 1/4096 pixel, so that the last bits of a sine, which differ between
  // processors, do not matter.  What lies outside the picture is cut off.  Ignores a polygon with a
  // corner that is not finite or beyond 1e6 pixels.
  void add(const PicturePolygon& polygon);

  // Calls use(row, first column, parts) from top to bottom for rows that are touched.  A part, 0 to
  // 1, is the area of a pixel that lies within the polygons, each counted by its direction, so that
  // a hole that runs against its outline is one.  It is exact, but for pixels in which two polygons
  // of one direction overlap.
  template <class Use>
  void for_each_row(const Use& use) const {
    std::vector<double> band;
    for (int top = 0; top < height_; top += kRows) {
      const Span span = accumulate(top, band);
      for (int row = 0; row < kRows && top + row < height_ && span.count > 0; ++row)
        use(top + row, span.first,
            std::span<const double>(band).subspan(static_cast<std::size_t>(row) * span.stride(),
                                                  span.count));
    }
  }

 private:
  static constexpr int kRows = 16;
  // Down from (x0, y0) to (x1, y1), y0 < y1, or up if the direction is -1.
  struct Edge {
    double x0, y0, x1, y1, direction;
  };
  struct Span {
    int first = 0;
    std::size_t count = 0;
    std::size_t stride() const { return count + 2; }
  };
  void add_edge(PicturePoint from, PicturePoint to);
  // The coverage of the band of rows that begins at `top`, row by row with the span's stride.
  Span accumulate(int top, std::vector<double>& band) const;

  int width_, height_;
  std::vector<std::vector<Edge>> edges_;  // that touch each band
};

}  // namespace domefall
