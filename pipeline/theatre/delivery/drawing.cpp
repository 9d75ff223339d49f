#include "pipeline/theatre/delivery/drawing.h"

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <new>
#include <numbers>
#include <stdexcept>
#include <string>

namespace domefall {
Drawing::Drawing(int width, int height, const ScreenSides& pixel)
    : width_(width),
      height_(height),
      surface_(cairo_image_surface_create(CAIRO_FORMAT_RGB24, width, height),
               cairo_surface_destroy),
      cairo_(cairo_create(surface_.get()), cairo_destroy) {
  cairo_scale(cairo_.get(), 1 / pixel.x, 1 / pixel.y);
  check();
}

void Drawing::check() const {
  const cairo_status_t status = cairo_status(cairo_.get());
  if (status == CAIRO_STATUS_NO_MEMORY) throw std::bad_alloc();
  if (status != CAIRO_STATUS_SUCCESS)
    throw std::runtime_error(std::string("Cairo: ") + cairo_status_to_string(status));
}

void Drawing::set_colour(double red, double green, double blue) {
  cairo_set_source_rgb(cairo_.get(), red, green, blue);
}

void Drawing::line(DrawingPoint from, DrawingPoint to, double thickness) {
  cairo_set_line_width(cairo_.get(), thickness);
  cairo_move_to(cairo_.get(), from.x, from.y);
  cairo_line_to(cairo_.get(), to.x, to.y);
  cairo_stroke(cairo_.get());
}

void Drawing::circle(DrawingPoint centre, double radius, double thickness) {
  cairo_set_line_width(cairo_.get(), thickness);
  cairo_new_sub_path(cairo_.get());
  cairo_arc(cairo_.get(), centre.x, centre.y, radius, 0, 2 * std::numbers::pi);
  cairo_stroke(cairo_.get());
}

void Drawing::box(DrawingPoint corner, double width, double height) {
  cairo_rectangle(cairo_.get(), corner.x, corner.y, width, height);
  cairo_fill(cairo_.get());
}

void Drawing::fill(const std::vector<TextOutline>& outlines, DrawingPoint middle, double capital,
                   double angle) {
  cairo_t* cairo = cairo_.get();
  cairo_save(cairo);
  cairo_translate(cairo, middle.x, middle.y);
  cairo_rotate(cairo, angle);
  cairo_scale(cairo, capital, -capital);
  for (const TextOutline& outline : outlines) {
    cairo_move_to(cairo, outline.start.x, outline.start.y);
    for (const auto& [c1, c2, end, straight] : outline.curves)
      cairo_curve_to(cairo, c1.x, c1.y, c2.x, c2.y, end.x, end.y);
    cairo_close_path(cairo);
  }
  cairo_fill(cairo);
  cairo_restore(cairo);
}

void Drawing::picture(const GradedFrame& picture, int x, int y) {
  cairo_surface_flush(surface_.get());
  unsigned char* bytes = cairo_image_surface_get_data(surface_.get());
  const int stride = cairo_image_surface_get_stride(surface_.get());
  const int columns = std::min(picture.width, width_ - x),
            rows = std::min(picture.height, height_ - y);
  for (int row = 0; row < rows; ++row) {
    const unsigned short* from = picture.row(row);
    unsigned char* to = bytes + static_cast<std::ptrdiff_t>(stride) * (y + row) + 4 * x;
    for (int k = 0; k < columns; ++k, from += 3, to += 4) {
      constexpr unsigned kHalf = 128, kCode = 257;
      const std::uint32_t pixel = (from[0] + kHalf) / kCode << 16 | (from[1] + kHalf) / kCode << 8 |
                                  (from[2] + kHalf) / kCode;
      std::memcpy(to, &pixel, sizeof pixel);
    }
  }
  cairo_surface_mark_dirty(surface_.get());
}

GradedFrame Drawing::finished() {
  check();
  cairo_surface_flush(surface_.get());
  const unsigned char* bytes = cairo_image_surface_get_data(surface_.get());
  const int stride = cairo_image_surface_get_stride(surface_.get());
  GradedFrame out(width(), height());
  for (int y = 0; y < height(); ++y) {
    const unsigned char* from = bytes + static_cast<std::ptrdiff_t>(stride) * y;
    unsigned short* to = out.row(y);
    for (int x = 0; x < width(); ++x, from += 4, to += 3) {
      std::uint32_t pixel = 0;
      std::memcpy(&pixel, from, sizeof pixel);
      constexpr unsigned kCode = 257, kByte = 0xff;  // 8 bits to 16
      to[0] = static_cast<unsigned short>((pixel >> 16 & kByte) * kCode);
      to[1] = static_cast<unsigned short>((pixel >> 8 & kByte) * kCode);
      to[2] = static_cast<unsigned short>((pixel & kByte) * kCode);
    }
  }
  return out;
}

void Drawing::text(const std::string& line, DrawingPoint middle, double size, double longest,
                   double angle) {
  const LetteredText letters = lettered(line, {});
  double capital = size / letters.em;
  if (2 * letters.half_width * capital > longest) capital = longest / (2 * letters.half_width);
  fill(letters.outlines, middle, capital, angle);
}

}  // namespace domefall
