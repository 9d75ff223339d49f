#include "pipeline/render/sky/sky_pass.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "pipeline/light/aberration.h"

namespace domefall {
namespace {

constexpr int kGridStep = RayGrid::kStep;
// An image whose shorter side has fewer pixels than this is not worth a grid.
constexpr int kSmallest = 64;
static_assert(FormulaShader::kSide == kGridStep);

bool has_backgrounds(const FrameScene& scene) {
  return std::ranges::any_of(scene.background, [](const auto& light) { return light.has_value(); });
}

}  // namespace

std::vector<CameraDirection> special_directions(const FrameScene& scene) {
  constexpr double kFast = 3;  // of a celerity; slower observers see light crowded little
  const V3d& celerity = scene.tracer.viewer().celerity;
  std::vector<CameraDirection> special;
  const auto add = [&](const V3d& in_tetrad) {
    special.push_back({apply_transposed(scene.state.observer.tetrad_from_camera, in_tetrad)});
  };
  if (celerity.length() > kFast) {
    add(celerity.normalized());
    add(-celerity.normalized());
  }
  // Aberration moves what is special to the lens.
  for (const V3d& n : scene.tracer.lens()->special_directions())
    add(to_observer(celerity, n).direction);
  return special;
}

SkyPass::SkyPass(const FrameScene& scene, AntiAliasing anti_aliasing,
                 std::vector<DarkenedCap> darkened, RayGrid& grid)
    : scene_(scene),
      shader_(scene, anti_aliasing, std::move(darkened)),
      grid_(grid),
      // The grid does not interpolate the amplification of backgrounds.
      interpolates_(!anti_aliasing.everywhere && !anti_aliasing.every_pixel &&
                    has_backgrounds(scene) && !scene.amplifies_backgrounds() &&
                    std::min(columns(scene.projection()), rows(scene.projection())) >= kSmallest) {
  if (interpolates_) grid_.make(shader_, special_directions(scene));
}

// The band writes through rgb.  NOLINTNEXTLINE(readability-non-const-parameter)
SkyPass::Band SkyPass::band_at(int number, float* rgb) const {
  Band band{number, std::min(kGridStep, rows(scene_.projection()) - number * kGridStep), {}, rgb};
  for (int row = 0; row < band.rows; ++row)
    band.inside[row] = inside_columns(scene_.projection(), number * kGridStep + row);
  return band;
}

void SkyPass::blacken_outside(const Band& band) const {
  const int width = columns(scene_.projection());
  for (int row = 0; row < band.rows; ++row) {
    float* out = row_of(band, row);
    const ColumnRange in = band.inside[row];
    // In a row without any pixel of the image, `first` may lie beyond the last column.
    std::fill(out, out + 3 * std::min(in.first, width), 0.0f);
    std::fill(out + 3 * std::max(in.last + 1, std::min(in.first, width)), out + 3 * width, 0.0f);
  }
}

// Blackens the pixels of dark cells that lie in the image.
void SkyPass::blacken(const Band& band, int first, int end) const {
  for (int row = 0; row < band.rows; ++row) {
    const auto [left, right] = band.columns_of(row, first, end);
    if (left <= right)
      std::fill(row_of(band, row) + 3 * left, row_of(band, row) + 3 * (right + 1), 0.0f);
  }
}

// Fills smooth cells of one sky for which one plain sample for each pixel is enough, row by row.
void SkyPass::fill_plain(const Band& band, int first, int end) const {
  constexpr int kMostCells = SampleBatch::kSize / kGridStep;
  const int width = columns(scene_.projection());
  SampleBatch batch;
  std::array<float, 3 * SampleBatch::kSize + 1> rgb;
  const SkySampler& sampler = *shader_.sampler(grid_.cell(band.number, first).sky);
  for (int from = first; from < end; from += kMostCells) {
    const int to = std::min(end, from + kMostCells), pixel = from * kGridStep;
    for (int row = 0; row < band.rows; ++row) {
      const auto [left, right] = band.columns_of(row, from, to);
      if (left > right) continue;
      grid_.interpolate_row(band.number, row, from, to, batch);
      // Whole cells are sampled directly into the row.  The sampler overwrites one float behind
      // them, which the next pixels of the row correct.  At the end of a row this float would
      // belong to the next row.
      const bool straight = left == pixel && right == to * kGridStep - 1 && right < width - 1;
      float* out = row_of(band, row);
      sampler.sample_plain(batch, (to - from) * kGridStep, straight ? out + 3 * pixel : rgb.data());
      if (straight) continue;
      std::copy(&rgb[3 * (left - pixel)], &rgb[3 * (right + 1 - pixel)], out + 3 * left);
    }
  }
}

// Fills other smooth cells of one sky block by block.  Neighbouring footprints are then sampled
// soon after one another, while their texels are in the cache.
void SkyPass::fill_block(const Band& band, int first, int end) const {
  SampleBatch batch;
  std::array<SampleFilter, SampleBatch::kSize> filters;
  std::array<float, 3 * SampleBatch::kSize + 1> rgb;
  const SkyRegion sky = grid_.cell(band.number, first).sky;
  for (int from = first; from < end; from += RayGrid::kBlock) {
    const int to = std::min(end, from + RayGrid::kBlock),
              count = (to - from) * kGridStep * kGridStep;
    grid_.interpolate_block(band.number, from, to, batch);
    if (const FormulaShader* formula = shader_.formula(sky)) {
      formula->shade(batch, count, rgb.data());
    } else {
      const SkySampler& sampler = *shader_.sampler(sky);
      sampler.choose_filters(batch.wide.data(), batch.narrow.data(), count, SkySampler::kMostTaps,
                             HUGE_VALF, filters.data());
      sampler.sample(batch, count, filters.data(), rgb.data());
    }
    for (int row = 0; row < band.rows; ++row)
      for (int cell = from; cell < to; ++cell) {
        // The batch is stored cell by cell, and each cell row by row.
        const float* cell_row = &rgb[3 * kGridStep * ((cell - from) * kGridStep + row)];
        const auto [left, right] = band.columns_of(row, cell, cell + 1);
        if (left > right) continue;
        std::copy(cell_row + 3 * (left - cell * kGridStep),
                  cell_row + 3 * (right + 1 - cell * kGridStep), row_of(band, row) + 3 * left);
      }
  }
}

// Appends those pixels of cells that lie in the image, cell by cell.
void SkyPass::append_pixels(const Band& band, int first, int end,
                            std::vector<Pixel>& pixels) const {
  for (int cell = first; cell < end; ++cell)
    for (int row = 0; row < band.rows; ++row) {
      const auto [left, right] = band.columns_of(row, cell, cell + 1);
      for (int column = left; column <= right; ++column)
        pixels.push_back({column, band.number * kGridStep + row});
    }
}

void SkyPass::fill_band(int number, float* rgb) const {
  const Band band = band_at(number, rgb);
  blacken_outside(band);
  std::vector<Pixel> traced;
  const int cells = (columns(scene_.projection()) + kGridStep - 1) / kGridStep;
  if (!interpolates_) append_pixels(band, 0, cells, traced);
  // Neighbouring cells that are alike are filled together.
  for (int first = 0, end = 0; interpolates_ && first < cells; first = end) {
    const RayGrid::Cell cell = grid_.cell(number, first);
    while (end < cells && grid_.cell(number, end) == cell) ++end;
    if (cell.kind == RayGrid::Kind::kExact) append_pixels(band, first, end, traced);
    if (cell.kind == RayGrid::Kind::kNothing) blacken(band, first, end);
    if (cell.kind != RayGrid::Kind::kSmooth) continue;
    if (cell.plain)
      fill_plain(band, first, end);
    else
      fill_block(band, first, end);
  }
  shader_.fill(traced, number * kGridStep, rgb);
}

double SkyPass::traced_fraction() const { return interpolates_ ? grid_.traced_fraction() : 1; }

}  // namespace domefall
