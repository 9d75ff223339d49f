#include "pipeline/image/tiff_file.h"

namespace domefall {

std::unique_ptr<TiffFile> begin_tiff(ByteSink& sink, const TiffLayout& layout) {
  static const auto& files = late_library<TiffFiles>("domefall_libtiff_file", "writes TIFF files");
  return files.begin(sink, layout);
}

}  // namespace domefall
