#include "pipeline/image/read_image.h"

#include <algorithm>
#include <cmath>

#include "pipeline/image/input_image.h"

namespace domefall {

FloatImage read_image(const std::filesystem::path& file) {
  const InputImage in(file);
  const ImageLayout& layout = in.layout();
  FloatImage image(layout.width, layout.height);
  in.read(0, layout.height, image.pixels.data());
  if (!is_floating_point(layout.samples))
    std::transform(image.pixels.begin(), image.pixels.end(), image.pixels.begin(),
                   linear_from_srgb);
  for (int y = 0; y < image.height; ++y)
    for (int k = 0; k < 3 * image.width; ++k)
      if (!std::isfinite(image.row(y)[k])) in.fail_not_finite(k / 3, y);
  return image;
}

}  // namespace domefall
