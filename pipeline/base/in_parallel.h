// Steps that do not depend on each other run on several threads.
#pragma once

#include <algorithm>
#include <atomic>
#include <future>
#include <vector>

namespace domefall {

// Calls step(0) to step(count - 1) on at most `threads` threads.  If steps fail, it throws what one
// of them has thrown, and the steps that were not begun by then are not called.
template <class Step>
void in_parallel(int count, int threads, const Step& step) {
  std::atomic<int> next{0};
  const auto work = [&] {
    try {
      for (int k = 0; (k = next++) < count;) step(k);
    } catch (...) {
      next = count;
      throw;
    }
  };
  std::vector<std::future<void>> others;
  for (int k = 1; k < std::min(threads, count); ++k)
    others.push_back(std::async(std::launch::async, work));
  work();
  for (auto& other : others) other.get();
}

}  // namespace domefall
