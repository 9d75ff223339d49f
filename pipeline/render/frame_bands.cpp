#include "pipeline/render/frame_bands.h"

#include <fmt/format.h>
#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "pipeline/simd/half_row.h"

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
    std::vector<CameraDirection> middles(static_cast<std::size_t>(blocks));
    const double half_rows = (end - first) / 2.0;
    directions_along(projection,
                     {box.first_column + 1 + (kColumns - 1) / 2.0, first + 0.5 + half_rows},
                     kColumns, blocks, middles.data());
    // No pixel is wider than the central one, so half of the block's diagonal is a safe reach.
    const double reach = central_pixel_angle(projection) * std::hypot(kColumns / 2.0, half_rows);
    kept_.clear();
    for (int k = 0; k < blocks; ++k) {
      const SkyBorders::Sight sight =
          borders.sight_around(middles[static_cast<std::size_t>(k)], reach);
      if (sight == SkyBorders::Sight::kSky) continue;
      const int column = box.first_column + k * kColumns;
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

}  // namespace

template <class T>
void draw_bands(const FrameScene& scene, const SkyPass& sky, const BlobLayer& stars,
                const DiscPass* disc, const std::optional<SkyBorders>& borders,
                const BlobLayer* bodies, BandMemory& memory, ImageRgb<T>& frame) {
  // A row has this many floats.
  const auto stride = static_cast<std::size_t>(frame.width) * 3;
  const bool lit = scene.plan.has_background();
  // Outside this box every pixel sees a sky.
  const std::optional<PixelBox> box = borders ? borders->box_without_sky() : std::nullopt;
  // Draws one band, in which everything happens while its rows are in the cache.
  const auto draw_band = [&](int band, SplatBuffer& splats) {
    const int first = band * kBandRows, end = std::min(frame.height, first + kBandRows);
    // SkyPass may overwrite one float behind the last row.
    std::vector<float>& rgb = memory.rows.local();
    rgb.resize(stride * kBandRows + 1);
    if (lit)
      sky.fill_band(band, rgb.data());
    else
      std::fill(rgb.begin(), rgb.end(), 0.0f);
    // The order matters: stars end before the disc and the bodies, which are nearer, are drawn.
    const bool bordered = box && first <= box->last_row && end > box->first_row;
    std::optional<StarsEnd> stars_end;
    if (bordered)
      stars_end.emplace(*borders, scene.projection(), *box, first, end, rgb.data(),
                        memory.background.local());
    stars.draw_band(band, splats, rgb.data());
    if (stars_end) stars_end->end_stars(rgb.data());
    if (disc) disc->draw_rows(first, end, rgb.data());
    if (bodies) bodies->draw_band(band, splats, rgb.data());
    for (int row = first; row < end; ++row)
      store_row(rgb.data() + static_cast<std::size_t>(row - first) * stride, row,
                inside_columns(scene.projection(), row), frame);
  };
  const int bands = (frame.height + kBandRows - 1) / kBandRows;
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

template void draw_bands(const FrameScene&, const SkyPass&, const BlobLayer&, const DiscPass*,
                         const std::optional<SkyBorders>&, const BlobLayer*, BandMemory&,
                         HalfFrame&);
template void draw_bands(const FrameScene&, const SkyPass&, const BlobLayer&, const DiscPass*,
                         const std::optional<SkyBorders>&, const BlobLayer*, BandMemory&,
                         FloatImage&);

}  // namespace domefall
