// Text as outlines, in any script that the machine has fonts for.  Pango orders, joins and places the
// letters.
#pragma once

#include <string>
#include <vector>

namespace domefall {

// A TextPoint is a place in a text, to the right and up from the middle of its block, in heights of
// the font's capital H.
struct TextPoint {
  double x, y;
};

// A TextOutline is a closed outline of cubic Bézier curves.  Each TextCurve begins where the one
// before it ends.  A straight line has its control points at a third and two thirds of the way.
// Outlines and the holes in them run in opposite directions.
struct TextCurve {
  TextPoint control1, control2, end;
  bool straight;
};
struct TextOutline {
  TextPoint start;
  std::vector<TextCurve> curves;
};

enum class TextAlign { kLeft, kCentre, kRight };

struct LetterStyle {
  // This is the family and perhaps the style, such as "DejaVu Serif Bold Italic", as Pango reads
  // them.
  std::string font = "Sans";
  TextAlign align = TextAlign::kCentre;  // of lines of different lengths
  bool even_digits = false;              // all as wide, if the font has such ones

  bool operator==(const LetterStyle&) const = default;
};

struct LetteredText {
  std::vector<TextOutline> outlines;
  // The block reaches `half_width` to either side of its middle.  It reaches from the top of the
  // first line's capitals, at `half_height`, down to the baseline of the last line.
  double half_width = 0, half_height = 0;
  double em = 0;           // of the font, in capitals
  bool font_found = true;  // or else another one stands in for it
  int missing = 0;         // letters that no font of the machine has, drawn as boxes
};

// Lays out UTF-8 text, whose lines end in '\n'.  Bytes that are not UTF-8 become U+FFFD.  No hinting is
// applied, so outlines are the same at any size.  They depend on the machine's fonts and on nothing
// else.  It may be called from any thread.  Throws TemporaryError if the machine has no font.
LetteredText lettered(const std::string& text, const LetterStyle& style);

}  // namespace domefall
