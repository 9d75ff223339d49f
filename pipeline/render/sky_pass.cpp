#include "pipeline/render/sky_pass.h"

#include <algorithm>

#include "pipeline/optics/aberration.h"
#include "pipeline/show/vantage.h"

namespace domefall {
namespace {

constexpr int kStep = LookGrid::kStep;
// A smaller picture is not worth a grid.
constexpr int kSmallest = 64;

bool has_maps(const PixelLight& light) {
  return std::any_of(std::begin(kEverySky), std::end(kEverySky),
                     [&](SeenSky sky) { return light.sampler(sky) != nullptr; });
}

}  // namespace

std::vector<CameraDirection> special_directions(const Show& show, const FrameState& state,
                                                const HoleOptics& optics) {
  constexpr double kFast = 3;
  const ObserverState& o = state.observer;
  const V3d celerity = vantage_of(o, show.effects).celerity;
  std::vector<CameraDirection> special;
  const auto add = [&](const V3d& in_tetrad) {
    special.push_back({apply_transposed(o.tetrad_from_camera, in_tetrad)});
  };
  if (celerity.length() > kFast) add(celerity.normalized()), add(-celerity.normalized());
  if (optics.white_hole)
    for (const double outward : {1.0, -1.0})
      add(to_observer(celerity, V3d(outward, 0, 0)).direction);
  return special;
}

SkyPass::SkyPass(const Show& show, const FrameState& state, const HoleOptics& optics,
                 AntiAliasing anti_aliasing, const PixelLight& light, LookGrid& grid)
    : projection_(state.projection),
      light_(light),
      grid_(grid),
      interpolates_(!anti_aliasing.everywhere && !anti_aliasing.every_pixel && has_maps(light) &&
                    show.effects.amplification != Amplification::kEverything &&
                    std::min(columns(projection_), rows(projection_)) >= kSmallest) {
  if (interpolates_) grid_.make(projection_, light, special_directions(show, state, optics));
}

void SkyPass::fill_smooth(const LookGrid::Line& line, const LookGrid::Cell& cell, int first,
                          int end, ColumnRange inside, float* rgb) const {
  constexpr int kCellsAtOnce = SkyPlaces::kSize / kStep;
  SkyPlaces places;
  std::array<float, 3 * SkyPlaces::kSize + 1> light;
  for (int from = first; from < end; from += kCellsAtOnce) {
    const int to = std::min(end, from + kCellsAtOnce), pixel = from * kStep;
    const int left = std::max(pixel, inside.first), right = std::min(to * kStep - 1, inside.last);
    if (left > right) continue;
    grid_.places(line, cell, from, to, places);
    // Straight into the row where nothing beside it is touched but what comes next.
    const bool whole = left == pixel && right == to * kStep - 1;
    float* out = whole ? rgb + 3 * pixel : light.data();
    light_.sampler(cell.sky)->sample(places, (to - from) * kStep, cell.taps, cell.minified, out);
    if (whole) continue;
    std::copy(&light[static_cast<std::size_t>(3 * (left - pixel))],
              &light[static_cast<std::size_t>(3 * (right + 1 - pixel))], rgb + 3 * left);
  }
}

void SkyPass::fill_row(int cell_row, int row, LookGrid::Line& line, float* rgb) const {
  const ColumnRange inside = inside_columns(projection_, cell_row * kStep + row);
  if (inside.first > inside.last) return;
  const int last = inside.last / kStep;
  bool lined = false;
  for (int first = inside.first / kStep, end = first; first <= last; first = end) {
    const LookGrid::Cell cell = grid_.cell(cell_row, first);
    while (end <= last && grid_.cell(cell_row, end) == cell) ++end;
    if (cell.kind != LookGrid::Kind::kSmooth) continue;
    if (!lined) grid_.line_at(cell_row, row, line);
    lined = true;
    fill_smooth(line, cell, first, end, inside, rgb);
  }
}

std::vector<Pixel> SkyPass::exact_pixels(int band) const {
  const int first = band * kStep, end = std::min(first + kStep, rows(projection_));
  std::array<ColumnRange, kStep> inside{};
  for (int row = first; row < end; ++row) inside[row - first] = inside_columns(projection_, row);
  std::vector<Pixel> pixels;
  for (int left = 0; left < columns(projection_); left += kStep) {
    if (interpolates_ && grid_.cell(band, left / kStep).kind != LookGrid::Kind::kExact) continue;
    for (int row = first; row < end; ++row) {
      const ColumnRange& in = inside[row - first];
      for (int i = std::max(left, in.first); i <= std::min(left + kStep - 1, in.last); ++i)
        pixels.push_back({i, row});
    }
  }
  return pixels;
}

void SkyPass::fill_band(int band, float* rgb) const {
  const int width = columns(projection_), height = rows(projection_);
  LookGrid::Line line;
  if (interpolates_)
    for (int row = 0; row < kStep && band * kStep + row < height; ++row)
      fill_row(band, row, line,
               rgb + static_cast<std::size_t>(row) * 3 * static_cast<std::size_t>(width));
  light_.fill(exact_pixels(band), band * kStep, rgb);
}

double SkyPass::exact_part() const { return interpolates_ ? grid_.exact_part() : 1; }

}  // namespace domefall
