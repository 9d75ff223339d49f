#include "pipeline/image/image_formats.h"

namespace domefall {

// The library stays for good, since OpenImageIO keeps threads.
const ImageFormats& image_formats() {
  static const auto& loaded = late_library<ImageFormats>("domefall_image_formats", "reads images");
  return loaded;
}

}  // namespace domefall
