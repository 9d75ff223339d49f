// Tests of the manual of show files: its examples are shows, and no key is missing from it.
#include <sstream>

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

std::string manual() { return page("show-format.md"); }

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
  std::filesystem::copy_file(source_file("shows/assets/sky_places.csv"),
                             folder_ / "assets/sky_places.csv",
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

// A section that does not know a key lists those it knows, and all of them must be in the manual.
TEST_F(ShowFormat, EveryKeyIsInTheManual) {
  const std::string text = manual();
  int keys = 0;
  const auto expect_described = [&](const std::string& yaml) {
    const std::string told = complaint(yaml), intro = "known here: ";
    const auto at = told.find(intro);
    ASSERT_NE(at, std::string::npos) << yaml << told;
    std::string list = told.substr(at + intro.size());
    list = list.substr(0, list.find('\n'));
    if (const auto last = list.find(" or "); last != std::string::npos) list.replace(last, 4, ", ");
    std::istringstream words(list);
    for (std::string key; std::getline(words >> std::ws, key, ',');) {
      if (key == "star") key = "{star: Vega}";
      if (key == "ra_deg" || key == "dec_deg") key = "{ra_deg, dec_deg}";
      if (key == "radial" || key == "theta" || key == "phi") key = "{radial, theta, phi}";
      EXPECT_NE(text.find("`" + key + "`"), std::string::npos) << key << " of " << yaml;
      ++keys;
    }
  };
  expect_described("qqq: 1\n");
  for (const char* section :
       {"black_hole", "camera", "effects", "sky", "stars", "disc", "exposure", "grade", "output"})
    expect_described(std::string(section) + ": {qqq: 1}\n");
  expect_described("timeline: [{qqq: 1}]\n");
  expect_described("grade: {cdl: {qqq: 1}}\n");
  expect_described("sky: {region_I: {qqq: 1}}\n");
  expect_described("bodies: {beacon: {qqq: 1}}\n");
  expect_described("black_hole: {at: {qqq: 1}}\n");
  for (const char* type : {"infall", "circular", "static", "velocity", "parabolic", "hyperbolic",
                           "bound", "thrown", "kruskal", "path"})
    expect_described(
        "black_hole: {mass_solar: 1}\n"
        "timeline: [{duration_s: 1, trajectory: {qqq: 1, type: " +
        std::string(type) + "}}]\n");
  for (const char* type : {"turbulence", "rings", "spot"})
    expect_described("disc: {pattern: {qqq: 1, type: " + std::string(type) + "}}\n");
  expect_described("timeline: [{duration_s: 1}]\nkeyframes: [{qqq: 1}]\n");
  EXPECT_GE(keys, 60);
}

}  // namespace
}  // namespace domefall
