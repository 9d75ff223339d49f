#include "pipeline/sources/stars/star_file.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

#include "pipeline/base/errors.h"
#include "pipeline/sources/stars/star_catalogue.h"
#include "pipeline/sources/stars/star_colour.h"
#include "tests/pipeline/image/test_folder.h"
#include "trajectories/equatorial.h"

namespace domefall {
namespace {

constexpr double kAll = std::numeric_limits<double>::infinity();

// 10,000 stars, so that there are three blocks, with names on the first and the last.
RawCatalogue some_stars() {
  constexpr int kStars = 10000;
  std::mt19937 random(1);
  std::uniform_real_distribution<double> ra(0, 360), sine(-1, 1);
  RawCatalogue catalogue;
  for (int i = 0; i < kStars; ++i) {
    CatalogueStar star{
        .direction = sky_direction(ra(random), std::asin(sine(random)) * 180 / 3.141592653589793),
        .pm_ra = static_cast<float>(i % 5),
        .v = static_cast<float>((i * 7919 % kStars) * 1e-3 - 1),
        .colour = i % 10 == 0 ? kNoColour : static_cast<float>(i % 20) * 0.1F,
        .id = hipparcos_id(static_cast<std::uint32_t>(i) + 1)};
    catalogue.stars.push_back(star);
  }
  catalogue.names = {{0, "First"}, {0, "alpha First"}, {kStars - 1, "Last"}};
  catalogue.text = {"drawn by lot", "none", "for a test"};
  sort_by_brightness(catalogue);
  return catalogue;
}

class StarFiles : public TestFolder {
 protected:
  StarFiles() : file_(folder_ / "some.stars"), written_(some_stars()) {
    write_star_file(file_, written_);
    bytes_ = contents(file_);
  }

  // What reading all of it, to a limit, says is wrong; empty if nothing.
  std::string complaint(double limit = kAll) const {
    return message_of([&] { read_star_catalogue(file_, limit); });
  }

  std::filesystem::path file_;
  RawCatalogue written_;
  std::string bytes_;
};

TEST_F(StarFiles, ComeBackAsTheyWereWritten) {
  const StarFile file(file_);
  EXPECT_EQ(file.text().source, "drawn by lot");
  EXPECT_EQ(file.text().licence, "none");
  EXPECT_EQ(file.text().made, "for a test");
  EXPECT_EQ(file.epoch(), 2000);
  const StarCatalogue read = stars_of(file, kAll, 2000);
  ASSERT_EQ(read.stars.size(), written_.stars.size());
  for (std::size_t i = 0; i < read.stars.size(); ++i) {
    const CatalogueStar& star = written_.stars[i];
    EXPECT_EQ(read.stars[i].v_magnitude, star.v);
    // Half a step of 2^-31 in each of three directions.
    EXPECT_LT((read.stars[i].direction.v - star.direction.v).length(), 4.1e-10);
    EXPECT_NEAR(read.stars[i].direction.v.length(), 1, 3e-16);
    const double b_v = star.colour == kNoColour ? 0.6 : star.colour;
    EXPECT_EQ(read.stars[i].temperature, static_cast<float>(temperature_from_b_v(b_v)));
  }
}

TEST_F(StarFiles, AreBrightestFirstAndCutAtTheLimit) {
  for (const double limit : {-2.0, -1.0, 0.5, 3.095, 3.096, 7.0, 8.999, 20.0}) {
    const StarCatalogue read = read_star_catalogue(file_, limit);
    const auto kept = std::ranges::count_if(
        written_.stars, [&](const auto& s) { return s.v <= static_cast<float>(limit); });
    EXPECT_EQ(static_cast<std::ptrdiff_t>(read.stars.size()), kept) << limit;
    EXPECT_TRUE(std::ranges::is_sorted(read.stars, {}, &Star::v_magnitude));
  }
}

TEST_F(StarFiles, SayHowManyAndHowFaintTheirStarsAreWithoutReadingThem) {
  bytes_.back() ^= 1;  // the last star is damaged
  std::ofstream(file_, std::ios::binary) << bytes_;
  EXPECT_EQ(star_file_count(file_, 40), 10000u);
  EXPECT_EQ(star_file_count(file_, 8.9), 8192u);  // two whole blocks
  EXPECT_EQ(star_file_count(file_, -2), 0u);
  EXPECT_EQ(star_file_faintest(file_), double{written_.stars.back().v});
  std::ofstream(folder_ / "table.csv") << "ra_deg,dec_deg,v_mag,b_v\n1,2,3,0.5\n";
  EXPECT_FALSE(star_file_count(folder_ / "table.csv", 9));
  EXPECT_FALSE(star_file_faintest(folder_ / "table.csv"));
}

TEST_F(StarFiles, AreFoundByTheNamesOfThoseWithinTheLimit) {
  const StarCatalogue all = read_star_catalogue(file_, kAll);
  const auto place_of = [](const StarCatalogue& stars, std::string_view name) {
    const auto found = std::ranges::find(stars.names, name, &NamedStar::name);
    return found == stars.names.end() ? std::nullopt : std::optional(found->direction);
  };
  ASSERT_TRUE(place_of(all, "alpha First"));
  EXPECT_LT((place_of(all, "First")->v - all.stars[0].direction.v).length(), 1e-15);
  EXPECT_EQ(all.names.size(), 3u);
  EXPECT_FALSE(place_of(read_star_catalogue(file_, 0), "Last"));
}

TEST_F(StarFiles, TwoWritingsGiveTheSameBytesAndFingerprint) {
  const auto print = star_file_fingerprint(file_);
  write_star_file(folder_ / "again.stars", some_stars());
  EXPECT_TRUE(contents(folder_ / "again.stars") == bytes_);
  EXPECT_EQ(star_file_fingerprint(folder_ / "again.stars"), print);
  written_.stars.back().v += 1;
  write_star_file(file_, written_);
  EXPECT_NE(star_file_fingerprint(file_), print);
}

TEST_F(StarFiles, EveryChangedByteIsNoticed) {
  std::mt19937 random(2);
  for (int i = 0; i < 600; ++i) {
    std::string damaged = bytes_;
    // The header and what follows it, then anywhere.
    const std::size_t at = i < 300 ? static_cast<std::size_t>(i) : random() % damaged.size();
    damaged[at] = static_cast<char>(damaged[at] ^ (1 << (random() % 8)));
    put(file_, damaged);
    EXPECT_TRUE(complaint().starts_with(file_.string() + ": byte ") ||
                complaint().starts_with(file_.string() + ":"))
        << "byte " << at;
  }
}

TEST_F(StarFiles, AFileCutShortIsRefusedWhereverItEnds) {
  for (const double part : {0.0001, 0.0003, 0.001, 0.5, 0.9999}) {
    put(file_,
        bytes_.substr(0, static_cast<std::size_t>(part * static_cast<double>(bytes_.size()))));
    EXPECT_NE(complaint(), "") << part;
  }
  put(file_, bytes_ + "x");
  EXPECT_EQ(complaint(), file_.string() + ": byte " + std::to_string(bytes_.size()) +
                             ": the star catalogue should end here; it has " +
                             std::to_string(bytes_.size() + 1) + " bytes instead of " +
                             std::to_string(bytes_.size()));
}

TEST_F(StarFiles, AFileShorterThanItsHeaderIsNotTakenForATable) {
  for (const std::size_t length : {0, 3, 8, 127}) {
    put(file_, bytes_.substr(0, length));
    const std::string expected = file_.string() + ": not a .stars file: shorter than its header (" +
                                 std::to_string(length) + " bytes instead of 128 and more)";
    EXPECT_EQ(complaint(), expected);
    EXPECT_EQ(message_of([&] { star_file_fingerprint(file_); }), expected);
  }
  put(folder_ / "short.csv", "ra_deg,dec_deg,v_mag,b_v\n10,20,3,0.5\n");
  EXPECT_EQ(read_star_catalogue(folder_ / "short.csv", kAll).stars.size(), 1u);
}

TEST_F(StarFiles, DamageBehindTheLimitDoesNotMatter) {
  std::string damaged = bytes_;
  damaged[damaged.size() - 5] ^= 1;
  put(file_, damaged);
  EXPECT_EQ(complaint(3), "");  // the first 4,001, of blocks of 4,096
  const std::size_t last_block = bytes_.size() - (10000 - 2 * 4096) * 32;
  EXPECT_EQ(complaint(9), file_.string() + ": byte " + std::to_string(last_block) +
                              ": the block of stars that begins here is damaged");
}

TEST_F(StarFiles, ANewerVersionOrAnotherOrderOfBytesIsNamed) {
  std::string other = bytes_;
  other[12] = 2;
  put(file_, other);
  EXPECT_EQ(complaint(), file_.string() +
                             ": byte 12: the star catalogue is of version 2; this "
                             "Domefall reads version 1");
  std::reverse(other.begin() + 8, other.begin() + 12);
  put(file_, other);
  EXPECT_EQ(complaint(), file_.string() + ": byte 8: the numbers are in another order of bytes");
}

TEST_F(StarFiles, OtherFilesAreNotTakenForThem) {
  put(file_, "PNG and nothing else" + std::string(128, ' '));
  EXPECT_THROW(StarFile{file_}, InputError);
  EXPECT_THROW(StarFile{folder_}, InputError);
  EXPECT_THROW(StarFile{folder_ / "missing.stars"}, TemporaryError);
  EXPECT_EQ(star_file_fingerprint(file_), std::nullopt);
}

TEST_F(StarFiles, ARecordThatIsNoStarIsRefusedThoughItsChecksumIsRight) {
  written_.stars[4].v = std::numeric_limits<float>::quiet_NaN();
  written_.stars[3].direction.v *= 0.5;
  write_star_file(file_, written_);
  const std::size_t records = contents(file_).size() - written_.stars.size() * 32;
  EXPECT_EQ(complaint(), file_.string() + ": byte " + std::to_string(records + 3 * 32) +
                             ": this record is no star");
}

TEST_F(StarFiles, MayBeNone) {
  write_star_file(file_, RawCatalogue{});
  EXPECT_TRUE(read_star_catalogue(file_, kAll).stars.empty());
}

TEST_F(StarFiles, ATemperatureIsKept) {
  written_.stars[0].colour = 31400;
  write_star_file(file_, written_);
  EXPECT_EQ(read_star_catalogue(file_, 0).stars[0].temperature, 31400);
}

}  // namespace
}  // namespace domefall
