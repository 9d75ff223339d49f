#include "pipeline/sky/read_sky.h"

#include <algorithm>
#include <cstdint>
#include <utility>

#include "pipeline/image/digest.h"
#include "pipeline/image/errors.h"
#include "pipeline/image/read_image.h"
#include "pipeline/image/some_light.h"
#include "pipeline/sky/make/panorama.h"
#include "pipeline/sky/maps/sky_file.h"

namespace domefall {
namespace {

FloatImage read_panorama(const std::filesystem::path& file) {
  FloatImage image = read_image(file);
  if (image.width < 4 || image.height < 2 || image.width != 2 * image.height)
    throw InputError(
        file.string() + ": a panorama is twice as wide as high, at least 4 x 2 pixels; " +
        "this one is " + std::to_string(image.width) + " x " + std::to_string(image.height));
  const auto [least, most] = std::minmax_element(image.pixels.begin(), image.pixels.end());
  check_light(file, *least, *most);
  return image;
}

// A smaller file is read to its end in a moment, and damage told before it is in a picture; of a larger
// one only what is looked at is to be read.
constexpr std::uintmax_t kReadWhole = std::uintmax_t{256} << 20;

}  // namespace

std::shared_ptr<const SkyMap> read_sky(const std::filesystem::path& file) {
  if (is_sky_file(file)) {
    SkyFile opened = open_sky_file(file);
    if (std::filesystem::file_size(file) <= kReadWhole) verify_sky_file(file);
    return std::make_shared<const SkyMap>(std::move(opened.map));
  }
  return std::make_shared<const SkyMap>(map_of_panorama(read_panorama(file)));
}

std::string sky_digest(const std::filesystem::path& file) {
  if (is_sky_file(file)) return "sky " + sky_file_digest(file);
  return Digest().add_file(file).hex();
}

}  // namespace domefall
