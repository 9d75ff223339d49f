#include "pipeline/render/sky/ray_grid.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

#include "pipeline/render/rays/footprint_batch.h"
#include "pipeline/render/rays/pixel_directions.h"
#include "pipeline/simd/dispatch.h"

namespace domefall {
namespace {

// At a distance of x pixels from an edge, -ln x interpolated every 8 pixels errs by 570/x^3 pixels.
constexpr float kEdgeCells = 5;
// Farther from any edge than across a cell, what is dark at its corners is dark in it.
constexpr float kDarkCells = 1.5f;
// So many cells about the direction of motion and the axis every pixel is looked at: ahead of a fast
// observer, x pixels from it, the sky lies like 1/x, and the cubic errs by 2300/x^3 pixels.
constexpr double kSpecialCells = 9;
// Of interpolated shifts: relative, of gains, and in octaves of temperature.
constexpr float kGainTolerance = 1e-3f, kToneTolerance = 2e-3f;
// Pixel value per unit of a map that shows nothing: its texels are below 2^15.
constexpr float kFaintGain = 1e-12f;
// The cubic through second next neighbours is 16 times worse: a part of that, since the worst is not at
// the nodes.
constexpr float kCoarser = 6;

constexpr std::uint8_t kMixed = 0xff, kDark = 0xfe;

// What the cubic through the second next neighbours errs by.
inline float missed(const float* p, std::ptrdiff_t stride) {
  const float between =
      (9 * (p[-stride] + p[stride]) - (p[-3 * stride] + p[3 * stride])) * (1.0f / 16);
  return between - p[0];
}

struct Checked {
  const float *x, *y, *z, *gain, *tone, *tolerance;
  float tone_floor;
};

// Along a line of nodes, or across it with a stride.  A comparison with NaN is false: not good.
// A place may be of any length: only what is off at right angles to it counts.
[[gnu::always_inline]] inline void check_loop(const Checked& nodes, std::ptrdiff_t stride,
                                              int count, std::uint8_t* good) {
  const Checked n = nodes;
  for (int k = 0; k < count; ++k) {
    const float x = missed(n.x + k, stride), y = missed(n.y + k, stride),
                z = missed(n.z + k, stride);
    const float most = kCoarser * n.tolerance[k];
    const float px = n.x[k], py = n.y[k], pz = n.z[k];
    const float u = y * pz - z * py, v = z * px - x * pz, w = x * py - y * px;
    const bool place = u * u + v * v + w * w <= most * most;
    const bool gain =
        std::abs(missed(n.gain + k, stride)) <= kCoarser * kGainTolerance * n.gain[k] + kFaintGain;
    const bool tone = std::abs(missed(n.tone + k, stride)) <=
                      kCoarser * (kGainTolerance * std::abs(n.tone[k]) + n.tone_floor);
    good[k] = static_cast<std::uint8_t>(good[k] & ((place & gain & tone) ? 1 : 0));
  }
}
Dispatched<check_loop> check;

// Radians on the sky.
[[gnu::always_inline]] inline void set_tolerances_loop(const float* wide, const float* narrow,
                                                       int count, float* tolerance) {
  constexpr float kNarrowest = 0.1f;  // of the longer side: an Einstein ring's is 0
  for (int k = 0; k < count; ++k) {
    const float least = kNarrowest * wide[k];
    tolerance[k] =
        static_cast<float>(RayGrid::kTolerance) * (narrow[k] > least ? narrow[k] : least);
  }
}
Dispatched<set_tolerances_loop> set_tolerances;

}  // namespace

void RayGrid::make(const PixelShader& shader, const std::vector<CameraDirection>& special) {
  shader_ = &shader;
  projection_ = shader.scene().projection();
  cell_columns_ = (columns(projection_) + kStep - 1) / kStep;
  cell_rows_ = (rows(projection_) + kStep - 1) / kStep;
  node_columns_ = cell_columns_ + 1 + 2 * kMargin;
  node_rows_ = cell_rows_ + 1 + 2 * kMargin;
  const std::size_t nodes = at(node_rows_, 0);
  for (auto& quantity : nodes_) quantity.resize(nodes + kPadding);
  tolerance_.resize(nodes), edge_.resize(nodes), sky_.resize(nodes), run_.resize(nodes);
  kinds_.resize(nodes);
  good_.assign(nodes, 1);
  cells_.resize(static_cast<std::size_t>(cell_rows_) * static_cast<std::size_t>(cell_columns_));
  tone_floor_ = kToneTolerance;
  for (const SkyRegion sky : kEverySky)
    if (shader.sampler(sky) && shader.sampler(sky)->map().kind() == SkyMapKind::kColour)
      tone_floor_ = kFaintGain;
  special_.clear();
  for (const CameraDirection& n : special)
    if (const auto pixel = pixel_of(projection_, n))
      special_.push_back({pixel->i - 1, pixel->j - 1});
  tbb::parallel_for(0, node_rows_, [this](int row) { trace_row(row); });
  tbb::parallel_for(kMargin, node_rows_ - kMargin, [this](int row) { check_row(row); });
  tbb::parallel_for(0, cell_rows_, [this](int row) { classify_row(row); });
}

// The nodes of a row that cells with pixels in the picture ask for; of a dome, those about its disc.
std::pair<int, int> RayGrid::needed_nodes(int row) const {
  if (!std::holds_alternative<Domemaster>(projection_)) return {0, node_columns_};
  const double middle = (columns(projection_) - 1) / 2.0;
  const double y =
      std::max(std::abs((row - kMargin) * kStep - middle) - (kMargin + 1) * kStep, 0.0);
  const double half = std::sqrt(std::max(middle * middle - y * y, 0.0)) + (kMargin + 2) * kStep;
  return {std::clamp(static_cast<int>((middle - half) / kStep) + kMargin, 0, node_columns_),
          std::clamp(static_cast<int>((middle + half) / kStep) + kMargin + 1, 0, node_columns_)};
}

void RayGrid::trace_row(int row) {
  ViewRayBatch batch;
  std::array<CameraDirection, ViewRayBatch::kSize> n;
  ViewRayBatch::Column<double> i, j, angle;
  j.fill((row - kMargin) * kStep + 1.0);
  const auto [from, to] = needed_nodes(row);
  for (int first = from; first < to; first += ViewRayBatch::kSize) {
    const int count = std::min(ViewRayBatch::kSize, to - first);
    for (int k = 0; k < count; ++k) i[k] = (first + k - kMargin) * kStep + 1.0;
    view_directions(projection_, i.data(), j.data(), count, n.data(), angle.data());
    shader_->scene().tracer.trace(n.data(), count, batch);
    store(at(row, first), batch, angle.data(), count);
  }
  // Where eight nodes in a row see one sky.
  const std::uint8_t* sky = sky_.data() + at(row, 0);
  std::uint8_t* run = run_.data() + at(row, 0);
  for (int k = 0; k < cell_columns_; ++k) {
    bool same = true;
    for (int m = 1; m < 2 * kMargin + 2; ++m) same &= sky[k + m] == sky[k];
    run[k] = same ? sky[k] : kMixed;
  }
}

void RayGrid::store(std::size_t node, const ViewRayBatch& batch, const double* angle, int count) {
  const auto of = [&](Quantity q) { return &nodes_[q][node]; };
  PerSky<std::uint8_t> skies{};
  bool any = false;
  for (const SkyRegion sky : kEverySky) {
    const bool map = shader_->sampler(sky) != nullptr;
    skies[sky] = !shader_->scene().background[sky] ? kDark
                 : map                             ? static_cast<std::uint8_t>(sky)
                                                   : kMixed;
  }
  for (int k = 0; k < count; ++k) {
    const std::uint8_t sky = skies[batch.sky[k]];
    sky_[node + k] = sky;
    edge_[node + k] = static_cast<float>(batch.to_edge[k] / (angle[k] * kStep));
    any |= sky < kDark;
  }
  if (!any) return;
  set_footprints(
      batch, angle, count,
      {of(kX), of(kY), of(kZ), of(kWide), of(kNarrow), of(kAlongX), of(kAlongY), of(kAlongZ)});
  set_tolerances(of(kWide), of(kNarrow), count, &tolerance_[node]);
  ViewRayBatch::Column<float> first, second;
  ViewRayBatch::Column<SampleKind> kinds;
  for (const SkyRegion sky : kEverySky) {
    const SkySampler* sampler = shader_->sampler(sky);
    const auto end = batch.sky.begin() + count;
    if (sampler == nullptr || std::find(batch.sky.begin(), end, sky) == end) continue;
    sampler->choose_kinds(of(kWide), of(kNarrow), count, SkySampler::kMostTaps, HUGE_VALF,
                          kinds.data());
    const SkyLight& light = *shader_->scene().background[sky];
    const bool thermal = sampler->map().kind() == SkyMapKind::kThermal;
    const double* g = batch.frequency_ratio.data();
    if (thermal)
      light.shifts(g, count, first.data(), second.data());
    else
      light.shift_sides(g, count, first.data(), second.data());
    for (int k = 0; k < count; ++k) {
      if (batch.sky[k] != sky) continue;
      of(kGain)[k] = first[k], of(kTone)[k] = second[k];
      kinds_[node + k] = kinds[k];
    }
  }
}

void RayGrid::check_row(int row) {
  const std::size_t first = at(row, kMargin);
  const Checked nodes{
      &nodes_[kX][first],    &nodes_[kY][first], &nodes_[kZ][first], &nodes_[kGain][first],
      &nodes_[kTone][first], &tolerance_[first], tone_floor_};
  const int count = cell_columns_ + 1;
  check(nodes, 1, count, &good_[first]);
  check(nodes, node_columns_, count, &good_[first]);
}

bool RayGrid::is_smooth(int row, int column) const {
  for (int k = 0; k < 2 * kMargin + 2; ++k)
    if (run_[at(row + k, column)] != sky_[at(row, column)]) return false;
  for (int j = row + kMargin; j <= row + kMargin + 1; ++j)
    for (int i = column + kMargin; i <= column + kMargin + 1; ++i)
      if (!good_[at(j, i)] || !(edge_[at(j, i)] > kEdgeCells)) return false;
  return std::none_of(special_.begin(), special_.end(), [&](const PixelPosition& p) {
    return std::hypot(p.i / kStep - column, p.j / kStep - row) < kSpecialCells;
  });
}

// Whether any of a cell's pixels is in the picture.
bool RayGrid::in_picture(int row, int column) const {
  if (!std::holds_alternative<Domemaster>(projection_)) return true;
  const double middle = (columns(projection_) - 1) / 2.0, radius = columns(projection_) / 2.0;
  const auto away = [middle](int cell) {
    return std::max({cell * kStep - middle, middle - (cell * kStep + kStep - 1), 0.0});
  };
  const double x = away(column), y = away(row);
  return x * x + y * y <= radius * radius;
}

RayGrid::Cell RayGrid::classified(int row, int column) const {
  Cell cell;
  if (!in_picture(row, column)) return cell;
  const std::array<std::size_t, 4> corners{
      at(row + kMargin, column + kMargin), at(row + kMargin, column + kMargin + 1),
      at(row + kMargin + 1, column + kMargin), at(row + kMargin + 1, column + kMargin + 1)};
  if (std::all_of(corners.begin(), corners.end(),
                  [&](std::size_t n) { return sky_[n] == kDark && edge_[n] > kDarkCells; }))
    return cell;
  cell.kind = Kind::kExact;
  if (sky_[corners[0]] >= kDark || !is_smooth(row, column)) return cell;
  cell.kind = Kind::kSmooth;
  cell.sky = static_cast<SkyRegion>(sky_[corners[0]]);
  cell.plain = std::all_of(corners.begin(), corners.end(),
                           [&](std::size_t n) { return kinds_[n].is_plain(); });
  return cell;
}

void RayGrid::classify_row(int row) {
  for (int column = 0; column < cell_columns_; ++column)
    cells_[static_cast<std::size_t>(row * cell_columns_ + column)] = classified(row, column);
}

double RayGrid::traced_fraction() const {
  std::size_t exact = 0, all = 0;
  for (const Cell& cell : cells_)
    exact += cell.kind == Kind::kExact, all += cell.kind != Kind::kNothing;
  return all > 0 ? static_cast<double>(exact) / static_cast<double>(all) : 0;
}

}  // namespace domefall
