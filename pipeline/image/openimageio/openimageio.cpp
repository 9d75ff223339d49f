// This is the library that pipeline/image/image_formats.cpp loads.  It reads image files by
// OpenImageIO, and HEALPix maps by CFITSIO.

#include <OpenImageIO/imageio.h>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <mutex>
#include <stdexcept>
#include <utility>

#include "pipeline/base/regular_file.h"
#include "pipeline/image/image_formats.h"
#include "pipeline/image/openimageio/exr_layers.h"
#include "pipeline/image/openimageio/healpix_fits.h"
#include "pipeline/image/openimageio/picture_claims.h"
#include "pipeline/image/openimageio/picture_colour.h"
#include "pipeline/image/openimageio/picture_format.h"

namespace domefall {
namespace {

constexpr int kBand = 64;                      // rows read at once of a file without tiles
constexpr std::size_t kHeaderBytes = 1 << 20;  // within which a header states the size

// When OpenImageIO 2.4 first meets an ICC profile, it fills a table.  Another thread that opens a
// file meanwhile reads the table half-filled, and the program ends by SIGSEGV.
std::mutex one_opens;

void read_rows(OIIO::ImageInput& in, const OIIO::ImageSpec& s, int part, std::pair<int, int> rows,
               int first, int count, float* values, std::size_t step) {
  const auto pixel = static_cast<OIIO::stride_t>(step * sizeof(float));
  const int top = s.y + rows.first, end = s.y + rows.second;
  const bool done =
      s.tile_height > 0
          ? in.read_tiles(part, 0, s.x, s.x + s.width, top, end, s.z, s.z + 1, first, first + count,
                          OIIO::TypeDesc::FLOAT, values, pixel, pixel * s.width)
          : in.read_scanlines(part, 0, top, end, s.z, first, first + count, OIIO::TypeDesc::FLOAT,
                              values, pixel, pixel * s.width);
  if (!done) throw std::runtime_error(in.geterror());
}

ImageLayout stored_layout(const OIIO::ImageSpec& s) {
  ImageLayout layout;
  layout.width = s.width, layout.height = s.height, layout.channels = s.nchannels;
  layout.band = std::min(s.tile_height > 0 ? s.tile_height : kBand, s.height);
  layout.description = std::string(s.get_string_attribute("ImageDescription"));
  layout.place.width = s.width, layout.place.height = s.height;
  return layout;
}

class CodeReader : public ImageReader {
 public:
  explicit CodeReader(std::unique_ptr<OIIO::ImageInput> in)
      : in_(std::move(in)), layout_(stored_layout(in_->spec())) {}

  const ImageLayout& layout() const override { return layout_; }
  std::string taken() const override { return "codes as they are stored"; }

  void read(int first, int end, float* rgb) override {
    const bool grey = layout_.channels < 3;
    read_rows(*in_, in_->spec(), 0, {first, end}, 0, grey ? 1 : 3, rgb, 3);
    const auto floats =
        3 * static_cast<std::size_t>(layout_.width) * static_cast<std::size_t>(end - first);
    for (std::size_t k = 0; grey && k < floats; k += 3) rgb[k + 1] = rgb[k + 2] = rgb[k];
  }

  void read(unsigned short* rgb) override {
    if (!in_->read_image(0, 0, 0, 3, OIIO::TypeDesc::UINT16, rgb))
      throw std::runtime_error(in_->geterror());
  }

 private:
  std::unique_ptr<OIIO::ImageInput> in_;
  ImageLayout layout_;
};

// A ChosenPicture is what is read of a file, and how.
struct ChosenPicture {
  OIIO::ImageSpec spec;  // of its part
  PictureChannels channels;
  PictureColour colour;
  PicturePlace place;
  std::vector<std::string> words;  // that come before those of its colour, for people
  std::vector<std::string> notes;  // and after them
  bool must_be_opaque = false;
};

class LightReader : public ImageReader {
 public:
  LightReader(std::unique_ptr<OIIO::ImageInput> in, ChosenPicture picture)
      : in_(std::move(in)), picture_(std::move(picture)), layout_(stored_layout(picture_.spec)) {
    const auto& [red, green, blue] = picture_.channels.rgb;
    channels_ = {red};
    if (green != red) channels_.insert(channels_.end(), {green, blue});
    layout_.has_alpha = picture_.channels.alpha >= 0;
    if (layout_.has_alpha) channels_.push_back(picture_.channels.alpha);
    layout_.place = picture_.place;
    layout_.xy = picture_.colour.xy();
    // A half that is taken as it is cannot.
    layout_.may_exceed_half =
        picture_.spec.format.is_floating_point() &&
        !(picture_.spec.channelformat(red) == OIIO::TypeDesc::HALF && picture_.colour.is_plain());
  }

  const ImageLayout& layout() const override { return layout_; }

  std::string taken() const override {
    std::vector<std::string> words = picture_.words;
    for (const auto& more : {picture_.colour.words(), picture_.notes})
      words.insert(words.end(), more.begin(), more.end());
    if (is_transparent_) words.emplace_back("transparent in parts, over black");
    return fmt::format("{}", fmt::join(words, ", "));
  }

  void read(int first, int end, float* rgb) override {
    const std::size_t pixels =
        static_cast<std::size_t>(layout_.width) * static_cast<std::size_t>(end - first);
    const std::size_t step = channels_.size();
    samples_.resize(pixels * step);
    // Neighbouring channels are read at once.
    for (std::size_t k = 0; k < step;) {
      std::size_t next = k + 1;
      while (next < step && channels_[next] == channels_[next - 1] + 1) ++next;
      read_rows(*in_, picture_.spec, picture_.channels.part, {first, end}, channels_[k],
                static_cast<int>(next - k), samples_.data() + k, step);
      k = next;
    }
    if (layout_.has_alpha) look_at_alpha();
    picture_.colour.light(samples_.data(), pixels, layout_.has_alpha, rgb);
  }

  void read(unsigned short*) override { throw std::logic_error("light has no codes"); }

 private:
  void look_at_alpha() {
    const std::size_t step = channels_.size();
    for (std::size_t k = step - 1; k < samples_.size() && !is_transparent_; k += step)
      is_transparent_ = samples_[k] < 1;
    // What OpenImageIO makes of a WebP's colours under alpha differs from version to version.
    if (is_transparent_ && picture_.must_be_opaque)
      throw std::runtime_error(
          "the picture is transparent in parts, which is not read of WebP; "
          "save it as PNG");
  }

  std::unique_ptr<OIIO::ImageInput> in_;
  ChosenPicture picture_;
  ImageLayout layout_;
  std::vector<int> channels_;
  std::vector<float> samples_;
  bool is_transparent_ = false;
};

// Returns the display window of OpenEXR, and of TIFF where Pixar's tags state one, as the place of
// what is stored.  The other formats have none, whatever offset on a page they may state.
PicturePlace place_of(std::string_view format, const OIIO::ImageSpec& s, int orientation) {
  PicturePlace place{s.width, s.height, 0, 0, orientation};
  if (format == "openexr" || format == "tiff") {
    place.width = s.full_width, place.height = s.full_height;
    place.left = std::int64_t{s.x} - s.full_x, place.top = std::int64_t{s.y} - s.full_y;
    if (place.left >= place.width || place.top >= place.height || place.left + s.width <= 0 ||
        place.top + s.height <= 0)
      throw std::runtime_error("its data window lies wholly outside of its display window");
  }
  if (orientation > 4) std::swap(place.width, place.height);
  return place;
}

std::vector<std::string> words_of_place(const PictureChannels& channels, const OIIO::ImageSpec& s,
                                        const PicturePlace& place) {
  std::vector<std::string> words;
  if (!channels.layer.empty()) words.push_back("layer " + short_name(channels.layer));
  if (!channels.view.empty()) words.push_back("view " + short_name(channels.view));
  words.push_back(fmt::format("{} x {}", place.width, place.height));
  const bool lies = place.orientation > 4;
  if (place.left != 0 || place.top != 0 || s.width != (lies ? place.height : place.width) ||
      s.height != (lies ? place.width : place.height))
    words.push_back(
        fmt::format("data window {} x {} at {}, {}", s.width, s.height, place.left, place.top));
  if (place.orientation != 1)
    words.push_back(fmt::format("turned upright (orientation {})", place.orientation));
  return words;
}

// The channels of a file that has no layers.
PictureChannels plain_channels(const OIIO::ImageSpec& s, PictureClaims& claims,
                               std::string_view format) {
  PictureChannels channels;
  const bool grey = claims.colours ? claims.colours == 1 : s.nchannels < 3;
  if (grey) channels.rgb.fill(0);
  if (format == "tiff") {
    channels.alpha = claims.alpha_channel < s.nchannels ? claims.alpha_channel : -1;
  } else if (s.alpha_channel >= (grey ? 1 : 3)) {
    channels.alpha = s.alpha_channel, claims.alpha = Alpha::kUnassociated;
  }
  const int used = (grey ? 1 : 3) + (channels.alpha >= 0 ? 1 : 0);
  if (s.nchannels > used)
    claims.notes.push_back(fmt::format("{} more channel{} not used", s.nchannels - used,
                                       s.nchannels - used == 1 ? "" : "s"));
  return channels;
}

std::vector<OIIO::ImageSpec> parts_of(OIIO::ImageInput& in) {
  constexpr int kMostParts = 256;
  std::vector<OIIO::ImageSpec> parts;
  for (int k = 0; in.seek_subimage(k, 0); ++k) {
    if (k == kMostParts) throw std::runtime_error("it has more than 256 parts");
    parts.push_back(in.spec());
  }
  // Past the last, an error is pending.
  (void)in.geterror();
  return parts;
}

std::string profile_of(const OIIO::ImageSpec& s, const PictureClaims& claims) {
  if (!claims.profile.empty()) return claims.profile;
  const OIIO::ParamValue* stated = s.find_attribute("ICCProfile");
  if (!stated || stated->type().basesize() != 1) return {};
  return {static_cast<const char*>(stated->data()), static_cast<std::size_t>(stated->datasize())};
}

ChosenPicture choose_picture(OIIO::ImageInput& in, std::string_view format, PictureClaims claims,
                             PixelEncoding encoding, std::uint64_t file_bytes) {
  OIIO::ImageSpec spec = in.spec();
  PictureChannels channels;
  if (format == "openexr") {
    const auto parts = parts_of(in);
    for (const OIIO::ImageSpec& part : parts)
      if (!part.deep) check_picture(format, part, file_bytes);
    channels = picture_channels(parts);
    spec = parts[static_cast<std::size_t>(channels.part)];
    claims = exr_claims(spec);
  } else {
    check_picture(format, spec, file_bytes);
    channels = plain_channels(spec, claims, format);
  }
  const PicturePlace place = place_of(format, spec, claims.orientation);
  check_side(place.width, place.height);
  const bool floating = spec.channelformat(channels.rgb[0]).is_floating_point();
  const float aspect = spec.get_float_attribute("PixelAspectRatio", 1);
  if (std::abs(aspect - 1) > 0.01f)
    claims.notes.push_back(fmt::format("its pixel aspect ratio of {:g} is not used", aspect));
  const int colours = channels.rgb[0] == channels.rgb[1] ? 1 : 3;
  return {spec,
          channels,
          PictureColour(claims, profile_of(spec, claims), encoding, floating, colours),
          place,
          words_of_place(channels, spec, place),
          claims.notes,
          format == "webp"};
}

class LoadedFormats : public ImageFormats {
 public:
  std::unique_ptr<ImageReader> open(const std::filesystem::path& file,
                                    PixelEncoding encoding) const override {
    RegularFile opened(file);
    std::string start(kHeaderBytes, '\0');
    start.resize(opened.read(start.data(), start.size()));
    const std::string format(picture_format(start));
    if (format.empty())
      throw std::runtime_error(fmt::format("by its first bytes it is not {}", kPictureFormats));
    if (const auto size = stated_size(format, start))
      check_size(size->width, size->height, format, "", opened.size());
    if (format == "openexr") check_exr_header(start, opened.size());
    const bool codes = encoding == PixelEncoding::kStored;
    const PictureClaims claims = codes ? PictureClaims() : picture_claims(format, opened, file);
    auto in = OIIO::ImageInput::create(format);
    // An error that nobody takes is printed when the program ends.
    if (!in) throw std::runtime_error(OIIO::geterror());
    OIIO::ImageSpec spec, wishes;
    wishes.attribute("oiio:UnassociatedAlpha", 1);  // alpha is multiplied in once values are light
    {
      const std::lock_guard lock(one_opens);
      if (!in->open(file.string(), spec, wishes)) throw std::runtime_error(in->geterror());
    }
    if (codes) {
      check_picture(format, spec, opened.size());
      return std::make_unique<CodeReader>(std::move(in));
    }
    ChosenPicture picture = choose_picture(*in, format, claims, encoding, opened.size());
    return std::make_unique<LightReader>(std::move(in), std::move(picture));
  }

  HealpixFile read_healpix(const std::filesystem::path& path, std::string_view unpacked,
                           int column) const override {
    return read_healpix_fits(path, unpacked, column);
  }
};

}  // namespace
}  // namespace domefall

extern "C" [[gnu::visibility("default")]] const domefall::Interface* domefall_openimageio() {
  static const domefall::LoadedFormats formats;
  return &formats;
}
