#include "pipeline/deliver/canvas.h"

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <nlohmann/json.hpp>
#include <numbers>
#include <stdexcept>

#include "pipeline/image/errors.h"

namespace domefall {
namespace {

// A show may be called by its file, whose name need not be UTF-8, which Cairo asks for.
std::string valid_utf8(const std::string& text) {
  using Json = nlohmann::json;
  return Json::parse(Json(text).dump(-1, ' ', false, Json::error_handler_t::replace))
      .get<std::string>();
}

}  // namespace

Canvas::Canvas(int width, int height)
    : width_(width),
      height_(height),
      surface_(cairo_image_surface_create(CAIRO_FORMAT_RGB24, width, height),
               cairo_surface_destroy),
      cairo_(cairo_create(surface_.get()), cairo_destroy) {
  cairo_select_font_face(cairo_.get(), "sans-serif", CAIRO_FONT_SLANT_NORMAL,
                         CAIRO_FONT_WEIGHT_NORMAL);
  cairo_font_options_t* options = cairo_font_options_create();
  cairo_font_options_set_antialias(options, CAIRO_ANTIALIAS_GRAY);
  cairo_font_options_set_hint_style(options, CAIRO_HINT_STYLE_NONE);
  cairo_font_options_set_hint_metrics(options, CAIRO_HINT_METRICS_OFF);
  cairo_set_font_options(cairo_.get(), options);
  cairo_font_options_destroy(options);
  check();
  cairo_text_extents_t extents;
  cairo_text_extents(cairo_.get(), "FRONT", &extents);
  if (!(extents.width > 0))
    throw TemporaryError("no font was found to write with; install one, such as fonts-dejavu-core");
}

void Canvas::check() const {
  const cairo_status_t status = cairo_status(cairo_.get());
  if (status == CAIRO_STATUS_NO_MEMORY) throw std::bad_alloc();
  if (status != CAIRO_STATUS_SUCCESS)
    throw std::runtime_error(std::string("Cairo: ") + cairo_status_to_string(status));
}

void Canvas::set_colour(double red, double green, double blue) {
  cairo_set_source_rgb(cairo_.get(), red, green, blue);
}

void Canvas::line(CanvasPoint from, CanvasPoint to, double thickness) {
  cairo_set_line_width(cairo_.get(), thickness);
  cairo_move_to(cairo_.get(), from.x, from.y);
  cairo_line_to(cairo_.get(), to.x, to.y);
  cairo_stroke(cairo_.get());
}

void Canvas::circle(CanvasPoint centre, double radius, double thickness) {
  cairo_set_line_width(cairo_.get(), thickness);
  cairo_new_sub_path(cairo_.get());
  cairo_arc(cairo_.get(), centre.x, centre.y, radius, 0, 2 * std::numbers::pi);
  cairo_stroke(cairo_.get());
}

void Canvas::box(CanvasPoint corner, double width, double height) {
  cairo_rectangle(cairo_.get(), corner.x, corner.y, width, height);
  cairo_fill(cairo_.get());
}

void Canvas::text(const std::string& line, CanvasPoint middle, double size, double longest,
                  double angle) {
  const std::string text = valid_utf8(line);
  cairo_t* cairo = cairo_.get();
  cairo_text_extents_t extents;
  cairo_set_font_size(cairo, size);
  cairo_text_extents(cairo, text.c_str(), &extents);
  if (extents.width > longest) cairo_set_font_size(cairo, size * longest / extents.width);
  cairo_text_extents(cairo, text.c_str(), &extents);
  cairo_font_extents_t font;
  cairo_font_extents(cairo, &font);
  cairo_save(cairo);
  cairo_translate(cairo, middle.x, middle.y);
  cairo_rotate(cairo, angle);
  cairo_move_to(cairo, -extents.x_bearing - extents.width / 2, (font.ascent - font.descent) / 2);
  cairo_show_text(cairo, text.c_str());
  cairo_restore(cairo);
}

void Canvas::picture(const GradedFrame& picture, int x, int y) {
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

GradedFrame Canvas::finished() {
  check();
  cairo_surface_flush(surface_.get());
  const unsigned char* bytes = cairo_image_surface_get_data(surface_.get());
  const int stride = cairo_image_surface_get_stride(surface_.get());
  GradedFrame out(width_, height_);
  for (int y = 0; y < height_; ++y) {
    const unsigned char* from = bytes + static_cast<std::ptrdiff_t>(stride) * y;
    unsigned short* to = out.row(y);
    for (int x = 0; x < width_; ++x, from += 4, to += 3) {
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

}  // namespace domefall
