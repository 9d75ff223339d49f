// A Drawing is a picture of lines and texts.  Places are in pixels from the top left corner, where
// the middle of the first pixel is (0.5, 0.5).  Where pixels are not square, lengths and places are
// in the unit of ScreenSides.  Greys and colours are display codes, 0 to 1.  Cairo
// draws them.
#pragma once

#include <cairo.h>

#include <memory>
#include <string>
#include <vector>

#include "pipeline/base/lettering.h"
#include "pipeline/image/frame_buffer.h"
#include "projections/projection.h"

namespace domefall {

struct DrawingPoint {
  double x, y;
};

class Drawing {
 public:
  // Begins a black picture.  Throws std::bad_alloc, and std::runtime_error with Cairo's reason.
  Drawing(int width, int height, const ScreenSides& pixel = {1, 1});

  // In pixels.
  int width() const { return width_; }
  int height() const { return height_; }

  void set_colour(double red, double green, double blue);
  void set_grey(double grey) { set_colour(grey, grey, grey); }

  void line(DrawingPoint from, DrawingPoint to, double thickness);
  void circle(DrawingPoint centre, double radius, double thickness);
  void box(DrawingPoint corner, double width, double height);  // filled

  // Fills the outlines of a text.  Its middle goes to `middle`, its capitals are `capital` pixels
  // high, and it is turned clockwise by `angle` (radians).
  void fill(const std::vector<TextOutline>& outlines, DrawingPoint middle, double capital,
            double angle);

  // Writes a line of text in letters whose em has `size` pixels, or in smaller ones if it would be
  // longer than `longest` pixels.  Throws as lettered().
  void text(const std::string& line, DrawingPoint middle, double size, double longest,
            double angle = 0);

  // Copies a picture so that its top left pixel is in column x and row y, from 0.  What would lie
  // beyond the right or the bottom edge is left out.
  void picture(const GradedFrame& picture, int x, int y);

  // Returns what was drawn.  Throws as the constructor if Cairo could not draw something.
  GradedFrame finished();

 private:
  void check() const;

  int width_, height_;
  std::unique_ptr<cairo_surface_t, decltype(&cairo_surface_destroy)> surface_;
  std::unique_ptr<cairo_t, decltype(&cairo_destroy)> cairo_;
};

}  // namespace domefall
