#include "pipeline/render/sky/sky_pass.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "pipeline/optics/aberration.h"

namespace domefall {
namespace {

constexpr int kStep = RayGrid::kStep;
// A smaller picture is not worth a grid.
constexpr int kSmallest = 64;

bool has_maps(const FrameScene& scene) {
  return std::any_of(scene.background.begin(), scene.background.end(),
                     [](const auto& light) { return light && light->map(); });
}

}  // namespace

std::vector<CameraDirection> special_directions(const FrameScene& scene) {
  constexpr double kFast = 3;
  const V3d& celerity = scene.tracer.vantage().celerity;
  std::vector<CameraDirection> special;
  const auto add = [&](const V3d& in_tetrad) {
    special.push_back({apply_transposed(scene.state.observer.tetrad_from_camera, in_tetrad)});
  };
  if (celerity.length() > kFast) {
    add(celerity.normalized());
    add(-celerity.normalized());
  }
  if (scene.optics.white_hole)
    for (const double outward : {1.0, -1.0})
      add(to_observer(celerity, V3d(outward, 0, 0)).direction);
  return special;
}

SkyPass::SkyPass(const FrameScene& scene, AntiAliasing anti_aliasing,
                 std::vector<DarkenedCap> darkened, RayGrid& grid)
    : scene_(scene),
      shader_(scene, anti_aliasing, std::move(darkened)),
      grid_(grid),
      interpolates_(!anti_aliasing.everywhere && !anti_aliasing.every_pixel && has_maps(scene) &&
                    !scene.amplifies_backgrounds() &&
                    std::min(columns(scene.projection()), rows(scene.projection())) >= kSmallest) {
  if (interpolates_) grid_.make(shader_, special_directions(scene));
}

SkyPass::Band SkyPass::band_at(int number) const {
  Band band{number, std::min(kStep, rows(scene_.projection()) - number * kStep), {}, nullptr};
  for (int row = 0; row < band.rows; ++row)
    band.inside[row] = inside_columns(scene_.projection(), number * kStep + row);
  return band;
}

void SkyPass::blacken_outside(const Band& band) const {
  const int width = columns(scene_.projection());
  for (int row = 0; row < band.rows; ++row) {
    float* out = row_of(band, row);
    const ColumnRange in = band.inside[row];
    std::fill(out, out + 3 * std::min(in.first, width), 0.0f);
    std::fill(out + 3 * std::max(in.last + 1, std::min(in.first, width)), out + 3 * width, 0.0f);
  }
}

// Of cells what is in the picture.
void SkyPass::blacken(const Band& band, int first, int end) const {
  for (int row = 0; row < band.rows; ++row) {
    const int left = std::max(first * kStep, band.inside[row].first),
              right = std::min(end * kStep - 1, band.inside[row].last);
    if (left <= right)
      std::fill(row_of(band, row) + 3 * left, row_of(band, row) + 3 * (right + 1), 0.0f);
  }
}

// Smooth cells of one sky where a look a pixel is enough, row by row.
void SkyPass::fill_plain(const Band& band, int first, int end) const {
  constexpr int kAtOnce = FootprintBatch::kSize / kStep;
  const int width = columns(scene_.projection());
  FootprintBatch places;
  std::array<float, 3 * FootprintBatch::kSize + 1> light;
  const SkySampler& sampler = *shader_.sampler(grid_.cell(band.number, first).sky);
  for (int from = first; from < end; from += kAtOnce) {
    const int to = std::min(end, from + kAtOnce), pixel = from * kStep;
    for (int row = 0; row < band.rows; ++row) {
      const int left = std::max(pixel, band.inside[row].first),
                right = std::min(to * kStep - 1, band.inside[row].last);
      if (left > right) continue;
      grid_.interpolate_row(band.number, row, from, to, places);
      // Straight into the row where nothing beside it is touched but what comes next.
      const bool whole = left == pixel && right == to * kStep - 1 && right < width - 1;
      float* out = row_of(band, row);
      sampler.sample_plain(places, (to - from) * kStep, whole ? out + 3 * pixel : light.data());
      if (whole) continue;
      std::copy(&light[3 * (left - pixel)], &light[3 * (right + 1 - pixel)], out + 3 * left);
    }
  }
}

// Other smooth cells of one sky, cell by cell: what is beside a line of looks is looked at next.
void SkyPass::fill_block(const Band& band, int first, int end) const {
  FootprintBatch places;
  std::array<SampleKind, FootprintBatch::kSize> kinds;
  std::array<float, 3 * FootprintBatch::kSize + 1> light;
  const SkySampler& sampler = *shader_.sampler(grid_.cell(band.number, first).sky);
  for (int from = first; from < end; from += RayGrid::kBlock) {
    const int to = std::min(end, from + RayGrid::kBlock), count = (to - from) * kStep * kStep;
    grid_.interpolate_block(band.number, from, to, places);
    sampler.choose_kinds(places.wide.data(), places.narrow.data(), count, SkySampler::kMostTaps,
                         HUGE_VALF, kinds.data());
    sampler.sample(places, count, kinds.data(), light.data());
    for (int row = 0; row < band.rows; ++row)
      for (int cell = from; cell < to; ++cell) {
        const float* of_row = &light[3 * kStep * ((cell - from) * kStep + row)];
        const int left = std::max(cell * kStep, band.inside[row].first),
                  right = std::min(cell * kStep + kStep - 1, band.inside[row].last);
        if (left > right) continue;
        std::copy(of_row + 3 * (left - cell * kStep), of_row + 3 * (right + 1 - cell * kStep),
                  row_of(band, row) + 3 * left);
      }
  }
}

// The pixels of cells, cell by cell.
void SkyPass::add_pixels(const Band& band, int first, int end, std::vector<Pixel>& pixels) const {
  for (int cell = first; cell < end; ++cell)
    for (int row = 0; row < band.rows; ++row) {
      const int left = std::max(cell * kStep, band.inside[row].first),
                right = std::min(cell * kStep + kStep - 1, band.inside[row].last);
      for (int column = left; column <= right; ++column)
        pixels.push_back({column, band.number * kStep + row});
    }
}

void SkyPass::fill_band(int number, float* rgb) const {
  Band band = band_at(number);
  band.rgb = rgb;
  blacken_outside(band);
  std::vector<Pixel> pixels;
  const int cells = (columns(scene_.projection()) + kStep - 1) / kStep;
  if (!interpolates_) add_pixels(band, 0, cells, pixels);
  for (int first = 0, end = 0; interpolates_ && first < cells; first = end) {
    const RayGrid::Cell cell = grid_.cell(number, first);
    while (end < cells && grid_.cell(number, end) == cell) ++end;
    if (cell.kind == RayGrid::Kind::kExact) add_pixels(band, first, end, pixels);
    if (cell.kind == RayGrid::Kind::kNothing) blacken(band, first, end);
    if (cell.kind != RayGrid::Kind::kSmooth) continue;
    if (cell.plain)
      fill_plain(band, first, end);
    else
      fill_block(band, first, end);
  }
  shader_.fill(pixels, number * kStep, rgb);
}

double SkyPass::traced_fraction() const { return interpolates_ ? grid_.traced_fraction() : 1; }

}  // namespace domefall
