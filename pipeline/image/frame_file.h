// Rendered frames on the disk are scene-linear OpenEXR, with channels R, G, B of half floats or
// floats, lossless, and with A and the channels of layers and data where they are asked for.  The
// header says what the pixels are (chromaticities of ACEScg, colorSpace), which frame of which show this is (the fields of FrameInfo) and what the digest of the file is
// (frame_check.h).  It says neither when nor where the frame was made, so the same frame has the
// same bytes, whatever the machine and the number of threads.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "pipeline/image/encode/exr_writer.h"
#include "pipeline/image/frame_buffer.h"
#include "pipeline/image/layer.h"

namespace domefall {

struct FrameInfo {
  std::string title{};     // of the show
  std::string show{};      // digest of what all frames of this version of the show share
  std::string key{};       // digest of everything that decides this frame, hexadecimal
  int frame = 0;           // number in the show, from 0
  std::string region{};    // of the observer: I, II, ...
  double r = 0;            // of the observer, M
  double proper_time = 0;  // of the observer, M
  double frames_per_second = 0;
  std::string projection{};
  std::string software{};
  std::string owner{};  // whose the picture is; empty: nothing is said
  // These lead from a world to the camera that made the picture and, where straight lines stay
  // straight, to places in it, both by the rules of the OpenEXR attributes of these names.
  std::optional<ExrMatrix> world_to_camera{}, world_to_ndc{};
  double pixel_aspect = 1;  // width of a pixel over its height
};

// Sets how many threads share the packing and unpacking of one file.  With 0 (the start) the
// caller's thread does it alone.  The bytes are the same.
void set_file_threads(int threads);

// FrameData are numbers of 32 bits about the pixels of a frame, and what the header says of them.
struct FrameData {
  std::vector<const ChannelImage*> images{};  // of the frame's size; not null
  std::vector<std::pair<std::string, std::string>> attributes{};
  bool without_layers = false;  // which are in files of their own
};

// Returns the bytes of a pixel in the files that the next two functions write, without compression.
template <class T>
std::size_t pixel_bytes(const LayeredFrame<T>& frame, const FrameData& data);
template <class T>
std::size_t pixel_bytes(const LayerImage<T>& layer);

// Writes a frame under its final name when it is complete.  T is Imath::half or float.  Throws as
// TemporaryFile does.
template <class T>
void write_frame(const std::filesystem::path& path, const LayeredFrame<T>& frame,
                 const FrameInfo& info, ExrCompression compression = ExrCompression::kZip,
                 const FrameData& data = {});
template <class T>
void write_frame(const std::filesystem::path& path, const ImageRgb<T>& picture,
                 const FrameInfo& info, ExrCompression compression = ExrCompression::kZip);

// Writes a layer likewise, as a picture R, G, B, with A where the layer has one.
template <class T>
void write_layer(const std::filesystem::path& path, const LayerImage<T>& layer,
                 const FrameInfo& info, ExrCompression compression);

// Writes a picture of other channels in the same way, as 32-bit floats with a header without
// colours.
void write_channels(const std::filesystem::path& path, const ChannelImage& image,
                    const FrameInfo& info);

// Reads back the picture of a frame that write_frame wrote, without its layers.  Floats become
// halves as by half_frame().  Nothing is decoded unless the digest of the file is right.  Throws InputError, which names the file, if it
// is missing, damaged or was not written by write_frame, and throws as FileBytes::open.
std::pair<HalfFrame, FrameInfo> read_frame(const std::filesystem::path& path);

}  // namespace domefall
