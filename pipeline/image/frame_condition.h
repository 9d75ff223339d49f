// Whether a frame on the disk can be kept.
#pragma once

namespace domefall {

enum class FrameCondition {
  kMissing,  // there is no such file
  kDamaged,  // it cannot be read to its end, or its pixels are not those that were written
  kStale,    // whole, but of another key, size or kind: another version of the show, say
  kGood,
};

}  // namespace domefall
