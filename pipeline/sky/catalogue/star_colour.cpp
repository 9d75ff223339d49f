#include "pipeline/sky/catalogue/star_colour.h"

#include <algorithm>

namespace domefall {

float colour_of_b_v(double b_v) { return std::clamp(static_cast<float>(b_v), kBluest, kReddest); }

double temperature_from_b_v(double b_v) {
  // With c = 0.92 (B-V), Ballesteros has T = 4600 K (1/(c + 1.7) + 1/(c + 0.62)).  The limit of
  // -0.4 keeps away from the pole at c = -0.62, which is B-V = -0.67.
  const double c = 0.92 * std::clamp(b_v, -0.4, double{kReddest});
  return 4600 * (1 / (c + 1.7) + 1 / (c + 0.62));
}

double temperature_of(float colour) {
  if (is_temperature(colour)) return colour;
  return temperature_from_b_v(colour == kNoColour ? kAssumedColour : colour);
}

}  // namespace domefall
