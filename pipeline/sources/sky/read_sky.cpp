#include "pipeline/sources/sky/read_sky.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>

#include "pipeline/base/digest.h"
#include "pipeline/base/errors.h"
#include "pipeline/image/read_image.h"
#include "pipeline/sources/sky/import_sky.h"
#include "pipeline/sources/sky/panorama.h"
#include "pipeline/sources/sky/sky_file.h"

namespace domefall {
namespace {

// Returns the image of a panorama, and throws InputError unless it is a whole sphere with some
// light.  Interpolation needs two rows at least (panorama.cpp).
PictureLight read_panorama(const std::filesystem::path& file) {
  PictureLight light = read_image(file);
  const FloatImage& image = light.pixels;
  if (image.width < 4 || image.height < 2 || image.width != 2 * image.height)
    throw InputError(fmt::format(
        "{}: a panorama is twice as wide as high, at least 4 x 2 pixels; this one is {} x {}",
        file.string(), image.width, image.height));
  const auto [least, most] = std::minmax_element(image.pixels.begin(), image.pixels.end());
  check_light(file, *least, *most);
  return light;
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
  const PictureLight light = read_panorama(file);
  return {std::make_shared<const SkyMap>(
      map_of_panorama(light.pixels, largest_face, working_from_rgb(light.xy)))};
}

void try_sky(const std::filesystem::path& file) {
  if (is_sky_file(file))
    read_sky(file);
  else
    read_panorama(file);
}

// This is raised with every change of what pictures are taken for.
constexpr int kPictureVersion = 2;

// The header of a .sky file holds the checksums of all faces, and an image is read as a whole.
std::string sky_digest(const std::filesystem::path& file) {
  if (is_sky_file(file)) return "sky " + SkyFile(file).digest();
  return Digest().add("picture").add(kPictureVersion).add_file(file).hex();
}

}  // namespace domefall
