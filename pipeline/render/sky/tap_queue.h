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
  SampleFilter filter;
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
  static int most_samples(SampleFilter filter) { return kMostPlaces / filter.taps(); }
  // Queues the taps of these samples.  Where that needs room, the queued taps are taken first.
  void add(const FilteredSamples& samples, ChannelPair* sums);
  // Takes all queued taps.  Each sample's sum receives the light of its taps, in two halves that
  // have yet to be added (total).
  void flush(ChannelPair* sums);

  // Taps on the map, and the indices of their samples' sums.
  static constexpr int kCapacity = 1024;
  struct Taps {
    int count = 0;
    alignas(64) std::array<std::int32_t, kCapacity> texel, level;
    alignas(64) std::array<TexelWeights, kCapacity> weights;
    alignas(64) std::array<std::uint16_t, kCapacity> indices;
  };

 private:
  static constexpr int kMostPlaces = 512;  // where one call of add() places taps
  // From this many taps on, each tap is taken on one level of the map instead of on two.
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
