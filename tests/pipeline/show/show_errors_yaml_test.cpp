// Messages about YAML, keys and numbers in any section, in full, with line and column.
#include <algorithm>

#include "tests/pipeline/show/show_mistakes.h"

namespace domefall {
namespace {

using ShowErrorsInYaml = ShowMistakes;

TEST_F(ShowErrorsInYaml, OdditiesOfYamlAreNamedWithTheirPlace) {
  expect_complaints({
      {"EmptyFile", "", "1:1: the show is empty; it needs a timeline at least"},
      {"OnlyAComment", "# nothing yet\n", "1:1: the show is empty; it needs a timeline at least"},
      {"AListInsteadOfAMap", "- a\n",
       "1:1: the show must be a map of keys (title, frames_per_second, size, black_hole, timeline, "
       "camera, cameras, keyframes, markers, fade_in_s, fade_out_s, effects, sky, stars, disc, "
       "bodies, begins_year, exposure, grade, dome, titles or output), got a list"},
      {"TextInsteadOfAMap", "hello\n",
       "1:1: the show must be a map of keys (title, frames_per_second, size, black_hole, timeline, "
       "camera, cameras, keyframes, markers, fade_in_s, fade_out_s, effects, sky, stars, disc, "
       "bodies, begins_year, exposure, grade, dome, titles or output), got 'hello'"},
      {"TabInIndentation",
       "timeline:\n"
       "	- {duration_s: 2}\n",
       "2:1: a tab cannot indent YAML; use spaces"},
      {"OpenBracket", "timeline: [\n",
       "1:12: this is not valid YAML: end of sequence flow not found"},
      {"OpenQuote", kShow + "title: \"Fall\n", "3:8: title opens a quote that is never closed"},
      {"BadIndentation",
       "timeline:\n"
       "  - duration_s: 1\n"
       "   camera: {}\n",
       "3:4: this is not valid YAML: end of sequence not found"},
      {"ColonInAPlainTitle", kShow + "title: Fall: part 1\n",
       "3:12: this is not valid YAML: illegal map value"},
      {"NotUtf8", kShow + "title: caf\xE9\n",
       "3:11: the byte 0xE9 is not UTF-8; save the show as UTF-8"},
      {"Utf16", std::string("\xFF\xFEt\0i\0", 6),
       "1:1: the byte 0xFF is not UTF-8; save the show as UTF-8"},
      {"ControlCharacter",
       kShow + "title: a\x07"
               "b\n",
       "3:9: the control character 0x07 has no place in a show"},
      {"BareCarriageReturns", "title: a\rtimeline: []\r",
       "1:9: the line ends with a bare carriage return; save the show with LF or CRLF"},
      {"SecondDocument",
       kShow + "---\n"
               "title: b\n",
       "4:1: a show file holds one YAML document; a second one starts here"},
      // yaml-cpp makes documents of it without end.
      {"ACommaFirst", ", timeline: []\n", "1:1: this is not valid YAML: nothing can begin here"},
      {"UndefinedAlias", "timeline: *shots\n",
       "1:11: this is not valid YAML: the referenced anchor is not defined"},
      {"CyclicAlias", "timeline: &t [*t]\n",
       "1:11: timeline[1] must be a map of keys (duration_s, dissolve_s, fade_in_s, fade_out_s, "
       "trajectory, camera, "
       "exposure, grade, sky, keyframes or titles), got a list"},
      {"CyclicTrajectory",
       kHole + "timeline:\n"
               "  - &s {duration_s: 1, trajectory: *s}\n",
       "3:5: timeline[1].trajectory.type is missing: static, circular, parabolic, hyperbolic, "
       "bound, infall, thrown, kruskal, path, velocity, body or continue"},
      {"MergeKey", kShow + "camera: {<<: {look_at: hole}}\n",
       "3:10: camera.<< is an unknown key; known here: projection, cut, fov_deg, look_at, "
       "euler_deg, "
       "roll_deg, elevation_deg or dome_tilt_deg"},
      {"TaggedValue", kShow + "title: !!str a\n",
       "3:8: title bears the YAML tag 'tag:yaml.org,2002:str'; shows use none"},
      {"ListAsKey", kShow + "[a]: 1\n", "3:1: ? is no key; keys are plain words"},
      {"ColumnsCountCharactersNotBytes",
       kHole + "timeline: [{duration_s: 1, trajectory: {type: static, r: 9}}]\n"
               "sky: {region_I: {background: \"münchen.png\", gain: -1}}\n",
       "3:30: sky.region_I.background names the file 'münchen.png', which is neither beside the "
       "show nor in the working folder\n"
       "3:51: sky.region_I.gain must be at least 0, got -1"},
  });
}

TEST_F(ShowErrorsInYaml, KeysThatAreUnknownRepeatedOrEmpty) {
  expect_complaints({
      {"UnknownKey", kShow + "projection: domemaster\n",
       "3:1: projection is an unknown key; known here: title, frames_per_second, size, black_hole, "
       "timeline, camera, cameras, keyframes, markers, fade_in_s, fade_out_s, effects, sky, stars, "
       "disc, bodies, begins_year, exposure, grade, dome, titles or output"},
      {"MisspeltKey", kShow + "exposre: {ev: 1}\n",
       "3:1: exposre is an unknown key; did you mean exposure?"},
      {"UnitLeftOut", kShow + "camera: {projection: stereographic, fov: 90}\n",
       "3:37: camera.fov is an unknown key; did you mean fov_deg?"},
      {"KeyInCapitals", kShow + "Camera: {}\n",
       "3:1: Camera is an unknown key; did you mean camera?"},
      {"OtherUnit", moving("{type: infall, from_radius: 9}"),
       "3:48: timeline[1].trajectory.from_radius is an unknown key; did you mean from_r?"},
      {"RepeatedKey",
       kShow + "frames_per_second: 30\n"
               "title: a\n"
               "frames_per_second: 60\n",
       "5:1: frames_per_second is repeated; it is given at line 3 already"},
      {"RepeatedKeyInAMap", moving("{type: static, r: 9, r: 8}"),
       "3:54: timeline[1].trajectory.r is repeated; it is given at line 3 already"},
      {"EmptyValue", kShow + "size:\n",
       "3:1: size must be 1k, 2k, 4k, 8k or a number of pixels (a domemaster is square), got "
       "nothing"},
      {"EmptySection", kShow + "camera:\n",
       "3:1: camera must be a map of keys (projection, cut, fov_deg, look_at, euler_deg, roll_deg, "
       "elevation_deg or dome_tilt_deg), got nothing"},
      {"NullValue", kShow + "title: ~\n", "3:1: title must be text, got nothing"},
  });
}

TEST_F(ShowErrorsInYaml, NumbersMustBePlainAndFinite) {
  expect_complaints({
      {"NotANumber", kShow + "frames_per_second: .nan\n",
       "3:20: frames_per_second must be a finite number (frames per second) that a double holds, "
       "got .nan"},
      {"Infinity", moving("{type: static, r: .inf}"),
       "3:51: timeline[1].trajectory.r must be a finite number (units of M) that a double holds, "
       "got .inf"},
      {"NanWithoutADot", kShow + "exposure: {ev: nan}\n",
       "3:16: exposure.ev must be a finite number (stops) that a double holds, got nan"},
      {"NumberWithUnit", moving("{type: static, r: 30M}"),
       "3:51: timeline[1].trajectory.r must be a number (units of M), got '30M'; leave the unit "
       "out"},
      {"NumberWithUnitAfterABlank", moving("{type: infall, from_r: 30 M}"),
       "3:56: timeline[1].trajectory.from_r must be a number (units of M), got '30 M'; leave the "
       "unit out"},
      {"BooleanForANumber", kShow + "frames_per_second: true\n",
       "3:20: frames_per_second must be a number (frames per second), got 'true'"},
      {"QuotedNumber", kShow + "frames_per_second: \"30\"\n",
       "3:20: frames_per_second must be a number (frames per second), got the text '30'; leave the "
       "quotes out"},
      {"DecimalComma",
       kShow + "exposure:\n"
               "  ev: 0,5\n",
       "4:7: exposure.ev must be a number (stops), got '0,5'; write a decimal point"},
      {"TwoSigns", kShow + "exposure: {ev: +-3}\n",
       "3:16: exposure.ev must be a number (stops), got '+-3'"},
      {"Sexagesimal", kShow + "camera: {look_at: {ra_deg: 17:45:40, dec_deg: -29}}\n",
       "3:28: camera.look_at.ra_deg must be a number (degrees), got '17:45:40'; write one decimal "
       "number, not parts of sixty"},
      {"HugeInteger", kShow + "size: 99999999999999999999999999\n",
       "3:7: size must be at most 16384 (pixels), got 99999999999999999999999999"},
      {"BeyondDoubles", kShow + "exposure: {ev: 1e999}\n",
       "3:16: exposure.ev must be at most 30 (stops), got 1e999"},
      {"FarBelowZero", kShow + "exposure: {ev: -1e999}\n",
       "3:16: exposure.ev must be at least -30 (stops), got -1e999"},
      {"BelowDoubles", moving("{type: infall, from_r: 1e-999}"),
       "3:56: timeline[1].trajectory.from_r must be a finite number (units of M) that a double "
       "holds, got 1e-999"},
      {"BoundsWithoutLeadingZeros", moving("{type: infall, from_r: 9, rate_m_per_s: 1e13}"),
       "3:73: timeline[1].trajectory.rate_m_per_s must be at most 1e12 (units of M per second of "
       "show), got 1e13"},
      {"EndlessSegment", "timeline: [{duration_s: 1e308}, {duration_s: 1e308}]\n",
       "1:25: timeline[1].duration_s must be at most 10000000 (seconds), got 1e308\n"
       "1:46: timeline[2].duration_s must be at most 10000000 (seconds), got 1e308"},
      {"Hexadecimal", kShow + "size: 0x1000\n",
       "3:7: size must be 1k, 2k, 4k, 8k or a number of pixels from 16 to 16384, got '0x1000'"},
      {"Underscore", kShow + "size: 4_096\n",
       "3:7: size must be 1k, 2k, 4k, 8k or a number of pixels from 16 to 16384, got '4_096'"},
      {"ListForANumber", kShow + "frames_per_second: [30]\n",
       "3:20: frames_per_second must be a number (frames per second), got a list"},
  });
}

TEST_F(ShowErrorsInYaml, AllMistakesAreListedInTheOrderOfTheFile) {
  EXPECT_EQ(complaint("frames_per_second: 0\n"
                      "size: 9k\n"
                      "black_hole: {mass_solar: x}\n"
                      "timeline:\n"
                      "  - {duration_s: 1, trajectory: {type: infall, from_r: -3}}\n"
                      "  - {duration: 1, trajectory: {type: circular, r: 2}}\n"),
            "show.yaml:1:20: frames_per_second must be at least 1 (frames per second), got 0\n"
            "show.yaml:2:7: size must be 1k, 2k, 4k, 8k or a number of pixels from 16 to 16384, "
            "got '9k'\n"
            "show.yaml:3:26: black_hole.mass_solar must be a number (solar masses; 0 is flat "
            "space), got 'x'\n"
            "show.yaml:5:56: timeline[1].trajectory.from_r must exceed 0 (units of M), got -3\n"
            "show.yaml:6:6: timeline[2].duration is an unknown key; did you mean duration_s?\n"
            "show.yaml:6:51: timeline[2].trajectory.r must exceed 3 (units of M), got 2: at the "
            "light circle an orbit needs the speed of light, below it more");
}

TEST_F(ShowErrorsInYaml, AfterAHundredMistakesTheRestIsCounted) {
  std::string yaml = "timeline:\n";
  for (int k = 0; k < 150; ++k) yaml += "  - {duration_s: 0}\n";
  const std::string told = complaint(yaml);
  EXPECT_EQ(std::ranges::count(told, '\n'), 100);
  EXPECT_TRUE(told.ends_with("\nshow.yaml: and 50 more")) << told;
}

TEST_F(ShowErrorsInYaml, FilesThatAreNoShowsAreNamed) {
  const auto told = [](const std::filesystem::path& file) -> std::string {
    try {
      read_show(file);
    } catch (const InputError& error) {
      return error.what();
    }
    return "";
  };
  const std::string here = folder_.string();
  EXPECT_EQ(told(folder_ / "no.yaml"), here + "/no.yaml: No such file or directory");
  EXPECT_EQ(told(folder_), here + ": this is a folder; a show is a YAML file");
  const std::string room(1 << 20, '#');
  EXPECT_EQ(told(write("big.yaml", kShow + room)),
            here + "/big.yaml: a show file is at most 1 MiB; this one is larger");
  EXPECT_EQ(told(write("full.yaml", kShow + room.substr(kShow.size()))), "");
}

TEST_F(ShowErrorsInYaml, DeepNestingIsRefusedWhereItBecomesTooDeep) {
  for (const char* bracket : {"[", "{a: "}) {
    std::string deep;
    for (int k = 0; k < 100'000; ++k) deep += bracket;
    EXPECT_TRUE(complaint("timeline: " + deep).ends_with("the show is nested too deeply"));
  }
}

TEST_F(ShowErrorsInYaml, MissingShippedFilesAreNamedWithTheirFolder) {
  std::filesystem::remove(folder_ / "assets/milky_way.sky");
  EXPECT_EQ(complaint(kShow),
            "show.yaml:1:1: the show needs Domefall's own file milky_way.sky, which is missing "
            "from assets (the variable DOMEFALL_ASSETS can name another folder)");
}

}  // namespace
}  // namespace domefall
