// A Drawing is a picture of lines and texts.  Places are in pixels from the top left corner, where
// the middle of the first pixel is (0.5, 0.5).  Greys and colours are display codes, 0 to 1.  Cairo
// draws them and brings 15 other libraries, among them those of X11.  So what calls it is a library
// of its own, libdomefall_cairo_drawing.so (pipeline/cairo_drawing), which is loaded for the first
// picture.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "pipeline/image/frame_buffer.h"
#include "pipeline/image/late_library.h"
#include "pipeline/lettering/lettering.h"

namespace domefall {

struct DrawingPoint {
  double x, y;
};

class Drawing : public Interface {
 public:
  Drawing(int width, int height) : width_(width), height_(height) {}

  int width() const { return width_; }
  int height() const { return height_; }

  virtual void set_colour(double red, double green, double blue) = 0;
  void set_grey(double grey) { set_colour(grey, grey, grey); }

  virtual void line(DrawingPoint from, DrawingPoint to, double thickness) = 0;
  virtual void circle(DrawingPoint centre, double radius, double thickness) = 0;
  virtual void box(DrawingPoint corner, double width, double height) = 0;  // filled

  // Fills the outlines of a text.  Its middle goes to `middle`, its capitals are `capital` pixels
  // high, and it is turned clockwise by `angle` (radians).
  virtual void fill(const std::vector<TextOutline>& outlines, DrawingPoint middle, double capital,
                    double angle) = 0;

  // Writes a line of text in letters whose em has `size` pixels, or in smaller ones if it would be
  // longer than `longest` pixels.  Throws as lettering() and Lettering::letter.
  void text(const std::string& line, DrawingPoint middle, double size, double longest,
            double angle = 0);

  // Copies a picture so that its top left pixel is in column x and row y, from 0.  What would lie
  // beyond the right or the bottom edge is left out.
  virtual void picture(const GradedFrame& picture, int x, int y) = 0;

  // Returns what was drawn.  Throws as new_drawing() if Cairo could not draw something.
  virtual GradedFrame finished() = 0;

 private:
  int width_, height_;
};

class DrawingMaker : public Interface {
 public:
  virtual std::unique_ptr<Drawing> make(int width, int height) const = 0;
};

// Begins a black picture.  Throws as load_library, std::bad_alloc, and std::runtime_error with
// Cairo's reason.
std::unique_ptr<Drawing> new_drawing(int width, int height);

}  // namespace domefall
