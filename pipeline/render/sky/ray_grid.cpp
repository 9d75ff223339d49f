#include "pipeline/render/sky/ray_grid.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

#include "pipeline/base/simd/dispatch.h"

namespace domefall {
namespace {

// A cubic through four nodes at a distance h errs by at most 3/128 h^4 f'''' between the middle
// two.  Towards an edge the azimuth goes like -ln x.  With h = 8 pixels the cubic then errs, at x
// pixels from the edge, by 576/x^4 in azimuth, which is 576/x^3 pixels: 0.009 at 5 cells.
constexpr float kEdgeCells = 5;
// A cell whose corners are dark is dark throughout if no edge is nearer than the diagonal of a
// cell, which is sqrt 2 cells.
constexpr float kDarkCells = 1.5f;
// Within this many cells of a special direction all pixels are traced.  At x pixels from the motion
// of a fast observer the position on the sky goes like 1/x.  By the same formula the cubic errs by
// 2304/x^3 pixels: 0.006 at 9 cells.
constexpr double kSpecialCells = 9;
// The errors of interpolated shifts are relative for gains, and in octaves of temperature for
// tones.
constexpr float kGainTolerance = 1e-3f, kToneTolerance = 2e-3f;
// Nothing shows where a unit of the map gives less than this pixel value.  Texels are below 2^15
// units, so their pixel values are then at most about 3e-8.
constexpr float kFaintGain = 1e-12f;
// The coarser cubic may err by this many tolerances.  It errs 16 times as much as the finer one,
// but the largest error need not be at a node.  The limit is therefore less than 16.
constexpr float kCoarser = 6;

// Returns the error, at p, of the cubic through p's neighbours 1 and 3 strides away on both sides.
// In the middle of these nodes Lagrange's weights are -1/16, 9/16, 9/16 and -1/16.
inline float coarse_error(const float* p, std::ptrdiff_t stride) {
  const float between =
      (9 * (p[-stride] + p[stride]) - (p[-3 * stride] + p[3 * stride])) * (1.0f / 16);
  return between - p[0];
}

struct NodeColumns {
  const float *x, *y, *z, *gain, *tone, *tolerance;
  float tone_floor;
};

// Clears the marks of nodes at which a cubic errs too much, along a row of nodes (stride 1) or
// across it.  Directions may have any length, so only errors at right angles to them count.  These
// have the length of the cross product.  Comparisons with NaN are false, which clears the mark.
[[gnu::always_inline]] inline void check_loop(const NodeColumns& nodes, std::ptrdiff_t stride,
                                              int count, std::uint8_t* marks) {
  const NodeColumns n = nodes;
  for (int k = 0; k < count; ++k) {
    const float x = coarse_error(n.x + k, stride), y = coarse_error(n.y + k, stride),
                z = coarse_error(n.z + k, stride);
    const float most = kCoarser * n.tolerance[k];
    const float px = n.x[k], py = n.y[k], pz = n.z[k];
    const float u = y * pz - z * py, v = z * px - x * pz, w = x * py - y * px;
    const bool direction = u * u + v * v + w * w <= most * most;
    const bool gain = std::abs(coarse_error(n.gain + k, stride)) <=
                      kCoarser * kGainTolerance * n.gain[k] + kFaintGain;
    const bool tone = std::abs(coarse_error(n.tone + k, stride)) <=
                      kCoarser * (kGainTolerance * std::abs(n.tone[k]) + n.tone_floor);
    marks[k] = static_cast<std::uint8_t>(marks[k] & ((direction & gain & tone) ? 1 : 0));
  }
}
Dispatched<check_loop> check;

}  // namespace

void RayGrid::resize(const Projection& projection) {
  projection_ = projection;
  circle_.reset();
  if (traits_of(projection).is_dome) {
    const PixelPosition middle = origin_of(projection);
    circle_ = PixelPosition{middle.i - 1, middle.j - 1};
  }
  cell_columns_ = (columns(projection) + kStep - 1) / kStep;
  cell_rows_ = (rows(projection) + kStep - 1) / kStep;
  node_columns_ = cell_columns_ + 1 + 2 * kMargin;
  node_rows_ = cell_rows_ + 1 + 2 * kMargin;
  const std::size_t nodes = at(node_rows_, 0);
  for (auto& quantity : nodes_) quantity.resize(nodes + kPadding);
  tolerance_.resize(nodes);
  edge_.resize(nodes);
  sky_.resize(nodes);
  run_.resize(nodes);
  filters_.resize(nodes);
  cubic_.assign(nodes, 1);
  cells_.resize(static_cast<std::size_t>(cell_rows_) * static_cast<std::size_t>(cell_columns_));
}

void RayGrid::make(const PixelShader& shader, const std::vector<CameraDirection>& special) {
  shader_ = &shader;
  resize(shader.scene().projection());
  tone_floor_ = kToneTolerance;
  for (const SkyRegion sky : kEverySky)
    if (shader.sampler(sky) && shader.sampler(sky)->map().kind() == SkyMapKind::kColour)
      tone_floor_ = kFaintGain;  // kTone then holds gains
  special_ = special;
  special_pixels_.clear();
  for (const CameraDirection& n : special)
    if (const auto pixel = pixel_of(projection_, n))
      special_pixels_.push_back({pixel->i - 1, pixel->j - 1});
  // Each step needs what the step before has found in neighbouring rows.
  tbb::parallel_for(0, node_rows_, [this](int row) { trace_row(row); });
  tbb::parallel_for(kMargin, node_rows_ - kMargin, [this](int row) { check_row(row); });
  tbb::parallel_for(0, cell_rows_, [this](int row) { classify_row(row); });
}

void RayGrid::check_row(int row) {
  const std::size_t first = at(row, kMargin);
  const NodeColumns nodes{
      &nodes_[kX][first],    &nodes_[kY][first], &nodes_[kZ][first], &nodes_[kGain][first],
      &nodes_[kTone][first], &tolerance_[first], tone_floor_};
  const int count = cell_columns_ + 1;
  check(nodes, 1, count, &cubic_[first]);
  check(nodes, node_columns_, count, &cubic_[first]);
}

// Says whether a cell can be interpolated.  All nodes on which its cubics and their check depend
// must see one sky, and the cubics must be right at its corners.  No edge or special direction may
// be near.
bool RayGrid::is_smooth(int row, int column) const {
  for (int k = 0; k < 2 * kMargin + 2; ++k)
    if (run_[at(row + k, column)] != sky_[at(row, column)]) return false;
  for (int j = row + kMargin; j <= row + kMargin + 1; ++j)
    for (int i = column + kMargin; i <= column + kMargin + 1; ++i)
      if (!cubic_[at(j, i)] || !(edge_[at(j, i)] > kEdgeCells)) return false;
  return !is_near_special(row, column);
}

// On an image with a seam, or with a point that is stretched into a line, cells may be close
// together on the sphere and far apart in the image.  There distances are measured on the sphere.
// The largest pixel's angle bounds them.
bool RayGrid::is_near_special(int row, int column) const {
  if (has_zenith(projection_) && !traits_of(projection_).half_sphere) {
    if (special_.empty()) return false;
    const CameraDirection n = direction_at(projection_, {column * kStep + 1.0, row * kStep + 1.0});
    const double reach = kSpecialCells * kStep * largest_pixel_angle(projection_);
    return std::ranges::any_of(
        special_, [&](const CameraDirection& s) { return (s.v - n.v).length() < reach; });
  }
  return std::ranges::any_of(special_pixels_, [&](const PixelPosition& p) {
    return std::hypot(p.i / kStep - column, p.j / kStep - row) < kSpecialCells;
  });
}

bool RayGrid::is_in_image(int row, int column) const {
  if (!circle_) return true;
  // away() is the distance of a cell from the middle along one axis.
  const auto away = [](int cell, double middle) {
    return std::max({cell * kStep - middle, middle - (cell * kStep + kStep - 1), 0.0});
  };
  const double x = away(column, circle_->i), y = away(row, circle_->j) / pixel_aspect(projection_);
  const double radius = columns(projection_) / 2.0;
  return x * x + y * y <= radius * radius;
}

RayGrid::Cell RayGrid::classified(int row, int column) const {
  Cell cell;
  if (!is_in_image(row, column)) return cell;
  const std::array<std::size_t, 4> corners{
      at(row + kMargin, column + kMargin), at(row + kMargin, column + kMargin + 1),
      at(row + kMargin + 1, column + kMargin), at(row + kMargin + 1, column + kMargin + 1)};
  if (std::ranges::all_of(corners,
                          [&](std::size_t n) { return sky_[n] == kDark && edge_[n] > kDarkCells; }))
    return cell;
  cell.kind = Kind::kExact;
  if (sky_[corners[0]] >= kDark || !is_smooth(row, column)) return cell;
  cell.kind = Kind::kSmooth;
  cell.sky = static_cast<SkyRegion>(sky_[corners[0]]);
  cell.plain = shader_->sampler(cell.sky) != nullptr &&
               std::ranges::all_of(corners, [&](std::size_t n) { return filters_[n].is_plain(); });
  return cell;
}

void RayGrid::classify_row(int row) {
  for (int column = 0; column < cell_columns_; ++column)
    cells_[static_cast<std::size_t>(row * cell_columns_ + column)] = classified(row, column);
}

double RayGrid::traced_fraction() const {
  std::size_t exact = 0, all = 0;
  for (const Cell& cell : cells_) {
    exact += cell.kind == Kind::kExact;
    all += cell.kind != Kind::kNothing;
  }
  return all > 0 ? static_cast<double>(exact) / static_cast<double>(all) : 0;
}

}  // namespace domefall
