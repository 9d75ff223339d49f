#include "pipeline/program/diagram/axis.h"

#include <fmt/core.h>

#include <array>
#include <cmath>

#include "pipeline/program/diagram/path.h"

namespace domefall {
namespace {

std::string general(double value) { return fmt::format("{:.6g}", value); }

std::string raised(int exponent) {
  static constexpr std::array kDigits{"\u2070", "\u00b9", "\u00b2", "\u00b3", "\u2074",
                                      "\u2075", "\u2076", "\u2077", "\u2078", "\u2079"};
  std::string out = exponent < 0 ? "\u207b" : "";
  for (const char c : fmt::format("{}", std::abs(exponent)))
    out += kDigits[static_cast<std::size_t>(c - '0')];
  return out;
}

std::vector<double> decade_marks(const Scale& scale, int count) {
  const int first = static_cast<int>(std::floor(std::log10(scale.from))),
            last = static_cast<int>(std::ceil(std::log10(scale.to)));
  const int every = std::max(1, (last - first + count - 1) / count);
  const bool between = (last - first) * 3 <= 2 * count;
  std::vector<double> marks;
  for (int k = first; k <= last; k += every)
    for (const double factor : {1.0, 2.0, 5.0})
      if (factor == 1 || between) {
        const double mark = factor * std::pow(10, k);
        if (mark >= scale.from * (1 - 1e-9) && mark <= scale.to * (1 + 1e-9)) marks.push_back(mark);
      }
  return marks;
}

}  // namespace

double Scale::operator()(double value) const {
  const double part =
      logarithmic ? std::log(value / from) / std::log(to / from) : (value - from) / (to - from);
  return at_from + part * (at_to - at_from);
}

std::vector<double> axis_marks(const Scale& scale, int count) {
  if (scale.logarithmic) return decade_marks(scale, count);
  const double step = round_step((scale.to - scale.from) / count);
  std::vector<double> marks;
  const auto first = static_cast<long>(std::ceil(scale.from / step - 1e-9));
  const auto last = static_cast<long>(std::floor(scale.to / step + 1e-9));
  for (long k = first; k <= last; ++k) marks.push_back(static_cast<double>(k) * step);
  return marks;
}

std::string number_text(double value) {
  const double size = std::abs(value);
  if (value < 0) return "\u2212" + number_text(size);
  if (size == 0 || (size < 0.99999e5 && size >= 0.99999e-3)) return general(value);
  const int exponent = static_cast<int>(std::floor(std::log10(size) + 1e-9));
  const std::string mantissa = general(value / std::pow(10, exponent));
  return fmt::format("{}10{}", mantissa == "1" ? "" : mantissa + "\u00d7", raised(exponent));
}

void draw_axes(Svg& page, const PageBox& box, const Scale& x, const Scale& y, int x_marks,
               int y_marks) {
  const Stroke grid{"#e3e6ec", 1};
  for (const double mark : axis_marks(x, x_marks)) {
    page.line({x(mark), box.top}, {x(mark), box.bottom}, grid);
    page.text({x(mark), box.bottom + 17}, number_text(mark), {12, "#5a606c", "middle"});
  }
  for (const double mark : axis_marks(y, y_marks)) {
    page.line({box.left, y(mark)}, {box.right, y(mark)}, grid);
    page.text({box.left - 7, y(mark) + 4}, number_text(mark), {12, "#5a606c", "end"});
  }
  page.frame(box, {"#8d94a1", 1});
}

}  // namespace domefall
