#include "pipeline/sky/read_sky.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <utility>

#include "pipeline/image/digest.h"
#include "pipeline/image/errors.h"
#include "pipeline/image/read_image.h"
#include "pipeline/image/some_light.h"
#include "pipeline/sky/make/import_sky.h"
#include "pipeline/sky/make/panorama.h"
#include "pipeline/sky/maps/sky_file.h"

namespace domefall {
namespace {

// Returns the image of a panorama, and throws InputError unless it is a whole sphere with some
// light.  Interpolation needs two rows at least (panorama.cpp).
FloatImage read_panorama(const std::filesystem::path& file) {
  FloatImage image = read_image(file);
  if (image.width < 4 || image.height < 2 || image.width != 2 * image.height)
    throw InputError(fmt::format(
        "{}: a panorama is twice as wide as high, at least 4 x 2 pixels; this one is {} x {}",
        file.string(), image.width, image.height));
  const auto [least, most] = std::minmax_element(image.pixels.begin(), image.pixels.end());
  check_light(file, *least, *most);
  return image;
}

// A .sky file up to this size is verified when it is opened, which takes a moment.  A larger one is
// not, because only the parts that are sampled should be read.
constexpr std::uint64_t kReadWhole = std::uint64_t{256} << 20;

// The line never comes first in the text, because import_sky() writes the source before it.
bool is_microwave_background(const SkyOrigin& origin) {
  return origin.text.find(std::string("\n") + kMicrowaveBackground) != std::string::npos;
}

}  // namespace

BackgroundMap read_sky(const std::filesystem::path& file, int largest_face) {
  if (is_sky_file(file)) {
    const SkyFile opened(file);
    // Only the levels that are kept are verified.
    if (opened.bytes() <= kReadWhole) opened.verify(largest_face);
    return {std::make_shared<const SkyMap>(opened.map().without_levels_above(largest_face)),
            is_microwave_background(opened.origin())};
  }
  return {std::make_shared<const SkyMap>(map_of_panorama(read_panorama(file), largest_face))};
}

void try_sky(const std::filesystem::path& file) {
  if (is_sky_file(file))
    read_sky(file);
  else
    read_panorama(file);
}

// The header of a .sky file holds the checksums of all faces, and an image is read as a whole.
std::string sky_digest(const std::filesystem::path& file) {
  if (is_sky_file(file)) return "sky " + SkyFile(file).digest();
  return Digest().add_file(file).hex();
}

}  // namespace domefall
