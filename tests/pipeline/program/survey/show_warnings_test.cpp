#include "pipeline/program/survey/show_warnings.h"

#include <gmock/gmock.h>

#include "pipeline/program/survey/axis_stars.h"
#include "pipeline/program/survey/show_survey.h"
#include "tests/pipeline/show/show_file.h"

namespace domefall {
namespace {

using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

// The catalogue has Sirius and two stars besides.
class AxisStarWarnings : public ShowFile {
 protected:
  std::vector<ShowWarning> of(const std::string& at, const std::string& trajectory,
                              const std::string& more = "") {
    const Show show = read(
        "frames_per_second: 10\nblack_hole: {mass_solar: 4e6, at: " + at +
        ", heading_deg: 20}\nsky: {region_I: {background: black, stars: {gain: 1}}, region_III: "
        "{background: "
        "black}}\n" +
        more + "camera: {look_at: hole}\ntimeline:\n  - {duration_s: 3, trajectory: " + trajectory +
        "}\n");
    AxisStars axis(show);
    survey(show, [&axis](const FrameState& state) { axis.add(state); });
    return axis.warnings();
  }
};

TEST_F(AxisStarWarnings, AStarBehindAnObserverAtRestIsToldWithWhatDimsIt) {
  const auto warnings = of("Sirius", "{type: static, r: 14}");
  ASSERT_EQ(warnings.size(), 1U);
  EXPECT_EQ(warnings[0].frame, 0);
  EXPECT_THAT(warnings[0].text, HasSubstr("Sirius stands straight behind the hole, and its ring "
                                          "blinds like a star of magnitude -11."));
  EXPECT_THAT(warnings[0].text, HasSubstr("stars.least_radius_deg: 0.5 dims it"));
}

TEST_F(AxisStarWarnings, WhatIsAdvisedHelps) {
  EXPECT_TRUE(of("Sirius", "{type: static, r: 14}", "stars: {least_radius_deg: 0.5}\n").empty());
  EXPECT_FALSE(of("Sirius", "{type: static, r: 14}", "stars: {least_radius_deg: 0.2}\n").empty());
}

TEST_F(AxisStarWarnings, AMotionThatBeginsAtRestIsSeen) {
  const auto warnings = of("Sirius", "{type: circular, r: 14, orbits: 0.02, pace: eased}");
  ASSERT_EQ(warnings.size(), 1U);
  EXPECT_EQ(warnings[0].frame, 0);
}

// The light of a frame's time is all that a star has which races past.
TEST_F(AxisStarWarnings, AStarThatRacesPastDoesNotBlind) {
  EXPECT_TRUE(of("Sirius", "{type: circular, r: 14, orbits: 2}").empty());
}

TEST_F(AxisStarWarnings, AStarBesideTheAxisDoesNotBlind) {
  EXPECT_TRUE(of("{ra_deg: 101.287, dec_deg: -14.7}", "{type: static, r: 14}").empty());
}

TEST_F(AxisStarWarnings, WhatTheShowLeavesInTheDarkDoesNotBlind) {
  EXPECT_TRUE(of("Sirius", "{type: static, r: 14}", "exposure: {ev: -8}\n").empty());
  EXPECT_TRUE(of("Sirius", "{type: static, r: 14}", "effects: {amplification: none}\n").empty());
}

class PlaceWarnings : public ShowFile {
 protected:
  std::vector<ShowWarning> of(const std::string& hole, const std::string& trajectory) {
    return place_warnings(read("black_hole: {mass_solar: 4e6, " + hole +
                               "}\ntimeline:\n  - {duration_s: 3, trajectory: " + trajectory +
                               "}\n"));
  }
};

TEST_F(PlaceWarnings, AHoleThatIsSeenElsewhereIsTold) {
  const std::string axis = "axis: {ra_deg: 0, dec_deg: 90}, at: {ra_deg: 40, dec_deg: 30}";
  const auto warnings = of("spin: 0.5, " + axis, "{type: circular, r: 9}");
  ASSERT_EQ(warnings.size(), 1U);
  EXPECT_THAT(warnings[0].text, HasSubstr("stands 30 degrees from black_hole.at"));
  EXPECT_THAT(warnings[0].text, HasSubstr("begins at latitude 0 of the hole"));
  EXPECT_THAT(warnings[0].text, HasSubstr("but from -30"));
  EXPECT_TRUE(of("spin: 0.5, " + axis, "{type: static, r: 9, latitude_deg: -30}").empty());
  EXPECT_TRUE(of("spin: 0.5", "{type: circular, r: 9}").empty());
  EXPECT_TRUE(of("at: {ra_deg: 40, dec_deg: 30}", "{type: circular, r: 9}").empty());
}

class GasWarnings : public ShowFile {
 protected:
  std::vector<ShowWarning> of(const std::string& hole, const std::string& disc,
                              const std::string& trajectory) {
    const Show show =
        read("frames_per_second: 10\nblack_hole: {mass_solar: 4e6" + hole + "}\ndisc: {" + disc +
             "}\ntimeline:\n  - {duration_s: 3, trajectory: " + trajectory + "}\n");
    NearGas gas(show);
    survey(show, [&gas](const FrameState& state) { gas.add(state); });
    return gas.warnings();
  }
};

TEST_F(GasWarnings, AreOfAnObserverWithinTheDisc) {
  // Through the disc's plane in the middle of its way.
  const std::string over =
      "{type: bound, periastron: 12, apoastron: 12, inclination_deg: 80, "
      "from_tau_m: -40, to_tau_m: 40}";
  const auto warnings = of(", spin: 0.9", "height: 0.1, outer_r: 20, optical_depth: 60", over);
  ASSERT_EQ(warnings.size(), 1U);
  EXPECT_GT(warnings[0].frame, 0);
  EXPECT_THAT(warnings[0].text,
              HasSubstr("the observer is inside opaque gas of the disc, to frame"));
  EXPECT_THAT(of(", spin: 0.9", "height: 0.1, outer_r: 20, optical_depth: 1", over), IsEmpty());
  EXPECT_THAT(of(", spin: 0.9", "outer_r: 20, optical_depth: 60", over), IsEmpty());
  EXPECT_THAT(of(", spin: 0.9", "height: 0.1, outer_r: 11, optical_depth: 60", over), IsEmpty());
  // About a hole without spin, too.
  EXPECT_EQ(of("", "height: 0.1, outer_r: 20, optical_depth: 60, inclination_deg: 0",
               "{type: circular, r: 9}")
                .size(),
            1U);
}

// Warnings of a title in a dome of 256 pixels, of which each is 0.7 degrees, at 10 frames a second.
class TitleWarnings : public ShowFile {
 protected:
  std::vector<std::string> texts(const std::string& title, const std::string& of_segment = "") {
    const Show show = read("frames_per_second: 10\nsize: 256\ntitles: [{" + title +
                           "}]\ntimeline: [{duration_s: 2" + of_segment + "}]\n");
    std::vector<std::string> all;
    for (const ShowWarning& w : title_warnings(show)) all.push_back(w.text);
    return all;
  }
};

TEST_F(TitleWarnings, AreNoneOfATitleThatIsSeen) {
  EXPECT_THAT(texts("text: Vega, height_deg: 3"), IsEmpty());
}

TEST_F(TitleWarnings, AreOfATitleBetweenTwoFrames) {
  const auto lost = HasSubstr("is seen in no frame");
  const auto at = [&](const std::string& times) {
    return texts("text: Vega, height_deg: 3, " + times);
  };
  EXPECT_THAT(at("at_s: 0.51, duration_s: 0.08"), ElementsAre(lost));
  EXPECT_THAT(at("at_s: 0.57, duration_s: 0.02"), ElementsAre(lost));
  EXPECT_THAT(at("at_s: 0.51, duration_s: 0.1"), IsEmpty());
  EXPECT_THAT(at("at_s: 0.5, duration_s: 0.02"), IsEmpty());
  EXPECT_THAT(at("at_s: 0.3, duration_s: 0.02"), IsEmpty());
  // The show's last frame stands a tenth of a second before its end.
  EXPECT_THAT(at("at_s: 1.95"), ElementsAre(lost));
  EXPECT_THAT(at("at_s: 1.9"), IsEmpty());
  // Its one frame would have it at the dark end of a fade.
  EXPECT_THAT(texts("text: Vega, height_deg: 3, at_s: 0.5, duration_s: 0.08, fade_in_s: 0.04"),
              ElementsAre(lost));
}

// ---- horizons ----

class HorizonWarnings : public ShowFile {
 protected:
  std::vector<std::string> texts(const std::string& charge, const std::string& more = "") {
    std::vector<std::string> texts;
    for (const ShowWarning& warning : horizon_warnings(
             read("frames_per_second: 5\nblack_hole: {mass_solar: 4e6, charge: " + charge +
                  "}\ntimeline:\n  - duration_s: 60\n    trajectory: {type: infall, rest_r: 9, "
                  "rate_m_per_s: 3}\n" +
                  more)))
      texts.push_back(warning.text);
    return texts;
  }
};

TEST_F(HorizonWarnings, AreOfEverySkyThatFlashes) {
  const auto flash = [](const char* passage, const char* sky) {
    return HasSubstr(std::string("the observer ") + passage + ", where all that the sky " + sky +
                     " will ever send arrives at once");
  };
  const auto in = flash("falls through the inner horizon", "of region III"),
             out = flash("rises through the inner horizon", "of region I"),
             next = flash("rises through the inner horizon", "of the next universe"),
             again = flash("falls through the horizon", "of region I"),
             third = flash("falls through the horizon", "of the next universe");
  EXPECT_THAT(texts("0.9"), ElementsAre(in, out, again, in, next, third, in, out));
  EXPECT_THAT(texts("1"), ElementsAre(out, again, next, third, out));
  EXPECT_THAT(texts("0.9",
                    "sky: {region_I: {gain: 0, stars: none}, region_III: {gain: 1}, next: {gain: "
                    "1}}\n"),
              ElementsAre(in, in, next, third, in));
}

TEST_F(TitleWarnings, AreOfATitleWithoutInk) {
  const auto nothing = HasSubstr("writes nothing");
  EXPECT_THAT(texts("text: \"\\u00A0\", height_deg: 3"), ElementsAre(nothing));
  EXPECT_THAT(texts("text: \"\\u3000\\u200B\", height_deg: 3"), ElementsAre(nothing));
  EXPECT_THAT(texts("text: \"a\\u00A0\", height_deg: 3"), IsEmpty());
}

TEST_F(TitleWarnings, AreOfCapitalsOfTwoPixels) {
  const auto small = HasSubstr("they have 2 with a height_deg of 1.41");
  EXPECT_THAT(texts("text: Vega, height_deg: 1.35"), ElementsAre(small));
  EXPECT_THAT(texts("text: Vega, height_deg: 0.7"),
              ElementsAre(HasSubstr("the title 'Vega' has capitals lower than 2 pixels")));
  EXPECT_THAT(texts("text: Vega, height_deg: 1.45"), IsEmpty());
  EXPECT_THAT(texts("text: Vega, height_deg: 3", ", titles: [{text: Deneb, height_deg: 0.5}]"),
              ElementsAre(small));
}

TEST_F(TitleWarnings, AreOfATitleThatRunsIntoItself) {
  EXPECT_THAT(texts("text: " + std::string(150, 'M') + ", height_deg: 5"),
              Contains(HasSubstr("a smaller height_deg or more lines would fit")));
}

}  // namespace
}  // namespace domefall
