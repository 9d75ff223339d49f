#include "pipeline/show/file/show_time.h"

#include <gtest/gtest.h>

#include <numbers>
#include <tuple>

#include "pipeline/show/observer_track.h"
#include "tests/pipeline/show/show_file.h"

namespace domefall {
namespace {

TEST(ClockTimes, AreMinutesAndSecondsAndPerhapsHours) {
  for (const auto& [text, seconds] :
       {std::pair("0:34", 34.0), std::pair("1:02.5", 62.5), std::pair("0:00", 0.0),
        std::pair("12:00", 720.0), std::pair("90:05", 5405.0), std::pair("1:02:03.25", 3723.25),
        std::pair("0:59.999", 59.999)})
    EXPECT_DOUBLE_EQ(parse_clock_time(text).value_or(-1), seconds) << text;
  for (const char* text :
       {"", "34", ":34", "0:", "0:3", "0:60", "0:3.5", "1:2:03", "1:60:00", "-0:34", "0:-1",
        "1.5:00", "0:34s", "1:02:03:04", "0:3x", "0:34.", "1e1:00", "door"})
    EXPECT_FALSE(parse_clock_time(text)) << text;
  for (const auto& [seconds, text] :
       {std::pair(34.0, "0:34"), std::pair(62.5, "1:02.5"), std::pair(59.9996, "1:00"),
        std::pair(3723.25, "62:03.25"), std::pair(0.0, "0:00")})
    EXPECT_EQ(clock_text(seconds), text);
}

using ShowTimes = ShowMistakes;

TEST_F(ShowTimes, AreClockTimesOrMarkersWhereverATimeIsGiven) {
  const Show show = read(
      "frames_per_second: 10\n"
      "markers: {door: 0:34, bow: 1:02.5, end: 80}\n"
      "black_hole: {mass_solar: 1}\n"
      "keyframes:\n"
      "  - {at_s: 0:10, exposure: {ev: 0}}\n"
      "  - {at_s: door, exposure: {ev: 2}}\n"
      "timeline:\n"
      "  - {duration_s: \"0:30\", trajectory: {type: static, r: 9}}\n"
      "  - duration_s: bow\n"
      "    dissolve_s: 0:02\n"
      "    trajectory: {type: static, r: 8}\n"
      "    keyframes:\n"
      "      - {at_s: door, camera: {roll_deg: 10}}\n"
      "      - {at_s: 0:07, camera: {roll_deg: 20}}\n"
      "  - {duration_s: end, trajectory: {type: static, r: 7}}\n");
  ASSERT_EQ(show.markers.size(), 3u);
  EXPECT_EQ(show.markers[1].name, "bow");
  EXPECT_EQ(show.markers[1].at_s, 62.5);
  EXPECT_EQ(show.timeline[0].duration_s, 30);
  EXPECT_EQ(show.timeline[1].duration_s, 34.5) << "from 28 s to the marker";
  EXPECT_EQ(show.timeline[2].duration_s, 17.5);
  EXPECT_EQ(segment_times(show).back(), 80);
  EXPECT_DOUBLE_EQ(frame_state(show, 100).settings.ev, 0);
  EXPECT_DOUBLE_EQ(frame_state(show, 340).settings.ev, 2);
  const auto roll = [&](double t) {
    return value_at(show.timeline[1], Channel::kRoll, t, 99) * 57.29577951308232;
  };
  EXPECT_NEAR(roll(34), 10, 1e-9) << "the marker is a time of the show";
  EXPECT_NEAR(roll(35), 20, 1e-9) << "clock times count from the segment's beginning, 28 s";
}

TEST_F(ShowTimes, OfEventsFollowFromTheTimeline) {
  const Show show = read(
      "black_hole: {mass_solar: 4e6}\n"
      "markers: {closest: periastron, far: {r: 60}, start: 0:01, horizon: {r: 2}}\n"
      "titles: [{text: here, at_s: closest, duration_s: far}]\n"
      "timeline:\n"
      "  - {duration_s: 3, trajectory: {type: static, r: 30}}\n"
      "  - {duration_s: 20, trajectory: {type: parabolic, periastron: 6, from_r: 40, to_r: 60, "
      "to_leg: outward}}\n"
      "  - {duration_s: 10, dissolve_s: 1, trajectory: {type: infall, from_r: 9, to_r: 1}}\n");
  const auto r_at = [&](int segment, double time) {
    return observer_at(show, segment, part_at(show, segment, time)).r;
  };
  ASSERT_EQ(show.markers.size(), 4U);
  EXPECT_NEAR(r_at(1, show.markers[0].at_s), 6, 1e-9);
  EXPECT_NEAR(show.markers[1].at_s, 23, 1e-9);
  EXPECT_EQ(show.markers[2].at_s, 1);
  EXPECT_NEAR(r_at(2, show.markers[3].at_s), 2, 1e-9);
  EXPECT_GT(show.markers[3].at_s, 22);
  EXPECT_EQ(show.titles[0].begin_s, show.markers[0].at_s);
  EXPECT_EQ(show.titles[0].end_s, show.markers[1].at_s);
}

TEST_F(ShowTimes, OfEventsThatCannotBeAreTold) {
  const std::string
      hole = "black_hole: {mass_solar: 4e6}\n",
      rest = "timeline: [{duration_s: 2, trajectory: {type: infall, from_r: 9, to_r: 3}}]\n";
  EXPECT_NE(complaint(hole + "markers: {gone: {r: 2}}\n" + rest)
                .find(":2:17: markers.gone happens nowhere in the show, which is never at r = 2"),
            std::string::npos);
  EXPECT_NE(complaint(hole + "markers: {near: periastron}\n" + rest).find("never falls and rises"),
            std::string::npos);
  EXPECT_NE(complaint(hole + "markers: {near: {R: 2}}\n" + rest).find("unknown key"),
            std::string::npos);
}

TEST_F(ShowTimes, OfEventsMayBeThoseOfKeyframesAndOfTitlesOfSegments) {
  const Show show = read(
      "black_hole: {mass_solar: 4e6}\n"
      "markers: {closest: periastron, horizon: {r: 2}, far: {r: 12}}\n"
      "keyframes:\n"
      "  - {at_s: closest, exposure: {ev: 3}}\n"
      "  - {at_s: horizon, exposure: {ev: -2}}\n"
      "timeline:\n"
      "  - duration_s: 6\n"
      "    trajectory: {type: parabolic, periastron: 6, from_r: 11, to_r: 6}\n"
      "  - duration_s: 4\n"
      "    trajectory: {type: continue, to_r: 15}\n"
      "    keyframes: [{at_s: far, camera: {roll_deg: 30}}]\n"
      "    titles: [{text: gone, at_s: far}]\n"
      "  - {duration_s: 5, trajectory: {type: infall, from_r: 9, to_r: 1}}\n");
  const double closest = show.markers[0].at_s, horizon = show.markers[1].at_s;
  EXPECT_NEAR(closest, 6, 1e-6) << "at the joint of two segments";
  EXPECT_GT(horizon, 10);
  EXPECT_DOUBLE_EQ(value_at(show.timeline[0], Channel::kEv, closest, 99), 3);
  EXPECT_DOUBLE_EQ(value_at(show.timeline[2], Channel::kEv, horizon, 99), -2);
  const double far = show.timeline[1].titles[0].begin_s;
  EXPECT_NEAR(observer_at(show, 1, part_at(show, 1, far)).r, 12, 1e-9);
  EXPECT_NEAR(value_at(show.timeline[1], Channel::kRoll, far, 99), std::numbers::pi / 6, 1e-12);
}

// The observer stands still between the fall and the rise.
TEST_F(ShowTimes, OfAPeriastronMayBeInAStandstill) {
  const Show show = read(
      "black_hole: {mass_solar: 4e6}\n"
      "markers: {closest: periastron}\n"
      "timeline:\n"
      "  - {duration_s: 3, trajectory: {type: static, r: 20}}\n"
      "  - {duration_s: 6, trajectory: {type: parabolic, periastron: 6, from_r: 30, to_r: 7}}\n"
      "  - {duration_s: 2, trajectory: {type: continue, pace: frozen}}\n"
      "  - {duration_s: 4, trajectory: {type: continue, to_leg: outward, to_r: 15}}\n");
  EXPECT_NEAR(observer_at(show, 3, part_at(show, 3, show.markers[0].at_s)).r, 6, 1e-9);
}

TEST_F(ShowTimes, OfEventsEndSegmentsWhoseClocksHaveARate) {
  const Show show = read(
      "black_hole: {mass_solar: 4e6}\n"
      "markers: {closest: periastron, horizon: {r: 2}, half: {r: 20}}\n"
      "timeline:\n"
      "  - duration_s: half\n"
      "    trajectory: {type: parabolic, periastron: 6, from_r: 30, rate_m_per_s: [8, 4]}\n"
      "  - {duration_s: closest, trajectory: {type: continue, rate_m_per_s: 4}}\n"
      "  - {duration_s: 3, trajectory: {type: continue, rate_m_per_s: [4, 2]}}\n"
      "  - duration_s: horizon\n"
      "    dissolve_s: 1\n"
      "    trajectory: {type: infall, rest_r: 12, time_lapse: 50}\n"
      "  - {duration_s: 3, trajectory: {type: continue, to_r: 0.1, pace: slowing}}\n");
  const std::vector<double> times = segment_times(show);
  for (const auto& [segment, marker, r] :
       {std::tuple(0, 2, 20.0), std::tuple(1, 0, 6.0), std::tuple(3, 1, 2.0)}) {
    const double end =
        times[static_cast<std::size_t>(segment)] + segment_of(show, segment).duration_s;
    EXPECT_NEAR(show.markers[static_cast<std::size_t>(marker)].at_s, end, 1e-9);
    EXPECT_NEAR(observer_at(show, segment, 1).r, r, 1e-9);
  }
  const Timing& timing = show.timeline[0].timing;
  EXPECT_NEAR(double(timing.tau_end - timing.tau_begin) / show.timeline[0].duration_s, 6, 1e-12)
      << "the mean of both rates";
}

TEST_F(ShowTimes, OfEventsThatFollowFromTheDurationItselfAreTold) {
  const auto ending = [](const std::string& event, const std::string& trajectory) {
    return "black_hole: {mass_solar: 4e6}\nmarkers: {it: " + event +
           "}\ntimeline: [{duration_s: it, trajectory: {" + trajectory + "}}]\n";
  };
  const std::string at = "3:25: timeline[1].duration_s names the event 'it', ";
  const std::string circle =
      at +
      "whose time would follow from this duration; give the trajectory rate_m_per_s or "
      "time_lapse, and no end";
  expect_complaints({
      {ending("{r: 2}", "type: infall, from_r: 9"), circle},
      {ending("{r: 2}", "type: infall, from_r: 9, to_r: 2, rate_m_per_s: [3, 3]"), circle},
      {ending("{r: 9}", "type: circular, r: 9, orbits: 2"), circle},
      {ending("{r: 5}", "type: static, r: 9, rate_m_per_s: 3"), at + "but its way is never there"},
      {ending("{r: 9}", "type: infall, from_r: 9, rate_m_per_s: 3"),
       at + "which happens as the segment begins"},
      {ending("periastron", "type: infall, from_r: 9, rate_m_per_s: 3"),
       at + "but its way has no periastron that is known in closed form"},
      {ending("{r: 2}", "type: infall, from_r: 9, rate_m_per_s: 0"),
       at + "but the clock of the segment stands still"},
      {ending("{r: 2}", "type: infall, from_r: 1e9, rate_m_per_s: 1"),
       at + "which comes after 1.490711985e13 s; at most 10000000 are possible"},
      {"markers: {it: {r: 2}}\ntimeline: [{duration_s: it}]\n",
       "2:25: timeline[1].duration_s names the event 'it', which needs a black hole"},
      {"black_hole: {mass_solar: 4e6}\nmarkers: {it: {r: 5}}\ntimeline:\n"
       "  - {duration_s: 4, trajectory: {type: infall, from_r: 9, to_r: 4}}\n"
       "  - {duration_s: it, trajectory: {type: static, r: 4}}\n",
       "5:18: timeline[2].duration_s names the marker 'it', which lies at 3.330454761 s, where it "
       "must "
       "be after 4 s"},
  });
}

TEST_F(ShowTimes, MistakesInThemAreTold) {
  const std::string markers = "markers: {door: 0:34}\n";
  const auto lasting = [](const std::string& text) {
    return "timeline: [{duration_s: " + text + "}]\n";
  };
  expect_complaints({
      {lasting("0:60"),
       "1:25: timeline[1].duration_s must be seconds, or minutes and seconds such as 1:02.5, got "
       "'0:60'"},
      {lasting("0:00"), "1:25: timeline[1].duration_s must exceed 0 (seconds), got 0:00"},
      {lasting("'34'"),
       "1:25: timeline[1].duration_s must be a number (seconds), got the text '34'; leave the "
       "quotes out"},
      {markers + "timeline: [{duration_s: doro}]\n",
       "2:25: timeline[1].duration_s names a marker that the show does not have: 'doro'; did you "
       "mean door?"},
      {markers + lasting("20"),
       "1:17: markers.door lies behind the end of the show at 20 s, got 0:34"},
      {markers + "timeline: [{duration_s: 40}, {duration_s: door}]\n",
       "2:43: timeline[2].duration_s names the marker 'door', which lies at 34 s, where it must be "
       "after 40 s"},
      {markers + "timeline:\n"
                 "  - {duration_s: 10, keyframes: [{at_s: door, exposure: {ev: 1}}]}\n"
                 "  - {duration_s: 40}\n",
       "3:41: timeline[1].keyframes[1].at_s names the marker 'door', which lies at 34 s, where it "
       "must be at most 10 s"},
      {"markers: {0:34: 20}\n" + lasting("30"),
       "1:17: markers.0:34 has a name that is a time itself; begin it with a letter"},
      {"markers: {door: open}\n" + lasting("30"),
       "1:17: markers.door must be a number (seconds), got 'open'"},
      {"markers: [0:34]\n" + lasting("30"),
       "1:10: markers must be a map of names and times, e.g. {door_opens: 0:34}, or a file such as "
       "cut.otio, got a list"},
      {"markers: {a: 1, a: 2}\n" + lasting("30"), "1:17: markers.a is repeated"},
  });
}

}  // namespace
}  // namespace domefall
