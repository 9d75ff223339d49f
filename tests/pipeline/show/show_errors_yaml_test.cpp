// Messages about YAML, keys and numbers in any section, in full, with line and column.
#include <algorithm>

#include "tests/pipeline/show/show_file.h"

namespace domefall {
namespace {

using ShowErrorsInYaml = ShowMistakes;

TEST_F(ShowErrorsInYaml, OdditiesOfYamlAreNamedWithTheirPlace) {
  expect_complaints_of_lines({
      {"title: \"Fall", "3:8: title opens a quote that is never closed"},
      {"title: Fall: part 1", "3:12: this is not valid YAML: illegal map value"},
      {"title: caf\xE9", "3:11: the byte 0xE9 is not UTF-8; save the show as UTF-8"},
      {"---\ntitle: b", "4:1: a show file holds one YAML document; a second one starts here"},
      {"camera: {<<: {look_at: hole}}",
       "3:10: camera.<< is an unknown key; known here: projection, cut, fov_deg, look_at, "
       "euler_deg, file, roll_deg, frame, elevation_deg or dome_tilt_deg"},
      {"title: !!str a", "3:8: title bears the YAML tag 'tag:yaml.org,2002:str'; shows use none"},
      {"[a]: 1", "3:1: ? is no key; keys are plain words"},
  });
  expect_complaints_behind_hole({
      {"timeline:\n  - &s {duration_s: 1, trajectory: *s}",
       "3:5: timeline[1].trajectory.type is missing: static, circular, parabolic, hyperbolic, "
       "bound, infall, thrown, kruskal, spiral, braked, path, velocity, body or continue"},
      {"timeline: [{duration_s: 1, trajectory: {type: static, r: 9}}]\nsky: {region_I: "
       "{background: \"münchen.png\", gain: -1}}",
       "3:30: sky.region_I.background names the file 'münchen.png', which is neither beside the "
       "show nor in the working folder\n3:51: sky.region_I.gain must be at least 0, got -1"},
  });
  expect_complaints({
      {"", "1:1: the show is empty; it needs a timeline at least"},
      {"# nothing yet\n", "1:1: the show is empty; it needs a timeline at least"},
      {"- a\n",
       "1:1: the show must be a map of keys (title, frames_per_second, size, black_hole, wormhole, "
       "camera, "
       "effects, sky, stars, disc, halo, jet, bodies, exposure, glare, grade, dome, output, "
       "begins_year, "
       "cameras, "
       "keyframes, titles, draw_titles, markers, audio, fade_in_s, fade_out_s or timeline), got a "
       "list"},
      {"hello\n",
       "1:1: the show must be a map of keys (title, frames_per_second, size, black_hole, wormhole, "
       "camera, "
       "effects, sky, stars, disc, halo, jet, bodies, exposure, glare, grade, dome, output, "
       "begins_year, "
       "cameras, "
       "keyframes, titles, draw_titles, markers, audio, fade_in_s, fade_out_s or timeline), got "
       "'hello'"},
      {"timeline:\n	- {duration_s: 2}\n", "2:1: a tab cannot indent YAML; use spaces"},
      {"timeline: [\n", "1:12: this is not valid YAML: end of sequence flow not found"},
      {"timeline:\n  - duration_s: 1\n   camera: {}\n",
       "3:4: this is not valid YAML: end of sequence not found"},
      {kShow + "title: a\x07"
               "b\n",
       "3:9: the control character 0x07 has no place in a show"},
      {"title: a\rtimeline: []\r",
       "1:9: the line ends with a bare carriage return; save the show with LF or CRLF"},
      // yaml-cpp makes documents of it without end.
      {", timeline: []\n", "1:1: this is not valid YAML: nothing can begin here"},
      {"timeline: *shots\n", "1:11: this alias (*) has no anchor (&) before it"},
      {"timeline: &t [*t]\n",
       "1:11: timeline[1] must be a map of keys (duration_s, trajectory, fade_in_s, fade_out_s, "
       "dissolve_s, camera, exposure, grade, sky, disc, bodies, title_light, keyframes or titles), "
       "got a list"},
  });
}

TEST_F(ShowErrorsInYaml, KeysThatAreUnknownRepeatedOrEmpty) {
  expect_complaints_of_lines({
      {"projection: domemaster",
       "3:1: projection is an unknown key; known here: title, frames_per_second, size, black_hole, "
       "wormhole, "
       "camera, effects, sky, stars, disc, halo, jet, bodies, exposure, glare, grade, dome, "
       "output, "
       "begins_year, "
       "cameras, keyframes, titles, draw_titles, markers, audio, fade_in_s, fade_out_s or "
       "timeline"},
      {"exposre: {ev: 1}", "3:1: exposre is an unknown key; did you mean exposure?"},
      {"camera: {projection: stereographic, fov: 90}",
       "3:37: camera.fov is an unknown key; did you mean fov_deg?"},
      {"Camera: {}", "3:1: Camera is an unknown key; did you mean camera?"},
      {"frames_per_second: 30\ntitle: a\nframes_per_second: 60",
       "5:1: frames_per_second is repeated; it is given at line 3 already"},
      {"size:",
       "3:1: size must be 1k, 2k, 4k, 8k or a number of pixels (a domemaster is square), got "
       "nothing"},
      {"camera:",
       "3:1: camera must be a map of keys (projection, cut, fov_deg, look_at, euler_deg, file, "
       "roll_deg, "
       "frame, elevation_deg or dome_tilt_deg), got nothing"},
      {"title: ~", "3:1: title must be text, got nothing"},
  });
  expect_complaints_of_trajectories({
      {"{type: infall, from_radius: 9}",
       "3:48: from_radius is an unknown key; did you mean from_r?"},
      {"{type: static, r: 9, r: 8}", "3:54: r is repeated; it is given at line 3 already"},
  });
}

TEST_F(ShowErrorsInYaml, NumbersMustBePlainAndFinite) {
  expect_complaints_of_lines({
      {"frames_per_second: .nan",
       "3:20: frames_per_second must be a finite number (frames per second) that a double holds, "
       "got .nan"},
      {"exposure: {ev: nan}",
       "3:16: exposure.ev must be a finite number (stops) that a double holds, got nan"},
      {"frames_per_second: true",
       "3:20: frames_per_second must be a number (frames per second), got 'true'"},
      {"frames_per_second: \"30\"",
       "3:20: frames_per_second must be a number (frames per second), got the text '30'; leave the "
       "quotes out"},
      {"exposure:\n  ev: 0,5",
       "4:7: exposure.ev must be a number (stops), got '0,5'; write a decimal point"},
      {"exposure: {ev: +-3}", "3:16: exposure.ev must be a number (stops), got '+-3'"},
      {"camera: {look_at: {ra_deg: 17:45:40, dec_deg: -29}}",
       "3:28: camera.look_at.ra_deg must be a number (degrees), got '17:45:40'; write one decimal "
       "number, not parts of sixty"},
      {"size: 99999999999999999999999999",
       "3:7: size must be at most 16384 (pixels), got 99999999999999999999999999"},
      {"exposure: {ev: 1e999}", "3:16: exposure.ev must be at most 30 (stops), got 1e999"},
      {"exposure: {ev: -1e999}", "3:16: exposure.ev must be at least -30 (stops), got -1e999"},
      {"size: 0x1000",
       "3:7: size must be 1k, 2k, 4k, 8k or a number of pixels from 16 to 16384, got '0x1000'"},
      {"size: 4_096",
       "3:7: size must be 1k, 2k, 4k, 8k or a number of pixels from 16 to 16384, got '4_096'"},
      {"frames_per_second: [30]",
       "3:20: frames_per_second must be a number (frames per second), got a list"},
  });
  expect_complaints_of_trajectories({
      {"{type: static, r: .inf}",
       "3:51: r must be a finite number (units of M) that a double holds, got .inf"},
      {"{type: static, r: 30M}",
       "3:51: r must be a number (units of M), got '30M'; leave the unit out"},
      {"{type: infall, from_r: 30 M}",
       "3:56: from_r must be a number (units of M), got '30 M'; leave the unit out"},
      {"{type: infall, from_r: 1e-999}",
       "3:56: from_r must be a finite number (units of M) that a double holds, got 1e-999"},
      {"{type: infall, from_r: 9, rate_m_per_s: 1e13}",
       "3:73: rate_m_per_s must be at most 1e12 (units of M per second of show), got 1e13"},
  });
  expect_complaints({
      {"timeline: [{duration_s: 1e308}, {duration_s: 1e308}]\n",
       "1:25: timeline[1].duration_s must be at most 10000000 (seconds), got 1e308\n1:46: "
       "timeline[2].duration_s must be at most 10000000 (seconds), got 1e308"},
  });
}

TEST_F(ShowErrorsInYaml, CharactersThatLookLikeOthersAreNamedWithTheirCode) {
  const std::string degrees = "3:20: camera.roll_deg must be a number (degrees), got ";
  const auto roll = [](const std::string& value) {
    return kShow + "camera: {roll_deg: " + value + "}\n";
  };
  expect_complaints_of_lines({
      {"\u200bcamera: {roll_deg: 3}",
       "3:1: \u200bcamera is an unknown key; it begins with a zero width space (U+200B); did you "
       "mean camera?"},
      {"camera: {roll\u200d_deg: 3}",
       "3:10: camera.roll\u200d_deg is an unknown key; it has a zero width joiner (U+200D) in it; "
       "did you mean roll_deg?"},
      {"camera: {projection: fis\u04bbeye}",
       "3:22: camera.projection must be domemaster, fisheye, equirectangular, cubemap, "
       "stereographic or rectilinear, got 'fis\u04bbeye'; it has a Cyrillic letter (U+04BB) in it, "
       "not one of a to z; did you mean fisheye?"},
      {"camera: {look_at: \"Sirius\u00a0\"}",
       "3:19: camera.look_at must be hole, motion or outward, or a place on the sky; it names "
       "'Sirius\u00a0', which is no star, planet, constellation or object that Domefall knows; it "
       "ends with a no-break space (U+00A0), not a space; did you mean Sirius?"},
  });
  expect_complaints({
      {roll("\u20133"), degrees + "'\u20133', which begins with an en dash (U+2013), not a minus"},
      {roll("\u22123"),
       degrees + "'\u22123', which begins with a minus sign (U+2212), not a hyphen-minus (-)"},
      {roll("3\u00a0"),
       degrees + "'3\u00a0', which ends with a no-break space (U+00A0), not a space"},
      {roll("1\u2009000"),
       degrees + "'1\u2009000', which has a typographic space (U+2009) in it, not a space"},
      {roll("1\uff12"),
       degrees + "'1\uff12', which ends with a full-width digit (U+FF12), not one of 0 to 9"},
      {roll("\u201c3\u201d"),
       degrees + "'\u201c3\u201d', which begins with a curly quote (U+201C), not a straight quote"},
      {"timeline: [{duration_s: \u20130:34}]\n",
       "1:25: timeline[1].duration_s must be seconds, or minutes and seconds such as 1:02.5, got "
       "'\u20130:34', which begins with an en dash (U+2013), not a minus"},
      {"timeline:\n\u00a0 - duration_s: 1\n",
       "1:1: timeline must be a list of at least one entry, got nothing\n2:1: \xC2\xA0 - "
       "duration_s is an unknown key; it begins with a no-break space (U+00A0), not a space; known "
       "here: title, frames_per_second, size, black_hole, wormhole, camera, effects, sky, stars, "
       "disc, halo, jet, "
       "bodies, exposure, glare, grade, dome, output, begins_year, cameras, keyframes, titles, "
       "draw_titles, markers, "
       "audio, "
       "fade_in_s, fade_out_s or timeline"},
      {"timeline:\n  \u2013 duration_s: 1\n",
       "2:3: timeline must be a list of at least one entry, got a map whose key '\u2013 "
       "duration_s' begins with an en dash (U+2013), not a minus"},
      {"size\uff1a64\n" + kShow,
       "2:11: this is not valid YAML: illegal map value; line 1 has a full-width colon (U+FF1A) in "
       "it, not a colon"},
  });
  // Titles may have any of them.
  EXPECT_EQ(read(kShow + "title: \u201cFall\u201d \u2013 10\u00a0s\n").title,
            "\u201cFall\u201d \u2013 10\u00a0s");
}

TEST_F(ShowErrorsInYaml, ShowsThatAreJsonAreRead) {
  const std::string timeline = "\"timeline\": [{\"duration_s\": 0.1}]";
  for (const std::string& json :
       {"{\"title\": \"Saturn \\ud83e\\ude90\", \"size\": 64, " + timeline + "}",
        "{\n\t\"title\":\t\"Saturn \\uD83E\\uDE90\",\r\n\t\"size\"\t:64,\n\t" + timeline + "\n}\n",
        "\xEF\xBB\xBF\n {\"title\":\"Saturn \U0001fa90\",\"size\":64," + timeline + "}"}) {
    const Show show = read(json);
    EXPECT_EQ(show.title, "Saturn \U0001fa90") << json;
    EXPECT_EQ(show.timeline.size(), 1U);
  }
  // A backslash that is escaped begins no escape.
  EXPECT_EQ(read("{\"title\": \"a\\/b \\\\ud83e \\u00e9 \\\"x\\\"\", " + timeline + "}").title,
            "a/b \\ud83e \u00e9 \"x\"");
}

TEST_F(ShowErrorsInYaml, MistakesInShowsThatAreJsonKeepTheirPlaces) {
  const std::string timeline = "\"timeline\": [{\"duration_s\": 0.1}]";
  expect_complaints_of_lines({
      {"title: \"\\ud83e\\ude90\"",
       "3:15: this escape is no character; halves of one, such as \\ud83e\\ude90, are read in "
       "pairs and in shows that are JSON"},
  });
  expect_complaints({
      {"{\"title\": \"\\ud83e\\ude90\\ud83e\\ude90\", \"sise\": 64, " + timeline + "}",
       "1:39: sise is an unknown key; did you mean size?"},
      {"{\n\t\t\"frames_per_second\":\t\"30\",\n\t" + timeline + "\n}",
       "2:24: frames_per_second must be a number (frames per second), got the text '30'; leave the "
       "quotes out"},
      {"{" + timeline + ",\n\"size\": 64,\n\t\"size\": 128}",
       "3:2: size is repeated; it is given at line 2 already"},
      {"{\"title\": \"\\ud83e\", " + timeline + "}",
       "1:18: this escape is no character; halves of one, such as \\ud83e\\ude90, are read in "
       "pairs and in shows that are JSON"},
  });
}

TEST_F(ShowErrorsInYaml, ShowsInUtf16AreRead) {
  const std::string text = "title: \u00e9\nsize: 9k\n" + kShow;
  for (const bool big : {false, true}) {
    std::string bytes;
    for (const char16_t c :
         u"\ufefftitle: \u00e9\n" + std::u16string(text.begin() + 10, text.end())) {
      bytes += static_cast<char>(big ? c >> 8 : c & 0xff);
      bytes += static_cast<char>(big ? c & 0xff : c >> 8);
    }
    EXPECT_TRUE(complaint(bytes).starts_with("show.yaml:2:7: size must be 1k")) << complaint(bytes);
  }
  EXPECT_EQ(complaint(std::string("\xFF\xFEt\0i", 5)),
            "show.yaml: byte 5: the text is UTF-16 and ends within a character");
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
  const auto told = [](const std::filesystem::path& file) {
    return message_of([&] { read_show(file); });
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
