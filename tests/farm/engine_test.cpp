#include "farm/engine.h"

#include <gmock/gmock.h>

#include <nlohmann/json.hpp>

#include "farm/commands.h"
#include "farm/rounds.h"
#include "farm/slurm.h"
#include "pipeline/base/temporary_file.h"
#include "tests/pipeline/image/test_folder.h"

namespace domefall {
namespace {

using ::testing::Contains;
using ::testing::HasSubstr;
using ::testing::StartsWith;

FarmPlan small_plan() {
  return {.id = "20260101T000000Z_00000a",
          .version = "domefall 1",
          .program = "/opt/dome fall/domefall",
          .show = "/shows/a fall's.yaml",
          .out = "/frames/100%",
          .frames = "0-9",
          .options = {"--size", "4k"},
          .engine = "slurm",
          .engine_options = {"--partition=render", "--mem=8G"},
          .threads = 3,
          .chunks = {{0, 0, "0-4", 1.5}, {0, 1, "5-7,9", 0}}};
}

TEST(ShellWords, TakeEveryWordLiterally) {
  EXPECT_EQ(shell_line({"a-b", "c d", "", "it's", "$x`"}), "a-b 'c d' '' 'it'\\''s' '$x`'");
}

TEST(FarmPlan, IsReadAsItWasWritten) {
  const ScratchFolder folder;
  FarmPlan plan = small_plan();
  plan.out = folder / "out";
  plan.movie = "review";
  plan.rounds = {{0, "12", "2026-01-01T00:00:00Z"}};
  write_plan(plan);
  const FarmPlan read = read_plan(plan.out, plan.id);
  EXPECT_EQ(read.show, plan.show);
  EXPECT_EQ(read.options, plan.options);
  EXPECT_EQ(read.engine_options, plan.engine_options);
  EXPECT_EQ(read.movie, "review");
  ASSERT_EQ(read.chunks.size(), 2U);
  EXPECT_EQ(read.chunks[1].frames, "5-7,9");
  EXPECT_EQ(read.chunks[0].estimated_s, 1.5);
  ASSERT_EQ(read.rounds.size(), 1U);
  EXPECT_EQ(read.rounds[0].job, "12");
}

TEST(FarmPlan, AFurtherRoundHasTheFramesThatLackInChunksOfTheUsualLength) {
  const FramesVerdict verdict{false, "1-7,9", 8, 10};
  const FarmPlan plan = with_round(small_plan(), verdict, 100);
  const auto chunks = chunks_of_round(plan, 1);
  ASSERT_EQ(chunks.size(), 2U);
  EXPECT_EQ(chunks[0].frames, "1-5");
  EXPECT_EQ(chunks[1].frames, "6-7,9");
  EXPECT_EQ(chunks[1].task, 1);
  EXPECT_EQ(chunks_of_round(with_round(small_plan(), verdict, 1), 1).size(), 1U);
  EXPECT_EQ(with_round(plan, verdict, 100).rounds.back().round, 2);
}

TEST(FarmPlan, AFurtherRoundIsInSmallChunksWhereTheFirstLeftFramesOutThatWereThere) {
  FarmPlan partial = small_plan();
  partial.frames = "0-999";
  EXPECT_EQ(chunks_of_round(with_round(partial, {false, "0-7,9", 9, 1000}, 100), 1).size(), 2U);
}

TEST(JobLists, AListHasALineForEachChunk) {
  EXPECT_EQ(list_of_commands(small_plan()),
            "'/opt/dome fall/domefall' render '/shows/a fall'\\''s.yaml' --frames 0-4 --out "
            "/frames/100% --threads 3 --size 4k\n"
            "'/opt/dome fall/domefall' render '/shows/a fall'\\''s.yaml' --frames 5-7,9 --out "
            "/frames/100% --threads 3 --size 4k\n");
}

TEST(JobLists, ATemplateRefusesWhatItWouldTakeForAVariable) {
  FarmPlan plan = small_plan();
  EXPECT_NO_THROW(openjd_template(plan));
  plan.out = "/frames/{{x}}";
  EXPECT_THROW(openjd_template(plan), InputError);
}

TEST(FarmPlan, RefusesPathsThatAreNoTextAndMakesNothing) {
  const ScratchFolder folder;
  FarmPlan plan = small_plan();
  plan.out = folder / "out";
  plan.show = "/shows/\xff.yaml";
  EXPECT_THAT(message_of([&] { write_plan(plan); }), StartsWith("/shows/\\xFF.yaml: is not UTF-8"));
  EXPECT_FALSE(std::filesystem::exists(plan.out));
}

TEST(JobLists, RefusePathsThatAreNoText) {
  for (std::filesystem::path FarmPlan::*path : {&FarmPlan::show, &FarmPlan::out}) {
    FarmPlan plan = small_plan();
    plan.*path = "/a b/\xff";
    const auto refusal = StartsWith("/a b/\\xFF: is not UTF-8");
    EXPECT_THAT(message_of([&] { openjd_template(plan); }), refusal);
    EXPECT_THAT(message_of([&] { flamenco_job(plan); }), refusal);
    // A shell takes any bytes.
    EXPECT_THAT(list_of_commands(plan), HasSubstr("\xff"));
  }
}

TEST(JobLists, RefusePathsWithControlCharacters) {
  for (const char* word : {"/a\ntouch pwned #", "/a\rb", "/a\x1b[2Jb", "/a\u009bb", "/a\u2028b"}) {
    FarmPlan plan = small_plan();
    plan.out = word;
    const auto refusal = HasSubstr("has the control character");
    EXPECT_THAT(message_of([&] { check_plan_text(plan); }), refusal);
    EXPECT_THAT(message_of([&] { list_of_commands(plan); }), refusal);
    EXPECT_THAT(message_of([&] { openjd_template(plan); }), refusal);
    EXPECT_THAT(message_of([&] { flamenco_job(plan); }), refusal);
    EXPECT_THAT(message_of([&] { array_submission(plan, 0); }), refusal);
    EXPECT_THAT(message_of([&] { conclusion_submission(plan, 0, ""); }), refusal);
  }
}

TEST(JobLists, ALongNameIsCutBetweenCharacters) {
  constexpr int kLetters = 200;
  FarmPlan plan = small_plan();
  std::string letters;
  for (int k = 0; k < kLetters; ++k) letters += "\u00e9";
  plan.show = "/shows/" + letters + ".yaml";
  const std::string beginning = "domefall ";
  const std::string name = nlohmann::json::parse(openjd_template(plan)).at("name");
  // The letters, which take two bytes each, fill the 128 characters.
  EXPECT_EQ(name, beginning + letters.substr(0, 2 * (128 - beginning.size())));
  // A job of Flamenco may have a name of any length.
  EXPECT_EQ(nlohmann::json::parse(flamenco_job(plan)).at("name"), beginning + letters);
}

// Slurm leaves the backslash out, and writes elsewhere.
TEST(Slurm, RefusesAFolderWhoseLogsItCouldNotWrite) {
  FarmPlan plan = small_plan();
  plan.out = "/frames/a\\b";
  EXPECT_THAT(message_of([&] { array_submission(plan, 0); }),
              HasSubstr("where a path has a backslash"));
}

TEST(Slurm, TakesNamesAsTheyAre) {
  FarmPlan plan = small_plan();
  plan.show = "/shows/--wrap=x, %j.yaml";
  plan.out = "/frames/a,b %j";
  const auto array = array_submission(plan, 0);
  EXPECT_THAT(array, Contains("--job-name=domefall---wrap=x, %j"));
  EXPECT_THAT(array, Contains("--output=/frames/a,b %%j/farm/log/slurm_%A_%a.log"));
  EXPECT_THAT(array, Contains(HasSubstr(" work '/frames/a,b %j' --plan")));
}

TEST(Slurm, AnArrayIsVerifiedAfterItsTasksHoweverTheyEnd) {
  const auto array = array_submission(small_plan(), 0);
  EXPECT_THAT(array, Contains("--array=0-1"));
  EXPECT_THAT(array, Contains("--cpus-per-task=3"));
  EXPECT_THAT(array, Contains("--partition=render"));
  EXPECT_THAT(array, Contains("--output=/frames/100%%/farm/log/slurm_%A_%a.log"));
  EXPECT_THAT(array, Contains("--wrap=exec '/opt/dome fall/domefall' farm work /frames/100% --plan "
                              "20260101T000000Z_00000a "
                              "--round 0 --slurm --task \"$SLURM_ARRAY_TASK_ID\""));
  const auto after = conclusion_submission(small_plan(), 0, "77");
  EXPECT_THAT(after, Contains("--dependency=afterany:77"));
  EXPECT_THAT(after, Contains("--mem=8G"));
  FarmPlan throttled = small_plan();
  throttled.at_once = 1;
  EXPECT_THAT(array_submission(throttled, 0), Contains("--array=0-1%1"));
}

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
