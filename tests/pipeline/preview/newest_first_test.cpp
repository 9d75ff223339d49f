#include "pipeline/preview/newest_first.h"

#include <gtest/gtest.h>

#include <future>

namespace domefall {
namespace {

using Turn = NewestFirst::Turn;

TEST(NewestFirst, LetsTheNewestOfAClientInAndTellsTheOthersThatTheyAreLate) {
  NewestFirst turns;
  ASSERT_EQ(turns.enter({"a", 1, false}), Turn::kNow);
  auto second = std::async(std::launch::async, [&] { return turns.enter({"a", 2, false}); });
  // Whether it waits already or not yet, the third one makes it late.
  auto third = std::async(std::launch::async, [&] { return turns.enter({"a", 3, false}); });
  const auto late = [&] { return second.wait_for(std::chrono::seconds(60)); };
  // The second may come after the third, and is then late at once.
  ASSERT_EQ(late(), std::future_status::ready);
  EXPECT_EQ(second.get(), Turn::kOutdated);
  turns.leave();
  EXPECT_EQ(third.get(), Turn::kNow);
  turns.leave();
  EXPECT_EQ(turns.enter({"a", 2, false}), Turn::kOutdated) << "one that was long on its way";
}

TEST(NewestFirst, LetsEachClientHaveItsTurn) {
  NewestFirst turns;
  ASSERT_EQ(turns.enter({"a", 5, false}), Turn::kNow);
  auto other = std::async(std::launch::async, [&] { return turns.enter({"b", 1, false}); });
  EXPECT_EQ(other.wait_for(std::chrono::milliseconds(20)), std::future_status::timeout);
  turns.leave();
  EXPECT_EQ(other.get(), Turn::kNow);
}

TEST(NewestFirst, StopsWhatCanGiveWayAndNothingElse) {
  NewestFirst turns;
  ASSERT_EQ(turns.enter({"a", 1, true}), Turn::kNow);
  EXPECT_FALSE(turns.stop());
  auto other = std::async(std::launch::async, [&] {
    const Turn turn = turns.enter({"b", 1, false});
    return std::pair(turn, turns.stop().load());
  });
  while (!turns.stop()) std::this_thread::yield();
  turns.leave();
  EXPECT_EQ(other.get(), std::pair(Turn::kNow, false));
  auto third = std::async(std::launch::async, [&] { return turns.enter({"a", 2, true}); });
  EXPECT_EQ(third.wait_for(std::chrono::milliseconds(20)), std::future_status::timeout);
  EXPECT_FALSE(turns.stop()) << "a moving picture is soon done";
  turns.leave();
  EXPECT_EQ(third.get(), Turn::kNow);
}

// Two clients that both want a fine picture would else stop each other for ever.
TEST(NewestFirst, DoesNotStopOneThatCanGiveWayForAnotherThatCan) {
  NewestFirst turns;
  ASSERT_EQ(turns.enter({"a", 1, true}), Turn::kNow);
  auto other = std::async(std::launch::async, [&] { return turns.enter({"b", 1, true}); });
  EXPECT_EQ(other.wait_for(std::chrono::milliseconds(20)), std::future_status::timeout);
  EXPECT_FALSE(turns.stop());
  auto newer = std::async(std::launch::async, [&] { return turns.enter({"a", 2, true}); });
  while (!turns.stop()) std::this_thread::yield();
  turns.leave();
  // Both get in, one after the other, in any order.
  auto first = std::async(std::launch::async, [&] {
    const Turn turn = other.get();
    turns.leave();
    return turn;
  });
  EXPECT_EQ(newer.get(), Turn::kNow);
  turns.leave();
  EXPECT_EQ(first.get(), Turn::kNow);
}

TEST(NewestFirst, GivesNobodyATurnOnceItEnds) {
  NewestFirst turns;
  ASSERT_EQ(turns.enter({"a", 1, false}), Turn::kNow);
  auto other =
      std::async(std::launch::async, [&] { return turns.enter(NewestFirst::own_ticket()); });
  turns.end();
  EXPECT_TRUE(turns.stop());
  EXPECT_EQ(other.get(), Turn::kTooMany);
  turns.leave();
  EXPECT_EQ(turns.enter({"a", 2, false}), Turn::kTooMany);
}

TEST(NewestFirst, LetsNoMoreWaitThanItSays) {
  NewestFirst turns;
  ASSERT_EQ(turns.enter({"a", 1, false}), Turn::kNow);
  std::vector<std::future<Turn>> waiting;
  for (int k = 0; k <= NewestFirst::kMostWaiting; ++k)
    waiting.push_back(std::async(std::launch::async, [&turns, k] {
      const Turn turn = turns.enter({"b" + std::to_string(k), 1, false});
      if (turn == Turn::kNow) turns.leave();
      return turn;
    }));
  int refused = 0;
  // The one too many is told at once; the others still wait.
  while (refused == 0)
    for (auto& one : waiting)
      if (one.valid() && one.wait_for(std::chrono::seconds(0)) == std::future_status::ready) {
        EXPECT_EQ(one.get(), Turn::kTooMany);
        ++refused;
      }
  turns.leave();
  for (auto& one : waiting) {
    if (one.valid()) {
      EXPECT_EQ(one.get(), Turn::kNow);
    }
  }
  EXPECT_EQ(refused, 1);
}

}  // namespace
}  // namespace domefall
