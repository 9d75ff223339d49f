#include "pipeline/base/side_by_side.h"

#include <tbb/info.h>

#include <algorithm>
#include <atomic>

namespace domefall {
namespace {

std::atomic<int> encoders{0};

}  // namespace

// More threads than processors would gain nothing, and TBB would warn of them on the terminal.
void set_encoder_threads(int threads) {
  encoders = std::min(threads, tbb::info::default_concurrency());
}
int encoder_threads() { return encoders; }

}  // namespace domefall
