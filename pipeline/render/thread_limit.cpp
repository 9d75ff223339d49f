#include "pipeline/render/thread_limit.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <future>
#include <system_error>
#include <thread>
#include <vector>

#include "pipeline/base/errors.h"

namespace domefall {
namespace {

// Returns how many of `count` threads can live at the same time, by starting them.
int threads_to_be_had(int count) {
  std::promise<void> end;
  const std::shared_future<void> ended = end.get_future().share();
  std::vector<std::thread> threads;
  threads.reserve(static_cast<std::size_t>(count));
  try {
    while (static_cast<int>(threads.size()) < count)
      threads.emplace_back([ended] { ended.wait(); });
  } catch (const std::system_error&) {
    // The system grants no more.
  }
  // All threads wait for this, so that all of them have lived at the same time.
  end.set_value();
  for (std::thread& thread : threads) thread.join();
  return static_cast<int>(threads.size());
}

// Returns the most threads that a run starts.  The terms of the sum are the pools of OpenEXR,
// OpenImageIO and TBB, the threads that grade, and those that do one thing beside another.
int most_threads(int threads) {
  constexpr int kSideBySide = 4;
  const int processors = std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
  return std::max(threads, processors) + processors + std::min(threads, processors) + threads +
         kSideBySide;
}

// A handler is not told why the program ends, so it tries whether a thread can be started.
[[noreturn]] void terminate() {
  if (threads_to_be_had(1) == 0) {
    std::fputs("no thread can be started: a limit on threads or processes (ulimit -u, pids.max)\n",
               stderr);
    _exit(kTryAgain);
  }
  // Any other end is that of the default handler.
  std::abort();
}

}  // namespace

void require_threads(int threads) {
  // Both are found by the first call alone.
  static const int count = most_threads(threads);
  static const int there = threads_to_be_had(count);
  if (there < count)
    throw TemporaryError(fmt::format(
        "{} more threads can be started, and this run starts {}: a limit on threads or processes "
        "(ulimit -u, pids.max). Raise it, or take fewer --threads",
        there, count));
}

int all_threads(int given) {
  // The system may not know the number of its processors, which then counts as 0.
  return given > 0 ? given : std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
}

void install_terminate_handler() { std::set_terminate(terminate); }

}  // namespace domefall
