// The library that image_formats.cpp loads: image files by OpenImageIO, HEALPix maps by CFITSIO.

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>
#include <fmt/core.h>

#include <algorithm>
#include <stdexcept>

#include "pipeline/image/image_formats.h"
#include "pipeline/image/regular_file.h"
#include "pipeline/image_formats/healpix_fits.h"
#include "pipeline/image_formats/picture_bounds.h"
#include "pipeline/image_formats/picture_format.h"

namespace domefall {
namespace {

constexpr int kBand = 64;                // rows read at once of a file without tiles
constexpr std::size_t kStart = 1 << 20;  // bytes in which a header states the size

SampleType sample_type(const OIIO::TypeDesc& type) {
  if (type == OIIO::TypeDesc::UINT16) return SampleType::kUint16;
  if (!type.is_floating_point()) return SampleType::kOtherInteger;
  return type == OIIO::TypeDesc::HALF ? SampleType::kHalf : SampleType::kFloat;
}

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

class Sink : public OIIO::Filesystem::IOProxy {
 public:
  explicit Sink(ImageSink& sink) : IOProxy("", Write), sink_(sink) {}

  const char* proxytype() const override { return "ImageSink"; }
  int64_t tell() override { return static_cast<int64_t>(sink_.position()); }
  bool seek(int64_t offset) override {
    sink_.seek(static_cast<std::uint64_t>(offset));
    return true;
  }
  size_t write(const void* bytes, size_t count) override {
    sink_.write({static_cast<const char*>(bytes), count});
    return count;
  }
  size_t size() const override { return sink_.size(); }

 private:
  ImageSink& sink_;
};

OIIO::ImageSpec spec_of(int width, int height, const std::string& description) {
  OIIO::ImageSpec spec(width, height, 3, OIIO::TypeDesc::UINT16);
  spec.attribute("ImageDescription", description);
  // Measured on a 4k frame with stars, the PNG filter SUB: 0.9 s and 36 MB, where libpng's choice
  // of filters at its usual level 6 takes 3.6 s for 32 MB; TIFF 0.8 s and 35 MB.
  spec.attribute("png:compressionLevel", 1);
  spec.attribute("png:filter", 16);
  spec.attribute("compression", "zip");
  spec.attribute("tiff:zipquality", 1);
  // Or the TIFF writer puts in the time of writing, and every file is different.
  spec.attribute("DateTime", "1970:01:01 00:00:00");
  return spec;
}

class Writer : public ImageWriter {
 public:
  Writer(const std::filesystem::path& file, ImageSink& sink, const OIIO::ImageSpec& spec)
      : sink_(sink), out_(OIIO::ImageOutput::create(file.string(), &sink_)) {
    if (!out_) throw std::runtime_error(OIIO::geterror());
    check(out_->open(file.string(), spec));
  }

  void write(const unsigned short* rgb, int count) override {
    check(out_->write_scanlines(row_, row_ + count, 0, OIIO::TypeDesc::UINT16, rgb));
    row_ += count;
  }

  void close() override { check(out_->close()); }

 private:
  void check(bool done) const {
    if (!done) throw std::runtime_error(out_->geterror());
  }

  Sink sink_;
  std::unique_ptr<OIIO::ImageOutput> out_;
  int row_ = 0;
};

class LoadedFormats : public ImageFormats {
 public:
  std::unique_ptr<ImageReader> open(const std::filesystem::path& file) const override {
    RegularFile opened(file);
    std::string start(kStart, '\0');
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
    if (!in->open(file.string(), spec)) throw std::runtime_error(in->geterror());
    check_picture(format, spec, opened.size());
    return std::make_unique<Reader>(std::move(in));
  }

  std::unique_ptr<ImageWriter> create(const std::filesystem::path& file, ImageSink& sink, int width,
                                      int height, const std::string& description) const override {
    return std::make_unique<Writer>(file, sink, spec_of(width, height, description));
  }

  HealpixFile read_healpix(const std::filesystem::path& path, int column) const override {
    return read_healpix_fits(path, column);
  }
};

}  // namespace
}  // namespace domefall

extern "C" const domefall::ImageFormats* domefall_image_formats() {
  static const domefall::LoadedFormats formats;
  return &formats;
}
