// Counters of titles: what they show, and that their digits stay where they are.
#include "pipeline/show/title_text.h"

#include <set>

#include "tests/pipeline/show/show_file.h"

namespace domefall {
namespace {

// The number of characters of UTF-8.
std::size_t width_of(const std::string& text) {
  std::size_t width = 0;
  for (const char c : text) width += (static_cast<unsigned char>(c) & 0xc0) != 0x80;
  return width;
}

// One M of so many suns lasts a second.
constexpr double kSecond = 203025.447;

class TitleText : public ShowFile {
 protected:
  // A show of 10 frames a second with one segment and a title all along.
  Show with(const std::string& text, const std::string& segment, double mass = 4.3e6) {
    return read("frames_per_second: 10\nbegins_year: 2012.25\nblack_hole: {mass_solar: " +
                std::to_string(mass) + "}\ntitles: [{text: '" + text +
                "'}]\ntimeline:\n  - {duration_s: " + segment + "}\n");
  }
  static std::string at(const Show& show, int frame) {
    return text_at(show, show.titles.at(0), frame_state(show, frame));
  }
};

TEST_F(TitleText, WithoutCountersStaysAsItIs) {
  const std::string rest = "1, trajectory: {type: static, r: 10}";
  EXPECT_EQ(at(with("Vega, 25 light years", rest), 3), "Vega, 25 light years");
  EXPECT_EQ(at(with("{{r}} = {{{r}}}", rest), 3), "{r} = {10.0}");
  EXPECT_FALSE(has_counters("{{r}}"));
  EXPECT_TRUE(has_counters("{{{r}}}"));
}

TEST_F(TitleText, ShowsTheFramesNumbers) {
  const Show circle =
      with("r = {r} M, {speed} c, {time}", "80, trajectory: {type: circular, r: 6, orbits: 1}");
  EXPECT_EQ(at(circle, 0), "r = 6.00 M, 0.50 c, 0:00");
  EXPECT_EQ(at(circle, 9), "r = 6.00 M, 0.50 c, 0:00");
  EXPECT_EQ(at(circle, 755), "r = 6.00 M, 0.50 c, 1:15");
  // A year is 31557600 s, and at rest far away v runs with the clock.
  const auto year = [&](const char* lapse, int frame) {
    return at(with("{year}", std::string("10, trajectory: {type: static, r: 1e8, time_lapse: ") +
                                 lapse + "}"),
              frame);
  };
  EXPECT_EQ(year("31557600", 0), "2012.2");
  EXPECT_EQ(year("31557600", 25), "2014.7");
  EXPECT_EQ(year("31557600", 75), "2019.7");
  EXPECT_EQ(year("1e6", 99), "2012.56");
  EXPECT_EQ(year("1e9", 50), "2170");
}

TEST_F(TitleText, ShowsProperTimeAsAClockOrWithAUnit) {
  const auto clock = [&](const char* rate, int frame) {
    return at(with("{proper_time}",
                   std::string("10, trajectory: {type: static, r: 10, rate_m_per_s: ") + rate + "}",
                   kSecond),
              frame);
  };
  EXPECT_EQ(clock("1", 50), "5.00 s");
  EXPECT_EQ(clock("10", 50), "0:50");
  EXPECT_EQ(clock("1000", 50), "1:23:20");
  EXPECT_EQ(clock("1e5", 50), "\u20075.8 d") << "filled up by a figure space";
  EXPECT_EQ(clock("1e7", 99), "3.14 a");
  EXPECT_EQ(clock("0.01", 50), "50.0 ms");
  EXPECT_EQ(clock("1e-5", 50), "50.0 \u00b5s");
  // Before and after its zero a time has its sign.
  const Show past = with("{proper_time}",
                         "10, trajectory: {type: parabolic, periastron: 10, from_tau_m: -100, "
                         "to_tau_m: 100}",
                         kSecond);
  EXPECT_EQ(at(past, 0), "\u22121:40");
  EXPECT_EQ(at(past, 75), "+0:50");
}

// From 12 M through the horizon to the singularity, frame by frame.
TEST_F(TitleText, KeepsItsWidthThroughAFall) {
  const Show fall = with("{r} {speed} {proper_time} {year} {time}",
                         "20, trajectory: {type: infall, rest_r: 12, to_r: 0.05}");
  std::set<std::size_t> widths;
  std::set<std::string> texts;
  for (int frame = 0; frame < 200; ++frame) {
    widths.insert(width_of(at(fall, frame)));
    texts.insert(at(fall, frame));
  }
  EXPECT_EQ(widths.size(), 1u);
  EXPECT_GT(texts.size(), 150u);
  EXPECT_EQ(at(fall, 0).substr(0, 10), "12.00 0.00");
  EXPECT_NE(at(fall, 199).find("\u2012.\u2012\u2012"), std::string::npos) << "nobody rests inside";
}

// No speed below that of light is 1.
TEST_F(TitleText, CutsSpeedsOff) {
  const Show show = with("{speed}", "1, trajectory: {type: static, r: 10}");
  FrameState state = frame_state(show, 0);
  state.observer.celerity = Celerity<ReferenceTetrad>(V3d(1e6, 0, 0));
  EXPECT_EQ(text_at(show, show.titles[0], state), "0.99");
}

}  // namespace
}  // namespace domefall
