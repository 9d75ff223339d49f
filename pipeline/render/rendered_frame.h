// A RenderedFrame is a frame in the precisions that the files of a show ask for.
#pragma once

#include <optional>

#include "pipeline/image/frame_file.h"
#include "pipeline/render/frame_mattes.h"
#include "pipeline/render/lens_map.h"
#include "pipeline/show/frame_state.h"

namespace domefall {

struct RenderedFrame {
  explicit RenderedFrame(const Show& show) {
    if (!show.output.linear) return;
    if (keeps_floats(show))
      full = LayeredFloatFrame(show.output.layers, mattes_of(show));
    else
      half = LayeredHalfFrame(show.output.layers, mattes_of(show));
  }

  // Says whether the show's scene-linear files are of floats.
  static bool keeps_floats(const Show& show) {
    return show.output.linear && show.output.linear->pixels == ExrPixels::kFloat;
  }

  LayeredHalfFrame half;   // its picture is graded
  LayeredFloatFrame full;  // in full precision, where the show's scene-linear files are of floats
  std::optional<ChannelImage> lens;
  std::optional<Cryptomatte> cryptomatte;
};

// Renders a frame by any renderer of both kinds, into memory that is used again.
template <class AnyRenderer>
void render_for_files(AnyRenderer& renderer, const Show& show, const FrameState& state,
                      RenderedFrame& frame) {
  const bool floats = RenderedFrame::keeps_floats(show);
  if (floats) {
    renderer.render(state, frame.full);
    frame.half.picture = half_frame(frame.full.picture);
  } else {
    renderer.render(state, frame.half);
  }
  if (!show.output.linear) return;
  if (show.output.data.lens) frame.lens = make_lens_map(show, state, renderer.threads());
  if (show.output.data.cryptomatte)
    frame.cryptomatte = identities(show, state, floats ? frame.full.mattes : frame.half.mattes);
}

// Returns what the scene-linear file has beside the frame's light.
inline FrameData data_of(const Show& show, const RenderedFrame& frame) {
  FrameData data{.without_layers = show.output.layer_files};
  if (frame.lens) data.images.push_back(&*frame.lens);
  if (frame.cryptomatte) {
    data.images.push_back(&frame.cryptomatte->image());
    data.attributes = frame.cryptomatte->attributes();
  }
  return data;
}

// Returns the bytes of a pixel in all scene-linear files of a frame, without compression: those of a
// frame of one pixel.
inline std::size_t linear_pixel_bytes(const Show& show) {
  if (!show.output.linear) return 0;
  RenderedFrame frame(show);
  if (show.output.data.lens) frame.lens = ChannelImage(1, 1, lens_channel_names());
  if (show.output.data.cryptomatte) frame.cryptomatte = Cryptomatte(1, 1, objects_of(show));
  const auto bytes_of = [&](auto& light) {
    light.set_size(1, 1);
    std::size_t bytes = pixel_bytes(light, data_of(show, frame));
    for (const auto& layer : light.layers)
      if (show.output.layer_files) bytes += pixel_bytes(layer);
    return bytes;
  };
  return RenderedFrame::keeps_floats(show) ? bytes_of(frame.full) : bytes_of(frame.half);
}

// Writes the scene-linear file of a show that has one, but for layers that have files of their own.
// Throws as write_frame.
inline void write_linear(const std::filesystem::path& path, const Show& show,
                         const RenderedFrame& frame, const FrameInfo& info) {
  const FrameData data = data_of(show, frame);
  const ExrCompression compression = show.output.linear->compression;
  if (RenderedFrame::keeps_floats(show))
    write_frame(path, frame.full, info, compression, data);
  else
    write_frame(path, frame.half, info, compression, data);
}

// Writes the file of a layer that the show asks for.  Throws as write_frame.
inline void write_layer_of(const std::filesystem::path& path, const Show& show, Layer layer,
                           RenderedFrame& frame, const FrameInfo& info) {
  const ExrCompression compression = show.output.linear->compression;
  if (RenderedFrame::keeps_floats(show))
    write_layer(path, *frame.full.find(layer), info, compression);
  else
    write_layer(path, *frame.half.find(layer), info, compression);
}

}  // namespace domefall
