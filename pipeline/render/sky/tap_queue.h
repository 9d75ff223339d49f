// A TapQueue holds the taps of many samples until they are taken.  The places of all taps are known
// before the first one is taken, so that their texels can be prefetched in time.
#pragma once

#include <array>
#include <cstdint>

#include "pipeline/render/sky/bilinear_tap.h"
#include "pipeline/render/sky/sample_batch.h"

namespace domefall {

// FilteredSamples share one filter.  The columns are those of SampleBatch.
struct FilteredSamples {
  SampleFilter filter;
  int count = 0;
  const float *x, *y, *z;
  const float *wide, *narrow;
  const float *ax, *ay, *az;
  const std::uint16_t* indices;  // of the samples' sums
};

class TapQueue {
 public:
  // spacing is the distance between the taps of a line, in units of the width of each.
  TapQueue(const SkyMap& map, double spacing);

  // Returns the most samples with this filter that one call of add() accepts.
  static int most_samples(SampleFilter filter) { return kMostPlaces / filter.taps(); }
  // Queues the taps of these samples.  If they need more room, the queued taps are taken first.
  void add(const FilteredSamples& samples, ChannelPair* sums);
  // Takes all queued taps.  The sum of each sample receives the light of its taps in two halves,
  // which total() adds later.
  void flush(ChannelPair* sums);

  // Taps holds taps on the map with the indices of their samples' sums.
  static constexpr int kCapacity = 1024;
  struct Taps {
    int count = 0;
    alignas(64) std::array<std::int32_t, kCapacity> texel, level;
    alignas(64) std::array<TexelWeights, kCapacity> weights;
    alignas(64) std::array<std::uint16_t, kCapacity> indices;
  };

 private:
  static constexpr int kMostPlaces = 512;  // the most positions of taps in one call of add()
  // A sample with at least this many taps takes each tap on one level of the map instead of on two.
  static constexpr int kManyTaps = 4;
  static bool on_two_levels(SampleFilter filter) {
    return filter.minified() && filter.taps() < kManyTaps;
  }
  void locate(const FilteredSamples& samples, Taps& queued) const;

  MipLevels levels_;
  int size_, last_;  // texels along a face of the finest level, number of the coarsest level
  float texels_per_radian_, spacing_;
  Taps finest_;    // on the finest level, whose column of levels is not used
  Taps levelled_;  // all others
};

}  // namespace domefall
