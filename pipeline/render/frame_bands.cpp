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

static_assert(kBandRows == RayGrid::kStep);

// The number of bands that one thread draws in succession where there are splats.  The splats at
// both ends of such a run are added by its neighbours too, so a run is long.  But each thread has
// several runs, so that none waits long for another at the end.
int bands_in_a_run(int bands) {
  constexpr int kRuns = 8, kLeast = 8;
  const int threads = tbb::this_task_arena::max_concurrency();
  return threads == 1 ? bands : std::max(bands / (kRuns * threads), kLeast);
}

// Stores a row as half floats.  Columns outside `inside` become 0.
void store_row(const float* rgb, int row, ColumnRange inside, HalfFrame& frame) {
  static_assert(sizeof(Imath::half) == sizeof(std::uint16_t));
  auto* out = reinterpret_cast<std::uint16_t*>(frame.row(row));
  const int first = 3 * inside.first, end = 3 * (inside.last + 1);
  if (first >= end) {
    std::fill_n(out, 3 * frame.width, std::uint16_t{0});
    return;
  }
  std::fill(out, out + first, std::uint16_t{0});
  std::fill(out + end, out + 3 * frame.width, std::uint16_t{0});
  if (to_half(rgb + first, end - first, out + first)) return;
  for (int k = 0; k < 3 * frame.width; ++k)
    if (!std::isfinite(rgb[k]))
      throw std::runtime_error(
          fmt::format("pixel ({}, {}) is not a finite number", k / 3 + 1, row + 1));
}

// Takes the light of stars off the pixels of a row that see no sky, and a part of it off those on a
// border.  `background` is the row without stars.
void end_stars_at(const SkyBorders& borders, const Projection& projection, const PixelBox& box,
                  int row, const float* background, float* rgb) {
  for (int column = box.first_column; column <= box.last_column; ++column) {
    const float* before = background + 3 * column;
    float* now = rgb + 3 * column;
    if (now[0] == before[0] && now[1] == before[1] && now[2] == before[2]) continue;
    const PixelPosition pixel{column + 1.0, row + 1.0};
    const auto part = static_cast<float>(
        borders.part_in_skies(direction_at(projection, pixel), pixel_angle(projection, pixel)));
    for (int c = 0; c < 3; ++c) now[c] = before[c] + part * (now[c] - before[c]);
  }
}

}  // namespace

void draw_bands(const FrameScene& scene, const SkyPass& sky, const BlobLayer& stars,
                const std::optional<SkyBorders>& borders, BandMemory& memory, HalfFrame& frame) {
  const auto stride = static_cast<std::size_t>(frame.width) * 3;
  const bool lit = scene.plan.has_background();
  const std::optional<PixelBox> box = borders ? borders->box_without_sky() : std::nullopt;
  const auto draw_band = [&](int band, SplatBuffer& splats) {
    const int first = band * kBandRows, end = std::min(frame.height, first + kBandRows);
    std::vector<float>& rgb = memory.rows.local();
    rgb.resize(stride * kBandRows + 1);
    if (lit)
      sky.fill_band(band, rgb.data());
    else
      std::fill(rgb.begin(), rgb.end(), 0.0f);
    const bool bordered = box && first <= box->last_row && end > box->first_row;
    std::vector<float>& background = memory.background.local();
    if (bordered) background.assign(rgb.begin(), rgb.end());
    stars.draw_band(band, splats, rgb.data());
    for (int row = first; bordered && row < end; ++row) {
      const std::size_t begin = static_cast<std::size_t>(row - first) * stride;
      end_stars_at(*borders, scene.projection(), *box, row, background.data() + begin,
                   rgb.data() + begin);
    }
    for (int row = first; row < end; ++row)
      store_row(rgb.data() + static_cast<std::size_t>(row - first) * stride, row,
                inside_columns(scene.projection(), row), frame);
  };
  const int bands = (frame.height + kBandRows - 1) / kBandRows;
  tbb::parallel_for(
      tbb::blocked_range<int>(0, bands, stars.has_splats() ? bands_in_a_run(bands) : 1),
      [&](const tbb::blocked_range<int>& run) {
        SplatBuffer& splats = memory.splats.local();
        stars.start_buffer(splats);
        for (int band = run.begin(); band < run.end(); ++band) draw_band(band, splats);
      },
      tbb::simple_partitioner());
}

}  // namespace domefall
