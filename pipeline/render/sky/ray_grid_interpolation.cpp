// Between the nodes of a RayGrid.
#include <array>
#include <cstring>

#include "pipeline/render/sky/ray_grid.h"
#include "pipeline/simd/dispatch.h"
#include "pipeline/simd/lanes.h"

namespace domefall {
namespace {

constexpr int kStep = RayGrid::kStep;
constexpr int kMostCells = FootprintBatch::kSize / kStep;
// Nodes are mixed in whole registers: the three about the cells besides their own, and what fills up.
constexpr int kMostNodes = kMostCells + 16, kBlockNodes = 16;

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

// kCubic, the other way round: of the pixels of a cell, in one register.
static_assert(kStep == kLanes);
constexpr std::array<std::array<float, kStep>, 4> kSpreading = [] {
  std::array<std::array<float, kStep>, 4> s{};
  for (int n = 0; n < 4; ++n)
    for (int k = 0; k < kStep; ++k) s[n][k] = kCubic[k].w[n];
  return s;
}();
constexpr std::array<float, kStep> kEven{0, 1, 2, 3, 4, 5, 6, 7};

[[gnu::always_inline]] inline void load(const std::array<float, kStep>& from, Lanes& to) {
  std::memcpy(&to, from.data(), sizeof to);
}

// `nodes` begins one row above the cells and one column before the first of them; pixels of a cell are in
// out[0..kStep), those of the next one `apart` farther on.
struct Nodes {
  const float* nodes;
  std::ptrdiff_t stride;
  int cells;
};

template <int kMost>
[[gnu::always_inline]] inline void cubic_row(const Nodes& in, int row, std::ptrdiff_t apart,
                                             float* out) {
  const float *a = in.nodes, *b = a + in.stride, *c = b + in.stride, *d = c + in.stride;
  const Weights by = kCubic[row];
  float line[kMost];
  const int mixed = (in.cells + 3 + 15) / 16 * 16;
  for (int k = 0; k < mixed; ++k)
    line[k] = by.w[0] * a[k] + by.w[1] * b[k] + by.w[2] * c[k] + by.w[3] * d[k];
  Lanes s0, s1, s2, s3;
  load(kSpreading[0], s0), load(kSpreading[1], s1), load(kSpreading[2], s2),
      load(kSpreading[3], s3);
  for (int cell = 0; cell < in.cells; ++cell, out += apart) {
    const Lanes pixels =
        s0 * line[cell] + s1 * line[cell + 1] + s2 * line[cell + 2] + s3 * line[cell + 3];
    std::memcpy(out, &pixels, sizeof pixels);
  }
}

[[gnu::always_inline]] inline void spread_row_loop(const Nodes& nodes, int row, float* out) {
  cubic_row<kMostNodes>(nodes, row, kStep, out);
}
Dispatched<spread_row_loop> spread_row;

[[gnu::always_inline]] inline void spread_block_loop(const Nodes& nodes, float* out) {
  for (int row = 0; row < kStep; ++row)
    cubic_row<kBlockNodes>(nodes, row, kStep * kStep, out + row * kStep);
}
Dispatched<spread_block_loop> spread_block;

[[gnu::always_inline]] inline void spread_block_evenly_loop(const Nodes& in, float* out) {
  const float *above = in.nodes + in.stride, *below = above + in.stride;
  Lanes even;
  load(kEven, even);
  for (int row = 0; row < kStep; ++row) {
    const float t = static_cast<float>(row) / kStep;
    float* to = out + row * kStep;
    for (int cell = 1; cell <= in.cells; ++cell, to += kStep * kStep) {
      const float left = above[cell] + t * (below[cell] - above[cell]);
      const float right = above[cell + 1] + t * (below[cell + 1] - above[cell + 1]);
      const float by = (right - left) * (1.0f / kStep);
      const Lanes pixels = left + even * by;
      std::memcpy(to, &pixels, sizeof pixels);
    }
  }
}
Dispatched<spread_block_evenly_loop> spread_block_evenly;

// Of a panorama: ShiftSides become the shift.
[[gnu::always_inline]] inline void choose_loop(const float* red, const float* blue, float knee,
                                               int count, float* gain) {
  for (int k = 0; k < count; ++k) gain[k] = red[k] > knee ? blue[k] : red[k];
}
Dispatched<choose_loop> choose;

}  // namespace

void RayGrid::choose_side(int cell_row, int cell, int count, FootprintBatch& out) const {
  const SkyRegion sky = this->cell(cell_row, cell).sky;
  if (shader_->sampler(sky)->map().kind() == SkyMapKind::kColour)
    choose(out.gain.data(), out.tone.data(), shader_->scene().background[sky]->knee(), count,
           out.gain.data());
}

void RayGrid::interpolate_row(int cell_row, int row, int first, int end,
                              FootprintBatch& out) const {
  const int cells = end - first;
  const auto spread = [&](Quantity q, FootprintBatch::Column& to) {
    spread_row({corner(q, cell_row, first), node_columns_, cells}, row, to.data());
  };
  spread(kX, out.x), spread(kY, out.y), spread(kZ, out.z);
  spread(kGain, out.gain), spread(kTone, out.tone);
  choose_side(cell_row, first, cells * kStep, out);
}

void RayGrid::interpolate_block(int cell_row, int first, int end, FootprintBatch& out) const {
  const int cells = end - first;
  const auto nodes = [&](Quantity q) {
    return Nodes{corner(q, cell_row, first), node_columns_, cells};
  };
  spread_block(nodes(kX), out.x.data()), spread_block(nodes(kY), out.y.data());
  spread_block(nodes(kZ), out.z.data());
  spread_block(nodes(kGain), out.gain.data()), spread_block(nodes(kTone), out.tone.data());
  choose_side(cell_row, first, cells * kStep * kStep, out);
  spread_block_evenly(nodes(kWide), out.wide.data());
  spread_block_evenly(nodes(kNarrow), out.narrow.data());
  spread_block_evenly(nodes(kAlongX), out.ax.data());
  spread_block_evenly(nodes(kAlongY), out.ay.data());
  spread_block_evenly(nodes(kAlongZ), out.az.data());
}

}  // namespace domefall
