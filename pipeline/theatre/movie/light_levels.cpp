#include "pipeline/theatre/movie/light_levels.h"

#include <algorithm>
#include <cstddef>
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

void take_levels(const GradedFrame& frame, LightLevels& levels) {
  const std::vector<double>& lights = light_of_codes();
  double sum = 0;
  unsigned short brightest = 0;
  for (std::size_t k = 0; k + 2 < frame.pixels.size(); k += 3) {
    const unsigned short most =
        std::max({frame.pixels[k], frame.pixels[k + 1], frame.pixels[k + 2]});
    brightest = std::max(brightest, most);
    sum += lights[most];
  }
  const std::size_t pixels = frame.pixels.size() / 3;
  levels.content = std::max(levels.content, lights[brightest]);
  levels.frame_average = std::max(levels.frame_average, sum / static_cast<double>(pixels));
}

}  // namespace domefall
