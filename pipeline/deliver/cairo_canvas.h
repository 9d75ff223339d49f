// Lines and texts in a picture, by Cairo.  Places are in pixels from the top left corner, where the
// middle of the first pixel is (0.5, 0.5).  Greys and colours are display codes, 0 to 1.
#pragma once

#include <cairo.h>

#include <memory>
#include <string>

#include "pipeline/image/frame_buffer.h"

namespace domefall {

struct CanvasPoint {
  double x, y;
};

class CairoCanvas {
 public:
  // A black picture.  Throws std::runtime_error with Cairo's reason.
  CairoCanvas(int width, int height);

  int width() const { return width_; }
  int height() const { return height_; }

  void set_grey(double grey) { set_colour(grey, grey, grey); }
  void set_colour(double red, double green, double blue);

  void line(CanvasPoint from, CanvasPoint to, double thickness);
  void circle(CanvasPoint centre, double radius, double thickness);
  void box(CanvasPoint corner, double width, double height);  // filled

  // A line of text about its middle, turned by `angle` (radians, clockwise), in letters whose em
  // has `size` pixels, or smaller so that it is no longer than `longest`.  Throws as lettering()
  // and Lettering::letter.
  void text(const std::string& line, CanvasPoint middle, double size, double longest,
            double angle = 0);

  // Puts a picture there.
  void picture(const GradedFrame& picture, int x, int y);

  // What was drawn.  Throws as the constructor does, for what Cairo could not draw.
  GradedFrame finished();

 private:
  void check() const;

  int width_, height_;
  std::unique_ptr<cairo_surface_t, decltype(&cairo_surface_destroy)> surface_;
  std::unique_ptr<cairo_t, decltype(&cairo_destroy)> cairo_;
};

}  // namespace domefall
