#include "pipeline/grade/shared_steps.h"

#include <gtest/gtest.h>

#include <atomic>
#include <stdexcept>
#include <thread>
#include <vector>

namespace domefall {
namespace {

TEST(SharedSteps, AreEachTakenOnceAndAllDoneWhenAnyoneReturns) {
  constexpr int kSteps = 1000, kThreads = 4;
  SharedSteps shared(kSteps);
  std::vector<std::atomic<int>> taken(kSteps);
  std::atomic<int> early = 0;
  std::vector<std::thread> threads;
  threads.reserve(kThreads);
  for (int t = 0; t < kThreads; ++t)
    threads.emplace_back([&] {
      shared.take([&](int k) { ++taken[static_cast<std::size_t>(k)]; });
      for (const auto& times : taken) early += times != 1;
    });
  for (auto& thread : threads) thread.join();
  EXPECT_EQ(early, 0);
}

TEST(SharedSteps, ThrowForEveryCallerWhatOneOfThemThrew) {
  SharedSteps shared(10);
  const auto step = [](int k) {
    if (k == 3) throw std::runtime_error("third");
  };
  EXPECT_THROW(shared.take(step), std::runtime_error);
  EXPECT_THROW(shared.take(step), std::runtime_error);
}

}  // namespace
}  // namespace domefall
