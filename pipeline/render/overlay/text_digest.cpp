#include "pipeline/render/overlay/text_digest.h"

#include <cmath>

namespace domefall {

void add_outlines(Digest& digest, const LetteredText& text) {
  constexpr double kSteps = 1e5;
  // Adding 0 turns -0 into 0, so that both count as one number.
  const auto add = [&digest](const TextPoint& p) {
    digest.add(std::round(p.x * kSteps) + 0.0).add(std::round(p.y * kSteps) + 0.0);
  };
  for (const TextOutline& outline : text.outlines) {
    digest.add("outline");
    add(outline.start);
    for (const TextCurve& curve : outline.curves)
      for (const TextPoint& p : {curve.control1, curve.control2, curve.end}) add(p);
  }
}

}  // namespace domefall
