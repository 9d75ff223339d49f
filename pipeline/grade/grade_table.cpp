#include "pipeline/grade/grade_table.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <utility>

#include "pipeline/grade/table_lookup.h"

namespace domefall {

namespace cells = grade_cells;

namespace {

// The work is shared out in blocks of planes.  A plane is all nodes of one order that have the same
// largest channel.
constexpr int kPlanesInBlock = 16;
constexpr int kBlocksInOrder = (cells::kLargest + kPlanesInBlock - 1) / kPlanesInBlock;
constexpr int kBlocks = cells::kOrders * kBlocksInOrder;
constexpr int kPlaneCells = cells::kInnerGreys * cells::kInnerHues;

template <class Step>
void for_planes(int block, int count, const Step& step) {
  const int order = block / kBlocksInOrder, first = block % kBlocksInOrder * kPlanesInBlock;
  for (int n = first; n < std::min(first + kPlanesInBlock, count); ++n) step(order, n);
}

std::size_t first_cell(int order, int n) {
  return static_cast<std::size_t>((order * cells::kCells + n) * kPlaneCells);
}

// A Probe says where a cell is compared, in steps from its middle node.  Along the largest channel
// it counts the steps of half floats.
struct Probe {
  float grey, hue;
  int largest;
};
constexpr std::array kProbes{
    Probe{0.5f, 0.5f, cells::kNodeStep / 2}, Probe{-0.5f, -0.5f, cells::kNodeStep / 2},
    Probe{-0.5f, 0.5f, cells::kNodeStep / 4}, Probe{0.5f, -0.5f, 3 * cells::kNodeStep / 4},
    Probe{0, 0, cells::kNodeStep / 2}};
// Most cells are so exact at the first two probes, or err so much there, that the others are left
// out.  These two are opposite corners.  The error of the line along the largest channel has the
// same sign at both, and that of the parabolas in grey and hue has opposite signs, so the two do
// not cancel at both.
constexpr int kFirstProbes = 2;
constexpr double kSmallPart = 0.1;
// Between the probes an error may be larger than at them.
constexpr double kProbedPart = 0.8;

// Returns the code of 0 to 1 that is shown.  A NaN is shown as black.
float clipped(float code) { return code > 0 ? std::min(code, 1.0f) : 0; }

// Says whether a channel leaves black within a cell.  It is then 0 at some of the cell's nodes, and
// not at others.  The display's gamma is infinitely steep there, which probes may miss.
bool leaves_black(const float* middle) {
  bool some[3]{}, all[3]{true, true, true};
  for (int i = -1; i <= 1; ++i)
    for (int j = -1; j <= 1; ++j)
      for (int n = 0; n <= 1; ++n) {
        const float* node = middle + i * cells::kRow + j * cells::kColumn + n * cells::kNode;
        for (int c = 0; c < 3; ++c) some[c] |= node[c] <= 0, all[c] &= node[c] <= 0;
      }
  return some[0] != all[0] || some[1] != all[1] || some[2] != all[2];
}

// Replaces each value of a line by the largest of it and its neighbours.
void spread(float* line, int count, std::ptrdiff_t step) {
  float before = 0;
  for (int k = 0; k < count; ++k, line += step) {
    const float after = k + 1 < count ? line[step] : 0;
    before = std::exchange(*line, std::max({before, *line, after}));
  }
}

// Does the same for all cells of an order along the largest channel, from plane to plane as they
// follow each other in memory.
void spread_planes(const float* errors, float* spread_out) {
  for (int n = 0; n < cells::kCells; ++n, errors += kPlaneCells, spread_out += kPlaneCells) {
    const float* before = n > 0 ? errors - kPlaneCells : errors;
    const float* after = n + 1 < cells::kCells ? errors + kPlaneCells : errors;
    for (int k = 0; k < kPlaneCells; ++k)
      spread_out[k] = std::max({before[k], errors[k], after[k]});
  }
}

}  // namespace

GradeTable::GradeTable(Formulas formulas)
    : formulas_(std::move(formulas)), filling_(kBlocks), comparing_(kBlocks), holding_(1) {}

void GradeTable::make() {
  if (made_) return;
  allocating_.take([this](int) {
    nodes_.resize(cells::kTable);
    errors_.resize(first_cell(cells::kOrders, 0));
  });
  filling_.take([this](int block) { fill(block); });
  comparing_.take([this](int block) { compare(block); });
  holding_.take([this](int) {
    hold();
    made_ = true;
  });
}

void GradeTable::fill(int block) {
  constexpr int kNodes = cells::kGreys * cells::kHues;
  std::vector<float> rgb(3 * kNodes), codes(3 * kNodes);
  for_planes(block, cells::kLargest, [&](int order, int n) {
    for (int k = 0; k < kNodes; ++k) {
      const int grey = k / cells::kHues, hue = k % cells::kHues;
      cells::put_pixel(order, cells::value_of(n * cells::kNodeStep), static_cast<float>(grey),
                       static_cast<float>(hue), &rgb[3 * k]);
    }
    formulas_(rgb.data(), kNodes, codes.data());
    for (int k = 0; k < kNodes; ++k)
      for (int c = 0; c < 3; ++c)
        nodes_[cells::node_at(order, n, k / cells::kHues, k % cells::kHues) + c] =
            clipped(codes[3 * k + c]) * 65535;
  });
}

void GradeTable::compare(int block) {
  std::vector<float> rgb(3 * kPlaneCells), codes(3 * kPlaneCells);
  std::vector<unsigned short> looked_up(3 * kPlaneCells + 1);
  std::vector<int> missed(kPlaneCells + 1), compared;
  cells::Places places;
  static_assert(kPlaneCells <= cells::Places::kSize);
  for_planes(block, cells::kCells, [&](int order, int n) {
    float* error = &errors_[first_cell(order, n)];
    compared.resize(kPlaneCells);
    std::iota(compared.begin(), compared.end(), 0);
    for (std::size_t p = 0; p < kProbes.size(); ++p) {
      const Probe& probe = kProbes[p];
      if (p == kFirstProbes)
        std::erase_if(compared, [&](int k) {
          return error[k] <= kSmallPart * kMostError || error[k] > kProbedPart * kMostError;
        });
      const int count = static_cast<int>(compared.size());
      if (count == 0) break;
      for (int k = 0; k < count; ++k) {
        const int i = compared[k] / cells::kInnerHues + 1, j = compared[k] % cells::kInnerHues + 1;
        cells::put_pixel(order, cells::value_of(n * cells::kNodeStep + probe.largest),
                         static_cast<float>(i) + probe.grey, static_cast<float>(j) + probe.hue,
                         &rgb[3 * k]);
        cells::put_place(places, k, cells::node_at(order, n, i, j), probe.grey, probe.hue,
                         static_cast<float>(probe.largest) / cells::kNodeStep);
      }
      formulas_(rgb.data(), count, codes.data());
      cells::interpolate(nodes_.data(), places, count, looked_up.data(), missed.data());
      for (int k = 0; k < 3 * count; ++k) {
        const float off = std::abs(static_cast<float>(looked_up[k]) / 65535 - clipped(codes[k]));
        float& most = error[compared[k / 3]];
        most = std::max(most, off);
      }
    }
  });
}

// A kink of the formulas passes through cells next to each other, and the probes of some of them
// miss it.  So a cell is held only if its neighbours are as good.
void GradeTable::hold() {
  std::vector<float> worst(errors_.size());
  for (int order = 0; order < cells::kOrders; ++order) {
    float* errors = &worst[first_cell(order, 0)];
    spread_planes(&errors_[first_cell(order, 0)], errors);
    for (int n = 0; n < cells::kCells; ++n, errors += kPlaneCells) {
      for (int j = 0; j < cells::kInnerHues; ++j)
        spread(errors + j, cells::kInnerGreys, cells::kInnerHues);
      for (int i = 0; i < cells::kInnerGreys; ++i)
        spread(errors + i * cells::kInnerHues, cells::kInnerHues, 1);
    }
  }
  std::size_t held = 0;
  for (std::size_t cell = 0; cell < worst.size(); ++cell) {
    if (!(worst[cell] <= kProbedPart * kMostError)) continue;
    const int k = static_cast<int>(cell), plane = k / kPlaneCells, at = k % kPlaneCells;
    float* middle = &nodes_[cells::node_at(plane / cells::kCells, plane % cells::kCells,
                                           at / cells::kInnerHues + 1, at % cells::kInnerHues + 1)];
    if (leaves_black(middle)) continue;
    middle[cells::kHeld] = 1;
    ++held;
    error_ = std::max<double>(error_, errors_[cell]);
  }
  held_ = static_cast<double>(held) / static_cast<double>(worst.size());
  errors_ = {};
}

int GradeTable::look_up(const PixelPlanes& planes, int count, unsigned short* out,
                        int* missed) const {
  cells::Places places;
  cells::locate(planes, count, places);
  return cells::interpolate(nodes_.data(), places, count, out, missed);
}

}  // namespace domefall
