// SharedSteps are work that is shared by the threads which need its result, without a thread of its
// own.
#pragma once

#include <atomic>
#include <exception>
#include <mutex>

namespace domefall {

class SharedSteps {
 public:
  explicit SharedSteps(int count) : count_(count) {}

  // Calls step(number) for numbers from 0 to count - 1 that no other caller has taken, until none
  // is left, and returns once all are done.  All callers give the same steps.  What a step throws,
  // each of them throws.
  template <class Step>
  void take(const Step& step) {
    for (int k = next_++; k < count_; k = next_++) {
      try {
        step(k);
      } catch (...) {
        const std::lock_guard lock(mutex_);
        error_ = std::current_exception();
      }
      if (++done_ == count_) done_.notify_all();
    }
    for (int done = done_; done < count_; done = done_) done_.wait(done);
    const std::lock_guard lock(mutex_);
    if (error_) std::rethrow_exception(error_);
  }

 private:
  const int count_;
  std::atomic<int> next_ = 0, done_ = 0;
  std::mutex mutex_;
  std::exception_ptr error_;
};

}  // namespace domefall
