#include "pipeline/farm/slurm_cancellation.h"

#include <gtest/gtest.h>

namespace domefall {
namespace {

constexpr const char* kEarly = "2026-01-31T23:59:58";
constexpr const char* kLate = "2026-02-01T00:00:01";

TEST(SlurmCancellation, OfAllThatWasLeftIsTheEndOfTheArray) {
  EXPECT_TRUE(end_by_cancellation(
      {{"COMPLETED", kEarly}, {"CANCELLED by 1000", kLate}, {"CANCELLED", kLate}}));
  EXPECT_TRUE(end_by_cancellation({{"FAILED", kLate}, {"CANCELLED", kLate}}));
}

TEST(SlurmCancellation, OfATaskWhileOthersGoOnIsNot) {
  EXPECT_FALSE(end_by_cancellation({{"CANCELLED", kEarly}, {"COMPLETED", kLate}}));
  EXPECT_FALSE(end_by_cancellation({{"COMPLETED", kEarly}, {"NODE_FAIL", kLate}}));
  EXPECT_FALSE(end_by_cancellation({}));
}

}  // namespace
}  // namespace domefall
