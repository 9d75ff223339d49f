#include "pipeline/render/frame_bands.h"

#include <fmt/format.h>
#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "pipeline/base/simd/half_row.h"

namespace domefall {
namespace {

// Stars and skies are drawn in the same bands.
static_assert(kBandRows == RayGrid::kStep);

// Returns the number of bands that one thread draws in succession where there are splats.  The
// splats at both ends of such a run are added by its neighbours too, so a run is long.  But each
// thread has several runs, so that none waits long for another at the end.
int bands_in_a_run(int bands) {
  constexpr int kRuns = 8, kLeast = 8;
  const int threads = tbb::this_task_arena::max_concurrency();
  return threads == 1 ? bands : std::max(bands / (kRuns * threads), kLeast);
}

// Stores values, negative ones as 0, and returns whether all are finite.
bool store(const float* values, int count, Imath::half* out) {
  static_assert(sizeof(Imath::half) == sizeof(std::uint16_t));
  return to_half(values, count, reinterpret_cast<std::uint16_t*>(out));
}
// Floats are stored as they are, except for negative ones.
bool store(const float* values, int count, float* out) {
  bool finite = true;
  for (int k = 0; k < count; ++k) {
    finite = finite && std::isfinite(values[k]);
    out[k] = std::max(values[k], 0.0f);
  }
  return finite;
}

// Stores a row.  Columns outside `inside` become 0.
template <class T>
void store_row(const float* rgb, int row, ColumnRange inside, ImageRgb<T>& frame) {
  T* out = frame.row(row);
  // A pixel has three values.  A row outside the image has no columns inside it.
  const int first = 3 * inside.first, end = 3 * (inside.last + 1);
  if (first >= end) {
    std::fill_n(out, 3 * frame.width, T(0));
    return;
  }
  std::fill(out, out + first, T(0));
  std::fill(out + end, out + 3 * frame.width, T(0));
  // Only a row that failed is searched for the pixel.
  if (store(rgb + first, end - first, out + first)) return;
  for (int k = 0; k < 3 * frame.width; ++k)
    if (!std::isfinite(rgb[k]))
      throw std::runtime_error(
          fmt::format("pixel ({}, {}) is not a finite number", k / 3 + 1, row + 1));
}

// BandLayers divide the light of a band among the layers of a frame while it is drawn.  What each
// gets is what came to the picture since the layer before, so that their sum is the picture.
template <class T>
class BandLayers {
 public:
  BandLayers(LayeredFrame<T>& frame, LayerRows& rows, int first, int end)
      : frame_(frame),
        rows_(rows),
        first_(first),
        pixels_(static_cast<std::size_t>(end - first) *
                static_cast<std::size_t>(frame.picture.width)) {
    rows_.before.assign(3 * pixels_, 0);
    for (std::vector<float>& left : rows_.left) left.clear();
    rows_.taken.fill(false);
  }

  // Gives a layer the light that has come to the picture since the last call.
  void take(Layer layer, const float* rgb) {
    std::vector<float>& before = rows_.before;
    if (is_drawn(layer)) {
      std::vector<float>& light = light_of(layer);
      light.resize(before.size());
      for (std::size_t k = 0; k < before.size(); ++k) light[k] = rgb[k] - before[k];
    }
    std::copy_n(rgb, before.size(), before.begin());
  }

  // Returns where a layer that hides what is behind it says how much of that is left.
  float* left(Layer layer) {
    std::vector<float>& left = left_of(layer);
    left.assign(pixels_, 1);
    return left.data();
  }
  // As take, of a layer that leaves that part of all light behind it and hides the rest.
  void take_hiding(Layer layer, const float* rgb) {
    const std::vector<float>& left = left_of(layer);
    const auto dim = [&](std::vector<float>& light) {
      for (std::size_t k = 0; k < left.size(); ++k)
        for (std::size_t c = 3 * k; c < 3 * k + 3; ++c) light[c] *= left[k];
    };
    dim(rows_.before);
    for (LayerImage<T>& image : frame_.layers)
      if (is_taken(image.layer)) dim(light_of(image.layer));
    take(layer, rgb);
  }

  void store(int row, ColumnRange inside) {
    const auto width = static_cast<std::size_t>(frame_.picture.width);
    const std::size_t at = static_cast<std::size_t>(row - first_) * width;
    for (LayerImage<T>& image : frame_.layers) {
      if (!is_drawn(image.layer)) continue;
      if (is_taken(image.layer))
        store_row(light_of(image.layer).data() + 3 * at, row, inside, image.light);
      else
        std::fill_n(image.light.row(row), 3 * width, T(0));
      if (image.alpha.empty()) continue;
      float* const alpha = image.alpha.data() + static_cast<std::size_t>(row) * width;
      if (const std::vector<float>& left = left_of(image.layer); !left.empty())
        for (std::size_t k = 0; k < width; ++k) alpha[k] = 1 - left[at + k];
      else
        std::fill_n(alpha, width, 0.0f);
    }
  }

 private:
  bool is_drawn(Layer layer) {
    const LayerImage<T>* image = frame_.find(layer);
    return image && !image->light.pixels.empty();
  }
  bool is_taken(Layer layer) const { return rows_.taken[static_cast<std::size_t>(layer)]; }
  std::vector<float>& left_of(Layer layer) { return rows_.left[static_cast<std::size_t>(layer)]; }
  std::vector<float>& light_of(Layer layer) {
    rows_.taken[static_cast<std::size_t>(layer)] = true;
    return rows_.light[static_cast<std::size_t>(layer)];
  }

  LayeredFrame<T>& frame_;
  LayerRows& rows_;
  int first_;
  std::size_t pixels_;
};

// A StarsEnd ends the stars of a band at the borders of the skies.  Nearly all of a band sees a sky
// as a whole and costs nothing, since only blocks of columns that see no sky, or a border, are
// visited.
class StarsEnd {
 public:
  // Finds the blocks of columns in the box that do not lie within one sky as a whole, and keeps
  // their pixels as they are before stars are drawn.
  StarsEnd(const SkyBorders& borders, const Projection& projection, const PixelBox& box, int first,
           int end, const float* rgb, std::vector<float>& kept)
      : borders_(borders), projection_(projection), first_(first), end_(end), kept_(kept) {
    const int blocks = (box.last_column - box.first_column) / kColumns + 1;
    const double half_rows = (end - first) / 2.0;
    // Half of the block's diagonal is a safe reach.
    const double reach = largest_pixel_angle(projection) * std::hypot(kColumns / 2.0, half_rows);
    kept_.clear();
    for (int k = 0; k < blocks; ++k) {
      const int column = box.first_column + k * kColumns;
      const CameraDirection middle =
          direction_at(projection, {column + 1 + (kColumns - 1) / 2.0, first + 0.5 + half_rows});
      const SkyBorders::Sight sight = borders.sight_around(middle, reach);
      if (sight == SkyBorders::Sight::kSky) continue;
      blocks_.push_back({column, std::min(box.last_column, column + kColumns - 1), sight});
      each_row(blocks_.back(), [&](int, std::size_t at, std::size_t count) {
        kept_.insert(kept_.end(), rgb + at, rgb + at + count);
      });
    }
  }

  // Removes the light of stars from the pixels that see no sky, and a part of it from those on a
  // border.
  void end_stars(float* rgb) const {
    const float* before = kept_.data();
    for (const Block& block : blocks_)
      each_row(block, [&](int row, std::size_t at, std::size_t count) {
        if (block.sight == SkyBorders::Sight::kNoSky)
          std::copy_n(before, count, rgb + at);
        else
          end_on_border(block, row, before, rgb + at);
        before += count;
      });
  }

 private:
  static constexpr int kColumns = 16;
  struct Block {
    int first, last;  // columns
    SkyBorders::Sight sight;
  };

  // Calls what(row, at, count) for each row of a block.  Its floats are the `count` floats of the
  // band from `at` on.
  template <class What>
  void each_row(const Block& block, const What& what) const {
    const auto width = static_cast<std::size_t>(columns(projection_));
    for (int row = first_; row < end_; ++row)
      what(row,
           3 * (static_cast<std::size_t>(row - first_) * width +
                static_cast<std::size_t>(block.first)),
           3 * static_cast<std::size_t>(block.last - block.first + 1));
  }

  // Leaves in each pixel on a border that part of the stars' light which falls on skies.
  void end_on_border(const Block& block, int row, const float* before, float* now) const {
    for (int column = block.first; column <= block.last; ++column, before += 3, now += 3) {
      if (now[0] == before[0] && now[1] == before[1] && now[2] == before[2]) continue;
      const PixelPosition pixel{column + 1.0, row + 1.0};
      const auto part = static_cast<float>(borders_.part_in_skies(direction_at(projection_, pixel),
                                                                  pixel_angle(projection_, pixel)));
      for (int c = 0; c < 3; ++c) now[c] = before[c] + part * (now[c] - before[c]);
    }
  }

  const SkyBorders& borders_;
  const Projection& projection_;
  int first_, end_;  // rows
  std::vector<float>& kept_;
  std::vector<Block> blocks_;
};

template <class T>
void draw_gas(const DrawnLight& drawn, int first, int end, float* rgb,
              std::optional<BandLayers<T>>& layers) {
  if (!drawn.disc && !drawn.gas) return;
  float* const left = layers ? layers->left(Layer::kDisc) : nullptr;
  if (drawn.disc) drawn.disc->draw_rows(first, end, rgb, left);
  if (drawn.gas) drawn.gas->draw_rows(first, end, rgb, left);
  if (layers) layers->take_hiding(Layer::kDisc, rgb);
}

template <class T>
void draw_bodies_of(const DrawnLight& drawn, int band, std::size_t pixels, SplatBuffer& splats,
                    float* rgb, std::optional<BandLayers<T>>& layers) {
  const bool hiding = layers && any_covers(drawn.bodies);
  draw_bodies(drawn.bodies, band, pixels, splats, rgb,
              hiding ? layers->left(Layer::kBodies) : nullptr);
  if (hiding)
    layers->take_hiding(Layer::kBodies, rgb);
  else if (layers)
    layers->take(Layer::kBodies, rgb);
}

// Gives pixels to the layers in which something may be drawn, and to no others.
template <class T>
void prepare_layers(bool lit, const DrawnLight& drawn, LayeredFrame<T>& frame) {
  const auto is_drawn = [&](Layer layer) {
    switch (layer) {
      case Layer::kSky:
        return lit || drawn.crowded_skies;
      case Layer::kStars:
        return drawn.stars->size() > 0;
      case Layer::kDisc:
        return drawn.disc || drawn.gas;
      case Layer::kBodies:
        return !drawn.bodies.empty();
      case Layer::kGlare:
      case Layer::kTitles:
        break;  // they come later
    }
    return false;
  };
  for (LayerImage<T>& image : frame.layers) {
    if (is_drawn(image.layer))
      image.add_pixels(image.layer == Layer::kDisc ||
                       (image.layer == Layer::kBodies && any_covers(drawn.bodies)));
    else
      image.remove_pixels();
  }
}

}  // namespace

template <class T>
void draw_bands(const FrameScene& scene, const SkyPass& sky, const DrawnLight& drawn,
                BandMemory& memory, LayeredFrame<T>& frame) {
  const int width = frame.picture.width, height = frame.picture.height;
  // A row has this many floats.
  const auto stride = static_cast<std::size_t>(width) * 3;
  const bool lit = scene.plan.has_background();
  const BlobLayer& stars = *drawn.stars;
  prepare_layers(lit, drawn, frame);
  // Outside this box every pixel sees a sky.
  const std::optional<PixelBox> box =
      drawn.borders ? drawn.borders->box_without_sky() : std::nullopt;
  // Draws one band, in which everything happens while its rows are in the cache.
  const auto draw_band = [&](int band, SplatBuffer& splats) {
    const int first = band * kBandRows, end = std::min(height, first + kBandRows);
    // SkyPass may overwrite one float behind the last row.
    std::vector<float>& rgb = memory.rows.local();
    rgb.resize(stride * kBandRows + 1);
    if (lit)
      sky.fill_band(band, rgb.data());
    else
      std::fill(rgb.begin(), rgb.end(), 0.0f);
    if (drawn.crowded_skies) drawn.crowded_skies->draw_band(band, splats, rgb.data());
    std::optional<BandLayers<T>> layers;
    if (!frame.layers.empty()) layers.emplace(frame, memory.layers.local(), first, end);
    if (layers) layers->take(Layer::kSky, rgb.data());
    // The order matters: stars end before the disc and the bodies, which are nearer, are drawn.
    const bool bordered = box && first <= box->last_row && end > box->first_row;
    std::optional<StarsEnd> stars_end;
    if (bordered)
      stars_end.emplace(*drawn.borders, scene.projection(), *box, first, end, rgb.data(),
                        memory.background.local());
    stars.draw_band(band, splats, rgb.data());
    if (stars_end) stars_end->end_stars(rgb.data());
    if (layers) layers->take(Layer::kStars, rgb.data());
    draw_gas(drawn, first, end, rgb.data(), layers);
    if (!drawn.bodies.empty()) {
      const std::size_t pixels = static_cast<std::size_t>(end - first) * stride / 3;
      draw_bodies_of(drawn, band, pixels, splats, rgb.data(), layers);
    }
    if (drawn.mattes) drawn.mattes->fill_rows(first, end, rgb.data(), splats, frame.mattes);
    for (int row = first; row < end; ++row) {
      const ColumnRange inside = inside_columns(scene.projection(), row);
      store_row(&rgb[static_cast<std::size_t>(row - first) * stride], row, inside, frame.picture);
      if (layers) layers->store(row, inside);
    }
  };
  const int bands = (height + kBandRows - 1) / kBandRows;
  tbb::parallel_for(
      tbb::blocked_range<int>(0, bands, stars.has_splats() ? bands_in_a_run(bands) : 1),
      [&](const tbb::blocked_range<int>& run) {
        // A frame that was told to stop ends after the runs that have begun.
        memory.throw_if_stopped();
        SplatBuffer& splats = memory.splats.local();
        stars.start_buffer(splats);
        for (int band = run.begin(); band < run.end(); ++band) draw_band(band, splats);
      },
      tbb::simple_partitioner());
}

template void draw_bands(const FrameScene&, const SkyPass&, const DrawnLight&, BandMemory&,
                         LayeredHalfFrame&);
template void draw_bands(const FrameScene&, const SkyPass&, const DrawnLight&, BandMemory&,
                         LayeredFloatFrame&);

}  // namespace domefall
