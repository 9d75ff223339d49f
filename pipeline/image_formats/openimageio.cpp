// This is the library that pipeline/image/image_formats.cpp loads.  It reads image files by
// OpenImageIO, and HEALPix maps by CFITSIO.

#include <OpenImageIO/imageio.h>
#include <fmt/core.h>

#include <algorithm>
#include <mutex>
#include <stdexcept>

#include "pipeline/image/image_formats.h"
#include "pipeline/image/regular_file.h"
#include "pipeline/image_formats/healpix_fits.h"
#include "pipeline/image_formats/picture_bounds.h"
#include "pipeline/image_formats/picture_format.h"

namespace domefall {
namespace {

constexpr int kBand = 64;                      // rows read at once of a file without tiles
constexpr std::size_t kHeaderBytes = 1 << 20;  // within which a header states the size

SampleType sample_type(const OIIO::TypeDesc& type) {
  if (type == OIIO::TypeDesc::UINT16) return SampleType::kUint16;
  if (!type.is_floating_point()) return SampleType::kOtherInteger;
  return type == OIIO::TypeDesc::HALF ? SampleType::kHalf : SampleType::kFloat;
}

// When OpenImageIO 2.4 first meets an ICC profile, it fills a table.  Another thread that opens a
// file meanwhile reads the table half-filled, and the program ends by SIGSEGV.
std::mutex one_opens;

class Reader : public ImageReader {
 public:
  explicit Reader(std::unique_ptr<OIIO::ImageInput> in) : in_(std::move(in)) {
    const OIIO::ImageSpec& s = in_->spec();
    layout_ = {s.width,
               s.height,
               s.nchannels,
               sample_type(s.format),
               std::min(s.tile_height > 0 ? s.tile_height : kBand, s.height),
               std::string(s.get_string_attribute("ImageDescription"))};
  }

  const ImageLayout& layout() const override { return layout_; }

  void read(int first, int end, float* rgb) override {
    const OIIO::ImageSpec& s = in_->spec();
    const int used = s.nchannels >= 3 ? 3 : 1;
    const OIIO::stride_t pixel = 3 * sizeof(float);
    const bool done =
        s.tile_height > 0
            ? in_->read_tiles(0, 0, s.x, s.x + s.width, s.y + first, s.y + end, s.z, s.z + 1, 0,
                              used, OIIO::TypeDesc::FLOAT, rgb, pixel, pixel * s.width)
            : in_->read_scanlines(0, 0, s.y + first, s.y + end, s.z, 0, used, OIIO::TypeDesc::FLOAT,
                                  rgb, pixel, pixel * s.width);
    if (!done) throw std::runtime_error(in_->geterror());
    if (used == 3) return;
    const auto floats =
        3 * static_cast<std::size_t>(s.width) * static_cast<std::size_t>(end - first);
    for (std::size_t k = 0; k < floats; k += 3) rgb[k + 1] = rgb[k + 2] = rgb[k];
  }

  void read(unsigned short* rgb) override {
    if (!in_->read_image(0, 0, 0, 3, OIIO::TypeDesc::UINT16, rgb))
      throw std::runtime_error(in_->geterror());
  }

 private:
  std::unique_ptr<OIIO::ImageInput> in_;
  ImageLayout layout_;
};

class LoadedFormats : public ImageFormats {
 public:
  std::unique_ptr<ImageReader> open(const std::filesystem::path& file) const override {
    RegularFile opened(file);
    std::string start(kHeaderBytes, '\0');
    start.resize(opened.read(start.data(), start.size()));
    const std::string format(picture_format(start));
    if (format.empty())
      throw std::runtime_error(fmt::format("by its first bytes it is not {}", kPictureFormats));
    if (const auto size = stated_size(format, start))
      check_size(size->width, size->height, format, "", opened.size());
    if (format == "openexr" && !exr_attributes_fit(start, opened.size()))
      throw std::runtime_error("the file ends within its header, or the header is wrong");
    auto in = OIIO::ImageInput::create(format);
    // An error that nobody takes is printed when the program ends.
    if (!in) throw std::runtime_error(OIIO::geterror());
    OIIO::ImageSpec spec;
    {
      const std::lock_guard lock(one_opens);
      if (!in->open(file.string(), spec)) throw std::runtime_error(in->geterror());
    }
    check_picture(format, spec, opened.size());
    return std::make_unique<Reader>(std::move(in));
  }

  HealpixFile read_healpix(const std::filesystem::path& path, int column) const override {
    return read_healpix_fits(path, column);
  }
};

}  // namespace
}  // namespace domefall

extern "C" const domefall::Interface* domefall_image_formats() {
  static const domefall::LoadedFormats formats;
  return &formats;
}
