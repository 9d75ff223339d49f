#include "pipeline/program/preview/live_show.h"

#include <gmock/gmock.h>

#include <fstream>
#include <future>
#include <map>

#include "pipeline/base/errors.h"
#include "pipeline/base/temporary_file.h"

namespace domefall {
namespace {

using Turn = NewestFirst::Turn;
using testing::HasSubstr;
using Words = std::map<std::string, std::string, std::less<>>;

void write(const std::filesystem::path& file, const char* text) { std::ofstream(file) << text; }

// Says whether one of two looks, of which the first may be at a file that is being written, tells
// of the file.
bool tells(FileWatch& watch) {
  const bool at_once = watch.is_written();
  return watch.is_written() || at_once;
}

TEST(FileWatch, SeesAFileThatIsWrittenAndOneThatTakesItsPlace) {
  const ScratchFolder folder;
  const auto file = folder / "show.yaml";
  write(file, "one");
  FileWatch watch(file);
  EXPECT_FALSE(tells(watch));
  write(file, "longer");
  EXPECT_TRUE(tells(watch));
  EXPECT_FALSE(tells(watch)) << "a second time";
  write(folder / "show.yaml~", "length");
  EXPECT_FALSE(tells(watch)) << "another file";
  std::filesystem::last_write_time(folder / "show.yaml~", std::filesystem::last_write_time(file));
  std::filesystem::rename(folder / "show.yaml~", file);
  EXPECT_TRUE(tells(watch)) << "of the same size and time";
  std::filesystem::last_write_time(file, std::filesystem::file_time_type::clock::now());
  EXPECT_TRUE(tells(watch)) << "a later time";
}

TEST(FileWatch, WaitsUntilAFileIsWrittenToItsEnd) {
  const ScratchFolder folder;
  const auto file = folder / "show.yaml";
  write(file, "one");
  FileWatch watch(file);
  for (const char* text : {"", "t", "tw", "two and more"}) {
    write(file, text);
    EXPECT_FALSE(watch.is_written()) << text;
  }
  EXPECT_TRUE(watch.is_written());
}

TEST(FileWatch, SeesWhatALinkLeadsTo) {
  const ScratchFolder folder, other;
  write(other / "target.yaml", "one");
  write(other / "second.yaml", "one");
  const auto link = folder / "show.yaml";
  std::filesystem::create_symlink(other / "target.yaml", link);
  FileWatch watch(link);
  write(other / "target.yaml", "longer");
  EXPECT_TRUE(tells(watch));
  std::filesystem::remove(link);
  std::filesystem::create_symlink(other / "second.yaml", link);
  EXPECT_TRUE(tells(watch)) << "another target";
}

TEST(FileWatch, SeesAFileGoAndComeBackInAnotherFolder) {
  const ScratchFolder folder;
  const auto inner = folder / "inner";
  std::filesystem::create_directory(inner);
  write(inner / "show.yaml", "one");
  FileWatch watch(inner / "show.yaml");
  std::filesystem::rename(inner, folder / "away");
  EXPECT_TRUE(tells(watch));
  EXPECT_FALSE(tells(watch));
  std::filesystem::create_directory(inner);
  write(inner / "show.yaml", "one");
  EXPECT_TRUE(tells(watch));
}

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

constexpr int kLong = 60;  // seconds, for machines that are busy

// A show of two seconds on a sky of squares, and what has its pictures made.
class LiveShows : public testing::Test {
 protected:
  LiveShows() { write("6"); }

  void write(const std::string& r) {
    const auto beside = folder_ / "new.yaml";
    std::ofstream(beside) << "frames_per_second: 10\nsize: 64\nblack_hole: {mass_solar: 10}\n"
                             "sky: {region_I: {background: grid, stars: none}}\n"
                             "timeline: [{duration_s: 2, trajectory: {type: static, r: "
                          << r << "}}]\n";
    std::filesystem::rename(beside, file_);  // as editors do
  }

  static std::string jpeg(LiveShow& live, Words words, long number = 1) {
    words.insert({{"w", "64"}, {"h", "48"}, {"display", "sRGB - Display"}});
    const Parameters parameters = [&](std::string_view name) -> std::optional<std::string> {
      const auto found = words.find(name);
      if (found == words.end()) return std::nullopt;
      return found->second;
    };
    const auto made = live.picture(parameters, {"a", number, false});
    return made ? made->picture.jpeg : "";
  }

  ScratchFolder folder_;
  std::filesystem::path file_ = folder_ / "show.yaml";
};

TEST_F(LiveShows, FollowTheirFileAndKeepTheLastGoodVersion) {
  LiveShow live(file_, 1);
  EXPECT_EQ(live.version().revision, 1);
  const std::string at_six = jpeg(live, {});
  EXPECT_THAT(at_six, testing::StartsWith("\xff\xd8"));

  write("-6");
  LiveShow::Version version = live.changed_since(1, kLong);
  EXPECT_THAT(version.mistake, HasSubstr("show.yaml:5:"));
  EXPECT_THAT(version.mistake, HasSubstr("-6"));
  EXPECT_EQ(version.revision, 1);
  EXPECT_EQ(jpeg(live, {}), at_six);

  write("9");
  version = live.changed_since(version.readings, kLong);
  EXPECT_EQ(version.mistake, "");
  EXPECT_EQ(version.revision, 2);
  EXPECT_NE(jpeg(live, {}), at_six);

  write("6");
  live.changed_since(version.readings, kLong);
  EXPECT_EQ(jpeg(live, {}), at_six);
  std::filesystem::remove(file_);
  EXPECT_EQ(jpeg(live, {}), at_six);
}

TEST_F(LiveShows, AreNotChangedByWhatAPictureLeavesOut) {
  LiveShow live(file_, 2);
  const std::string plain = jpeg(live, {});
  for (const auto& [name, value] :
       std::multimap<std::string, std::string>{{"effects", ""},
                                               {"effects", "aberration,doppler_colour,intensity"},
                                               {"amplification", "everything"},
                                               {"skies", ""},
                                               {"ev", "2"},
                                               {"look", "90,0,0"},
                                               {"overlays", "grid"},
                                               {"projection", "equirectangular"},
                                               {"view", "ACES SDR"}}) {
    EXPECT_NE(jpeg(live, {{name, value}}), plain) << name;
    EXPECT_EQ(jpeg(live, {}), plain) << "after " << name;
  }
  EXPECT_EQ(jpeg(live, {{"view", "Dome"}}), plain);
  EXPECT_THROW(jpeg(live, {{"view", "Doom"}}), InputError);
  EXPECT_EQ(jpeg(live, {}), plain) << "after a refusal";
}

TEST_F(LiveShows, MakePicturesForManyWhileTheirFileIsWritten) {
  LiveShow live(file_, 2);
  std::vector<std::future<int>> clients;
  for (int client = 0; client < 4; ++client)
    clients.push_back(std::async(std::launch::async, [&live, client] {
      int made = 0;
      for (int n = 1; n <= 10; ++n)
        made += !jpeg(live, {{"frame", std::to_string(client + n)}}, 1000).empty();
      return made;
    }));
  int readings = 1;
  for (const char* r : {"7", "-1", "8"}) {
    write(r);
    readings = live.changed_since(readings, kLong).readings;
  }
  for (auto& client : clients) EXPECT_EQ(client.get(), 10);
  EXPECT_GE(live.version().revision, 2);
}

TEST_F(LiveShows, LetNobodyWaitForNewsOnceTheyStop) {
  LiveShow live(file_, 1);
  auto waiting = std::async(std::launch::async, [&] { return live.changed_since(1, 3600); });
  live.stop();
  EXPECT_EQ(waiting.get().revision, 1);
}

}  // namespace
}  // namespace domefall
