#include "pipeline/sources/disc/disc_pattern.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <numbers>
#include <vector>

#include "pipeline/base/simd/dispatch.h"
#include "pipeline/base/simd/lanes.h"
#include "pipeline/base/simd/vector_math.h"
#include "pipeline/sources/disc/noise_tile.h"

namespace domefall {
namespace {

constexpr double kTurn = 2 * std::numbers::pi;
// This is the width of rows, in ln r.
constexpr double kRowWidth = 0.24, kOutermost = 1e6, kOutermostLog = 14;
// Each place has light of so many rows, and in each of so many generations.
constexpr int kRows = 2, kGenerations = 2;
// The shear draws out gas that plunges, so that from this part of the last stable orbit inwards it
// is even.
constexpr double kEvenBelow = 2.0 / 3;
constexpr std::size_t kPlacesAtOnce = 128;

// ---- loops over places ----

// A PlaceBlock holds a block of places, a field at a time.
struct PlaceBlock {
  std::array<float, kPlacesAtOnce> rows;              // ln r in rows
  std::array<float, kPlacesAtOnce> turns, turning;    // azimuth and angular velocity, in turns
  std::array<float, kPlacesAtOnce> winding;           // -dOmega/dln(r), in turns
  std::array<float, kPlacesAtOnce> width, log_width;  // the footprint, in turns and in ln r
  std::array<float, kPlacesAtOnce> high;  // of the tile's rows, as a logarithm to base 2
  std::array<double, kPlacesAtOnce> time;
  std::array<float, kPlacesAtOnce> kept, sum;
};

// A RowBlock is what a row is at each place: its spline's weight, its key, its youngest generation
// with the part of its first age that has passed, and the time between generations.
struct RowBlock {
  std::array<float, kPlacesAtOnce> weight, passed, span;
  std::array<std::uint32_t, kPlacesAtOnce> key, youngest;
};

// A TileBlock is where a generation of a row has each place on the tile, and its weight.
struct TileBlock {
  std::array<float, kPlacesAtOnce> row, column, wide, weight;
};

// A ReadBlock has the texels of one level on the left and on the right of each place, and where it lies
// between them.
struct ReadBlock {
  std::array<int, kPlacesAtOnce> at;
  std::array<std::uint32_t, kPlacesAtOnce> left, right;
  std::array<float, kPlacesAtOnce> down, on, light;
};

struct Clocks {
  const double *spans, *rates;
  std::uint32_t seed;
};

// Returns the level whose means, read between four of them, have the variance of a footprint of so many
// texels: 2^(2 level)/4 against texels^2/12.
[[gnu::always_inline]] inline float level_of(float texels, int highest) {
  constexpr float kLogOfRootThree = 0.7924813f;
  const float level = binary_logarithm(texels > 1.0f ? texels : 1.0f) - kLogOfRootThree;
  const float most = static_cast<float>(highest), least = level > 0 ? level : 0;
  return least < most ? least : most;
}

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
  constexpr auto kTexelsPerLog = static_cast<float>(NoiseTile::kTexelsPerLog);
  for (int k = 0; k < count; ++k)
    b.high[k] = level_of(b.log_width[k] * kTexelsPerLog, NoiseTile::kLogRows);
}

// Returns the weight of what fades in from 0 to 1.
[[gnu::always_inline]] inline float faded(float part) { return part * part * (3 - 2 * part); }

[[gnu::always_inline]] inline void read_rows_loop(const PlaceBlock& b, const Clocks& clocks,
                                                  int which, int count, RowBlock& rows) {
  for (int k = 0; k < count; ++k) {
    const int lower = static_cast<int>(b.rows[k]), row = lower + which;
    const float next = faded(b.rows[k] - static_cast<float>(lower));
    rows.weight[k] = which ? next : 1 - next;
    const std::uint32_t key = lattice_key(clocks.seed, static_cast<std::uint32_t>(row));
    const double clock =
        b.time[k] * clocks.rates[row] + static_cast<double>(static_cast<int>(key >> 8)) * 0x1p-24;
    const double shifted = (clock - 0.5) + kRounding;
    rows.key[k] = key;
    rows.youngest[k] = static_cast<std::uint32_t>(std::bit_cast<std::uint64_t>(shifted));
    rows.passed[k] = static_cast<float>(clock - (shifted - kRounding));
    rows.span[k] = static_cast<float>(clocks.spans[row]);
  }
}

// Finds where the generation that came `older` generations before the youngest has each place.
[[gnu::always_inline]] inline void read_generation_loop(const PlaceBlock& b, const RowBlock& rows,
                                                        int older, int count, TileBlock& tile) {
  constexpr float kRound = 12582912.0f;  // 1.5 * 2^23
  constexpr auto kHigh = static_cast<float>(NoiseTile::kTileRows),
                 kColumns = static_cast<float>(NoiseTile::kTileColumns),
                 kTexelsPerRow = static_cast<float>(NoiseTile::kTexelsPerLog * kRowWidth);
  for (int k = 0; k < count; ++k) {
    const float age = (rows.passed[k] + static_cast<float>(older)) * rows.span[k];
    // Omega falls outwards, so across a footprint of the height h in ln r the gas has turned by
    // angles that differ by winding h age.  A footprint that is high is therefore wide as well.
    const float drawn = b.winding[k] * age * b.log_width[k];
    const std::uint32_t key =
        lattice_key(rows.key[k], rows.youngest[k] - static_cast<std::uint32_t>(older));
    const float turns = b.turns[k] - b.turning[k] * age +
                        static_cast<float>(static_cast<int>(key & 0xffff)) * 0x1p-16f;
    tile.column[k] = (turns - ((turns + kRound) - kRound) + 0.5f) * kColumns;
    tile.row[k] = (b.rows[k] * kTexelsPerRow +
                   static_cast<float>(static_cast<int>(key >> 16)) * 0x1p-16f * kHigh);
    const float wide = __builtin_sqrtf(b.width[k] * b.width[k] + drawn * drawn) * kColumns;
    tile.wide[k] = level_of(wide, NoiseTile::kLogColumns);
    const float young = faded(rows.passed[k]);
    tile.weight[k] = rows.weight[k] * (older ? 1 - young : young);
  }
}

// Returns 2^-level.
[[gnu::always_inline]] inline float halved(int level) {
  return std::bit_cast<float>(static_cast<std::uint32_t>(127 - level) << 23);
}

// Finds what is read of the level that is so many rows and columns coarser than each place's own.
[[gnu::always_inline]] inline void find_texels_loop(const PlaceBlock& b, const TileBlock& tile,
                                                    int higher, int wider, int count,
                                                    ReadBlock& read) {
  for (int k = 0; k < count; ++k) {
    const int i0 = static_cast<int>(b.high[k]) + higher,
              j0 = static_cast<int>(tile.wide[k]) + wider;
    const int i = i0 < NoiseTile::kLogRows ? i0 : NoiseTile::kLogRows,
              j = j0 < NoiseTile::kLogColumns ? j0 : NoiseTile::kLogColumns;
    // A whole tile more keeps these above 0.
    const float y = (tile.row[k] + (NoiseTile::kTileRows + 0.5f)) * halved(i) - 0.5f,
                x = (tile.column[k] + (NoiseTile::kTileColumns + 0.5f)) * halved(j) - 0.5f;
    const int top = static_cast<int>(y), left = static_cast<int>(x);
    const int last_row = (NoiseTile::kTileRows >> i) - 1,
              last_column = (NoiseTile::kTileColumns >> j) - 1;
    read.at[k] = NoiseTile::row_at(i, top & last_row) + NoiseTile::column_at(j, left & last_column);
    read.down[k] = y - static_cast<float>(top), read.on[k] = x - static_cast<float>(left);
  }
}

// Finds the light between the texels of a level.
[[gnu::always_inline]] inline void mix_texels_loop(int count, ReadBlock& read) {
  for (int k = 0; k < count; ++k) {
    const std::uint32_t left = read.left[k], right = read.right[k];
    const auto above = static_cast<float>(static_cast<int>(left & 0xffff)),
               below = static_cast<float>(static_cast<int>(left >> 16)),
               above_on = static_cast<float>(static_cast<int>(right & 0xffff)),
               below_on = static_cast<float>(static_cast<int>(right >> 16));
    const float high = above + read.on[k] * (above_on - above),
                low = below + read.on[k] * (below_on - below);
    read.light[k] = high + read.down[k] * (low - high);
  }
}

// Adds the weighted light between two or four levels to the sums.
[[gnu::always_inline]] inline void add_light_loop(const TileBlock& tile, const ReadBlock* levels,
                                                  bool coarser_rows, int count, PlaceBlock& b) {
  for (int k = 0; k < count; ++k) {
    const float wide = tile.wide[k] - static_cast<float>(static_cast<int>(tile.wide[k])),
                high = b.high[k] - static_cast<float>(static_cast<int>(b.high[k]));
    float light = levels[0].light[k] + wide * (levels[1].light[k] - levels[0].light[k]);
    if (coarser_rows)
      light +=
          high * (levels[2].light[k] + wide * (levels[3].light[k] - levels[2].light[k]) - light);
    b.sum[k] += tile.weight[k] * (light - NoiseTile::kOne);
  }
}

Dispatched<read_places_loop> read_places;
Dispatched<read_rows_loop> read_rows;
Dispatched<read_generation_loop> read_generation;
Dispatched<find_texels_loop> find_texels;
Dispatched<mix_texels_loop> mix_texels;
Dispatched<add_light_loop> add_light;

// Reads a level.  Reads at computed places are in no SIMD code.
void read_level(const PlaceBlock& b, const TileBlock& tile, int higher, int wider, int count,
                ReadBlock& read) {
  find_texels(b, tile, higher, wider, count, read);
  const std::uint32_t* const texels = noise_tile().texels();
  for (std::size_t k = 0; k < static_cast<std::size_t>(count); ++k) {
    const std::uint32_t* const at = texels + read.at[k];
    const std::uint32_t left = at[0], right = at[1];
    read.left[k] = left, read.right[k] = right;
  }
  mix_texels(count, read);
}

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

// The light of a spot spread over the footprint, as a part of even gas, and its mean around the ring.
struct SpotLight {
  double light, mean;
};
SpotLight spot_light(const SpotPattern& spot, const GasOrbits& orbits, const PatternPlace& at) {
  const double across = at.r_width / 2, along = at.azimuth_width / 2, own = spot.size / at.r;
  const double high = std::hypot(spot.size, across), wide = std::hypot(own, along);
  const double off = (at.r - spot.r) / high;
  const double mean = (spot.brightness - 1) * spot.size / high * exponential(-off * off / 2) * own /
                      std::sqrt(kTwoPi);
  const double turns = orbits.angular_velocity(spot.r) / kTwoPi * at.time;
  const double angle = at.azimuth - spot.azimuth - (turns - std::floor(turns)) * kTwoPi;
  return {mean * wrapped_gaussian(angle, wide), mean};
}

// Gas that is further in has turned further since the map was painted, so that a footprint is the wider
// the higher it is.
double map_factor(const PatternMap& map, double painted, const GasOrbits& orbits,
                  const PatternPlace& at) {
  const double age = at.time - painted, turning = orbits.angular_velocity(at.r);
  const double turns = turning / kTwoPi * age, sheared = orbits.shear(at.r) * turning / at.r * age;
  return map.mean(at.r, at.azimuth - (turns - std::floor(turns)) * kTwoPi, at.r_width,
                  std::hypot(at.azimuth_width, sheared * at.r_width));
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
  for (int row = 0; row * kRowWidth < kOutermostLog + 2 * kRowWidth; ++row) {
    const double middle = row * kRowWidth;
    // Rows inside the last stable orbit go by what charge and spin do there.
    const double r = std::max(exponential(middle), orbits.last_stable());
    const double orbit =
        kTurn * exponential(1.5 * middle) / (orbits.circling(r) * r * std::sqrt(r));
    spans_.push_back(pattern.orbits * orbit / kGenerations);
    rates_.push_back(1 / spans_.back());
  }
}

void Turbulence::factors(std::span<const PatternPlace> places, std::span<float> out) const {
  const Clocks clocks{spans_.data(), rates_.data(), lattice_key(pattern_.seed, 0)};
  const auto contrast = static_cast<float>(pattern_.contrast) / NoiseTile::kOne;
  PlaceBlock block;
  RowBlock rows;
  TileBlock tile;
  std::array<ReadBlock, 4> levels;
  for (std::size_t at = 0; at < places.size(); at += kPlacesAtOnce) {
    const std::size_t count = std::min(kPlacesAtOnce, places.size() - at);
    const int n = static_cast<int>(count);
    read_places(orbits_, places.data() + at, n, block);
    const bool coarser_rows = std::any_of(block.high.begin(), block.high.begin() + n,
                                          [](float high) { return high > 0; });
    for (int row = 0; row < kRows; ++row) {
      read_rows(block, clocks, row, n, rows);
      for (int older = 0; older < kGenerations; ++older) {
        read_generation(block, rows, older, n, tile);
        read_level(block, tile, 0, 0, n, levels[0]);
        read_level(block, tile, 0, 1, n, levels[1]);
        if (coarser_rows) {
          read_level(block, tile, 1, 0, n, levels[2]);
          read_level(block, tile, 1, 1, n, levels[3]);
        }
        add_light(tile, levels.data(), coarser_rows, n, block);
      }
    }
    for (std::size_t k = 0; k < count; ++k)
      out[at + k] = 1 + contrast * block.kept[k] * block.sum[k];
  }
}

DiscPattern::DiscPattern(std::span<const PatternKind> kinds, const GasOrbits& orbits)
    : orbits_(orbits) {
  for (const PatternKind& kind : kinds) {
    if (const auto* turbulence = std::get_if<TurbulencePattern>(&kind))
      turbulence_.emplace(*turbulence, orbits);
    else if (const auto* rings = std::get_if<RingPattern>(&kind))
      rings_ = *rings;
    else if (const auto* spot = std::get_if<SpotPattern>(&kind))
      spots_.push_back(*spot);
    else
      map_.emplace(std::get<MapPattern>(kind)), map_at_ = std::get<MapPattern>(kind).at;
  }
}

void DiscPattern::factors(std::span<const PatternPlace> places, std::span<float> out) const {
  if (turbulence_)
    turbulence_->factors(places, out);
  else
    std::fill(out.begin(), out.end(), 1.0f);
  if (!rings_ && !map_ && spots_.empty()) return;
  for (std::size_t k = 0; k < places.size(); ++k) {
    double light = out[k], mean = 1;
    if (rings_) light *= ring_factor(*rings_, places[k]);
    if (map_) light *= map_factor(*map_, map_at_, orbits_, places[k]);
    for (const SpotPattern& spot : spots_) {
      const SpotLight more = spot_light(spot, orbits_, places[k]);
      light += more.light, mean += more.mean;
    }
    out[k] = static_cast<float>(light / mean);
  }
}

}  // namespace domefall
