// An Svg is a drawing in SVG 1.1, written shape by shape.  Later shapes lie on earlier ones.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace domefall {

// A PagePoint is a place in pixels of the page, where y grows downwards.
struct PagePoint {
  double x = 0, y = 0;
};

struct PageBox {
  double left = 0, top = 0, right = 0, bottom = 0;

  double width() const { return right - left; }
  double height() const { return bottom - top; }
};

struct TextStyle {
  double size = 13;
  const char* colour = "#30343c";
  const char* anchor = "start";  // or "middle" or "end"
  bool bold = false, italic = false;
  bool halo = false;      // a white rim, for text over lines
  double turned_deg = 0;  // clockwise about its place
};

struct Stroke {
  std::string colour;
  double width = 1;
  const char* dashes = "";  // lengths of dash and gap, e.g. "6 4"; empty for an unbroken line
};

// Replaces the special characters of XML by entities, and control characters other than the tab by
// U+FFFD.  The text is UTF-8.
std::string xml_escaped(std::string_view text);

// Returns a rough width in pixels.  It is 0.6 of the size for each character, which is the average
// of DejaVu Sans.
double text_width(std::string_view text, double size);

// Returns `text` if it is at most `width` wide, else its beginning and an ellipsis.
std::string shortened(const std::string& text, double size, double width);

class Svg {
 public:
  Svg(double width, double height);

  void rectangle(const PageBox& box, const std::string& fill, double opacity = 1);
  void frame(const PageBox& box, const Stroke& stroke);
  void line(const PagePoint& a, const PagePoint& b, const Stroke& stroke);
  void circle(const PagePoint& centre, double radius, const std::string& fill,
              const Stroke& stroke = {"none", 0});
  // Points nearer than 0.15 pixel to the one before are left out, except the last.
  void curve(const std::vector<PagePoint>& points, const Stroke& stroke);
  void area(const std::vector<PagePoint>& points, const std::string& fill, double opacity = 1);
  void text(const PagePoint& at, std::string_view text, const TextStyle& style = {});
  // Shapes between these two calls form a group with this id.
  void begin_group(std::string_view id);
  void end_group();

  std::string document() const;

 private:
  std::string head_, body_;
};

}  // namespace domefall
