// Frames that are put together from images: of the faces of a cubemap, and of parts of pixels.
#pragma once

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cstddef>

#include "pipeline/image/layer.h"
#include "projections/projection.h"

namespace domefall {

// Calls use(from, to, channels) for each plane of an image and that of a frame with the same layers.
template <class T, class Use>
void each_plane(const LayeredFrame<T>& image, LayeredFrame<T>& frame, const Use& use) {
  use(image.picture.pixels, frame.picture.pixels, 3);
  for (std::size_t k = 0; k < frame.layers.size(); ++k) {
    use(image.layers[k].light.pixels, frame.layers[k].light.pixels, 3);
    use(image.layers[k].alpha, frame.layers[k].alpha, 1);
  }
  for (std::size_t k = 0; k < frame.mattes.size(); ++k)
    use(image.mattes[k].covered, frame.mattes[k].covered, 1);
}

// Puts the image of a face into the frame of a cubemap.
template <class T>
void put(const LayeredFrame<T>& image, const CubemapFace& face, LayeredFrame<T>& frame) {
  each_plane(image, frame, [&](const auto& from, auto& to, int channels) {
    // A layer may be empty on one face and not on another.
    if (from.empty() && to.empty()) return;
    const std::ptrdiff_t width = std::ptrdiff_t{channels} * image.picture.width,
                         stride = std::ptrdiff_t{channels} * frame.picture.width;
    to.resize(static_cast<std::size_t>(stride * frame.picture.height));
    for (int row = 0; row < image.picture.height; ++row) {
      const auto at =
          to.begin() + (face.row + row) * stride + std::ptrdiff_t{channels} * face.column;
      if (from.empty())
        std::fill_n(at, width, 0.0f);
      else
        std::copy_n(from.begin() + row * width, width, at);
    }
  });
}

// Makes each pixel of a frame the mean of its parts, which are the pixels of an image.  A pixel
// whose middle is not shown is black, as in any frame.
template <class T>
void put_means(const LayeredFrame<T>& image, const PixelParts& parts, const Projection& projection,
               LayeredFrame<T>& frame) {
  const float share = 1 / static_cast<float>(parts.across * parts.down);
  const int width = frame.picture.width;
  each_plane(image, frame, [&](const auto& from, auto& to, int channels) {
    // A layer may be empty now that was not in the frame before.
    if (from.empty()) return to.clear();
    to.resize(static_cast<std::size_t>(std::ptrdiff_t{width} * channels * frame.picture.height));
    tbb::parallel_for(0, frame.picture.height, [&](int row) {
      const ColumnRange inside = inside_columns(projection, row);
      auto out = to.begin() + std::ptrdiff_t{row} * width * channels;
      std::fill_n(out, width * channels, 0.0f);
      for (int column = inside.first; column <= inside.last; ++column)
        for (int c = 0; c < channels; ++c) {
          float sum = 0;
          for (int down = 0; down < parts.down; ++down)
            for (int across = 0; across < parts.across; ++across)
              sum += from[static_cast<std::size_t>(
                  ((std::ptrdiff_t{row} * parts.down + down) * image.picture.width +
                   std::ptrdiff_t{column} * parts.across + across) *
                      channels +
                  c)];
          out[column * channels + c] = share * sum;
        }
    });
  });
}

}  // namespace domefall
