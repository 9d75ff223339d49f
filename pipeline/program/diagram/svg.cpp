#include "pipeline/program/diagram/svg.h"

#include <fmt/core.h>

#include <cmath>

namespace domefall {
namespace {

// Writes a number to hundredths of a pixel, without trailing zeros.
std::string number(double value) {
  std::string out = fmt::format("{:.2f}", value);
  out.erase(out.find_last_not_of('0') + 1);
  if (out.back() == '.') out.pop_back();
  return out == "-0" ? "0" : out;
}

std::string attribute(const char* name, const std::string& value) {
  return fmt::format(" {}=\"{}\"", name, value);
}

std::string attribute(const char* name, double value) { return attribute(name, number(value)); }

std::string stroke_attributes(const Stroke& stroke) {
  if (stroke.width == 0) return "";
  std::string out = attribute("stroke", stroke.colour) + attribute("stroke-width", stroke.width);
  if (*stroke.dashes != 0) out += attribute("stroke-dasharray", std::string(stroke.dashes));
  return out;
}

std::string pair(const PagePoint& p) { return fmt::format("{} {}", number(p.x), number(p.y)); }

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
    : head_(fmt::format("<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"
                        "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{0}\" height=\"{1}\" "
                        "viewBox=\"0 0 {0} {1}\" "
                        "font-family=\"DejaVu Sans, Verdana, Helvetica, Arial, sans-serif\">\n",
                        number(width), number(height))) {
  rectangle({0, 0, width, height}, "#ffffff");
}

void Svg::rectangle(const PageBox& box, const std::string& fill, double opacity) {
  body_ += fmt::format("<rect{}{}{}/>\n", box_attributes(box), attribute("fill", fill),
                       opacity < 1 ? attribute("fill-opacity", opacity) : "");
}

void Svg::frame(const PageBox& box, const Stroke& stroke) {
  body_ +=
      fmt::format("<rect{} fill=\"none\"{}/>\n", box_attributes(box), stroke_attributes(stroke));
}

void Svg::line(const PagePoint& a, const PagePoint& b, const Stroke& stroke) {
  body_ += fmt::format("<path d=\"M{}L{}\"{}/>\n", pair(a), pair(b), stroke_attributes(stroke));
}

void Svg::circle(const PagePoint& centre, double radius, const std::string& fill,
                 const Stroke& stroke) {
  body_ += fmt::format("<circle cx=\"{}\" cy=\"{}\" r=\"{}\" fill=\"{}\"{}/>\n", number(centre.x),
                       number(centre.y), number(radius), fill, stroke_attributes(stroke));
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
  body_ += fmt::format("<path d=\"{}\" fill=\"none\" stroke-linejoin=\"round\"{}{}/>\n", path,
                       *stroke.dashes == 0 ? " stroke-linecap=\"round\"" : "",
                       stroke_attributes(stroke));
}

void Svg::area(const std::vector<PagePoint>& points, const std::string& fill, double opacity) {
  std::string path;
  for (const PagePoint& p : points) path += (path.empty() ? "M" : "L") + pair(p);
  body_ += fmt::format("<path d=\"{}Z\" fill=\"{}\"{}/>\n", path, fill,
                       opacity < 1 ? attribute("fill-opacity", opacity) : "");
}

void Svg::text(const PagePoint& at, std::string_view text, const TextStyle& style) {
  std::string more;
  if (style.bold) more += " font-weight=\"bold\"";
  if (style.italic) more += " font-style=\"italic\"";
  if (style.turned_deg != 0)
    more += fmt::format(" transform=\"rotate({} {})\"", number(style.turned_deg), pair(at));
  const std::string common =
      fmt::format(R"(<text x="{}" y="{}" font-size="{}" text-anchor="{}"{})", number(at.x),
                  number(at.y), number(style.size), style.anchor, more);
  const std::string end = fmt::format(">{}</text>\n", xml_escaped(text));
  // The rim is drawn under the letters.  The attribute paint-order would do both in one, but some
  // viewers do not know it.
  if (style.halo)
    body_ += common +
             R"( fill="#ffffff" stroke="#ffffff" stroke-width="3.5" stroke-linejoin="round")" + end;
  body_ += common + attribute("fill", std::string(style.colour)) + end;
}

void Svg::begin_group(std::string_view id) {
  body_ += fmt::format("<g id=\"{}\">\n", xml_escaped(id));
}

void Svg::end_group() { body_ += "</g>\n"; }

std::string Svg::document() const { return head_ + body_ + "</svg>\n"; }

}  // namespace domefall
