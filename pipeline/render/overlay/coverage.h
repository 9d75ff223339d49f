// What is drawn over a frame: a Coverage says how much of each pixel lies within outlines, by exact
// areas, and Ink is the light that is drawn there.
#pragma once

#include <span>
#include <variant>
#include <vector>

#include "pipeline/image/layer.h"
#include "pipeline/sources/colour/colour_space.h"
#include "projections/projection.h"

namespace domefall {

// An ImagePoint is a place in the image of a projection, in pixels to the right of the top left
// corner and down from it.  The middle of the first pixel is (0.5, 0.5).
struct ImagePoint {
  double x, y;
};

inline ImagePoint image_point(const PixelPosition& pixel) { return {pixel.i - 0.5, pixel.j - 0.5}; }

// Says whether a place is in the image and the projection shows something there.
inline bool is_in_image(const Projection& p, const PixelPosition& pixel) {
  return is_inside(p, pixel) && pixel.i > 0.5 && pixel.j > 0.5 && pixel.i < columns(p) + 0.5 &&
         pixel.j < rows(p) + 0.5;
}

// The last corner of a polygon is joined to the first.
using ImagePolygon = std::vector<ImagePoint>;

// A CoveredRow says how much of the pixels of a row is covered, from the column `first` on.
struct CoveredRow {
  int row, first;
  std::vector<double> parts;  // 0 to 1
};

class Coverage {
 public:
  // The size is that of the image, in pixels.
  Coverage(int width, int height) : width_(width), height_(height) {}

  // Adds a polygon.  Its corners are rounded to 1/4096 pixel, so that the last bits of a sine,
  // which differ between processors, do not matter.  Everything outside the image is cut off.  A
  // polygon is ignored if a corner is not finite or lies beyond 1e6 pixels.
  void add(const ImagePolygon& polygon);

  // Calls use(row, first column, parts) from top to bottom for rows that are touched.  A part, 0 to
  // 1, is the area of a pixel that lies within the polygons.  Each polygon counts with the sign of
  // its direction, so that a hole must run against its outline.  The part is exact, except in
  // pixels where two polygons of one direction overlap.
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
  // An Edge goes down from (x0, y0) to (x1, y1), y0 < y1, or up if its direction is -1.
  struct Edge {
    double x0, y0, x1, y1, direction;
  };
  struct Span {
    int first = 0;
    std::size_t count = 0;
    std::size_t stride() const { return count + 2; }
  };
  void add_edge(ImagePoint from, ImagePoint to);
  // Fills `band` with the coverage of the rows that begin at `top`, row by row with the span's
  // stride.  Returns the columns that are touched.
  Span accumulate(int top, std::vector<double>& band) const;

  int width_, height_;
  std::vector<std::vector<Edge>> edges_;  // for each band those that touch it
};

// What is drawn over: a picture, and its layer of titles or null.
template <class T>
struct OverlaidImages {
  ImageRgb<T>* picture;
  LayerImage<T>* titles = nullptr;
};

// A FrameRef refers to a frame of halves or of floats over which overlays are drawn.
struct FrameRef {
  int width, height;
  std::variant<OverlaidImages<Imath::half>, OverlaidImages<float>> images;

  // The constructors are implicit, so that either kind of frame can be passed as it is.
  template <class T>
  FrameRef(ImageRgb<T>& frame)
      : width(frame.width), height(frame.height), images(OverlaidImages<T>{&frame}) {}
  template <class T>
  FrameRef(LayeredFrame<T>& frame) : FrameRef(frame.picture) {
    std::get<OverlaidImages<T>>(images).titles = frame.find(Layer::kTitles);
  }
};

// An Ink is light that replaces the light behind it.
struct Ink {
  WorkingRgb light;    // pixel values
  double opacity = 1;  // 0 to 1
};

// Draws over a frame of the projection's size wherever the coverage says, but only where the projection shows anything.
void draw_over(const Coverage& coverage, const Ink& ink, const Projection& projection,
               const FrameRef& frame);
void draw_over(const std::vector<CoveredRow>& covered, const Ink& ink, const Projection& projection,
               const FrameRef& frame);

// Draws over a frame everywhere, even outside a dome's circle.
void draw_anywhere(const Coverage& coverage, const Ink& ink, const FrameRef& frame);

}  // namespace domefall
