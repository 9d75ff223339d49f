// Rates, slow frames and failed chunks, as the manifests and logs tell them.
#include "farm/work_summary.h"

#include <gmock/gmock.h>

#include "tests/pipeline/image/test_folder.h"

namespace domefall {
namespace {

namespace fs = std::filesystem;
using testing::ElementsAre;
using testing::IsEmpty;
using testing::SizeIs;

constexpr std::int64_t kSecond = 1'000'000'000;

FrameWriter writer_since(double first_s, std::vector<std::int64_t> finished_s) {
  FrameWriter writer;
  writer.first_s = first_s;
  for (const std::int64_t at : finished_s) {
    writer.finished.push_back(at * kSecond);
    writer.last_sign_s = static_cast<double>(at);
  }
  return writer;
}

TEST(WorkRate, IsOfAllWhoLiveSinceTheFirstBegan) {
  Manifest manifest;
  EXPECT_FALSE(frames_per_second(manifest, 10'000));
  manifest.writers.push_back(writer_since(9'900, {9'950, 9'990}));
  manifest.writers.push_back(writer_since(9'950, {9'970, 9'980, 9'990}));
  EXPECT_DOUBLE_EQ(*frames_per_second(manifest, 10'000), 5.0 / 100);
  manifest.writers.push_back(writer_since(9'000, {9'999}));
  manifest.writers.back().ended = true;
  EXPECT_DOUBLE_EQ(*frames_per_second(manifest, 10'000), 5.0 / 100);
  // After ten quiet minutes nobody is taken to work.
  EXPECT_FALSE(frames_per_second(manifest, 10'600));
}

TEST(WorkRate, ForgetsWhatIsOlderThanTenMinutes) {
  Manifest manifest;
  manifest.writers.push_back(writer_since(1'000, {2'000, 3'000, 9'500, 9'900}));
  EXPECT_DOUBLE_EQ(*frames_per_second(manifest, 10'000), 2.0 / 600);
}

TEST(SlowFrames, AreThoseOfTheLastMakingSlowestFirst) {
  Manifest manifest;
  const auto add = [&](int frame, std::int64_t at, double seconds) {
    manifest.files["linear/" + std::to_string(frame)].push_back(
        {frame, "", 1, at, "", "", seconds, 1, "host" + std::to_string(at), 1});
  };
  add(1, 10, 3), add(2, 10, 9), add(2, 20, 1), add(3, 10, 3), add(4, 10, 5);
  const auto slow = slowest_frames(manifest, {1, 2, 3, 4}, 3);
  ASSERT_THAT(slow, SizeIs(3));
  EXPECT_EQ(slow[0].frame, 4);
  EXPECT_EQ(slow[1].frame, 1);
  EXPECT_EQ(slow[2].frame, 3);
  EXPECT_THAT(slowest_frames(manifest, {1, 2, 3, 4}, 100), SizeIs(4));
  // Frames of another plan are no part of this one's work.
  EXPECT_EQ(slowest_frames(manifest, {2, 3}, 1).front().frame, 3);
}

class FailedChunks : public TestFolder {
 protected:
  FailedChunks() { fs::create_directories(folder_ / "farm" / "log"); }
  void put_log(const char* name, const std::string& text) const {
    put(folder_ / "farm" / "log" / name, text);
  }
  const std::vector<TaskFrames> chunks_{{0, 0, {0, 1}, {"_0_0", "_7_0"}},
                                        {0, 1, {2, 3}, {"_0_1", "_7_1"}},
                                        {0, 12, {4, 5}, {"_7_12"}}};
};

TEST_F(FailedChunks, AreToldWithTheLastLineOfTheirLogs) {
  put_log("slurm_7_1.log", "begins\nframe 3: the pixel (1, 2) is no number\n\n  \n");
  put_log("slurm_7_12.log", "\x1b[Kdisk is\x07 full\r\n");
  const auto failed = failed_chunks(chunks_, {1, 3, 4, 5}, {}, folder_);
  ASSERT_THAT(failed, SizeIs(2));
  EXPECT_EQ(failed[0].task, 1);
  EXPECT_THAT(failed[0].lacking, ElementsAre(3));
  EXPECT_EQ(failed[0].last_line, "frame 3: the pixel (1, 2) is no number");
  EXPECT_EQ(failed[1].task, 12);
  EXPECT_EQ(failed[1].last_line, "[Kdisk is full");
}

TEST_F(FailedChunks, AreNotThoseThatAreDoneOrBeingMade) {
  put_log("slurm_7_1.log", "begins\n");
  put_log("slurm_7_0.log", "");
  Manifest manifest;
  manifest.writers.emplace_back().being_made[2] = 100;
  EXPECT_THAT(failed_chunks(chunks_, {2, 3}, manifest, folder_), IsEmpty());
  EXPECT_THAT(failed_chunks(chunks_, {}, {}, folder_), IsEmpty());
}

// It may just have begun; where the disk is full, nothing can be written there either.
TEST_F(FailedChunks, SayThatTheirLogIsEmptyAfterAWhile) {
  put_log("slurm_7_0.log", "");
  EXPECT_THAT(failed_chunks(chunks_, {0}, {}, folder_), IsEmpty());
  fs::last_write_time(folder_ / "farm/log/slurm_7_0.log",
                      fs::file_time_type::clock::now() - std::chrono::hours(1));
  EXPECT_EQ(failed_chunks(chunks_, {0}, {}, folder_).at(0).last_line, "the log is empty");
}

TEST_F(FailedChunks, AreToldByTheLogThatWasWrittenLast) {
  put_log("slurm_7_1.log", "old\n");
  put_log("local_0_1.log", "new\n");
  put_log("verify_1.log", "of another kind\n");
  fs::last_write_time(folder_ / "farm/log/slurm_7_1.log",
                      fs::file_time_type::clock::now() - std::chrono::hours(1));
  EXPECT_EQ(failed_chunks(chunks_, {3}, {}, folder_).at(0).last_line, "new");
}

// The show was edited, or frames were removed, when the task had ended.
TEST_F(FailedChunks, AreNotThoseThatEndedWell) {
  put_log("slurm_7_1.log", "begins\n2 frames made, 0 already there, in 0.3 s: /frames\n");
  EXPECT_THAT(failed_chunks(chunks_, {2, 3}, {}, folder_), IsEmpty());
}

// Frame 3 failed in the first round and is submitted again.
TEST_F(FailedChunks, HaveNotFailedAgainBeforeTheirNextTaskBegan) {
  std::vector<TaskFrames> tasks = chunks_;
  tasks.push_back({1, 0, {3}, {"_1_0", "_8_0"}});
  put_log("slurm_7_1.log", "first\n");
  EXPECT_THAT(failed_chunks(tasks, {3}, {}, folder_), IsEmpty());
  put_log("slurm_8_0.log", "second\n");
  const auto failed = failed_chunks(tasks, {2, 3}, {}, folder_);
  ASSERT_THAT(failed, SizeIs(2));
  EXPECT_THAT(failed[0].lacking, ElementsAre(2));
  EXPECT_EQ(failed[1].round, 1);
  EXPECT_EQ(failed[1].last_line, "second");
}

}  // namespace
}  // namespace domefall
