// These functions of RayGrid interpolate pixels between its nodes.
#include <array>
#include <cstring>

#include "pipeline/base/simd/dispatch.h"
#include "pipeline/base/simd/lanes.h"
#include "pipeline/render/sky/ray_grid.h"

namespace domefall {
namespace {

constexpr int kStep = RayGrid::kStep;
constexpr int kMostCells = SampleBatch::kSize / kStep;
// Cells depend on three more nodes than there are cells.  Their number is rounded up to whole
// registers.
constexpr int kMostNodes = kMostCells + 16, kBlockNodes = 16;

// Weights belong to four successive nodes.
struct Weights {
  float w[4];
};

// Returns the weights of Lagrange's cubic through nodes at -1, 0, 1 and 2, evaluated at t
// in [0, 1].  The weight of node n is the product of (t - m)/(n - m) over the other nodes m.
constexpr Weights cubic_weights(double t) {
  return {{static_cast<float>(-t * (t - 1) * (t - 2) / 6),
           static_cast<float>((t + 1) * (t - 1) * (t - 2) / 2),
           static_cast<float>(-(t + 1) * t * (t - 2) / 2),
           static_cast<float>((t + 1) * t * (t - 1) / 6)}};
}

// This table has, for each pixel of a cell, the weights of the four nodes.
constexpr std::array<Weights, kStep> kPixelWeights = [] {
  std::array<Weights, kStep> table{};
  for (int k = 0; k < kStep; ++k) table[k] = cubic_weights(static_cast<double>(k) / kStep);
  return table;
}();

// This table has, for each node, the weights for the eight pixels of a cell.  They fill one
// register.
static_assert(kStep == kLanes);
constexpr std::array<std::array<float, kStep>, 4> kNodeWeights = [] {
  std::array<std::array<float, kStep>, 4> table{};
  for (int n = 0; n < 4; ++n)
    for (int k = 0; k < kStep; ++k) table[n][k] = kPixelWeights[k].w[n];
  return table;
}();
constexpr std::array<float, kStep> kPixelNumbers{0, 1, 2, 3, 4, 5, 6, 7};

[[gnu::always_inline]] inline void load(const std::array<float, kStep>& from, Lanes& to) {
  std::memcpy(&to, from.data(), sizeof to);
}

// A NodeWindow gives one quantity at the nodes around a row of cells.  `first` is one row above the
// first cell and one column before it.
struct NodeWindow {
  const float* first;
  std::ptrdiff_t stride;
  int cells;
};

// Interpolates one row of pixels, first between four rows of nodes and then along the row.  The
// eight pixels of a cell are stored side by side, and those of the next cell `cell_stride` floats
// farther on.
template <int kMost>
[[gnu::always_inline]] inline void interpolate_cubic(const NodeWindow& in, int row,
                                                     std::ptrdiff_t cell_stride, float* out) {
  const float *a = in.first, *b = a + in.stride, *c = b + in.stride, *d = c + in.stride;
  const Weights by = kPixelWeights[row];
  float line[kMost];
  // The loop runs over whole registers and reads padding beyond the last node.
  const int nodes = (in.cells + 3 + 15) / 16 * 16;
  for (int k = 0; k < nodes; ++k)
    line[k] = by.w[0] * a[k] + by.w[1] * b[k] + by.w[2] * c[k] + by.w[3] * d[k];
  Lanes w0, w1, w2, w3;
  load(kNodeWeights[0], w0);
  load(kNodeWeights[1], w1);
  load(kNodeWeights[2], w2);
  load(kNodeWeights[3], w3);
  for (int cell = 0; cell < in.cells; ++cell, out += cell_stride) {
    const Lanes pixels =
        w0 * line[cell] + w1 * line[cell + 1] + w2 * line[cell + 2] + w3 * line[cell + 3];
    std::memcpy(out, &pixels, sizeof pixels);
  }
}

[[gnu::always_inline]] inline void row_cubic_loop(const NodeWindow& in, int row, float* out) {
  interpolate_cubic<kMostNodes>(in, row, kStep, out);
}
Dispatched<row_cubic_loop> row_cubic;

[[gnu::always_inline]] inline void block_cubic_loop(const NodeWindow& in, float* out) {
  for (int row = 0; row < kStep; ++row)
    interpolate_cubic<kBlockNodes>(in, row, kStep * kStep, out + row * kStep);
}
Dispatched<block_cubic_loop> block_cubic;

// Interpolates linearly between the four corners of each cell, which is accurate enough for
// footprints.
[[gnu::always_inline]] inline void block_linear_loop(const NodeWindow& in, float* out) {
  const float *above = in.first + in.stride, *below = above + in.stride;
  Lanes numbers;
  load(kPixelNumbers, numbers);
  for (int row = 0; row < kStep; ++row) {
    const float t = static_cast<float>(row) / kStep;
    float* to = out + row * kStep;
    // The window begins one node before the first cell.
    for (int cell = 1; cell <= in.cells; ++cell, to += kStep * kStep) {
      const float left = above[cell] + t * (below[cell] - above[cell]);
      const float right = above[cell + 1] + t * (below[cell + 1] - above[cell + 1]);
      const float slope = (right - left) * (1.0f / kStep);
      const Lanes pixels = left + numbers * slope;
      std::memcpy(to, &pixels, sizeof pixels);
    }
  }
}
Dispatched<block_linear_loop> block_linear;

// Chooses one of the two sides of a panorama's shift (SkyLight::shift_sides).
[[gnu::always_inline]] inline void choose_loop(const float* red, const float* blue, float knee,
                                               int count, float* gain) {
  for (int k = 0; k < count; ++k) gain[k] = red[k] > knee ? blue[k] : red[k];
}
Dispatched<choose_loop> choose;

}  // namespace

void RayGrid::choose_side(int cell_row, int cell, int count, SampleBatch& out) const {
  const SkyRegion sky = this->cell(cell_row, cell).sky;
  const SkySampler* sampler = shader_->sampler(sky);
  if (sampler != nullptr && sampler->map().kind() == SkyMapKind::kColour)
    choose(out.gain.data(), out.tone.data(), shader_->scene().background[sky]->knee(), count,
           out.gain.data());
}

void RayGrid::interpolate_row(int cell_row, int row, int first, int end, SampleBatch& out) const {
  const int cells = end - first;
  const auto cubic = [&](Quantity q, SampleBatch::Column& to) {
    row_cubic({first_node(q, cell_row, first), node_columns_, cells}, row, to.data());
  };
  cubic(kX, out.x);
  cubic(kY, out.y);
  cubic(kZ, out.z);
  cubic(kGain, out.gain);
  cubic(kTone, out.tone);
  choose_side(cell_row, first, cells * kStep, out);
}

void RayGrid::interpolate_block(int cell_row, int first, int end, SampleBatch& out) const {
  const int cells = end - first;
  const auto nodes = [&](Quantity q) {
    return NodeWindow{first_node(q, cell_row, first), node_columns_, cells};
  };
  block_cubic(nodes(kX), out.x.data());
  block_cubic(nodes(kY), out.y.data());
  block_cubic(nodes(kZ), out.z.data());
  block_cubic(nodes(kGain), out.gain.data());
  block_cubic(nodes(kTone), out.tone.data());
  choose_side(cell_row, first, cells * kStep * kStep, out);
  block_linear(nodes(kWide), out.wide.data());
  block_linear(nodes(kNarrow), out.narrow.data());
  block_linear(nodes(kAxisX), out.ax.data());
  block_linear(nodes(kAxisY), out.ay.data());
  block_linear(nodes(kAxisZ), out.az.data());
}

}  // namespace domefall
