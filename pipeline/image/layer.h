// The layers of a frame, which divide its light by where it comes from, for compositors.
//
// Premultiplied and scene-linear, they make the picture again, to the rounding of its halves:
//
//     picture = titles + (1 - titles.A) (sky + stars + disc + bodies + glare)
//
// Sky and stars hold the light that is left behind the disc, so that this is true of the mean of
// several instants and of a mixture of two views, too.  The alpha of the disc says how much it hides.
#pragma once

#include <array>
#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "pipeline/image/frame_buffer.h"

namespace domefall {

enum class Layer { kSky, kStars, kDisc, kBodies, kGlare, kTitles };

struct LayerKind {
  std::string_view name;  // of its channels, NAME.R
  bool has_alpha;         // whether it can hide what is behind it
};
// In the order of the enumeration, which is that of drawing.
inline constexpr std::array<LayerKind, 6> kLayers{{{"sky", false},
                                                   {"stars", false},
                                                   {"disc", true},
                                                   {"bodies", true},
                                                   {"glare", false},
                                                   {"titles", true}}};

static_assert(kLayers.size() == static_cast<std::size_t>(Layer::kTitles) + 1);

inline const LayerKind& kind_of(Layer layer) { return kLayers[static_cast<std::size_t>(layer)]; }

// What is 0 everywhere takes no memory: a light in which nothing is drawn has a size but no pixels,
// and an alpha that hides nothing is empty.
template <class T>
struct LayerImage {
  Layer layer;
  ImageRgb<T> light{};
  // [height][width].  It is in full precision, since what is left behind it may be bright.
  std::vector<float> alpha{};

  // Lets light be drawn, on black where nothing is drawn yet, and lets it hide what is behind it.
  void add_pixels(bool hides) {
    const auto pixels =
        static_cast<std::size_t>(light.width) * static_cast<std::size_t>(light.height);
    light.pixels.resize(3 * pixels);
    if (hides) alpha.resize(pixels);
  }
  void remove_pixels() {
    light.pixels.clear();
    alpha.clear();
  }
};

// A Matte says how much of each pixel belongs to what it is named after.
struct Matte {
  std::string name;              // of its layer, NAME.A
  std::vector<float> covered{};  // [height][width], 0 to 1
};

// A LayeredFrame is a picture with those of its layers that are asked for, each once in the order of
// drawing, and with its mattes.
template <class T>
struct LayeredFrame {
  ImageRgb<T> picture;
  std::vector<LayerImage<T>> layers;
  std::vector<Matte> mattes;
  std::vector<T> alpha;  // 1 where the projection shows anything; empty without layers

  LayeredFrame() = default;
  explicit LayeredFrame(const std::vector<Layer>& asked, std::vector<Matte> mattes_asked = {})
      : mattes(std::move(mattes_asked)) {
    for (const Layer layer : asked) layers.push_back({layer});
  }
  // Returns a frame without a size that has the same layers and mattes.
  LayeredFrame without_pixels() const {
    LayeredFrame other;
    for (const LayerImage<T>& image : layers) other.layers.push_back({image.layer});
    for (const Matte& matte : mattes) other.mattes.push_back({matte.name});
    return other;
  }

  // Gives all of them one size.  Memory of that size is kept as it is, and layers have none yet.
  void set_size(int width, int height) {
    const auto resize = [&](ImageRgb<T>& image) {
      if (image.width != width || image.height != height) image = ImageRgb<T>(width, height);
    };
    const auto pixels = static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
    resize(picture);
    if (!layers.empty() || !mattes.empty()) alpha.resize(pixels);
    for (Matte& matte : mattes) matte.covered.resize(pixels);
    for (LayerImage<T>& image : layers) {
      if (image.light.width != width || image.light.height != height) image.remove_pixels();
      image.light.width = width;
      image.light.height = height;
    }
  }

  // Returns the image of a layer, or null where it is not asked for.
  LayerImage<T>* find(Layer layer) {
    for (LayerImage<T>& image : layers)
      if (image.layer == layer) return &image;
    return nullptr;
  }

  // Return the values of the picture and of each layer's light, and those of each layer's alpha and
  // of the mattes, always in one order.  Those of a layer are empty where all are 0.
  std::vector<std::vector<T>*> lights() {
    std::vector<std::vector<T>*> planes{&picture.pixels};
    for (LayerImage<T>& image : layers) planes.push_back(&image.light.pixels);
    return planes;
  }
  std::vector<std::vector<float>*> alphas() {
    std::vector<std::vector<float>*> planes;
    for (LayerImage<T>& image : layers) planes.push_back(&image.alpha);
    for (Matte& matte : mattes) planes.push_back(&matte.covered);
    return planes;
  }
};

using LayeredHalfFrame = LayeredFrame<Imath::half>;
using LayeredFloatFrame = LayeredFrame<float>;

}  // namespace domefall
