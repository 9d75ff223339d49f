#include "pipeline/sources/stars/star_colour.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>

#include "pipeline/sources/stars/raw_catalogue.h"

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

namespace {

// Types are counted in steps.  There are ten steps from one letter to the next.
constexpr std::string_view kLetters = "OBAFGKM";
constexpr double kSteps = 10, kMiddle = 5;

struct Node {
  double step, value;
};
// Returns the steps from O0 to a type, for example 25 to A5.
constexpr double step_of(std::size_t letter, double digit) {
  return kSteps * static_cast<double>(letter) + digit;
}
// Both tables are those of the header, in ascending order of steps from O0.
constexpr std::array kTemperatures{Node{step_of(0, 5), 41400}, Node{step_of(1, 0), 31400},
                                   Node{step_of(1, 5), 15700}, Node{step_of(2, 0), 9700}};
constexpr std::array kColours{Node{step_of(2, 0), 0.07}, Node{step_of(2, 5), 0.26},
                              Node{step_of(3, 0), 0.35}, Node{step_of(3, 5), 0.48},
                              Node{step_of(4, 0), 0.60}, Node{step_of(4, 5), 0.89},
                              Node{step_of(5, 0), 1.07}, Node{step_of(5, 2), 1.30},
                              Node{step_of(5, 5), 1.55}, Node{step_of(6, 0), 1.64}};
constexpr float kOfS = 1.8F, kOfN = 2.4F, kOfR = 1.55F;

// Interpolates between nodes, in the logarithm if `logarithmic` is set.  Beyond the ends it returns
// the value of the last node.
double interpolated(std::span<const Node> nodes, double step, bool logarithmic) {
  if (step <= nodes.front().step) return nodes.front().value;
  for (std::size_t i = 1; i < nodes.size(); ++i) {
    const Node &a = nodes[i - 1], &b = nodes[i];
    if (step > b.step) continue;
    const double part = (step - a.step) / (b.step - a.step);
    return logarithmic ? a.value * std::pow(b.value / a.value, part)
                       : a.value + part * (b.value - a.value);
  }
  return nodes.back().value;
}

// Returns the digit behind the letter, or a middle one where there is none.  It passes over the
// small letters of Oa to Oe, which are the catalogue's types of Wolf-Rayet and O stars.
double digit_of(std::string_view rest) {
  while (!rest.empty() && rest.front() >= 'a' && rest.front() <= 'e') rest.remove_prefix(1);
  return !rest.empty() && rest.front() >= '0' && rest.front() <= '9' ? rest.front() - '0' : kMiddle;
}

}  // namespace

float colour_of_spectral_type(std::string_view type) {
  if (type.empty() || type.starts_with("Pec") || type.starts_with("Con")) return kNoColour;
  if (type[0] == 'S') return kOfS;
  if (type[0] == 'N') return kOfN;
  if (type[0] == 'R') return kOfR;
  // S, N and R lie off the sequence of temperatures and have returned.
  const std::size_t letter = kLetters.find(type[0]);
  if (letter == std::string_view::npos) return kNoColour;
  const double step = step_of(letter, digit_of(type.substr(1)));
  // Types before A0 have a temperature, and those from A0 on an observed B-V.
  if (step < step_of(2, 0)) return static_cast<float>(interpolated(kTemperatures, step, true));
  return static_cast<float>(interpolated(kColours, step, false));
}

}  // namespace domefall
