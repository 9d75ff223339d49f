// Clocks of programs and of what they measure.
#pragma once

#include <chrono>
#include <ctime>
#include <utility>

namespace domefall {

// A StopWatch runs from its construction, by the wall clock.
class StopWatch {
 public:
  double seconds() const { return between(start_, Clock::now()); }
  // Returns the seconds since the last lap, or since the start.
  double lap() {
    const Clock::time_point now = Clock::now();
    return between(std::exchange(start_, now), now);
  }

 private:
  using Clock = std::chrono::steady_clock;
  static double between(Clock::time_point from, Clock::time_point to) {
    return std::chrono::duration<double>(to - from).count();
  }
  Clock::time_point start_ = Clock::now();
};

// Returns the CPU time of all threads.  It wraps after 71 minutes where clock_t has 32 bits.
inline double processor_seconds() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

}  // namespace domefall
