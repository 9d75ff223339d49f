#include "farm/chunks.h"

#include <gtest/gtest.h>

#include <numeric>

namespace domefall {
namespace {

std::vector<int> first_frames(int count) {
  std::vector<int> frames(static_cast<std::size_t>(count));
  std::iota(frames.begin(), frames.end(), 0);
  return frames;
}

TEST(EqualChunks, FramesOfOneCostAreSharedEvenly) {
  const auto chunks = equal_chunks(first_frames(40), std::vector<double>(40, 0.3), 4);
  ASSERT_EQ(chunks.size(), 4U);
  for (const auto& chunk : chunks) EXPECT_EQ(chunk.size(), 10U);
  EXPECT_EQ(chunks[1].front(), 10);
}

TEST(EqualChunks, WhereFramesAreDearChunksAreShort) {
  std::vector<double> costs(1000, 1.0);
  for (std::size_t k = 600; k < 700; ++k) costs[k] = 20;
  const auto chunks = equal_chunks(first_frames(1000), costs, 29);
  ASSERT_EQ(chunks.size(), 29U);
  for (const auto& chunk : chunks) {
    double cost = 0;
    for (const int frame : chunk) cost += costs[static_cast<std::size_t>(frame)];
    EXPECT_NEAR(cost, 100, 20) << "from frame " << chunk.front();
    if (chunk.front() >= 600 && chunk.back() < 700) {
      EXPECT_LE(chunk.size(), 6U);
    }
  }
}

TEST(EqualChunks, EachFrameIsInOneChunkAndNoneIsEmpty) {
  for (const int most : {1, 3, 7, 50, 1000}) {
    std::vector<double> costs;
    for (int k = 0; k < 50; ++k) costs.push_back(k % 7 == 0 ? 40.0 : 0.1 + k);
    std::vector<int> joined;
    const auto chunks = equal_chunks(first_frames(50), costs, most);
    EXPECT_LE(chunks.size(), static_cast<std::size_t>(most));
    for (const auto& chunk : chunks) {
      EXPECT_FALSE(chunk.empty());
      joined.insert(joined.end(), chunk.begin(), chunk.end());
    }
    EXPECT_EQ(joined, first_frames(50)) << most;
  }
  EXPECT_TRUE(equal_chunks({}, {}, 5).empty());
}

}  // namespace
}  // namespace domefall
