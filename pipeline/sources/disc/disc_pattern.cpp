#include "pipeline/sources/disc/disc_pattern.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <numbers>

#include "pipeline/base/simd/dispatch.h"
#include "pipeline/base/simd/vector_math.h"

namespace domefall {
namespace {

constexpr double kTurn = 2 * std::numbers::pi;
constexpr int kSizes = Turbulence::kSizes;
// This is the width of the widest rows, in ln r.  Grains of each size are half as large as those
// before.
constexpr double kRowWidth = 0.16, kOutermost = 1e6, kOutermostLog = 14;
// Rows of different sizes do not end at the same places.
constexpr float kRowsApart = 0.37f;
// A spline reaches so many rows, and so many generations live at the same time.
constexpr int kReach = 3;
// Each size has its part of all light, the number of grains in a row, and the standard deviation of
// one along the row, in turns.
constexpr std::array<float, kSizes> kParts{0.45f, 0.33f, 0.22f};
constexpr std::array<int, kSizes> kGrains{3, 4, 6};
constexpr std::array<float, kSizes> kSpread{0.03f, 0.016f, 0.008f};
// The shear draws out gas that plunges, so that from this part of the last stable orbit inwards it
// is even.
constexpr double kEvenBelow = 2.0 / 3;
constexpr std::size_t kPlacesAtOnce = 128;

// This is the finaliser of MurmurHash3 (A. Appleby, public domain), in which each bit of the result
// depends on each bit of x.
[[gnu::always_inline]] inline std::uint32_t mixed(std::uint32_t x) {
  x = (x ^ (x >> 16)) * 0x85ebca6bu;
  x = (x ^ (x >> 13)) * 0xc2b2ae35u;
  return x ^ (x >> 16);
}

[[gnu::always_inline]] inline std::uint32_t lattice_key(std::uint32_t a, std::uint32_t b) {
  return mixed(a ^ (b * 0x9e3779b9u + 0x7f4a7c15u));
}

// ---- loops over places ----

// A PlaceBlock holds a block of places, a field at a time.
struct PlaceBlock {
  std::array<float, kPlacesAtOnce> rows;              // ln r in rows of the first size
  std::array<float, kPlacesAtOnce> turns, turning;    // azimuth and angular velocity, in turns
  std::array<float, kPlacesAtOnce> winding;           // -dOmega/dln(r), in turns
  std::array<float, kPlacesAtOnce> width, log_width;  // the footprint, in turns and in ln r
  std::array<double, kPlacesAtOnce> time;
  std::array<float, kPlacesAtOnce> kept, sum;
};

// A RowBlock is what a row is at each place: its spline's weight, its key, its youngest generation
// with the part of its first age that has passed, and the time between generations.
struct RowBlock {
  std::array<float, kPlacesAtOnce> weight, passed, span;
  std::array<std::uint32_t, kPlacesAtOnce> key, youngest;
};

struct SizeOfGrains {
  const double *spans, *rates;
  std::uint32_t seed;
};

[[gnu::always_inline]] inline void read_places_loop(const GasOrbits& orbits,
                                                    const PatternPlace* places, int count,
                                                    PlaceBlock& b) {
  const GasOrbits gas = orbits;
  const double even_below = gas.last_stable() * kEvenBelow;
  for (int k = 0; k < count; ++k) {
    const PatternPlace& p = places[k];
    const double low_r = p.r > gas.horizon() ? p.r : gas.horizon();
    const double r = low_r < kOutermost ? low_r : kOutermost;
    const double plunge = (r - even_below) / (gas.last_stable() - even_below);
    const double low = plunge < 0 ? 0 : plunge, part = low > 1 ? 1 : low;
    b.rows[k] = static_cast<float>(logarithm(r) / kRowWidth);
    const double turns = p.azimuth / kTurn;
    b.turns[k] = static_cast<float>(turns - ((turns + kRounding) - kRounding));
    const double orbit = gas.circling(r), fall = gas.plunging(r);
    b.turning[k] = static_cast<float>((r < gas.last_stable() ? fall : orbit) / kTurn);
    b.winding[k] = static_cast<float>(gas.shear(r)) * b.turning[k];
    b.width[k] = static_cast<float>(p.azimuth_width / kTurn);
    b.log_width[k] = static_cast<float>(p.r_width / r);
    b.time[k] = p.time;
    b.kept[k] = static_cast<float>(part * part * (3 - 2 * part));
    b.sum[k] = 0;
  }
}

// Returns the weights of a quadratic B-spline at `off` (-1/2 to 1/2) from the middle of three.
[[gnu::always_inline]] inline float spline_weight(int which, float off) {
  const float before = 0.5f - off, after = 0.5f + off;
  return which == 0   ? 0.5f * before * before
         : which == 1 ? 0.75f - off * off
                      : 0.5f * after * after;
}

template <int kSize>
[[gnu::always_inline]] inline void read_rows(const PlaceBlock& b, const SizeOfGrains& size,
                                             int which, int count, RowBlock& rows) {
  for (int k = 0; k < count; ++k) {
    const float at = b.rows[k] * static_cast<float>(1 << kSize) + kRowsApart * kSize;
    const int middle = static_cast<int>(at), row = middle + which - 1;
    rows.weight[k] = spline_weight(which, at - static_cast<float>(middle) - 0.5f);
    const std::uint32_t key = lattice_key(size.seed, static_cast<std::uint32_t>(row));
    const double clock =
        b.time[k] * size.rates[row] + static_cast<double>(static_cast<int>(key >> 8)) * 0x1p-24;
    const double shifted = (clock - 0.5) + kRounding;
    rows.key[k] = key;
    rows.youngest[k] = static_cast<std::uint32_t>(std::bit_cast<std::uint64_t>(shifted));
    rows.passed[k] = static_cast<float>(clock - (shifted - kRounding));
    rows.span[k] = static_cast<float>(size.spans[row]);
  }
}

// Adds the light of the generation that came `older` generations before the youngest.  A grain is
// (1 - x^2)^3 for |x| < 1 along its row, with a standard deviation of 1/3.  It looks like a
// Gaussian that is cut off at three standard deviations, and costs less.
template <int kSize>
[[gnu::always_inline]] inline void add_generation(const RowBlock& rows, int older, int count,
                                                  PlaceBlock& b) {
  constexpr float kRound = 12582912.0f;  // 1.5 * 2^23
  constexpr auto kRowsPerLog = static_cast<float>((1 << kSize) / kRowWidth);
  constexpr float kVariance = kSpread[kSize] * kSpread[kSize], kOfBox = 1.0f / 12;
  for (int k = 0; k < count; ++k) {
    const float age = (rows.passed[k] + static_cast<float>(older)) * rows.span[k];
    // Omega falls outwards, so across a footprint of the height h in ln r the gas has turned by
    // angles that differ by winding h age.  A footprint that is high is therefore wide as well.
    const float drawn = b.winding[k] * age * b.log_width[k];
    const float variance = kVariance + kOfBox * (b.width[k] * b.width[k] + drawn * drawn);
    const float reach = 3.0f * __builtin_sqrtf(variance), most = reach < 0.5f ? reach : 0.5f;
    // A grain that would reach all around the ring fades into the mean.
    const float even = most / reach, inverse = 1.0f / most;
    const float turns = b.turns[k] - b.turning[k] * age;
    std::uint32_t key =
        lattice_key(rows.key[k], rows.youngest[k] - static_cast<std::uint32_t>(older));
    float light = 0;
    for (int grain = 0; grain < kGrains[kSize]; ++grain) {
      const float place = static_cast<float>(static_cast<int>(key & 0xffff)) * 0x1p-16f;
      const float off = turns - place, x = (off - ((off + kRound) - kRound)) * inverse;
      const float left = 1.0f - x * x, bump = left > 0 ? left : 0;
      light += bump * bump * bump;
      key =
          grain % 2 == 0 ? key >> 16 : mixed(key + static_cast<std::uint32_t>(grain) * 0x9e3779b9u);
    }
    constexpr float kNorm = 35.0f / 32 / static_cast<float>(kGrains[kSize]);
    const float high = b.log_width[k] * kRowsPerLog, fading = even * even / (1.0f + high * high);
    const float alive = spline_weight(kReach - 1 - older, rows.passed[k] - 0.5f);
    b.sum[k] += kParts[kSize] * rows.weight[k] * alive * fading * (light * inverse * kNorm - 1.0f);
  }
}

template <int kSize>
[[gnu::always_inline]] inline void add_grains_loop(const SizeOfGrains& size, int count,
                                                   PlaceBlock& b) {
  RowBlock rows;
  for (int row = 0; row < kReach; ++row) {
    read_rows<kSize>(b, size, row, count, rows);
    for (int older = 0; older < kReach; ++older) add_generation<kSize>(rows, older, count, b);
  }
}

Dispatched<read_places_loop> read_places;
Dispatched<add_grains_loop<0>> add_large_grains;
Dispatched<add_grains_loop<1>> add_middle_grains;
Dispatched<add_grains_loop<2>> add_small_grains;

constexpr double kTwoPi = 2 * std::numbers::pi;

// Returns a Gaussian of that standard deviation (radians), wrapped around the circle, with a mean
// of 1.
double wrapped_gaussian(double angle, double sigma) {
  const double x = (angle / kTwoPi - std::floor(angle / kTwoPi + 0.5)) * kTwoPi;
  double sum = 0;
  // What either series leaves out is below 1e-5 of the mean.
  if (sigma < 1.3) {
    for (int k = -1; k <= 1; ++k) {
      const double off = (x + k * kTwoPi) / sigma;
      sum += exponential(-off * off / 2);
    }
    return sum * std::sqrt(kTwoPi) / sigma;
  }
  for (int m = 1; m <= 3; ++m)
    sum += exponential(-m * m * sigma * sigma / 2) * sin_cos(m * x).cosine;
  return 1 + 2 * sum;
}

// Returns the light of the gas and the spot, with the spot spread over the footprint, over the mean
// of the two around the ring.
double spot_factor(const SpotPattern& spot, const GasOrbits& orbits, const PatternPlace& at) {
  const double across = at.r_width / 2, along = at.azimuth_width / 2, own = spot.size / at.r;
  const double high = std::hypot(spot.size, across), wide = std::hypot(own, along);
  const double off = (at.r - spot.r) / high;
  const double mean = (spot.brightness - 1) * spot.size / high * exponential(-off * off / 2) * own /
                      std::sqrt(kTwoPi);
  const double turns = orbits.angular_velocity(spot.r) / kTwoPi * at.time;
  const double angle = at.azimuth - spot.azimuth - (turns - std::floor(turns)) * kTwoPi;
  return (1 + mean * wrapped_gaussian(angle, wide)) / (1 + mean);
}

double ring_factor(const RingPattern& rings, const PatternPlace& at) {
  const double turns = (at.r + rings.inward_speed * at.time) / rings.spacing;
  // The mean of a cosine over a pixel is that in its middle times sin(width)/width.  This Gaussian
  // agrees with that factor to second order and does not change sign.
  const double width = std::numbers::pi * at.r_width / rings.spacing;
  const double fading = exponential(-width * width / 6);
  return 1 + rings.contrast * fading * sin_cos((turns - std::floor(turns)) * kTwoPi).cosine;
}

}  // namespace

Turbulence::Turbulence(const TurbulencePattern& pattern, const GasOrbits& orbits)
    : pattern_(pattern), orbits_(orbits) {
  for (int size = 0; size < kSizes; ++size) {
    const double width = std::ldexp(kRowWidth, -size);
    for (int row = 0; row * width < kOutermostLog + 2 * kRowWidth; ++row) {
      const double middle = (row + 0.5 - static_cast<double>(kRowsApart) * size) * width;
      // Rows inside the last stable orbit go by its charge.
      const double r = std::max(exponential(middle), orbits.last_stable());
      const double orbit =
          kTurn * exponential(1.5 * middle) / std::sqrt(1 - orbits.charge_squared() / r);
      const double span = pattern.orbits * orbit / kReach;
      spans_[static_cast<std::size_t>(size)].push_back(span);
      rates_[static_cast<std::size_t>(size)].push_back(1 / span);
    }
  }
}

void Turbulence::factors(std::span<const PatternPlace> places, std::span<float> out) const {
  const auto size = [this](std::size_t k) {
    return SizeOfGrains{spans_[k].data(), rates_[k].data(),
                        lattice_key(pattern_.seed, static_cast<std::uint32_t>(k))};
  };
  const auto contrast = static_cast<float>(pattern_.contrast);
  PlaceBlock block;
  for (std::size_t at = 0; at < places.size(); at += kPlacesAtOnce) {
    const int count = static_cast<int>(std::min(kPlacesAtOnce, places.size() - at));
    read_places(orbits_, places.data() + at, count, block);
    add_large_grains(size(0), count, block);
    add_middle_grains(size(1), count, block);
    add_small_grains(size(2), count, block);
    for (std::size_t k = 0; k < static_cast<std::size_t>(count); ++k)
      out[at + k] = 1 + contrast * block.kept[k] * block.sum[k];
  }
}

DiscPattern::DiscPattern(const PatternKind& kind, const GasOrbits& orbits)
    : kind_(kind), orbits_(orbits) {
  if (const auto* turbulence = std::get_if<TurbulencePattern>(&kind))
    turbulence_.emplace(*turbulence, orbits);
}

void DiscPattern::factors(std::span<const PatternPlace> places, std::span<float> out) const {
  if (turbulence_) return turbulence_->factors(places, out);
  const auto* rings = std::get_if<RingPattern>(&kind_);
  const auto* spot = std::get_if<SpotPattern>(&kind_);
  for (std::size_t k = 0; k < places.size(); ++k)
    out[k] = static_cast<float>(rings ? ring_factor(*rings, places[k])
                                      : spot_factor(*spot, orbits_, places[k]));
}

}  // namespace domefall
