// The layers of a frame, which divide its light by where it comes from, for compositors.
//
// Premultiplied and scene-linear, they make the picture again, to the rounding of its halves:
//
//     picture = titles + (1 - titles.A) (sky + stars + disc + bodies)
//
// Sky and stars hold the light that is left behind the disc, so that this is true of the mean of
// several instants and of a mixture of two views, too.  The alpha of the disc says how much it hides.
#pragma once

#include <array>
#include <cstddef>
#include <string_view>
#include <vector>

#include "pipeline/image/frame_buffer.h"

namespace domefall {

enum class Layer { kSky, kStars, kDisc, kBodies, kTitles };

struct LayerKind {
  std::string_view name;  // of its channels, NAME.R
  bool has_alpha;         // whether it can hide what is behind it
};
// In the order of the enumeration, which is that of drawing.
inline constexpr std::array<LayerKind, 5> kLayers{
    {{"sky", false}, {"stars", false}, {"disc", true}, {"bodies", true}, {"titles", true}}};

static_assert(kLayers.size() == static_cast<std::size_t>(Layer::kTitles) + 1);

inline const LayerKind& kind_of(Layer layer) { return kLayers[static_cast<std::size_t>(layer)]; }

template <class T>
struct LayerImage {
  Layer layer;
  ImageRgb<T> light{};
  // [height][width], or empty without one.  It is in full precision, since what is left behind it
  // may be bright.
  std::vector<float> alpha{};
};

// A LayeredFrame is a picture and those of its layers that are asked for, each once, in the order of
// drawing.
template <class T>
struct LayeredFrame {
  ImageRgb<T> picture;
  std::vector<LayerImage<T>> layers;
  std::vector<T> alpha;  // 1 where the projection shows anything; empty without layers

  LayeredFrame() = default;
  explicit LayeredFrame(const std::vector<Layer>& asked) {
    for (const Layer layer : asked) layers.push_back({layer});
  }

  // Gives all of them one size.  Memory of that size is kept as it is.
  void set_size(int width, int height) {
    const auto resize = [&](ImageRgb<T>& image) {
      if (image.width != width || image.height != height) image = ImageRgb<T>(width, height);
    };
    const auto pixels = static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
    resize(picture);
    if (!layers.empty()) alpha.resize(pixels);
    for (LayerImage<T>& image : layers) {
      resize(image.light);
      if (kind_of(image.layer).has_alpha) image.alpha.resize(pixels);
    }
  }

  // Returns the image of a layer, or null where it is not asked for.
  LayerImage<T>* find(Layer layer) {
    for (LayerImage<T>& image : layers)
      if (image.layer == layer) return &image;
    return nullptr;
  }

  // Calls use(values) with the values of the picture and of each layer's light, or of each layer's
  // alpha, always in one order.
  template <class Use>
  void each_light(const Use& use) {
    use(picture.pixels);
    for (LayerImage<T>& image : layers) use(image.light.pixels);
  }
  template <class Use>
  void each_alpha(const Use& use) {
    for (LayerImage<T>& image : layers)
      if (!image.alpha.empty()) use(image.alpha);
  }
};

using LayeredHalfFrame = LayeredFrame<Imath::half>;
using LayeredFloatFrame = LayeredFrame<float>;

}  // namespace domefall
