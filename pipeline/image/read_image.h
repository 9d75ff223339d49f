// Pictures and HEALPix maps that the user names.
#pragma once

#include <algorithm>
#include <array>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "pipeline/image/encode/display_colour.h"
#include "pipeline/image/frame_buffer.h"
#include "pipeline/image/image_formats.h"

namespace domefall {

// An InputImage is a picture that the user names.  It may be any of kPictureFormats, whatever the
// file is called.
class InputImage {
 public:
  // Reads the header.  Throws as RegularFile, and InputError naming the file if it is of another
  // format or damaged, has more than 32768 pixels a side, 32768 x 16384 pixels or 64 channels,
  // states more pixels than a file of its length can hold, or says of itself what cannot be obeyed.
  explicit InputImage(const std::filesystem::path& file,
                      PixelEncoding encoding = PixelEncoding::kOfFile);

  const ImageLayout& layout() const { return reader_->layout(); }
  // Calls `use(x, y, rgb)` for every pixel that is stored, with its place in the upright picture.
  // The rest of the picture is black.  Throws InputError naming the file.
  template <class Use>
  void each_pixel(Use use) const {
    const ImageLayout& l = layout();
    std::vector<float> rgb(3 * static_cast<std::size_t>(l.band) *
                           static_cast<std::size_t>(l.width));
    for (int first = 0; first < l.height; first += l.band) {
      const int end = std::min(first + l.band, l.height);
      read(first, end, rgb.data());
      const float* pixel = rgb.data();
      for (int y = first; y < end; ++y)
        for (int x = 0; x < l.width; ++x, pixel += 3)
          if (const auto place = l.place.of(x, y)) use(place->first, place->second, pixel);
    }
  }
  // Says what was taken as what, and of alpha what has been read (ImageReader::taken).
  std::string taken() const { return reader_->taken(); }
  // Throws InputError naming the file and the pixel, which the message counts from 1 instead of 0.
  [[noreturn]] void fail_not_finite(int x, int y) const;

 private:
  void read(int first, int end, float* rgb) const;

  std::filesystem::path file_;
  std::unique_ptr<ImageReader> reader_;
};

struct PictureLight {
  FloatImage pixels;           // linear RGB
  std::array<double, 8> xy{};  // of that RGB: CIE x, y of red, green, blue and white
};

// Returns the light of a picture, as its file says that it is encoded; integers that say nothing
// are sRGB, and floats are linear.  It is upright, of the size of the display window, black outside
// of the data window, and over black where it is transparent.  Grey is spread to RGB.  Throws as
// InputImage, and InputError naming the file if it cannot be read to its end or holds a pixel that
// is not finite.
PictureLight read_image(const std::filesystem::path& file);

// Says what of a picture is taken as what, for people, such as "layer ViewLayer.Combined, 4096 x
// 2048, linear (floats), primaries ACEScg (chromaticities)".  Throws as read_image.  Pixels are
// read only for their alpha.
std::string picture_taken(const std::filesystem::path& file);

// A LightImage is a large picture, held as half floats.  A panorama of 16384 x 8192 takes 0.8 GB.
// Colours are linear RGB, and a pixel's value is `unit` times its half.
struct LightImage {
  ImageRgb<Imath::half> pixels;
  double unit = 1;
  // CIE x, y of red, green, blue and white of that RGB.
  std::array<double, 8> xy = kRec709Places;
  std::string taken = {};  // what of the file was taken as what, for people
};

// Reads a file of a format and size that InputImage takes, by bands of rows or tiles, as
// read_image().  What is negative becomes 0.  Throws as InputImage, and InputError naming the file
// if it cannot be read to its end, holds a pixel that is not finite, or has negative values and
// none above 0.
LightImage read_light_image(const std::filesystem::path& file, PixelEncoding encoding);

// An all-sky map in the HEALPix pixelisation (Gorski et al. 2005, ApJ 622, 759).
struct HealpixFile {
  int nside = 1;              // a power of two
  bool nested = false;        // else RING
  std::string coordinates;    // letters of COORDSYS in capitals; empty where there is none
  std::string units;          // TUNITn as written; empty where there is none
  std::vector<float> values;  // 12 nside^2; bad pixels are NaN
};

// Reads from a FITS file column `column` (from 1) of the first binary table that is a HEALPix map, within the first
// 100 extensions of a file, which may be packed by gzip.  The column has floats or integers, one
// pixel or many in a row.  In a map that lists its pixels (INDXSCHM EXPLICIT) the columns are
// counted behind that of their numbers, and other pixels are bad.  NSIDE is 8192 at most; without
// the keyword, the number of pixels tells it.  Throws as RegularFile, and InputError naming the
// file for anything that is wrong in it.
HealpixFile read_healpix(const std::filesystem::path& path, int column);

// `least` and `most` are of a file's values, and 0.  Throws InputError naming the file where
// nothing exceeds 0 and something is below it, as after a subtraction or in the logarithm: the sky
// would be black without a word.  All zeros are black because somebody wanted it so.
void check_light(const std::filesystem::path& file, double least, double most);

}  // namespace domefall
