#include "pipeline/grade/grade_table.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <bit>
#include <cmath>
#include <cstring>
#include <future>
#include <system_error>
#include <thread>

#include "pipeline/simd/dispatch.h"
#include "pipeline/simd/lanes.h"

namespace domefall {
namespace {

constexpr int kGreys = 21, kHues = 9, kOrders = 6, kStep = 32, kInfinity = 0x7c00;
constexpr int kLargest = kInfinity / kStep + 1;  // nodes of the largest channel
constexpr int kColumns = kOrders * kGreys * kHues;
// Nodes with a neighbour on either side.
constexpr int kInnerGreys = kGreys - 2, kInnerHues = kHues - 2;
constexpr int kCellColumns = kOrders * kInnerGreys * kInnerHues, kCells = kLargest - 1;
constexpr float kLeastGrey = 0.25f, kLeastRoot = 0.5f;  // and its square root
constexpr float kRootScale = (kGreys - 1) / (1 - kLeastRoot), kHueScale = kHues - 1;
constexpr float kWhite = 65535;

// The channels from the largest to the least, for each order: its number is that of
// (r >= g) + 2 (g >= b) + 4 (b >= r), less 1.
constexpr int kChannels[kOrders][3] = {{0, 2, 1}, {1, 0, 2}, {0, 1, 2},
                                       {2, 1, 0}, {2, 0, 1}, {1, 2, 0}};

int column_of(int order, int i, int j) { return (order * kGreys + i) * kHues + j; }

float value_of(int bits) {
  Imath::half h;
  h.setBits(static_cast<std::uint16_t>(std::min(bits, kInfinity - 1)));
  return h;
}

// A pixel by its largest channel and by its place between nodes.
void put_pixel(int order, float largest, float grey, float hue, float* rgb) {
  const float root = kLeastRoot + grey / kRootScale, least = root * root * largest;
  rgb[kChannels[order][0]] = largest;
  rgb[kChannels[order][1]] = least + hue / kHueScale * (largest - least);
  rgb[kChannels[order][2]] = least;
}

// Where pixels fall in the table: the middle one of three nodes each way, and how far from it.
struct Places {
  static constexpr int kSize = GradeTable::kMostPixels;
  alignas(64) std::array<std::int32_t, kSize> node, cell, outside, black;
  alignas(64) std::array<float, kSize> grey, hue, largest;  // in steps from node to node
};

// Shifted, a half's bits are those of a float that is 2^112 times too small.
[[gnu::always_inline]] inline float value_of_half(std::int32_t bits) {
  return std::bit_cast<float>(bits << 13) * 0x1p112f;
}

// The node next to a place that is not negative, but none at either end.
[[gnu::always_inline]] inline std::int32_t middle_node(float place, std::int32_t most) {
  const float beyond = place + 0.5f;
  const auto node = static_cast<std::int32_t>(beyond);
  const std::int32_t bounded = node < most ? node : most;
  return bounded > 1 ? bounded : 1;
}

[[gnu::always_inline]] inline void locate_loop(const std::uint16_t* __restrict rgb, int count,
                                               Places& __restrict places) {
  for (int k = 0; k < count; ++k) {
    const std::int32_t r = rgb[3 * k], g = rgb[3 * k + 1], b = rgb[3 * k + 2];
    const std::int32_t more = r > g ? r : g, less = r > g ? g : r;
    const std::int32_t most = more > b ? more : b, least = less < b ? less : b;
    const std::int32_t middle = r + g + b - most - least;
    const std::int32_t code = (r >= g ? 1 : 0) + (g >= b ? 2 : 0) + (b >= r ? 4 : 0);
    const std::int32_t order = code < kOrders ? code - 1 : kOrders - 1;
    const float high = value_of_half(most), low = value_of_half(least);
    const float span = high - low;
    const float ratio = high > 0 ? low / (high > 0 ? high : 1.0f) : 1.0f;
    const bool inside = (ratio >= kLeastGrey) & (most < kInfinity);
    const float x = (__builtin_sqrtf(ratio) - kLeastRoot) * kRootScale;
    const float y = (value_of_half(middle) - low) / (span > 0 ? span : 1.0f) * kHueScale;
    const float u = inside ? x : 0.0f, v = inside ? y : 0.0f;
    const std::int32_t magnitude = inside ? most : 0;
    const std::int32_t i = middle_node(u, kInnerGreys);
    const std::int32_t j = middle_node(v, kInnerHues);
    const std::int32_t n = magnitude / kStep;
    places.node[k] = ((order * kGreys + i) * kHues + j) * kLargest + n;
    places.cell[k] = ((order * kInnerGreys + i - 1) * kInnerHues + j - 1) * kCells + n;
    places.outside[k] = inside ? 0 : 1;
    places.black[k] = most == 0 ? 1 : 0;
    places.grey[k] = u - static_cast<float>(i);
    places.hue[k] = v - static_cast<float>(j);
    places.largest[k] = static_cast<float>(magnitude % kStep) * (1.0f / kStep);
  }
}
Dispatched<locate_loop> locate;

using Node __attribute__((vector_size(16))) = float;

// Two nodes that follow each other in the largest channel, in one register.
[[gnu::always_inline]] inline void load_pair(const float* nodes, Lanes& pair) {
  std::memcpy(&pair, nodes, sizeof pair);
}

// The weights of nodes at -1, 0 and 1 in the parabola through them.
struct Parabola {
  float before, middle, after;
};
[[gnu::always_inline]] inline Parabola parabola(float t) {
  return {0.5f * t * (t - 1), (1 - t) * (1 + t), 0.5f * t * (t + 1)};
}

[[gnu::always_inline]] inline void load_row(const float* middle, const Parabola& w, Lanes& row) {
  constexpr int kNext = 4 * kLargest;
  Lanes a, b, c;
  load_pair(middle - kNext, a);
  load_pair(middle, b);
  load_pair(middle + kNext, c);
  row = a * w.before + b * w.middle + c * w.after;
}

// The code of a pixel, plus 0.5, in units of 1/65535: parabolas in grey and hue, a line in the
// largest channel.
[[gnu::always_inline]] inline void interpolate(const float* middle, float grey, float hue,
                                               float largest, Node& code) {
  constexpr int kRow = 4 * kLargest * kHues;
  const Parabola across = parabola(hue), along = parabola(grey);
  Lanes a, b, c;
  load_row(middle - kRow, across, a);
  load_row(middle, across, b);
  load_row(middle + kRow, across, c);
  const Lanes pair = a * along.before + b * along.middle + c * along.after;
  const Node low = __builtin_shufflevector(pair, pair, 0, 1, 2, 3);
  const Node high = __builtin_shufflevector(pair, pair, 4, 5, 6, 7);
  const Node between = low + (high - low) * largest;
  const Node most{kWhite + 0.5f, kWhite + 0.5f, kWhite + 0.5f, kWhite + 0.5f};
  // A parabola may pass beyond its nodes.
  const Node positive = between > 0.5f ? between : Node{0.5f, 0.5f, 0.5f, 0.5f};
  code = positive < most ? positive : most;
}

// Of four values that are stored the next pixel's first overwrites the last.
[[gnu::always_inline]] inline void interpolate_loop(const float* nodes, const Places& places,
                                                    int count, unsigned short* out) {
  using Integers __attribute__((vector_size(16))) = std::int32_t;
  using Words __attribute__((vector_size(16))) = std::uint16_t;
  for (int k = 0; k < count; ++k, out += 3) {
    Node code;
    interpolate(nodes + 4 * static_cast<std::ptrdiff_t>(places.node[k]), places.grey[k],
                places.hue[k], places.largest[k], code);
    const Integers whole = __builtin_convertvector(code, Integers);
    Words words;
    std::memcpy(&words, &whole, sizeof words);
    words = __builtin_shufflevector(words, words, 0, 2, 4, 6, 0, 2, 4, 6);
    std::memcpy(out, &words, 4 * sizeof *out);
  }
}
Dispatched<interpolate_loop> interpolate_all;

// Calls step(number) for each number from 0 to count - 1, on as many processors as there are
// threads to be had.
template <class Step>
void for_all(int count, const Step& step) {
  std::atomic<int> next = 0;
  const auto work = [&] {
    for (int k = next++; k < count; k = next++) step(k);
  };
  std::vector<std::future<void>> others;
  try {
    for (unsigned t = 1; t < std::thread::hardware_concurrency(); ++t)
      others.push_back(std::async(std::launch::async, work));
  } catch (const std::system_error&) {  // no further thread
  }
  work();
  for (auto& other : others) other.get();
}

// Where a cell is compared: in steps from its middle node, and of the largest channel in half
// floats' steps.
struct Probe {
  float grey, hue;
  int largest;
};
constexpr std::array kProbes{Probe{0.5f, 0.5f, kStep / 2}, Probe{-0.5f, 0.5f, kStep / 4},
                             Probe{0.5f, -0.5f, 3 * kStep / 4}, Probe{-0.5f, -0.5f, kStep / 2},
                             Probe{0, 0, kStep / 2}};
// Between the probes an error may be larger than at them.
constexpr double kProbedPart = 0.8;

}  // namespace

struct GradeTable::Fill {
  const Formulas& formulas;
  GradeTable& table;

  void nodes(int column) const {
    const int order = column / (kGreys * kHues), i = column / kHues % kGreys, j = column % kHues;
    std::vector<float> rgb(3 * kLargest), codes(3 * kLargest);
    for (int n = 0; n < kLargest; ++n)
      put_pixel(order, value_of(n * kStep), static_cast<float>(i), static_cast<float>(j),
                &rgb[3 * n]);
    formulas(rgb.data(), kLargest, codes.data());
    float* out = &table.nodes_[static_cast<std::size_t>(4 * column) * kLargest];
    for (int n = 0; n < kLargest; ++n, out += 4)
      for (int c = 0; c < 3; ++c) out[c] = std::clamp(codes[3 * n + c], 0.0f, 1.0f) * kWhite + 0.5f;
  }

  // Sets errors[n] to the largest error at the probes of the cells of a column.
  void compare(int column, float* errors) const {
    const int order = column / (kInnerGreys * kInnerHues),
              i = column / kInnerHues % kInnerGreys + 1, j = column % kInnerHues + 1;
    const float* nodes =
        &table.nodes_[static_cast<std::size_t>(4 * column_of(order, i, j)) * kLargest];
    std::vector<float> rgb(3 * kCells), codes(3 * kCells);
    for (const Probe& probe : kProbes) {
      for (int n = 0; n < kCells; ++n)
        put_pixel(order, value_of(n * kStep + probe.largest), static_cast<float>(i) + probe.grey,
                  static_cast<float>(j) + probe.hue, &rgb[3 * n]);
      formulas(rgb.data(), kCells, codes.data());
      for (int n = 0; n < kCells; ++n) {
        Node code;
        interpolate(nodes + 4 * n, probe.grey, probe.hue, static_cast<float>(probe.largest) / kStep,
                    code);
        for (int c = 0; c < 3; ++c)
          errors[n] = std::max(errors[n], std::abs((code[c] - 0.5f) / kWhite -
                                                   std::clamp(codes[3 * n + c], 0.0f, 1.0f)));
      }
    }
  }
};

GradeTable::GradeTable(const Formulas& formulas)
    : nodes_(static_cast<std::size_t>(4 * kColumns) * kLargest),
      holds_(static_cast<std::size_t>(kCellColumns) * kCells) {
  const Fill fill{formulas, *this};
  for_all(kColumns, [&](int column) { fill.nodes(column); });
  std::vector<float> errors(holds_.size());
  for_all(kCellColumns, [&](int column) {
    fill.compare(column, &errors[static_cast<std::size_t>(column) * kCells]);
  });
  hold(errors);
}

// A kink of the formulas passes through cells next to each other, and the probes of some of them
// miss it.  So a cell is held only if its neighbours are as good.
void GradeTable::hold(const std::vector<float>& errors) {
  const auto worst_about = [&errors](int order, int i, int j, int n) {
    float worst = 0;
    for (int a = std::max(i - 1, 0); a <= std::min(i + 1, kInnerGreys - 1); ++a)
      for (int b = std::max(j - 1, 0); b <= std::min(j + 1, kInnerHues - 1); ++b) {
        const auto column =
            static_cast<std::size_t>((order * kInnerGreys + a) * kInnerHues + b) * kCells;
        for (int m = std::max(n - 1, 0); m <= std::min(n + 1, kCells - 1); ++m)
          worst = std::max(worst, errors[column + static_cast<std::size_t>(m)]);
      }
    return worst;
  };
  std::size_t held = 0, cell = 0;
  for (int order = 0; order < kOrders; ++order)
    for (int i = 0; i < kInnerGreys; ++i)
      for (int j = 0; j < kInnerHues; ++j)
        for (int n = 0; n < kCells; ++n, ++cell) {
          if (!(worst_about(order, i, j, n) <= kProbedPart * kMostError)) continue;
          holds_[cell] = 1;
          ++held;
          error_ = std::max<double>(error_, errors[cell]);
        }
  held_ = static_cast<double>(held) / static_cast<double>(cell);
}

int GradeTable::look_up(const Imath::half* rgb, int count, unsigned short* out, int* missed) const {
  Places places;
  static_assert(sizeof(Imath::half) == sizeof(std::uint16_t));
  locate(reinterpret_cast<const std::uint16_t*>(rgb), count, places);
  interpolate_all(nodes_.data(), places, count, out);
  int misses = 0;
  for (int k = 0; k < count; ++k) {
    const bool held = holds_[static_cast<std::size_t>(places.cell[k])] != 0;
    missed[misses] = k;
    misses += places.outside[k] != 0 || (!held && places.black[k] == 0);
  }
  return misses;
}

}  // namespace domefall
