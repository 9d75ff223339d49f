#include "pipeline/theatre/movie/light_levels.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

#include "pipeline/image/encode/display_colour.h"

namespace domefall {
namespace {

const std::vector<double>& light_of_codes() {
  static const std::vector<double> lights = [] {
    constexpr std::size_t kCodes = 65536;
    std::vector<double> all(kCodes);
    for (std::size_t code = 0; code < kCodes; ++code)
      all[code] = pq_light(static_cast<double>(code) / (kCodes - 1));
    return all;
  }();
  return lights;
}

}  // namespace

FrameLevels::FrameLevels(int width, int height)
    : width_(static_cast<std::size_t>(width)), rows_(static_cast<std::size_t>(height)) {}

void FrameLevels::take(int first, int end, const unsigned short* rgb) {
  const std::vector<double>& lights = light_of_codes();
  for (int row = first; row < end; ++row) {
    Row& taken = rows_[static_cast<std::size_t>(row)];
    for (std::size_t k = 0; k < width_; ++k, rgb += 3) {
      const unsigned short most = std::max({rgb[0], rgb[1], rgb[2]});
      taken.brightest = std::max(taken.brightest, most);
      taken.sum += lights[most];
    }
  }
}

// The rows are added in their order, so that the mean does not depend on threads.
void FrameLevels::add_to(LightLevels& levels) const {
  double sum = 0;
  unsigned short brightest = 0;
  for (const Row& row : rows_) {
    sum += row.sum;
    brightest = std::max(brightest, row.brightest);
  }
  levels.content = std::max(levels.content, light_of_codes()[brightest]);
  levels.frame_average = std::max(
      levels.frame_average, sum / static_cast<double>(width_) / static_cast<double>(rows_.size()));
}

std::optional<MasteringDisplay> mastering_display(const Grader& grader) {
  const std::optional<DisplayColour>& colour = grader.colour();
  if (!colour || colour->curve != DisplayColour::Curve::kPq) return std::nullopt;
  HalfFrame white(1, 1);
  std::ranges::fill(white.pixels, std::numeric_limits<Imath::half>::max());
  const std::vector<unsigned short> codes = grader.grade(white).pixels;
  return MasteringDisplay{colour->xy, std::round(light_of_codes()[std::ranges::max(codes)])};
}

}  // namespace domefall
