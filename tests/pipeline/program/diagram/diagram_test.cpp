#include <algorithm>
#include <cmath>
#include <numbers>

#include "pipeline/program/diagram/axis.h"
#include "pipeline/program/diagram/page.h"
#include "pipeline/program/diagram/path.h"
#include "pipeline/program/diagram/svg.h"
#include "tests/pipeline/show/show_file.h"

namespace domefall {
namespace {

class Paths : public ObservedShow {
 protected:
  Path path(const std::string& segments, const std::string& more = "") {
    return sample_path(show(segments, more));
  }
};

const PathPoint& at_radius(const Path& path, double r) {
  return *std::ranges::min_element(path.points, [r](const PathPoint& a, const PathPoint& b) {
    return std::abs(a.r - r) < std::abs(b.r - r);
  });
}

TEST_F(Paths, AFallCrossesTheHorizonAtTheMiddleOfItsLine) {
  const Path p =
      path("  - {duration_s: 20, trajectory: {type: infall, from_r: 30, pace: slowing}}\n");
  EXPECT_EQ(p.origins.at(0).centre, Origin::Centre::kCrossing);
  const PathPoint& crossing = at_radius(p, 2);
  // The nearest sample is within 4 % of r = 2, so within 1/150 on the diagram.
  EXPECT_NEAR(crossing.penrose.x, 0.25, 0.01);
  EXPECT_NEAR(crossing.penrose.up, 0.25, 0.01);
  EXPECT_EQ(p.points.front().time_s, 0);
  EXPECT_EQ(p.points.front().r, 30);
  EXPECT_EQ(p.points.back().time_s, 20);
  EXPECT_NEAR(p.points.back().r, 0.05, 1e-9);
}

TEST_F(Paths, ATimelikePathRisesSteeplyInSmallSteps) {
  const Path p = path(
      "  - {duration_s: 5, trajectory: {type: circular, r: 7, orbits: 1.5}}\n"
      "  - {duration_s: 5, trajectory: {type: infall, from_r: 7, to_r: 0.01}}\n");
  for (std::size_t i = 1; i < p.points.size(); ++i) {
    const PathPoint &a = p.points[i - 1], &b = p.points[i];
    EXPECT_TRUE(is_joined(a, b));
    EXPECT_GT(b.time_s, a.time_s);
    const double dx = std::abs(b.penrose.x - a.penrose.x), up = b.penrose.up - a.penrose.up;
    EXPECT_LE(dx, up + 4e-16);
    EXPECT_LT(std::hypot(dx, up), 1.0 / 150);
    if (a.segment == b.segment) {
      EXPECT_LT(std::abs(std::log(b.r / a.r)), 0.0401);
      EXPECT_LT(std::abs(b.swept - a.swept), 2.501 * std::numbers::pi / 180);
    }
  }
}

TEST_F(Paths, AnOrbitIsCentredInTimeAndEndsAtTheAngleItSwept) {
  const Path p = path("  - {duration_s: 12, trajectory: {type: circular, r: 6, orbits: 1.25}}\n");
  EXPECT_EQ(p.origins.at(0).centre, Origin::Centre::kMiddle);
  EXPECT_NEAR(p.points.front().penrose.up, -p.points.back().penrose.up, 1e-6);
  EXPECT_NEAR(p.points.front().azimuth, 0, 1e-12);
  EXPECT_NEAR(p.points.back().azimuth, std::numbers::pi / 2, 1e-9);
  EXPECT_EQ(p.instant_step_s, 1);
  ASSERT_EQ(p.instants.size(), 12);
  EXPECT_NEAR(p.instants[4].swept, 4.0 / 12 * 2.5 * std::numbers::pi, 1e-7);
}

TEST_F(Paths, OfAMillionTurnsTheFirstAndLastAreSampled) {
  const Path p = path("  - {duration_s: 300, trajectory: {type: circular, r: 9, orbits: 1e6}}\n",
                      "frames_per_second: 240\n");
  EXPECT_TRUE(p.has_gaps_in_plane);
  EXPECT_LT(p.points.size(), 30'000);
  double drawn = 0;
  for (std::size_t i = 1; i < p.points.size(); ++i) {
    EXPECT_TRUE(std::isfinite(p.points[i].penrose.x));
    if (is_joined_in_plane(p.points[i - 1], p.points[i]))
      drawn += p.points[i].swept - p.points[i - 1].swept;
  }
  EXPECT_NEAR(drawn / (2 * std::numbers::pi), 2 * kTurnsDrawn, 0.1);
}

TEST_F(Paths, AJumpOfRadiusIsACutAndAChangeOfMotionIsNone) {
  const Path p = path(
      "  - {duration_s: 1, trajectory: {type: static, r: 9}}\n"
      "  - {duration_s: 1, trajectory: {type: circular, r: 9}}\n"
      "  - {duration_s: 1, trajectory: {type: static, r: 8}}\n"
      "  - {duration_s: 1, trajectory: {type: velocity, r: 8, region: III, against: free_fall, "
      "speed: 0}}\n");
  std::vector<bool> jumps;
  for (std::size_t i = 1; i < p.points.size(); ++i)
    if (p.points[i].segment != p.points[i - 1].segment)
      jumps.push_back(is_jump(p.points[i - 1], p.points[i]));
  EXPECT_EQ(jumps, (std::vector{false, true, true}));
}

TEST_F(Paths, SegmentsThatDissolveOverlapInTimeAndBothReachTheirEnds) {
  const Path p = path(
      "  - {duration_s: 6, trajectory: {type: infall, from_r: 10, to_r: 3}}\n"
      "  - {duration_s: 8, dissolve_s: 2, trajectory: {type: circular, r: 9}}\n");
  const auto second =
      std::ranges::find_if(p.points, [](const PathPoint& q) { return q.segment == 1; });
  ASSERT_NE(second, p.points.end());
  EXPECT_NEAR((second - 1)->time_s, 6, 1e-7);  // a tick before the end
  EXPECT_NEAR((second - 1)->r, 3, 1e-7);
  EXPECT_EQ(second->time_s, 4);
  EXPECT_TRUE(is_jump(*(second - 1), *second));
  EXPECT_EQ(p.points.back().time_s, 12);
  ASSERT_EQ(p.instants.size(), 12);  // every second of 12 s
  for (const PathPoint& q : p.instants) EXPECT_EQ(q.segment, q.time_s < 4 ? 0 : 1) << q.time_s;
}

TEST_F(Paths, AFallThatFollowsALongOrbitIsTheOneInTheMiddle) {
  const Path p = path(
      "  - {duration_s: 9, trajectory: {type: circular, r: 10, orbits: 1e6}}\n"
      "  - {duration_s: 9, trajectory: {type: infall, from_r: 10, to_r: 1}}\n");
  const PathPoint& crossing = at_radius(p, 2);
  // v reaches 3e8 M, of which a double keeps 6e-8 M.
  EXPECT_NEAR(crossing.penrose.x, 0.25, 0.01);
  EXPECT_NEAR(crossing.penrose.up, 0.25, 0.01);
  EXPECT_NEAR(p.points.front().penrose.x, 0.5, 1e-12);
  EXPECT_NEAR(p.points.front().penrose.up, -0.5, 1e-12);
}

TEST_F(Paths, AnInstantOnTheHorizonItselfIsOnTheDiagonal) {
  const Path p = path(
      "  - {duration_s: 1, trajectory: {type: velocity, r: 2, region: II, against: free_fall, "
      "speed: 0}}\n");
  for (const PathPoint& q : p.points) {
    EXPECT_NEAR(q.penrose.x, 0.25, 1e-15);
    EXPECT_NEAR(q.penrose.up, 0.25, 1e-15);
  }
}

TEST_F(Paths, FlatSpaceHasASpeedAndNoPlace) {
  const Path p = sample_path(
      read("timeline: [{duration_s: 2, trajectory: {type: velocity, speed: 0.6, direction: "
           "Vega}}]\n"));
  for (const PathPoint& q : p.points) {
    EXPECT_NEAR(q.speed, 0.6, 1e-15);
    EXPECT_EQ(q.r, kFlatSpace);
  }
}

TEST(RoundStep, IsTheNextOfOneTwoFive) {
  EXPECT_DOUBLE_EQ(round_step(1), 1);
  EXPECT_DOUBLE_EQ(round_step(1.01), 2);
  EXPECT_DOUBLE_EQ(round_step(0.03), 0.05);
  EXPECT_DOUBLE_EQ(round_step(700), 1000);
}

// After a jump the second world line does not share t with the first, so each lies in the middle.
TEST_F(Paths, EveryRunIsCentredByItself) {
  const Path p = path(
      "  - {duration_s: 4, trajectory: {type: infall, from_r: 20, to_r: 0.1, pace: slowing}}\n"
      "  - {duration_s: 4, trajectory: {type: kruskal, energy: 0}}\n"
      "  - {duration_s: 4, trajectory: {type: infall, from_r: 5, to_r: 0.1, region: III}}\n");
  EXPECT_EQ(p.origins.at(0).centre, Origin::Centre::kCrossing);
  EXPECT_EQ(p.origins.at(1).centre, Origin::Centre::kMiddle);
  EXPECT_EQ(p.origins.at(2).centre, Origin::Centre::kCrossing);
  double upper = -1, lower = 1;
  for (const PathPoint& point : p.points) {
    if (point.segment != 1) continue;
    EXPECT_NEAR(point.penrose.x, 0, 1e-9);  // straight through the throat, at t = 0
    upper = std::max(upper, point.penrose.up), lower = std::min(lower, point.penrose.up);
  }
  EXPECT_GT(upper, 0.3);
  EXPECT_LT(lower, -0.3);
}

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

using Pages = ShowFile;

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

TEST_F(Pages, ShowTheWayThroughACharge) {
  const std::string fall =
      "timeline: [{duration_s: 5, trajectory: {type: infall, from_r: 9, to_r: 9, to_leg: "
      "outward}}]\n";
  for (const char* charge : {"0.3", "0.9", "0.999999", "1"}) {
    const Show show =
        read("black_hole: {mass_solar: 10, charge: " + std::string(charge) + "}\n" + fall);
    const std::string page = show_page(show);
    for (const char* text : {"id=\"penrose\"", ">V<", ">I+1<", "singularity, r = 0"})
      EXPECT_NE(page.find(text), std::string::npos) << charge << ' ' << text;
    EXPECT_EQ(page.find(">IV+1<") == std::string::npos, std::string(charge) == "1");
    EXPECT_EQ(page.find("nan"), std::string::npos) << charge;
    EXPECT_EQ(page.find("inf"), page.find("infall")) << charge;
    // The path rises, more steeply than light, and without a gap.
    const Path p = sample_path(show);
    for (std::size_t i = 1; i < p.points.size(); ++i) {
      const PenrosePoint &a = p.points[i - 1].penrose, &b = p.points[i].penrose;
      EXPECT_TRUE(is_joined(p.points[i - 1], p.points[i]));
      EXPECT_LE(std::abs(b.x - a.x), b.up - a.up + 1e-12) << charge << ' ' << p.points[i].r;
      // A small charge leaves so little time inside that a tick of it is half a block.
      EXPECT_LT(b.up - a.up, std::string(charge) == "0.3" ? 0.6 : 0.06) << p.points[i].r;
    }
  }
}

TEST_F(Pages, ShowTheWayThroughAWormhole) {
  const Show show = read(
      "wormhole: {radius_km: 1e6, profile: ellis}\n"
      "timeline: [{duration_s: 5, trajectory: {type: infall, from_l: 9, to_l: -9, speed: 0.5}}]\n");
  const std::string page = show_page(show);
  for (const char* text : {"id=\"penrose\"", ">III<", "throat, r = 1", "throat of 10"})
    EXPECT_NE(page.find(text), std::string::npos) << text;
  EXPECT_EQ(page.find("nan"), std::string::npos);
  const Path p = sample_path(show);
  EXPECT_GT(p.points.front().penrose.x, 0.05);
  EXPECT_LT(p.points.back().penrose.x, -0.05);
  for (std::size_t i = 1; i < p.points.size(); ++i) {
    const PenrosePoint &a = p.points[i - 1].penrose, &b = p.points[i].penrose;
    EXPECT_LE(std::abs(b.x - a.x), b.up - a.up);
  }
}

TEST_F(Pages, ShowASpinFromAboveAndFromTheSide) {
  const Show show = read(
      "black_hole: {mass_solar: 10, spin: 0.9, axis: {ra_deg: 10, dec_deg: 70}}\ntimeline:\n"
      "  - {duration_s: 5, trajectory: {type: bound, periastron: 6, apoastron: 9, inclination_deg: "
      "60, rate_m_per_s: 40}}\n"
      "  - {duration_s: 5, trajectory: {type: infall, from_r: 6, latitude_deg: 30}}\n");
  const std::string page = show_page(show);
  for (const char* text :
       {"id=\"side\"", "the ergosphere, to r = 2 in", "with the spin r = 1.55785",
        "light against it r = 3.91027", ">II<", ">III<"})
    EXPECT_NE(page.find(text), std::string::npos) << text;
  // The way ends at the inner horizon.
  for (const char* text : {">V<", "singularity", "nan"})
    EXPECT_EQ(page.find(text), std::string::npos) << text;
  const Path p = sample_path(show);
  double highest = 0;
  for (const PathPoint& point : p.points) highest = std::max(highest, point.cosine);
  EXPECT_NEAR(highest, std::sin(std::numbers::pi / 3), 1e-2);
  EXPECT_NEAR(p.points.back().cosine, 0.5, 0.01);
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

// A segment far away left a dot of the orbits of the others.
TEST_F(Pages, ShowAnOrbitBesideAPlaceFarAway) {
  const auto page = [this](const char* far, const char* near) {
    return marked_page(read(std::string("black_hole: {mass_solar: 10}\ntimeline:\n"
                                        "  - {duration_s: 2, trajectory: {type: static, r: ") +
                            far + "}}\n  - {duration_s: 8, trajectory: " + near + "}\n"),
                       101);
  };
  constexpr const char* kOrbit = "{type: circular, r: 10, orbits: 1}";
  const MarkedPage both = page("1e8", kOrbit);
  EXPECT_NE(both.svg.find("logarithmic beyond r = 11<"), std::string::npos);
  // The orbit is half as wide as the panel of 460 pixels, and the other place is in the panel too.
  const PagePoint begin = both.places[20][1], half_way = both.places[60][1],
                  far = both.places[0][1];
  EXPECT_GT(begin.x - half_way.x, 200);
  EXPECT_GT(far.x - begin.x, 50);
  EXPECT_LT(far.x, 540);
  // What is not so far, or has no orbit beside it, is drawn evenly.
  EXPECT_EQ(page("200", kOrbit).svg.find("logarithmic beyond"), std::string::npos);
  EXPECT_EQ(page("1e8", "{type: static, r: 10}").svg.find("logarithmic beyond"), std::string::npos);
}

}  // namespace
}  // namespace domefall
