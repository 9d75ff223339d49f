#include "pipeline/image/frame_file.h"

#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfDoubleAttribute.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfInputFile.h>
#include <OpenEXR/ImfIntAttribute.h>
#include <OpenEXR/ImfStringAttribute.h>
#include <OpenEXR/ImfThreading.h>
#include <OpenEXR/ImfTimeCode.h>
#include <fmt/format.h>

#include <optional>
#include <vector>

#include "pipeline/base/errors.h"
#include "pipeline/base/frame_rate.h"
#include "pipeline/base/new_file.h"
#include "pipeline/base/side_by_side.h"
#include "pipeline/image/encode/exr_writer.h"
#include "pipeline/image/frame_check.h"
#include "pipeline/image/frame_head.h"

namespace domefall {
namespace {

// These are the AP1 primaries of ACEScg and the ACES white (Academy S-2014-004).
constexpr ExrChromaticities kAcesCg{
    {0.713f, 0.293f, 0.165f, 0.830f, 0.128f, 0.044f, 0.32168f, 0.33767f}};
constexpr const char *kShow = "showDigest", *kFrame = "frameNumber",
                     *kRegionAttribute = "observerRegion", *kRadius = "observerRadius",
                     *kProperTime = "observerProperTime", *kRate = "showFramesPerSecond",
                     *kOwner = "owner";

template <class T>
Imf::FrameBuffer buffer_of(ImageRgb<T>& frame, Imf::PixelType type) {
  Imf::FrameBuffer buffer;
  const std::size_t pixel = 3 * sizeof(T);
  auto* base = reinterpret_cast<char*>(frame.pixels.data());
  const char* names[] = {"R", "G", "B"};
  for (std::size_t c = 0; c < 3; ++c)
    buffer.insert(names[c], Imf::Slice(type, base + c * sizeof(T), pixel,
                                       pixel * static_cast<std::size_t>(frame.width)));
  return buffer;
}

// Returns a time code for the rates that SMPTE ST 12-1 counts by whole frames, or from above 30 on
// by pairs of them, of which the second has the mark of a second field.  Frames of other rates bear
// none.
std::optional<ExrTimeCode> time_code(const FrameInfo& info) {
  const auto rate = static_cast<int>(info.frames_per_second);
  constexpr int kFastest = 30, kMinute = 60, kHour = 60, kDay = 24;
  const int counted = rate > kFastest ? 2 : 1;
  if (rate < 1 || rate > 2 * kFastest || rate % counted != 0 || rate != info.frames_per_second)
    return std::nullopt;
  const int seconds = info.frame / rate, minutes = seconds / kMinute, frame = info.frame % rate;
  Imf::TimeCode code(minutes / kHour % kDay, minutes % kHour, seconds % kMinute, frame / counted);
  code.setFieldPhase(frame % counted == 1);
  // OpenEXR's library reads and writes the attribute in its default packing, at any rate.
  return ExrTimeCode{code.timeAndFlags()};
}

std::vector<std::pair<std::string, ExrValue>> attributes_of(const FrameInfo& info) {
  std::vector<std::pair<std::string, ExrValue>> all{
      {kExrTitle, info.title},
      {kShow, info.show},
      {kExrKey, info.key},
      {kFrame, info.frame},
      {kRegionAttribute, info.region},
      {kRadius, info.r},
      {kProperTime, info.proper_time},
      {kRate, info.frames_per_second},
      {kExrProjection, info.projection},
      {"software", info.software},
      {kExrDigest, std::string(kBlankDigest)},
  };
  if (info.frames_per_second > 0) {
    const FrameRate rate = frame_rate_of(info.frames_per_second);
    all.emplace_back("framesPerSecond", ExrRational{static_cast<int>(rate.frames),
                                                    static_cast<unsigned>(rate.seconds)});
  }
  if (const auto code = time_code(info)) all.emplace_back("timeCode", *code);
  if (!info.owner.empty()) all.emplace_back(kOwner, info.owner);
  if (info.world_to_camera) all.emplace_back("worldToCamera", *info.world_to_camera);
  if (info.world_to_ndc) all.emplace_back("worldToNDC", *info.world_to_ndc);
  return all;
}

template <class Attribute, class Value>
void read_attribute(const Imf::Header& header, const char* name, Value& value) {
  const auto* attribute = header.findTypedAttribute<Attribute>(name);
  if (!attribute) throw std::runtime_error(std::string("it has no attribute ") + name);
  value = attribute->value();
}

FrameInfo info_of(const Imf::Header& header) {
  FrameInfo info;
  read_attribute<Imf::StringAttribute>(header, kExrTitle, info.title);
  read_attribute<Imf::StringAttribute>(header, kShow, info.show);
  read_attribute<Imf::StringAttribute>(header, kExrKey, info.key);
  read_attribute<Imf::IntAttribute>(header, kFrame, info.frame);
  read_attribute<Imf::StringAttribute>(header, kRegionAttribute, info.region);
  read_attribute<Imf::DoubleAttribute>(header, kRadius, info.r);
  read_attribute<Imf::DoubleAttribute>(header, kProperTime, info.proper_time);
  read_attribute<Imf::DoubleAttribute>(header, kRate, info.frames_per_second);
  read_attribute<Imf::StringAttribute>(header, kExrProjection, info.projection);
  read_attribute<Imf::StringAttribute>(header, "software", info.software);
  info.pixel_aspect = header.pixelAspectRatio();
  if (const auto* owner = header.findTypedAttribute<Imf::StringAttribute>(kOwner))
    info.owner = owner->value();
  return info;
}

// Returns the type of the colours.  Throws std::runtime_error for a layout that no frame has.
Imf::PixelType check_layout(const Imf::Header& header) {
  const auto& box = header.dataWindow();
  if (box.min != Imath::V2i(0) || box != header.displayWindow())
    throw std::runtime_error("its windows are not those of a frame");
  const Imf::Channel* red = header.channels().findChannel("R");
  for (const char* name : {"R", "G", "B"}) {
    const Imf::Channel* channel = header.channels().findChannel(name);
    if (!channel || channel->type != red->type || channel->type == Imf::UINT ||
        channel->xSampling != 1 || channel->ySampling != 1)
      throw std::runtime_error("it has no floats R, G, B");
  }
  return red->type;
}

// Decodes the pixels.  Throws std::exception of some kind for anything that is wrong with the file.
std::pair<HalfFrame, FrameInfo> decode(const std::filesystem::path& path) {
  Imf::InputFile file(path.c_str(), Imf::globalThreadCount());
  const Imf::Header& header = file.header();
  const Imf::PixelType type = check_layout(header);
  FrameInfo info = info_of(header);
  const Imath::V2i size = header.dataWindow().max + Imath::V2i(1);
  const auto pixels = [&]<class T>(ImageRgb<T> frame) {
    file.setFrameBuffer(buffer_of(frame, type));
    file.readPixels(0, size.y - 1);
    return frame;
  };
  if (type == Imf::FLOAT) return {half_frame(pixels(FloatImage(size.x, size.y))), std::move(info)};
  return {pixels(HalfFrame(size.x, size.y)), std::move(info)};
}

void write_sealed(const std::filesystem::path& path, const ExrPicture& picture) {
  NewFile made(path);
  write_exr(made, picture);
  seal_frame(made);
  made.commit();
}

const std::vector<std::string> kColours{"R", "G", "B"};

template <class T>
std::vector<ExrChannel> channels_of(const ImageRgb<T>& picture) {
  return interleaved(kColours, picture.pixels.empty() ? nullptr : picture.pixels.data());
}

template <class T>
std::vector<ExrChannel> channels_of(const LayerImage<T>& layer) {
  std::vector<ExrChannel> channels = channels_of(layer.light);
  const float* const alpha = layer.alpha.empty() ? nullptr : layer.alpha.data();
  if (kind_of(layer.layer).has_alpha) channels.push_back({"A", alpha});
  return channels;
}

template <class T>
std::vector<ExrChannel> channels_of(const LayeredFrame<T>& frame, bool without_layers) {
  std::vector<ExrChannel> channels = channels_of(frame.picture);
  if (!frame.alpha.empty()) channels.push_back({"A", frame.alpha.data()});
  for (const LayerImage<T>& layer : frame.layers) {
    if (without_layers) break;
    for (ExrChannel channel : channels_of(layer)) {
      channel.name = fmt::format("{}.{}", kind_of(layer.layer).name, channel.name);
      channels.push_back(std::move(channel));
    }
  }
  for (const Matte& matte : frame.mattes)
    channels.push_back({matte.name + ".A", matte.covered.data()});
  return channels;
}

template <class T>
std::vector<ExrChannel> channels_of(const LayeredFrame<T>& frame, const FrameData& data) {
  std::vector<ExrChannel> channels = channels_of(frame, data.without_layers);
  for (const ChannelImage* image : data.images)
    for (ExrChannel& channel : interleaved(image->channels, image->pixels.data()))
      channels.push_back(std::move(channel));
  return channels;
}

std::size_t bytes_of(const std::vector<ExrChannel>& channels) {
  std::size_t bytes = 0;
  for (const ExrChannel& channel : channels)
    bytes += std::visit([](const auto* numbers) { return sizeof(*numbers); }, channel.numbers);
  return bytes;
}

void write_colours(const std::filesystem::path& path, int width, int height,
                   std::vector<ExrChannel> channels, const FrameInfo& info,
                   ExrCompression compression, const FrameData& data = {}) {
  ExrPicture picture{
      width, height, std::move(channels), compression, attributes_of(info), info.pixel_aspect};
  picture.attributes.insert(picture.attributes.end(), data.attributes.begin(),
                            data.attributes.end());
  const std::pair<std::string, ExrValue> colours[] = {{"chromaticities", kAcesCg},
                                                      {"colorSpace", "ACEScg"}};
  picture.attributes.insert(picture.attributes.begin(), std::begin(colours), std::end(colours));
  write_sealed(path, picture);
}

}  // namespace

void set_file_threads(int threads) {
  Imf::setGlobalThreadCount(threads);
  set_encoder_threads(threads);
}

template <class T>
std::size_t pixel_bytes(const LayeredFrame<T>& frame, const FrameData& data) {
  return bytes_of(channels_of(frame, data));
}

template <class T>
std::size_t pixel_bytes(const LayerImage<T>& layer) {
  return bytes_of(channels_of(layer));
}

template <class T>
void write_frame(const std::filesystem::path& path, const LayeredFrame<T>& frame,
                 const FrameInfo& info, ExrCompression compression, const FrameData& data) {
  write_colours(path, frame.picture.width, frame.picture.height, channels_of(frame, data), info,
                compression, data);
}

template <class T>
void write_layer(const std::filesystem::path& path, const LayerImage<T>& layer,
                 const FrameInfo& info, ExrCompression compression) {
  write_colours(path, layer.light.width, layer.light.height, channels_of(layer), info, compression);
}

template <class T>
void write_frame(const std::filesystem::path& path, const ImageRgb<T>& picture,
                 const FrameInfo& info, ExrCompression compression) {
  write_colours(path, picture.width, picture.height, channels_of(picture), info, compression);
}

template std::size_t pixel_bytes(const LayeredHalfFrame&, const FrameData&);
template std::size_t pixel_bytes(const LayeredFloatFrame&, const FrameData&);
template std::size_t pixel_bytes(const LayerImage<Imath::half>&);
template std::size_t pixel_bytes(const LayerImage<float>&);
template void write_frame(const std::filesystem::path&, const LayeredHalfFrame&, const FrameInfo&,
                          ExrCompression, const FrameData&);
template void write_frame(const std::filesystem::path&, const LayeredFloatFrame&, const FrameInfo&,
                          ExrCompression, const FrameData&);
template void write_layer(const std::filesystem::path&, const LayerImage<Imath::half>&,
                          const FrameInfo&, ExrCompression);
template void write_layer(const std::filesystem::path&, const LayerImage<float>&, const FrameInfo&,
                          ExrCompression);
template void write_frame(const std::filesystem::path&, const HalfFrame&, const FrameInfo&,
                          ExrCompression);
template void write_frame(const std::filesystem::path&, const FloatImage&, const FrameInfo&,
                          ExrCompression);

void write_channels(const std::filesystem::path& path, const ChannelImage& image,
                    const FrameInfo& info) {
  write_sealed(path, {image.width, image.height, interleaved(image.channels, image.pixels.data()),
                      ExrCompression::kZip, attributes_of(info), info.pixel_aspect});
}

std::pair<HalfFrame, FrameInfo> read_frame(const std::filesystem::path& path) {
  if (!is_whole(path))
    throw InputError(path.string() + ": not a frame that can be used: missing or damaged");
  try {
    return decode(path);
  } catch (const std::bad_alloc&) {
    throw;
  } catch (const std::exception& error) {
    throw InputError(path.string() + ": not a frame that can be used: " + error.what());
  }
}

}  // namespace domefall
