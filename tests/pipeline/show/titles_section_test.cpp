// Tests of the titles of show files: what their keys mean, and what is said of mistakes.
#include "tests/pipeline/show/show_file.h"

namespace domefall {
namespace {

using Titles = ShowKeys;
using TitleMistakes = ShowMistakes;

TEST_F(Titles, LastAsLongAsTheShowAtTheFrontUnlessTheySayOtherwise) {
  const Show show = with("titles: [{text: Sagittarius A*}]\n");
  ASSERT_EQ(show.titles.size(), 1u);
  const Title& t = show.titles[0];
  EXPECT_EQ(t.text, "Sagittarius A*");
  EXPECT_EQ(t.begin_s, 0);
  EXPECT_EQ(t.end_s, 10);
  EXPECT_EQ(t.fades.in_s + t.fades.out_s, 0);
  EXPECT_EQ(t.azimuth, 0);
  EXPECT_DOUBLE_EQ(t.elevation, 30 * kDegree);
  EXPECT_DOUBLE_EQ(t.height, 2 * kDegree);
  EXPECT_EQ(t.style, LetterStyle{});
  EXPECT_NEAR(t.light.r, 1, 1e-6);
  EXPECT_NEAR(t.light.b, 1, 1e-6);
  EXPECT_EQ(t.plate, 0);
  EXPECT_EQ(t.shadow, 0);
  EXPECT_TRUE(show.draws_titles);
  EXPECT_EQ(with("camera: {projection: stereographic}\ntitles: [{text: a}]\n").titles[0].elevation,
            0);
}

TEST_F(Titles, BelongToPlacesAndFiguresOfTheSky) {
  const Show show = with(
      "titles:\n"
      "  - {text: a star, place: Vega}\n"
      "  - {figure: orion}\n"
      "  - {text: The hunter, figure: Ori, place: {ra_deg: 90, dec_deg: 0}}\n");
  ASSERT_EQ(show.titles.size(), 3U);
  expect_near(show.titles[0].place->v, place(279.235, 38.784).v, 1e-8);
  EXPECT_TRUE(show.titles[0].figure.empty());
  EXPECT_EQ(show.titles[1].text, "");
  ASSERT_EQ(show.titles[1].figure.size(), 2U);
  EXPECT_EQ(show.titles[1].figure[1].size(), 3U);
  expect_near(show.titles[1].figure[1][0].v, place(78.634, -8.202).v);
  expect_near(show.titles[1].place->v, place(85.39, 5.69).v);
  expect_near(show.titles[2].place->v, place(90, 0).v);
  EXPECT_EQ(show.titles[2].figure.size(), 2U);
}

TEST_F(TitleMistakes, OfPlacesAndFiguresAreTold) {
  const std::string rest = "}]\ntimeline: [{duration_s: 2}]\n";
  EXPECT_NE(
      complaint("titles: [{figure: Oryon" + rest)
          .find("1:19: titles[1].figure names 'Oryon', which is no constellation; did you mean"),
      std::string::npos);
  const std::string bodies = "black_hole: {mass_solar: 1}\nbodies: {star: {r: 9}}\n";
  EXPECT_NE(complaint(bodies + "titles: [{text: a, body: stra" + rest)
                .find("titles[1].body names a body that the show does not have: 'stra'; did you "
                      "mean star?"),
            std::string::npos);
  EXPECT_NE(complaint(bodies + "titles: [{text: a, body: star, place: Vega" + rest)
                .find("titles[1].place excludes body"),
            std::string::npos);
  EXPECT_NE(complaint("titles: [{text: a, place: Wega" + rest).find("titles[1].place names 'Wega'"),
            std::string::npos);
  EXPECT_NE(complaint("titles: [{text: a, place: Vega, azimuth_deg: 4" + rest)
                .find("titles[1].azimuth_deg is for titles of the dome"),
            std::string::npos);
  EXPECT_NE(complaint("titles: [{place: Vega" + rest).find("titles[1].text is missing"),
            std::string::npos);
}

TEST_F(Titles, HaveTheTimesOfShowsInSegmentsToo) {
  const Show show = read(
      "markers: {here: 4, there: 0:07}\n"
      "titles: [{text: a, at_s: here, duration_s: there, fade_in_s: 0:01, fade_out_s: 0.5}]\n"
      "timeline:\n"
      "  - {duration_s: 3}\n"
      "  - {duration_s: 6, dissolve_s: 1, titles: [{text: b}, {text: c, at_s: here, duration_s: "
      "1}]}\n");
  EXPECT_EQ(show.titles[0].begin_s, 4);
  EXPECT_EQ(show.titles[0].end_s, 7);
  EXPECT_EQ(show.titles[0].fades.in_s, 1);
  EXPECT_EQ(show.titles[0].fades.out_s, 0.5);
  ASSERT_EQ(show.timeline[1].titles.size(), 2u);
  EXPECT_EQ(show.timeline[1].titles[0].begin_s, 2) << "with the dissolve";
  EXPECT_EQ(show.timeline[1].titles[0].end_s, 8);
  EXPECT_EQ(show.timeline[1].titles[1].begin_s, 4) << "a marker is the same instant everywhere";
  EXPECT_EQ(show.timeline[1].titles[1].end_s, 5);
}

TEST_F(Titles, HaveLinesAPlaceALookAndALight) {
  const Show show = with(
      "titles:\n"
      "  - text: |\n"
      "      Άστρον,\n"
      "      the star\n"
      "    azimuth_deg: -90\n"
      "    elevation_deg: 12\n"
      "    height_deg: 0.5\n"
      "    font: DejaVu Serif Bold\n"
      "    align: right\n"
      "    colour: [1, 0, 0]\n"
      "    brightness: 3\n"
      "    plate: 0.5\n"
      "    shadow: 0.75\n"
      "draw_titles: false\n");
  const Title& t = show.titles.at(0);
  EXPECT_EQ(t.text, "Άστρον,\nthe star");
  EXPECT_DOUBLE_EQ(t.azimuth, -90 * kDegree);
  EXPECT_DOUBLE_EQ(t.elevation, 12 * kDegree);
  EXPECT_DOUBLE_EQ(t.height, 0.5 * kDegree);
  EXPECT_EQ(t.style.font, "DejaVu Serif Bold");
  EXPECT_EQ(t.style.align, TextAlign::kRight);
  EXPECT_EQ(t.plate, 0.5);
  EXPECT_EQ(t.shadow, 0.75);
  EXPECT_FALSE(show.draws_titles);
  // Red of Rec.709 in ACEScg, as other programs convert it.
  EXPECT_NEAR(t.light.r, 3 * 0.6131, 3e-3);
  EXPECT_NEAR(t.light.g, 3 * 0.0702, 3e-3);
  EXPECT_NEAR(t.light.b, 3 * 0.0206, 3e-3);
}

TEST_F(TitleMistakes, AreToldWithTheirPlaces) {
  const auto title = [](const std::string& keys) { return kShow + "titles: [{" + keys + "}]\n"; };
  expect_complaints_of_lines({
      {"titles: Sirius", "3:9: titles must be a list of at least one entry, got 'Sirius'"},
  });
  expect_complaints({
      {title("at_s: 1"), "3:10: titles[1].text is missing, e.g. text: Sagittarius A*"},
      {title("text: ' '"), "3:17: titles[1].text must not be empty"},
      {title("text: \"a\\tb\""),
       "3:17: titles[1].text may have no control characters but ends of lines, got 'a b'"},
      {title("text: a, hight_deg: 3"),
       "3:20: titles[1].hight_deg is an unknown key; did you mean height_deg?"},
      {title("text: a, at_s: 2"), "3:26: titles[1].at_s must stay below 2 (seconds), got 2"},
      {title("text: a, at_s: 1.5, duration_s: 1"),
       "3:43: titles[1].duration_s must be at most 0.5 (seconds), got 1"},
      {title("text: a, at_s: 1, fade_in_s: 0.8, fade_out_s: 0.4"),
       "3:57: titles[1].fade_out_s makes 1.2 s of fades, but the title lasts 1 s"},
      {title("text: 'r = {radius}'"),
       "3:17: titles[1].text has an unknown counter {radius}; counters are r, time, proper_time, "
       "year or speed"},
      {title("text: '{speeed} c'"),
       "3:17: titles[1].text has an unknown counter {speeed}; counters are r, time, proper_time, "
       "year or speed; did you mean speed?"},
      {title("text: '{{a} b'"),
       "3:17: titles[1].text has a } without its {; a brace that is meant is doubled: {{ or }}"},
      {title("text: 'a {r'"),
       "3:17: titles[1].text has a { without its }; a brace that is meant is doubled: {{ or }}"},
      {title("text: 'a {r {time}'"),
       "3:17: titles[1].text has a { without its }; a brace that is meant is doubled: {{ or }}"},
      {title("text: '{year}'"),
       "3:17: titles[1].text has {year}, which needs the show's begins_year"},
      {"begins_year: 2000\ntitles: [{text: '{r}'}]\ntimeline: [{duration_s: 2}]\n",
       "2:17: titles[1].text has {r}, which needs a black hole: give the show "
       "black_hole.mass_solar"},
      {title("text: a, shadow: 1.5"), "3:28: titles[1].shadow must be at most 1, got 1.5"},
      {title("text: a, plate: -1"), "3:27: titles[1].plate must be at least 0, got -1"},
      {title("text: a, height_deg: 0"),
       "3:32: titles[1].height_deg must exceed 0 (degrees), got 0"},
      {title("text: a, elevation_deg: 95"),
       "3:35: titles[1].elevation_deg must be at most 90 (degrees), got 95"},
      {title("text: a, align: center"),
       "3:27: titles[1].align must be left, centre or right, got 'center'; did you mean centre?"},
      {title("text: a, colour: red"),
       "3:28: titles[1].colour must be a list of 3 numbers, got 'red'"},
      {title("text: a, colour: [1, 2, 0]"), "3:32: titles[1].colour[2] must be at most 1, got 2"},
      {"timeline: [{duration_s: 2, titles: [{text: a, brightness: -1}]}]\n",
       "1:59: timeline[1].titles[1].brightness must be at least 0 (pixel values), got -1"},
  });
}

}  // namespace
}  // namespace domefall
