// Tests of the manual of show files: its examples are shows, and its tables those of the program.
#include <set>
#include <sstream>

#include "pipeline/show/file/keys.h"
#include "pipeline/show/frame_state.h"
#include "tests/pipeline/show/show_file.h"
#include "tests/source_tree.h"

namespace domefall {
namespace {

std::string page(const std::string& name) {
  std::ifstream in(source_file("docs/" + name));
  std::ostringstream text;
  text << in.rdbuf();
  return text.str();
}

std::vector<std::string> examples(const std::string& text) {
  const std::string opening = "```yaml\n", closing = "```\n";
  std::vector<std::string> found;
  for (auto at = text.find(opening); at != std::string::npos; at = text.find(opening, at)) {
    at += opening.size();
    found.push_back(text.substr(at, text.find(closing, at) - at));
  }
  return found;
}

using ShowFormat = ShowFile;

TEST_F(ShowFormat, EveryExampleIsAShow) {
  write("art/summer_sky.exr", "");
  // The recipes name more places than the stand-in has.
  for (const char* table : {"sky_places.csv", "figures.csv"})
    std::filesystem::copy_file(source_file(std::string("shows/assets/") + table),
                               folder_ / "assets" / table,
                               std::filesystem::copy_options::overwrite_existing);
  for (const char* name : {"show-format.md", "settings.md"}) {
    const auto all = examples(page(name));
    ASSERT_GE(all.size(), 8u);
    for (const std::string& yaml : all) {
      EXPECT_EQ(complaint(yaml), "") << yaml;
      const Show show = read(yaml);
      EXPECT_NO_THROW(frame_state(show, frame_count(show) - 1)) << yaml;
    }
  }
}

std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream in(text);
  for (std::string line; std::getline(in, line);) lines.push_back(line);
  return lines;
}

// After a change of a row in pipeline/show/file/keys.cpp, put the row into the manual as it stands
// there.
TEST(ShowFormatTables, HaveTheRowsOfTheProgram) {
  std::set<std::string> of_manual, of_program;
  bool of_keys = false;
  for (const std::string& line : lines_of(page("show-format.md"))) {
    if (of_keys && line.starts_with("| `")) of_manual.insert(line);
    of_keys = line == "| key | value | default |" || (of_keys && line.starts_with("|"));
  }
  for (const std::string& line : lines_of(std::string(rows_of_keys())))
    if (line.starts_with("| ")) of_program.insert(line);
  EXPECT_GE(of_program.size(), 150u);
  for (const std::string& row : of_program) EXPECT_TRUE(of_manual.contains(row)) << "lacks " << row;
  for (const std::string& row : of_manual) EXPECT_TRUE(of_program.contains(row)) << "has " << row;
}

// A section's default is its table's, in the units of the program.
TEST(Keys, SayTheirRangeTheirUnitAndTheirDefault) {
  const Key key{"height_deg", "above 0, at most 60: of a capital letter", "[2]"};
  EXPECT_EQ(key.range().low, 0);
  EXPECT_TRUE(key.range().low_excluded);
  EXPECT_EQ(key.range().high, 60);
  EXPECT_FALSE(key.range().high_excluded);
  EXPECT_EQ(key.range().unit, "degrees");
  EXPECT_EQ(key.number(), 2);
  const auto range = [](std::string_view value) { return Key{"x_r", value, ""}.range(); };
  EXPECT_EQ(range("-1e3 to below 2.5 stops: far").low, -1000);
  EXPECT_TRUE(range("-1e3 to below 2.5 stops: far").high_excluded);
  EXPECT_EQ(range("-1e3 to below 2.5 stops: far").unit, "stops");
  EXPECT_EQ(range("0 to 1 M").unit, "units of M");
  EXPECT_EQ(range("at least 0: r").unit, "units of M");
  EXPECT_EQ(range("above 0, below 1").high, 1);
  EXPECT_THROW(range("a list"), std::logic_error);
  const Key word{"align", "`left`, `centre` or `right`: of `lines`", "[`centre`], flat `left`"};
  EXPECT_EQ(word.words(), (std::vector<std::string_view>{"left", "centre", "right"}));
  EXPECT_EQ(word.word(), "centre");
  EXPECT_THROW(word.number(), std::logic_error);
}

}  // namespace
}  // namespace domefall
