#include "pipeline/deliver/drawing.h"

namespace domefall {

void Drawing::text(const std::string& line, DrawingPoint middle, double size, double longest,
                   double angle) {
  const LetteredText letters = lettering().letter(line, {});
  double capital = size / letters.em;
  if (2 * letters.half_width * capital > longest) capital = longest / (2 * letters.half_width);
  fill(letters.outlines, middle, capital, angle);
}

std::unique_ptr<Drawing> new_drawing(int width, int height) {
  static const auto& maker =
      late_library<DrawingMaker>("domefall_cairo_drawing", "draws contact sheets and leaders");
  return maker.make(width, height);
}

}  // namespace domefall
