#include "pipeline/grade/table_lookup.h"

#include <cstring>

#include "pipeline/base/simd/dispatch.h"
#include "pipeline/base/simd/lanes.h"

namespace domefall::grade_cells {
namespace {

using Ints __attribute__((vector_size(4 * kLanes))) = std::int32_t;
constexpr int kGroup = kLanes;  // pixels

template <class Vector>
[[gnu::always_inline]] inline void load(const float* from, Vector& to) {
  std::memcpy(&to, from, sizeof to);
}
template <class Vector, class Value>
[[gnu::always_inline]] inline void store(const Vector& from, Value* to) {
  std::memcpy(to, &from, sizeof from);
}

// Finds the node nearest to a place that is not negative.  The first and the last node are left
// out, since a parabola needs a neighbour on either side.
[[gnu::always_inline]] inline void middle_node(const Lanes& place, int last, Ints& node) {
  node = __builtin_convertvector(place + 0.5f, Ints);
  node = node < last ? node : Ints{} + last;
  node = node > 1 ? node : Ints{} + 1;
}

[[gnu::always_inline]] inline void store_parabola(const Lanes& t, int k, Parabolas& out) {
  store(0.5f * t * (t - 1), &out.before[k]);
  store((1 - t) * (1 + t), &out.middle[k]);
  store(0.5f * t * (t + 1), &out.after[k]);
}

// The compiler makes one instruction of this loop.
[[gnu::always_inline]] inline void square_root(Lanes& values) {
  for (int k = 0; k < kLanes; ++k) values[k] = __builtin_sqrtf(values[k]);
}

[[gnu::always_inline]] inline void locate_cells_loop(const float* red, const float* green,
                                                     const float* blue, int count, Places& places) {
  // Halves are 2^-24 apart below 2^-14.  Above, a float has 13 bits more than a half.
  constexpr float kNormal = 0x1p-14f, kSubnormalSteps = 0x1p24f / kNodeStep;
  constexpr std::int32_t kLeastExponent = 112 << 23, kStepBits = 13 + 5;
  const Lanes zero{}, one = zero + 1.0f;
  for (int k = 0; k < count; k += kGroup) {
    Lanes r, g, b;
    load(red + k, r);
    load(green + k, g);
    load(blue + k, b);
    const Lanes more = r > g ? r : g, less = r > g ? g : r;
    const Lanes high = more > b ? more : b, low = less < b ? less : b;
    const Lanes rest = more < b ? more : b, between = less > rest ? less : rest;
    const Ints code = -(r >= g) - 2 * (g >= b) - 4 * (b >= r);
    Ints order = code > kOrders ? Ints{} + kOrders : code;
    order = (order < 1 ? Ints{} + 1 : order) - 1;
    const Ints lit = high > zero;
    const Lanes span = high - low;
    Lanes ratio = lit ? low / (lit ? high : one) : one;
    const Ints inside = (low >= zero) & (ratio >= kLeastGrey) & (high <= kBrightest);
    ratio = inside ? ratio : one;
    square_root(ratio);
    const Lanes u = (ratio - kLeastRoot) * kRootScale;
    const Lanes spread = span > zero ? span : one;
    const Lanes v = inside ? (between - low) / spread * kHueScale : zero;
    const Lanes m = inside ? high : zero;
    Ints i, j;
    middle_node(u, kInnerGreys, i);
    middle_node(v, kInnerHues, j);
    const Ints small = m < kNormal;
    const Lanes small_place = (small ? m : zero) * kSubnormalSteps;
    const Ints small_node = __builtin_convertvector(small_place, Ints);
    Ints bits;
    std::memcpy(&bits, &m, sizeof bits);
    bits -= kLeastExponent;
    const Ints fine = bits & ((1 << kStepBits) - 1);
    const Lanes fraction = __builtin_convertvector(fine, Lanes) * (1.0f / (1 << kStepBits));
    const Ints n = small ? small_node : bits >> kStepBits;
    const Lanes above = small ? small_place - __builtin_convertvector(small_node, Lanes) : fraction;
    store(order * kOrder + i * kRow + j * kColumn + n * kNode, &places.node[k]);
    store(-inside - (inside & ~lit), &places.asked[k]);
    store_parabola(u - __builtin_convertvector(i, Lanes), k, places.grey);
    store_parabola(v - __builtin_convertvector(j, Lanes), k, places.hue);
    store(above, &places.largest[k]);
  }
}
Dispatched<locate_cells_loop> locate_all;

// Loads two nodes that follow each other in the largest channel.
[[gnu::always_inline]] inline void load_pair(const float* nodes, Lanes& pair) {
  std::memcpy(&pair, nodes, sizeof pair);
}

[[gnu::always_inline]] inline void load_row(const float* middle, float before, float between,
                                            float after, Lanes& row) {
  Lanes a, b, c;
  load_pair(middle - kColumn, a);
  load_pair(middle, b);
  load_pair(middle + kColumn, c);
  row = a * before + b * between + c * after;
}

using Node __attribute__((vector_size(16))) = float;

// Interpolates by parabolas in grey and hue, and by a line in the largest channel.  Four values are
// stored for each pixel, and the first one of the next pixel overwrites the fourth.
[[gnu::always_inline]] inline int interpolate_loop(const float* nodes, const Places& places,
                                                   int count, unsigned short* out, int* missed) {
  using Integers __attribute__((vector_size(16))) = std::int32_t;
  using Words __attribute__((vector_size(16))) = std::uint16_t;
  constexpr float kWhite = 65535.5f, kBlack = 0.5f;
  int misses = 0;
  for (int k = 0; k < count; ++k, out += 3) {
    const float* middle = nodes + places.node[k];
    missed[misses] = k;
    misses += places.asked[k] + static_cast<int>(middle[kHeld]) < 2;
    const float before = places.hue.before[k], between = places.hue.middle[k],
                after = places.hue.after[k];
    Lanes a, b, c;
    load_row(middle - kRow, before, between, after, a);
    load_row(middle, before, between, after, b);
    load_row(middle + kRow, before, between, after, c);
    const Lanes pair =
        a * places.grey.before[k] + b * places.grey.middle[k] + c * places.grey.after[k];
    const Node low = __builtin_shufflevector(pair, pair, 0, 1, 2, 3);
    const Node high = __builtin_shufflevector(pair, pair, 4, 5, 6, 7);
    const Node code = low + (high - low) * places.largest[k] + 0.5f;
    // A parabola may pass beyond its nodes.
    const Node positive = code > kBlack ? code : Node{} + kBlack;
    const Node bounded = positive < kWhite ? positive : Node{} + kWhite;
    const Integers whole = __builtin_convertvector(bounded, Integers);
    Words words;
    std::memcpy(&words, &whole, sizeof words);
    words = __builtin_shufflevector(words, words, 0, 2, 4, 6, 0, 2, 4, 6);
    std::memcpy(out, &words, 4 * sizeof *out);
  }
  return misses;
}
Dispatched<interpolate_loop> interpolate_all;

}  // namespace

void locate(const PixelPlanes& planes, int count, Places& places) {
  locate_all(planes.red.data(), planes.green.data(), planes.blue.data(), count, places);
}

void put_place(Places& places, int k, std::size_t node, float grey, float hue, float largest) {
  const auto put = [k](Parabolas& out, float t) {
    out.before[k] = 0.5f * t * (t - 1);
    out.middle[k] = (1 - t) * (1 + t);
    out.after[k] = 0.5f * t * (t + 1);
  };
  places.node[k] = static_cast<std::int32_t>(node);
  places.asked[k] = 2;
  put(places.grey, grey);
  put(places.hue, hue);
  places.largest[k] = largest;
}

int interpolate(const float* nodes, const Places& places, int count, unsigned short* out,
                int* missed) {
  return interpolate_all(nodes, places, count, out, missed);
}

}  // namespace domefall::grade_cells
