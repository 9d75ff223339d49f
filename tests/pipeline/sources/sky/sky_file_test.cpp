#include "pipeline/sources/sky/sky_file.h"

#include <gmock/gmock.h>

#include <fstream>
#include <functional>

#include "pipeline/sources/sky/read_sky.h"
#include "tests/pipeline/image/test_folder.h"

namespace domefall {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

class SkyFiles : public TestFolder {
 protected:
  // Channel 0 depends on the direction of a texel.
  static void write(const fs::path& path, int size) {
    NewSkyFile file(
        path, SkyMapKind::kColour, 0x1p-20, size,
        {"source: a test\nlicence: none\n", Orientation{SkyFrame::kGalactic, true, false, 266.5}});
    paint(file.pyramid().levels[0], [](const V3d& d, float* channel) {
      channel[0] = static_cast<float>(2 + d.normalized().z);
      channel[1] = 1;
    });
    file.finish();
  }

  // What is said of the file after `damage` was done to its bytes.
  std::string said_of(const std::function<void(std::string&)>& damage, bool verify = false) const {
    const fs::path path = folder_ / "damaged.sky";
    write(path, 4);
    std::string bytes = contents(path);
    damage(bytes);
    put(path, bytes);
    const std::string said = message_of([&] {
      const SkyFile file(path);
      if (verify) file.verify();
    });
    EXPECT_TRUE(said.empty() || said.starts_with(path.string() + ": ")) << said;
    return said;
  }
};

TEST_F(SkyFiles, TheFaintestStarsThatAMapLeavesOutAreKept) {
  for (const double limit : {9.0, 12.5, -1.0}) {
    NewSkyFile file(folder_ / "limited.sky", SkyMapKind::kColour, 1, 4,
                    {"source: a test\n", std::nullopt, limit});
    file.finish();
    EXPECT_EQ(SkyFile(folder_ / "limited.sky").origin().fainter_than, limit);
  }
  EXPECT_EQ(SkyFile(folder_ / "limited.sky").origin().text,
            "stars: fainter than V = -1\nsource: a test\n");
  write(folder_ / "unlimited.sky", 4);
  EXPECT_FALSE(SkyFile(folder_ / "unlimited.sky").origin().fainter_than);
}

TEST_F(SkyFiles, OnlyTheLevelsThatAreUsedAreVerified) {
  const fs::path path = folder_ / "fine.sky";
  write(path, 64);
  std::fstream damaged(path, std::ios::binary | std::ios::in | std::ios::out);
  damaged.seekp(5000);  // in the finest level
  damaged.put('x');
  damaged.close();
  const SkyFile file(path);
  EXPECT_THROW(file.verify(), InputError);
  EXPECT_NO_THROW(file.verify(32));
  EXPECT_THROW(read_sky(path), InputError);
  EXPECT_EQ(read_sky(path, 32).map->levels().front().size, 32);
}

TEST_F(SkyFiles, AMapComesBackAsItWasWithWhatIsSaidOfIt) {
  const fs::path path = folder_ / "map.sky";
  write(path, 32);
  const SkyFile file(path);
  EXPECT_EQ(file.map().kind(), SkyMapKind::kColour);
  EXPECT_EQ(file.map().unit(), 0x1p-20);
  EXPECT_EQ(file.map().levels().size(), 6u);
  EXPECT_EQ(file.origin().text, "source: a test\nlicence: none\n");
  EXPECT_EQ(file.origin().panorama, (Orientation{SkyFrame::kGalactic, true, false, 266.5}));
  for (const SkyLevel& level : file.map().levels())
    EXPECT_EQ(reinterpret_cast<std::uintptr_t>(level.texels) % 4096, 0u);
  for (const V3d& d : {V3d(0, 0, 1), V3d(1, 0, 0), V3d(-0.6, 0, -0.8)})
    EXPECT_NEAR(file.map().sample(d, 0).r, (2 + d.z) * 0x1p-20, 2e-3 * 0x1p-20);
  EXPECT_NO_THROW(file.verify());
  EXPECT_NEAR(read_sky(path).map->sample({0, 0, 1}, 0).r, 3 * 0x1p-20, 2e-3 * 0x1p-20);
  const auto coarse = read_sky(path, 9).map;
  ASSERT_EQ(coarse->levels().size(), 4u);
  EXPECT_EQ(coarse->levels().front().size, 8);
  EXPECT_EQ(read_sky(path, 0).map->levels().size(), 1u);
  EXPECT_EQ(file_count(), 1) << "no temporary is left";
}

TEST_F(SkyFiles, AnAbandonedFileLeavesTheOldOneAndNothingElse) {
  const fs::path path = folder_ / "map.sky";
  write(path, 4);
  const std::string before = SkyFile(path).digest();
  { const NewSkyFile unfinished(path, SkyMapKind::kColour, 1, 8, {}); }
  EXPECT_EQ(SkyFile(path).digest(), before);
  EXPECT_EQ(file_count(), 1);
  EXPECT_THROW(NewSkyFile(folder_ / "nowhere" / "map.sky", SkyMapKind::kColour, 1, 8, {}),
               TemporaryError);
}

TEST_F(SkyFiles, WhatIsWrongIsToldWithItsByte) {
  EXPECT_EQ(said_of([](std::string&) {}, true), "");
  EXPECT_THAT(said_of([](std::string& s) { s[0] = 'X'; }), HasSubstr("byte 0: this is not a"));
  EXPECT_THAT(said_of([](std::string& s) { s[8] = 2; }),
              HasSubstr("byte 8: a .sky file of version 2"));
  EXPECT_THAT(said_of([](std::string& s) { s[33] ^= 1; }),
              HasSubstr("byte 16: the header is damaged"));
  EXPECT_THAT(said_of([](std::string& s) { s[12] = 1; }), HasSubstr("byte 12: the header is"));
  EXPECT_THAT(said_of([](std::string& s) { s.resize(s.size() - 1); }),
              HasSubstr("bytes instead of"));
  EXPECT_THAT(said_of([](std::string& s) { s += "more"; }), HasSubstr("bytes instead of"));
}

// The levels are not read when a map is opened; only a verification finds what is wrong there.
TEST_F(SkyFiles, ADamagedTexelIsFoundByVerification) {
  const auto damage = [](std::string& s) { s[4096 + 2 * 36 * 8 + 9] ^= 1; };
  EXPECT_EQ(said_of(damage), "");
  EXPECT_THAT(said_of(damage, true),
              HasSubstr("byte 4672: face 2 of the level of size 4 is damaged"));
}

// Resident memory (KiB) of this process's mapping of a file.
long resident(const fs::path& path) {
  std::ifstream maps("/proc/self/smaps");
  bool here = false;
  for (std::string line; std::getline(maps, line);) {
    if (line.find(path.filename().string()) != std::string::npos) here = true;
    if (here && line.starts_with("Rss:")) return std::stol(line.substr(4));
  }
  return -1;
}

TEST_F(SkyFiles, AMapIsMappedAndNotRead) {
  const fs::path path = folder_ / "large.sky";
  { NewSkyFile(path, SkyMapKind::kColour, 1, 1024, {}).finish(); }
  const SkyFile file(path);
  ASSERT_GT(file.map().bytes(), 66'000'000u);
  ASSERT_GE(resident(path), 0);
  // A small cap is sampled finely, and the whole sky coarsely.
  for (int k = 0; k < 1000; ++k) {
    file.map().sample({1, 1e-4 * k, 0.01 * (k % 10)}, 0);
    file.map().sample({std::cos(k), std::sin(k), std::sin(7.0 * k)}, 0.2);
  }
  EXPECT_LT(resident(path), 6000) << "KiB of 87,000";
}

// Such a file is not taken for an image either.
TEST_F(SkyFiles, OneShorterThanItsHeaderIsToldAsSuch) {
  const fs::path path = folder_ / "short.sky";
  for (const std::size_t length : {0, 5, 63}) {
    put(path, std::string(length, 'D'));
    for (const bool digest : {false, true})
      EXPECT_EQ(message_of([&] { digest ? (void)sky_digest(path) : (void)read_sky(path); }),
                path.string() + ": not a .sky file: shorter than its header (" +
                    std::to_string(length) + " bytes instead of 64 and more)");
  }
}

}  // namespace
}  // namespace domefall
