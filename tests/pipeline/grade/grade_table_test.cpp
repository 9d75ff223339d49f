#include "pipeline/grade/grade_table.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <mutex>
#include <set>
#include <stdexcept>
#include <thread>
#include <vector>

namespace domefall {
namespace {

void square_roots(const float* rgb, int pixels, float* codes) {
  for (int k = 0; k < 3 * pixels; ++k) codes[k] = std::sqrt(std::max(rgb[k], 0.0f));
}

TEST(PixelPlanes, SplitWhatLightIsAndMarkTheRest) {
  std::vector<Imath::half> rgb;
  for (int k = 0; k < 19; ++k)
    for (int c = 0; c < 3; ++c)
      rgb.emplace_back(std::ldexp(1.0f + 0.25f * static_cast<float>(c), k - 24));
  rgb[3 * 5] = -1.0f, rgb[3 * 7 + 1] = HUGE_VALF, rgb[3 * 9 + 2] = NAN;
  std::fill_n(rgb.begin() + 3 * 18, 3, Imath::half(0.0f));
  PixelPlanes planes;
  EXPECT_EQ(split_pixels(rgb.data(), 19, planes), 1);
  for (int k = 0; k < 19; ++k) {
    const auto n = static_cast<std::size_t>(k);
    const bool bad = k == 5 || k == 7 || k == 9;
    EXPECT_EQ(planes.red[n], bad ? -1 : float{rgb[3 * n]}) << k;
    EXPECT_EQ(planes.green[n], bad ? -1 : float{rgb[3 * n + 1]}) << k;
    EXPECT_EQ(planes.blue[n], bad ? -1 : float{rgb[3 * n + 2]}) << k;
  }
}

TEST(GradeTable, MissesWhatIsNegativeOrTooColourfulOrTooBright) {
  GradeTable table(square_roots);
  table.make();
  PixelPlanes planes;
  const float pixels[][3] = {{0.5f, 0.4f, 0.3f}, {0.5f, 0.4f, 0.1f},   {-1, -1, -1},
                             {0, 0, 0},          {0.3f, 0.3f, -1e-6f}, {1e5f, 1e5f, 1e5f}};
  for (std::size_t k = 0; k < 6; ++k)
    planes.red[k] = pixels[k][0], planes.green[k] = pixels[k][1], planes.blue[k] = pixels[k][2];
  unsigned short codes[19];
  int missed[7];
  const int misses = table.look_up(planes, 6, codes, missed);
  EXPECT_EQ(std::vector<int>(missed, missed + misses), (std::vector<int>{1, 2, 4, 5}));
  EXPECT_NEAR(codes[0], 65535 * std::sqrt(0.5), 8);
  EXPECT_NEAR(codes[2], 65535 * std::sqrt(0.3), 8);
  for (int c = 0; c < 3; ++c) EXPECT_EQ(codes[9 + c], 0) << "black is held whatever its cell is";
}

// So a run with --threads 1 has no other thread at work.
TEST(GradeTable, IsMadeByTheThreadsThatAskForIt) {
  std::mutex mutex;
  std::set<std::thread::id> seen;
  GradeTable table([&](const float* rgb, int pixels, float* codes) {
    square_roots(rgb, pixels, codes);
    const std::lock_guard lock(mutex);
    seen.insert(std::this_thread::get_id());
  });
  std::thread other([&] { table.make(); });
  table.make();
  other.join();
  seen.insert(std::this_thread::get_id());
  EXPECT_LE(seen.size(), 2U);
  EXPECT_GT(table.held(), 0.5);
  EXPECT_LT(table.error(), GradeTable::kMostError);
}

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
