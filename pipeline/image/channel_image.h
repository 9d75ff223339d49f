// A ChannelImage is a picture whose channels are not colours.
#pragma once

#include <cstddef>
#include <string>
#include <utility>
#include <vector>

namespace domefall {

// Pixels are in rows from the top, with the channels of each side by side.
struct ChannelImage {
  int width = 0, height = 0;
  std::vector<std::string> channels;  // their names; a layer's are LAYER.CHANNEL
  std::vector<float> pixels;          // [height][width][channels.size()]

  ChannelImage() = default;
  ChannelImage(int w, int h, std::vector<std::string> names)
      : width(w),
        height(h),
        channels(std::move(names)),
        pixels(static_cast<std::size_t>(w) * static_cast<std::size_t>(h) * channels.size()) {}

  float* pixel(int x, int y) {
    const auto place =
        static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x);
    return pixels.data() + place * channels.size();
  }
  const float* pixel(int x, int y) const { return const_cast<ChannelImage*>(this)->pixel(x, y); }
};

}  // namespace domefall
