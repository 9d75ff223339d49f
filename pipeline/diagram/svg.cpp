#include "pipeline/diagram/svg.h"

#include <array>
#include <cmath>
#include <cstdio>

namespace domefall {
namespace {

// Hundredths of a pixel, without trailing zeros.
std::string number(double value) {
  std::array<char, 48> text{};
  std::snprintf(text.data(), text.size(), "%.2f", value);  // NOLINT(*-vararg)
  std::string out = text.data();
  out.erase(out.find_last_not_of('0') + 1);
  if (out.back() == '.') out.pop_back();
  return out == "-0" ? "0" : out;
}

std::string attribute(const char* name, const std::string& value) {
  return std::string(" ") + name + "=\"" + value + "\"";
}

std::string attribute(const char* name, double value) { return attribute(name, number(value)); }

std::string stroke_attributes(const Stroke& stroke) {
  if (stroke.width == 0) return "";
  std::string out = attribute("stroke", stroke.colour) + attribute("stroke-width", stroke.width);
  if (*stroke.dashes != 0) out += attribute("stroke-dasharray", std::string(stroke.dashes));
  return out;
}

std::string pair(const PagePoint& p) { return number(p.x) + " " + number(p.y); }

std::string box_attributes(const PageBox& box) {
  return attribute("x", box.left) + attribute("y", box.top) + attribute("width", box.width()) +
         attribute("height", box.height());
}

bool begins_character(char c) { return (static_cast<unsigned char>(c) & 0xC0U) != 0x80U; }

constexpr double kWidthOfCharacter = 0.6;

}  // namespace

std::string xml_escaped(std::string_view text) {
  std::string out;
  for (const char c : text) {
    if (c == '&')
      out += "&amp;";
    else if (c == '<')
      out += "&lt;";
    else if (c == '>')
      out += "&gt;";
    else if (c == '"')
      out += "&quot;";
    else if (static_cast<unsigned char>(c) < ' ' && c != '\t')
      out += "\xEF\xBF\xBD";
    else
      out += c;
  }
  return out;
}

double text_width(std::string_view text, double size) {
  double characters = 0;
  for (const char c : text) characters += begins_character(c) ? 1 : 0;
  return characters * size * kWidthOfCharacter;
}

std::string shortened(const std::string& text, double size, double width) {
  if (text_width(text, size) <= width) return text;
  std::string out;
  for (const char c : text) {
    if (begins_character(c) && text_width(out, size) + 2 * size * kWidthOfCharacter > width) break;
    out += c;
  }
  return out + "\u2026";
}

Svg::Svg(double width, double height)
    : head_(
          "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<svg xmlns=\"http://www.w3.org/2000/svg\"" +
          attribute("width", width) + attribute("height", height) +
          attribute("viewBox", "0 0 " + number(width) + " " + number(height)) +
          " font-family=\"DejaVu Sans, Verdana, Helvetica, Arial, sans-serif\">\n") {
  rectangle({0, 0, width, height}, "#ffffff");
}

void Svg::rectangle(const PageBox& box, const std::string& fill, double opacity) {
  body_ += "<rect" + box_attributes(box) + attribute("fill", fill) +
           (opacity < 1 ? attribute("fill-opacity", opacity) : "") + "/>\n";
}

void Svg::frame(const PageBox& box, const Stroke& stroke) {
  body_ += "<rect" + box_attributes(box) + " fill=\"none\"" + stroke_attributes(stroke) + "/>\n";
}

void Svg::line(const PagePoint& a, const PagePoint& b, const Stroke& stroke) {
  body_ += "<path d=\"M" + pair(a) + "L" + pair(b) + "\"" + stroke_attributes(stroke) + "/>\n";
}

void Svg::circle(const PagePoint& centre, double radius, const std::string& fill,
                 const Stroke& stroke) {
  body_ += "<circle" + attribute("cx", centre.x) + attribute("cy", centre.y) +
           attribute("r", radius) + attribute("fill", fill) + stroke_attributes(stroke) + "/>\n";
}

void Svg::curve(const std::vector<PagePoint>& points, const Stroke& stroke) {
  constexpr double kNear = 0.15;
  if (points.size() < 2) return;
  PagePoint last = points.front();
  std::string path = "M" + pair(last);
  for (std::size_t i = 1; i < points.size(); ++i) {
    const PagePoint& p = points[i];
    if (i + 1 < points.size() && std::hypot(p.x - last.x, p.y - last.y) < kNear) continue;
    path += "L" + pair(p);
    last = p;
  }
  body_ += "<path d=\"" + path + R"(" fill="none" stroke-linejoin="round")" +
           (*stroke.dashes == 0 ? R"( stroke-linecap="round")" : "") + stroke_attributes(stroke) +
           "/>\n";
}

void Svg::area(const std::vector<PagePoint>& points, const std::string& fill, double opacity) {
  std::string path;
  for (const PagePoint& p : points) path += (path.empty() ? "M" : "L") + pair(p);
  body_ += "<path d=\"" + path + "Z\"" + attribute("fill", fill) +
           (opacity < 1 ? attribute("fill-opacity", opacity) : "") + "/>\n";
}

void Svg::text(const PagePoint& at, std::string_view text, const TextStyle& style) {
  std::string more;
  if (style.bold) more += " font-weight=\"bold\"";
  if (style.italic) more += " font-style=\"italic\"";
  if (style.turned_deg != 0)
    more += attribute("transform", "rotate(" + number(style.turned_deg) + " " + pair(at) + ")");
  const std::string common = "<text" + attribute("x", at.x) + attribute("y", at.y) +
                             attribute("font-size", style.size) +
                             attribute("text-anchor", std::string(style.anchor)) + more;
  const std::string end = ">" + xml_escaped(text) + "</text>\n";
  // A rim under the letters; paint-order, which would do it in one, is not known to all viewers.
  if (style.halo)
    body_ += common +
             R"( fill="#ffffff" stroke="#ffffff" stroke-width="3.5" stroke-linejoin="round")" + end;
  body_ += common + attribute("fill", std::string(style.colour)) + end;
}

void Svg::begin_group(std::string_view id) {
  body_ += "<g" + attribute("id", xml_escaped(id)) + ">\n";
}

void Svg::end_group() { body_ += "</g>\n"; }

std::string Svg::document() const { return head_ + body_ + "</svg>\n"; }

}  // namespace domefall
