#include "pipeline/grade/dome_light.h"

#include <algorithm>
#include <numbers>
#include <utility>

#include "projections/projection.h"

namespace domefall {

namespace {

// Returns sin(theta)/theta in s = theta^2, which a pixel's area on the dome is proportional to.
// The terms that are left out are below 5e-10 up to theta = pi/2, less than a float rounds.
float sine_over_angle(float s) {
  constexpr float k1 = 1 / 6.0f, k2 = 1 / 20.0f, k3 = 1 / 42.0f, k4 = 1 / 72.0f, k5 = 1 / 110.0f,
                  k6 = 1 / 156.0f;
  return 1 - s * k1 * (1 - s * k2 * (1 - s * k3 * (1 - s * k4 * (1 - s * k5 * (1 - s * k6)))));
}

constexpr float kAreaUnits = 1 << 20;  // of a pixel in the middle

// The left half of a row is the mirror image of the right one.
void pixel_areas(int size, int row, ColumnRange range, std::uint32_t* areas) {
  const double scale = std::numbers::pi / size, middle = (size - 1) / 2.0;
  const auto y2 = static_cast<float>((row - middle) * scale * (row - middle) * scale);
  const auto step = static_cast<float>(scale), first = static_cast<float>(range.first - middle);
  const int count = range.last - range.first + 1;
  for (int k = 0; k < (count + 1) / 2; ++k) {
    const float x = (first + static_cast<float>(k)) * step;
    // To add 1/2 and cut rounds a positive number.  Unlike lround, it lets the loop become SIMD
    // code.
    const float rounded = kAreaUnits * sine_over_angle(x * x + y2) + 0.5f;
    const auto area = static_cast<std::int32_t>(rounded);
    areas[k] = areas[count - 1 - k] = static_cast<std::uint32_t>(area);
  }
}

// Above is the mean of max(light - c, 0) over the dome, and the part of the dome where that is not
// 0.
struct Above {
  double mean = 0, part = 0;
};
Above above(const DomeCodes& dome, int channel, const std::vector<double>& curve, double c) {
  Above sum;
  for (int code = 0; code < kCodes; ++code) {
    const double light = curve[static_cast<std::size_t>(code)] - c;
    if (!(light > 0)) continue;
    const auto area = static_cast<double>(dome.area(channel, code));
    sum.mean += area * light;
    sum.part += area;
  }
  const auto whole = static_cast<double>(std::max<std::uint64_t>(dome.whole(), 1));
  return {sum.mean / whole, sum.part / whole};
}

// Returns the root of c = k mean(c) by Newton's method from c = 0.  The mean is convex and falls,
// so each step stays below the root.  The mean is a straight line between two codes' light, so the
// root is reached when no further code falls below c.
double compensation(const DomeCodes& dome, int channel, const std::vector<double>& curve,
                    double k) {
  double c = 0;
  for (int step = 0; step < 100; ++step) {
    const Above left = above(dome, channel, curve, c);
    const double more = (k * left.mean - c) / (1 + k * left.part);
    if (!(more > 1e-12 * c)) break;
    c += more;
  }
  return c;
}

// Returns the code whose light is nearest to each code's own plus `more`.
std::vector<unsigned short> shifted_codes(const std::vector<double>& curve, double more) {
  std::vector<unsigned short> codes(kCodes);
  std::size_t at = 0;
  for (std::size_t code = 0; code < codes.size(); ++code) {
    const double light = curve[code] + more;
    while (at + 1 < codes.size() && curve[at + 1] <= light) ++at;
    const bool next = at + 1 < codes.size() && curve[at + 1] - light < light - curve[at];
    codes[code] = static_cast<unsigned short>(next ? at + 1 : at);
  }
  return codes;
}

}  // namespace

void DomeCodes::add_rows(const GradedFrame& frame, int y0, int y1) {
  const Domemaster dome{frame.width};
  std::vector<std::uint32_t> areas(static_cast<std::size_t>(frame.width));
  std::uint64_t* const red = areas_.data();
  for (int y = y0; y < y1; ++y) {
    const ColumnRange range = inside_columns(dome, y);
    if (range.first > range.last) continue;
    pixel_areas(frame.width, y, range, areas.data());
    const unsigned short* rgb = frame.row(y) + 3 * range.first;
    const int count = range.last - range.first + 1;
    for (int k = 0; k < count; ++k, rgb += 3) {
      const std::uint64_t area = areas[static_cast<std::size_t>(k)];
      red[rgb[0]] += area;
      red[kCodes + rgb[1]] += area;
      red[2 * kCodes + rgb[2]] += area;
      whole_ += area;
    }
  }
}

void DomeCodes::add(const DomeCodes& other) {
  for (std::size_t k = 0; k < areas_.size(); ++k) areas_[k] += other.areas_[k];
  whole_ += other.whole_;
}

void CodeMap::change(unsigned short* rgb, std::ptrdiff_t pixels) const {
  const unsigned short *red = codes[0].data(), *green = codes[1].data(), *blue = codes[2].data();
  for (std::ptrdiff_t k = 0; k < pixels; ++k, rgb += 3) {
    rgb[0] = red[rgb[0]];
    rgb[1] = green[rgb[1]];
    rgb[2] = blue[rgb[2]];
  }
}

void CodeMap::change_rows(GradedFrame& frame, int y0, int y1) const {
  for (int y = y0; y < y1; ++y) {
    const ColumnRange range = inside_columns(Domemaster{frame.width}, y);
    if (range.first <= range.last)
      change(frame.row(y) + 3 * range.first, range.last - range.first + 1);
  }
}

DomeLight::DomeLight(const DomeSettings& settings, Curves curves)
    : settings_(settings), curves_(std::move(curves)) {}

std::array<double, 3> DomeLight::change_for(const DomeCodes& dome) const {
  const double k = bounced_part(settings_.reflectance);
  std::array<double, 3> change{};
  for (std::size_t c = 0; c < 3; ++c) {
    const int channel = static_cast<int>(c);
    const std::vector<double>& curve = curves_[c];
    change[c] = settings_.light == DomeSettings::Light::kSimulate
                    ? k * above(dome, channel, curve, 0).mean
                    : -compensation(dome, channel, curve, k);
  }
  return change;
}

CodeMap DomeLight::map_for(const DomeCodes& dome) const {
  const std::array<double, 3> change = change_for(dome);
  CodeMap map;
  for (std::size_t c = 0; c < 3; ++c) map.codes[c] = shifted_codes(curves_[c], change[c]);
  return map;
}

}  // namespace domefall
