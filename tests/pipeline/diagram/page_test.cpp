#include "pipeline/diagram/page.h"

#include "pipeline/diagram/axis.h"
#include "pipeline/diagram/page_marks.h"
#include "pipeline/diagram/path.h"
#include "pipeline/diagram/svg.h"
#include "tests/pipeline/show/show_file.h"

namespace domefall {
namespace {

TEST(Svg, TextCannotBreakTheDocument) {
  EXPECT_EQ(xml_escaped("a<b> & \"c\"\x01"), "a&lt;b&gt; &amp; &quot;c&quot;\xEF\xBF\xBD");
  EXPECT_EQ(xml_escaped("caf\xc3\xa9"), "caf\xc3\xa9");
}

TEST(Svg, ALongTextEndsBetweenCharacters) {
  const std::string text = "\u00e4\u00f6\u00fc\u00e4\u00f6\u00fc";
  EXPECT_EQ(shortened(text, 10, 36), text);
  EXPECT_EQ(shortened(text, 10, 35), "\u00e4\u00f6\u00fc\u00e4\u2026");
}

TEST(Svg, ACurveKeepsItsEndsAndLeavesOutWhatCannotBeSeen) {
  Svg page(100, 100);
  std::vector<PagePoint> points;
  for (int i = 0; i <= 10'000; ++i) points.push_back({i * 0.001, 0});
  page.curve(points, {"#000000"});
  const std::string document = page.document();
  EXPECT_NE(document.find("M0 0L"), std::string::npos);
  EXPECT_NE(document.find("L10 0\""), std::string::npos);
  EXPECT_LT(document.size(), 1500);
}

TEST(Axis, MarksAreRoundAndWithin) {
  EXPECT_EQ(axis_marks({0, 20, 0, 1}, 5), (std::vector<double>{0, 5, 10, 15, 20}));
  EXPECT_EQ(axis_marks({0.8, 30, 0, 1, true}, 6), (std::vector<double>{1, 2, 5, 10, 20}));
  EXPECT_EQ(axis_marks({1e-6, 1e9, 0, 1, true}, 5).size(), 6);
}

TEST(Axis, LogarithmicScalesPutFactorsAtEqualDistances) {
  const Scale scale{1, 100, 200, 0, true};
  EXPECT_DOUBLE_EQ(scale(1), 200);
  EXPECT_DOUBLE_EQ(scale(10), 100);
  EXPECT_DOUBLE_EQ(scale(100), 0);
}

TEST(Axis, NumbersAreWrittenAsOneReadsThem) {
  EXPECT_EQ(number_text(0), "0");
  EXPECT_EQ(number_text(-2.5), "\u22122.5");
  EXPECT_EQ(number_text(20000), "20000");
  EXPECT_EQ(number_text(1e6), "10\u2076");
  EXPECT_EQ(number_text(4.3e-12), "4.3\u00d710\u207b\u00b9\u00b2");
}

class Pages : public ShowFile {};

TEST_F(Pages, HaveThreePanelsNearAHoleAndNoNumberThatIsNone) {
  for (const char* trajectory :
       {"{type: infall, from_r: 1e9, to_r: 1e4}", "{type: circular, r: 6, orbits: 1e6}",
        "{type: infall, from_r: 2.5, to_r: 0.01}", "{type: static, r: 2.0000000001}",
        "{type: velocity, region: III, r: 4, against: outgoing, speed: 0}",
        "{type: velocity, region: IV, r: 2, against: outgoing, speed: 0}"}) {
    const std::string page =
        show_page(read("black_hole: {mass_solar: 10}\ntimeline: [{duration_s: 5, trajectory: " +
                       std::string(trajectory) + "}]\n"));
    for (const char* id : {"id=\"radius\"", "id=\"orbit\"", "id=\"penrose\""})
      EXPECT_NE(page.find(id), std::string::npos) << trajectory;
    EXPECT_EQ(page.find("nan"), std::string::npos) << trajectory;
    EXPECT_EQ(page.find("inf "), std::string::npos) << trajectory;
    EXPECT_EQ(page.find("inf\""), std::string::npos) << trajectory;
  }
}

TEST_F(Pages, NameTrajectoriesAndDissolves) {
  const std::string page = show_page(
      read("black_hole: {mass_solar: 10}\ntimeline:\n"
           "  - {duration_s: 6, trajectory: {type: parabolic, periastron: 6, from_r: 20}}\n"
           "  - {duration_s: 6, dissolve_s: 2, trajectory: {type: circular, r: 9}}\n"
           "  - {duration_s: 6, trajectory: {type: static, r: 12}}\n"));
  for (const char* text :
       {">1 parabolic<", ">2 circular<", ">3 static<", ">dissolve<", ">cut<", "  16 s  "})
    EXPECT_NE(page.find(text), std::string::npos) << text;
}

TEST_F(Pages, SayThatFlatSpaceHasNoHole) {
  const std::string page = show_page(read("timeline: [{duration_s: 5}]\n"));
  EXPECT_NE(page.find("flat space: no hole"), std::string::npos);
  EXPECT_NE(page.find("id=\"speed\""), std::string::npos);
  EXPECT_EQ(page.find("id=\"penrose\""), std::string::npos);
}

// The circles that the page draws at even seconds stand where it says the observer is then.
TEST_F(Pages, TellWhereTheObserverIsInEachPanel) {
  const Show show = read(
      "black_hole: {mass_solar: 10}\ntimeline:\n"
      "  - {duration_s: 4, trajectory: {type: circular, r: 8, orbits: 0.7}}\n"
      "  - {duration_s: 6, trajectory: {type: infall, from_r: 8, to_r: 1}}\n");
  const MarkedPage page = marked_page(show, 201);
  EXPECT_EQ(page.svg, show_page(show));
  EXPECT_NEAR(page.step_s, 0.05, 1e-12);
  ASSERT_EQ(page.places.size(), 201);
  for (const auto& places : page.places) ASSERT_EQ(places.size(), 3);
  for (std::size_t k = 1; k < 80; ++k) {
    EXPECT_GT(page.places[k][0].x, page.places[k - 1][0].x);
    EXPECT_NEAR(page.places[k][0].y, page.places[0][0].y, 1e-6) << "r stays 8";
  }
  const PagePoint begin = page.places[0][1], quarter = page.places[20][1];
  EXPECT_GT(std::hypot(begin.x - quarter.x, begin.y - quarter.y), 100);
  EXPECT_GT(page.places[200][0].y, page.places[90][0].y) << "r falls, and the page grows downwards";
  EXPECT_LT(page.places[200][2].y, page.places[90][2].y) << "the future is up";
  // Each instant that the page marks by a small disc is one of the places.
  const Path path = sample_path(show);
  EXPECT_FALSE(path.instants.empty());
  for (std::size_t k = 0; k < path.instants.size(); ++k) {
    const double at = path.instants[k].time_s / page.step_s;
    const PagePoint place = page.places[static_cast<std::size_t>(std::lround(at))][0];
    EXPECT_NEAR(place.x, 80 + (1400 - 150 - 80) * path.instants[k].time_s / 10, 0.6);
  }
}

}  // namespace
}  // namespace domefall
