#include "pipeline/preview/live_show.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <future>
#include <map>

#include "pipeline/image/errors.h"
#include "pipeline/image/scratch_folder.h"

namespace domefall {
namespace {

using testing::HasSubstr;
using Words = std::map<std::string, std::string, std::less<>>;

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
