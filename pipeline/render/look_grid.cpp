#include "pipeline/render/look_grid.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

#include "pipeline/render/simd.h"

namespace domefall {
namespace {

constexpr int kStep = LookGrid::kStep;
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

struct Weights {
  float w[4];
};

// Lagrange's cubic through -1, 0, 1 and 2 at t in [0, 1].
constexpr Weights cubic_weights(double t) {
  return {{static_cast<float>(-t * (t - 1) * (t - 2) / 6),
           static_cast<float>((t + 1) * (t - 1) * (t - 2) / 2),
           static_cast<float>(-(t + 1) * t * (t - 2) / 2),
           static_cast<float>((t + 1) * t * (t - 1) / 6)}};
}

constexpr std::array<Weights, kStep> kCubic = [] {
  std::array<Weights, kStep> table{};
  for (int k = 0; k < kStep; ++k) table[k] = cubic_weights(static_cast<double>(k) / kStep);
  return table;
}();

[[gnu::always_inline]] inline void mix_four_loop(const float* a, const float* b, const float* c,
                                                 const float* d, const Weights& weights, int count,
                                                 float* out) {
  const Weights w = weights;
  for (int k = 0; k < count; ++k)
    out[k] = w.w[0] * a[k] + w.w[1] * b[k] + w.w[2] * c[k] + w.w[3] * d[k];
}
Dispatched<mix_four_loop> mix_four;

[[gnu::always_inline]] inline void mix_two_loop(const float* a, const float* b, float t, int count,
                                                float* out) {
  for (int k = 0; k < count; ++k) out[k] = a[k] + t * (b[k] - a[k]);
}
Dispatched<mix_two_loop> mix_two;

// kStep pixels for each cell; `line` begins one node before the first of them.
[[gnu::always_inline]] inline void spread_cubic_loop(const float* line, int cells, float* out) {
  float w[4][kStep];
  for (int n = 0; n < 4; ++n)
    for (int k = 0; k < kStep; ++k) w[n][k] = kCubic[k].w[n];
  for (int c = 0; c < cells; ++c, out += kStep) {
    const float p = line[c], q = line[c + 1], r = line[c + 2], s = line[c + 3];
    for (int k = 0; k < kStep; ++k) out[k] = w[0][k] * p + w[1][k] * q + w[2][k] * r + w[3][k] * s;
  }
}
Dispatched<spread_cubic_loop> spread_cubic;

[[gnu::always_inline]] inline void spread_linear_loop(const float* line, int cells, float* out) {
  for (int c = 0; c < cells; ++c, out += kStep) {
    const float from = line[c + 1], by = (line[c + 2] - line[c + 1]) * (1.0f / kStep);
    for (int k = 0; k < kStep; ++k) out[k] = from + static_cast<float>(k) * by;
  }
}
Dispatched<spread_linear_loop> spread_linear;

// Of a panorama: ShiftSides become the shift.
[[gnu::always_inline]] inline void choose_side_loop(const float* red, const float* blue, float knee,
                                                    int count, float* gain) {
  for (int k = 0; k < count; ++k) gain[k] = red[k] > knee ? blue[k] : red[k];
}
Dispatched<choose_side_loop> choose_side;

// What the cubic through the second next neighbours errs by.
inline float missed(const float* p, std::ptrdiff_t stride) {
  const float between =
      (9 * (p[-stride] + p[stride]) - (p[-3 * stride] + p[3 * stride])) * (1.0f / 16);
  return std::abs(between - p[0]);
}

struct Checked {
  const float *x, *y, *z, *gain, *tone, *tolerance;
  float tone_floor;
};

// Along a line of nodes, or across it with a stride.  A comparison with NaN is false: not good.
[[gnu::always_inline]] inline void check_loop(const Checked& nodes, std::ptrdiff_t stride,
                                              int count, std::uint8_t* good) {
  const Checked n = nodes;
  for (int k = 0; k < count; ++k) {
    const float x = missed(n.x + k, stride), y = missed(n.y + k, stride),
                z = missed(n.z + k, stride);
    const float most = kCoarser * n.tolerance[k];
    const bool place = x * x + y * y + z * z <= most * most;
    const bool gain =
        missed(n.gain + k, stride) <= kCoarser * kGainTolerance * n.gain[k] + kFaintGain;
    const bool tone = missed(n.tone + k, stride) <=
                      kCoarser * (kGainTolerance * std::abs(n.tone[k]) + n.tone_floor);
    good[k] = static_cast<std::uint8_t>(good[k] & ((place & gain & tone) ? 1 : 0));
  }
}
Dispatched<check_loop> check;

}  // namespace

void LookGrid::make(const Projection& projection, const PixelLight& light,
                    const std::vector<CameraDirection>& special) {
  projection_ = projection, light_ = &light;
  cell_columns_ = (columns(projection) + kStep - 1) / kStep;
  cell_rows_ = (rows(projection) + kStep - 1) / kStep;
  node_columns_ = cell_columns_ + 1 + 2 * kMargin;
  node_rows_ = cell_rows_ + 1 + 2 * kMargin;
  const std::size_t nodes = at(node_rows_, 0);
  for (auto& quantity : nodes_) quantity.resize(nodes);
  tolerance_.resize(nodes), edge_.resize(nodes), sky_.resize(nodes), run_.resize(nodes);
  good_.assign(nodes, 1);
  cells_.resize(static_cast<std::size_t>(cell_rows_) * static_cast<std::size_t>(cell_columns_));
  tone_floor_ = kToneTolerance;
  for (const SeenSky sky : kEverySky)
    if (light.sampler(sky) && light.sampler(sky)->map().kind() == SkyMapKind::kColour)
      tone_floor_ = kFaintGain;
  special_.clear();
  for (const CameraDirection& n : special)
    if (const auto pixel = pixel_of(projection, n))
      special_.push_back({pixel->i - 1, pixel->j - 1});
  tbb::parallel_for(0, node_rows_, [this](int row) { look_at_row(row); });
  tbb::parallel_for(kMargin, node_rows_ - kMargin, [this](int row) { check_row(row); });
  tbb::parallel_for(0, cell_rows_, [this](int row) { classify_row(row); });
}

// The nodes of a row that cells with pixels in the picture ask for; of a dome, those about its disc.
std::pair<int, int> LookGrid::needed_nodes(int row) const {
  if (!std::holds_alternative<Domemaster>(projection_)) return {0, node_columns_};
  const double middle = (columns(projection_) - 1) / 2.0;
  const double y =
      std::max(std::abs((row - kMargin) * kStep - middle) - (kMargin + 1) * kStep, 0.0);
  const double half = std::sqrt(std::max(middle * middle - y * y, 0.0)) + (kMargin + 2) * kStep;
  return {std::clamp(static_cast<int>((middle - half) / kStep) + kMargin, 0, node_columns_),
          std::clamp(static_cast<int>((middle + half) / kStep) + kMargin + 1, 0, node_columns_)};
}

void LookGrid::look_at_row(int row) {
  const double j = (row - kMargin) * kStep + 1.0;
  LookBatch batch;
  std::array<CameraDirection, LookBatch::kSize> n;
  const auto [from, to] = needed_nodes(row);
  for (int first = from; first < to; first += LookBatch::kSize) {
    const int count = std::min(LookBatch::kSize, to - first);
    directions_along(projection_, {(first - kMargin) * kStep + 1.0, j}, kStep, count, n.data());
    light_->tracer().look(n.data(), count, batch);
    for (int k = 0; k < count; ++k)
      store(at(row, first + k), batch, k,
            pixel_angle(projection_, {(first + k - kMargin) * kStep + 1.0, j}));
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

void LookGrid::store(std::size_t node, const LookBatch& batch, int k, double pixel) {
  const SeenSky sky = batch.sky[k];
  const SkySampler* sampler = light_->sampler(sky);
  edge_[node] = static_cast<float>(batch.to_edge[k] / (pixel * kStep));
  sky_[node] = light_->is_dark(sky) ? kDark : sampler ? static_cast<std::uint8_t>(sky) : kMixed;
  if (!sampler) return;
  const double longer = std::max(batch.radial_scale[k], batch.tangential_scale[k]);
  const double shorter = std::min(batch.radial_scale[k], batch.tangential_scale[k]);
  const V3d on_sky = batch.sky_direction(k);
  V3d along = batch.along(k);
  if (batch.tangential_scale[k] > batch.radial_scale[k]) along = along.cross(on_sky);
  along *= longer * pixel;
  const double g = batch.frequency_ratio[k];
  const bool thermal = sampler->map().kind() == SkyMapKind::kThermal;
  const MapShift shift = thermal ? light_->shift(sky, g) : MapShift{};
  ShiftSides sides{};
  if (!thermal) light_->shift_sides(sky, &g, 1, &sides.red, &sides.blue);
  const std::array<double, kQuantities> values{on_sky.x,
                                               on_sky.y,
                                               on_sky.z,
                                               thermal ? shift.gain : sides.red,
                                               thermal ? shift.tone : sides.blue,
                                               longer * pixel,
                                               shorter * pixel,
                                               along.x,
                                               along.y,
                                               along.z};
  for (std::size_t q = 0; q < kQuantities; ++q) nodes_[q][node] = static_cast<float>(values[q]);
  constexpr double kNarrowest = 0.1;  // of the longer side: an Einstein ring's is 0
  tolerance_[node] =
      static_cast<float>(kTolerance * pixel * std::max(shorter, kNarrowest * longer));
}

void LookGrid::check_row(int row) {
  const std::size_t first = at(row, kMargin);
  const Checked nodes{
      &nodes_[kX][first],    &nodes_[kY][first], &nodes_[kZ][first], &nodes_[kGain][first],
      &nodes_[kTone][first], &tolerance_[first], tone_floor_};
  const int count = cell_columns_ + 1;
  check(nodes, 1, count, &good_[first]);
  check(nodes, node_columns_, count, &good_[first]);
}

bool LookGrid::is_smooth(int row, int column) const {
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
bool LookGrid::in_picture(int row, int column) const {
  if (!std::holds_alternative<Domemaster>(projection_)) return true;
  const double middle = (columns(projection_) - 1) / 2.0;
  const auto away = [middle](int cell) {
    return std::max({cell * kStep - middle, middle - (cell * kStep + kStep - 1), 0.0});
  };
  return std::hypot(away(row), away(column)) <= columns(projection_) / 2.0;
}

LookGrid::Cell LookGrid::classified(int row, int column) const {
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
  cell.sky = static_cast<SeenSky>(sky_[corners[0]]);
  const SkySampler& sampler = *light_->sampler(cell.sky);
  for (const std::size_t n : corners)
    cell.taps = std::max(
        cell.taps, static_cast<std::uint8_t>(sampler.taps(nodes_[kWide][n], nodes_[kNarrow][n])));
  for (const std::size_t n : corners)
    cell.minified |= sampler.is_minified(nodes_[kWide][n], nodes_[kNarrow][n], cell.taps);
  return cell;
}

void LookGrid::classify_row(int row) {
  for (int column = 0; column < cell_columns_; ++column)
    cells_[static_cast<std::size_t>(row * cell_columns_ + column)] = classified(row, column);
}

double LookGrid::exact_part() const {
  std::size_t exact = 0, all = 0;
  for (const Cell& cell : cells_)
    exact += cell.kind == Kind::kExact, all += cell.kind != Kind::kNothing;
  return all > 0 ? static_cast<double>(exact) / static_cast<double>(all) : 0;
}

void LookGrid::line_at(int cell_row, int row, Line& line) const {
  const auto w = static_cast<std::size_t>(row);
  const float t = static_cast<float>(row) / kStep;
  for (int q = 0; q < kQuantities; ++q) {
    auto& out = line.quantity[static_cast<std::size_t>(q)];
    out.resize(static_cast<std::size_t>(node_columns_));
    const float* first = nodes_[static_cast<std::size_t>(q)].data() + at(cell_row + kMargin - 1, 0);
    const auto stride = static_cast<std::size_t>(node_columns_);
    if (q < kCubics)
      mix_four(first, first + stride, first + 2 * stride, first + 3 * stride, kCubic[w],
               node_columns_, out.data());
    else
      mix_two(first + stride, first + 2 * stride, t, node_columns_, out.data());
  }
}

void LookGrid::places(const Line& line, const Cell& cell, int first, int end,
                      SkyPlaces& out) const {
  const int cells = end - first, from = first + kMargin - 1;
  const auto of = [&](Quantity q) {
    return line.quantity[static_cast<std::size_t>(q)].data() + from;
  };
  spread_cubic(of(kX), cells, out.x.data());
  spread_cubic(of(kY), cells, out.y.data());
  spread_cubic(of(kZ), cells, out.z.data());
  spread_cubic(of(kGain), cells, out.gain.data());
  spread_cubic(of(kTone), cells, out.tone.data());
  if (light_->sampler(cell.sky)->map().kind() == SkyMapKind::kColour)
    choose_side(out.gain.data(), out.tone.data(), light_->knee(cell.sky), cells * kStep,
                out.gain.data());
  if (cell.taps > 1 || cell.minified) spread_linear(of(kWide), cells, out.wide.data());
  if (cell.taps == 1) return;
  spread_linear(of(kNarrow), cells, out.narrow.data());
  spread_linear(of(kAlongX), cells, out.ax.data());
  spread_linear(of(kAlongY), cells, out.ay.data());
  spread_linear(of(kAlongZ), cells, out.az.data());
}

}  // namespace domefall
