// The taps of many samples, which wait to be taken.  Where all of them fall is known before the
// first one is taken, so that their texels can be prefetched in time.
#pragma once

#include <array>
#include <cstdint>

#include "pipeline/render/sky/bilinear_tap.h"
#include "pipeline/render/sky/sample_batch.h"

namespace domefall {

// Samples that share one filter.  The columns are those of SampleBatch.
struct FilteredSamples {
  SampleFilter filter;  // of 1 tap or an even number
  int count = 0;
  const float *x, *y, *z;
  const float *wide, *narrow;
  const float *ax, *ay, *az;
  const std::uint16_t* indices;  // of the samples' sums
};

class TapQueue {
 public:
  // spacing: how far apart the taps of a line are, in units of the width of each.
  TapQueue(const SkyMap& map, double spacing);

  // The most samples with this filter that one call of add() accepts.
  static int most_samples(SampleFilter filter) { return kMostPairs / pairs(filter); }
  // Queues the taps of these samples.  Where that needs room, the queued taps are taken first.
  void add(const FilteredSamples& samples, ChannelPair* sums);
  // Takes all queued taps.  Each sample's sum receives 1/kTapScale of the light of its taps, in two
  // halves that have yet to be added.
  void flush(ChannelPair* sums);

  // Where taps fall on the map, and the factors of their light.
  static constexpr int kCapacity = 1024;
  struct TapColumns {
    alignas(64) std::array<std::int32_t, kCapacity> texel, level;
    alignas(64) std::array<float, kCapacity> fx, fy, weight;
  };

 private:
  static constexpr int kMostPairs = 512;  // that one call of add() queues
  // From this many taps on, each tap is taken on one level of the map instead of on two.
  static constexpr int kManyTaps = 4;
  static bool on_two_levels(SampleFilter filter) {
    return filter.minified() && filter.taps() < kManyTaps;
  }
  static int pairs(SampleFilter filter) {
    return on_two_levels(filter) ? filter.taps() : (filter.taps() + 1) / 2;
  }

  // Taps wait in pairs: the first taps of all pairs in one set of columns, the second in another.
  // A pair is one tap on two levels, or two neighbours of a line.
  struct PendingPairs {
    int count = 0;
    std::array<TapColumns, 2> taps;
    alignas(64) std::array<std::uint16_t, kCapacity> indices;
  };
  void locate(const FilteredSamples& samples, PendingPairs& pending) const;

  MipLevels levels_;
  int size_, last_;  // texels along a face of the finest level, number of the coarsest level
  float texels_per_radian_, spacing_;
  PendingPairs finest_;    // on the finest level with the weight 1
  PendingPairs weighted_;  // all others
};

}  // namespace domefall
