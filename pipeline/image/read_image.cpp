#include "pipeline/image/read_image.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <system_error>

#include "pipeline/base/errors.h"
#include "pipeline/base/regular_file.h"
#include "pipeline/base/unpacked_file.h"
#include "pipeline/image/image_formats.h"

namespace domefall {
namespace {

// Calls step(), and puts the file's name before the reasons of the library, which lack it.
template <class Step>
auto named(const std::filesystem::path& file, const char* what, Step step) {
  try {
    return step();
  } catch (const InputError&) {
    throw;
  } catch (const TemporaryError&) {
    throw;
  } catch (const std::system_error& error) {  // of threads that it may not start
    throw TemporaryError(file.string() + ": " + what + ": " + error.what());
  } catch (const std::runtime_error& error) {
    throw InputError(file.string() + ": " + what + ": " + error.what());
  }
}

constexpr int kLargestExponent = 14;  // of a half, with one to spare

// Integers and halves fit in halves as they are, but of floats the greatest has to be known.
double unit_for(const InputImage& in) {
  if (!in.layout().may_exceed_half) return 1;
  float greatest = 0;
  in.each_pixel([&](int x, int y, const float* rgb) {
    for (int c = 0; c < 3; ++c) {
      if (!std::isfinite(rgb[c])) in.fail_not_finite(x, y);
      greatest = std::max(greatest, rgb[c]);
    }
  });
  return greatest > 0 ? std::ldexp(1.0, std::ilogb(greatest) - kLargestExponent) : 1;
}

}  // namespace

// The sides are exchanged where rows are stored as columns.
std::optional<std::pair<int, int>> PicturePlace::of(int x, int y) const {
  const bool lies = orientation > 4;
  const std::int64_t w = lies ? height : width, h = lies ? width : height;
  const std::int64_t left_x = left + x, top_y = top + y;
  if (left_x < 0 || left_x >= w || top_y < 0 || top_y >= h) return std::nullopt;
  const bool from_right =
      orientation == 2 || orientation == 3 || orientation == 7 || orientation == 8;
  const bool from_below =
      orientation == 3 || orientation == 4 || orientation == 6 || orientation == 7;
  const auto across = static_cast<int>(from_right ? w - 1 - left_x : left_x),
             down = static_cast<int>(from_below ? h - 1 - top_y : top_y);
  return lies ? std::pair{down, across} : std::pair{across, down};
}

InputImage::InputImage(const std::filesystem::path& file, PixelEncoding encoding) : file_(file) {
  const ImageFormats& formats = image_formats();
  reader_ = named(file, "the image cannot be read", [&] { return formats.open(file, encoding); });
}

void InputImage::read(int first, int end, float* rgb) const {
  named(file_, "the image cannot be read to its end", [&] { reader_->read(first, end, rgb); });
}

void InputImage::fail_not_finite(int x, int y) const {
  throw InputError(
      fmt::format("{}: pixel ({}, {}) is not a finite number", file_.string(), x + 1, y + 1));
}

PictureLight read_image(const std::filesystem::path& file) {
  const InputImage in(file);
  const PicturePlace& place = in.layout().place;
  PictureLight light{{place.width, place.height}, in.layout().xy};
  in.each_pixel([&](int x, int y, const float* rgb) {
    for (int c = 0; c < 3; ++c)
      if (!std::isfinite(rgb[c])) in.fail_not_finite(x, y);
    std::copy_n(rgb, 3, light.pixels.row(y) + 3 * x);
  });
  return light;
}

std::string picture_taken(const std::filesystem::path& file) {
  const InputImage in(file);
  if (in.layout().has_alpha) in.each_pixel([](int, int, const float*) {});
  return in.taken();
}

LightImage read_light_image(const std::filesystem::path& file, PixelEncoding encoding) {
  const InputImage in(file, encoding);
  const PicturePlace& place = in.layout().place;
  LightImage image{{place.width, place.height}, unit_for(in), in.layout().xy, ""};
  const auto scale = static_cast<float>(1 / image.unit);
  float least = 0, most = 0;  // of the light
  // The file is read a second time, since keeping the floats would take twice the memory of the
  // result.
  in.each_pixel([&](int x, int y, const float* rgb) {
    Imath::half* out = image.pixels.row(y) + 3 * x;
    for (int c = 0; c < 3; ++c) {
      const float light = rgb[c] * scale;
      least = std::min(least, rgb[c]), most = std::max(most, rgb[c]);
      out[c] = std::max(light, 0.0f);
      if (!std::isfinite(light) || !out[c].isFinite()) in.fail_not_finite(x, y);
    }
  });
  check_light(file, least, most);
  image.taken = in.taken();
  return image;
}

HealpixFile read_healpix(const std::filesystem::path& path, int column) {
  if (!is_gzip(start_of_file(path, 2))) return image_formats().read_healpix(path, {}, column);
  return image_formats().read_healpix(path, unpacked(MappedFile(path).bytes(), path), column);
}

void check_light(const std::filesystem::path& file, double least, double most) {
  if (most > 0 || !(least < 0)) return;
  throw InputError(
      fmt::format("{}: there is no light in it: no value exceeds 0, and they go down to {:.4g}",
                  file.string(), least));
}

}  // namespace domefall
