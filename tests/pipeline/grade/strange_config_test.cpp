// Configurations that crash OpenColorIO, make it wait for ever, or make of light what is no number.
#include <gmock/gmock.h>
#include <sys/stat.h>

#include <array>
#include <csignal>
#include <cstring>

#include "pipeline/base/errors.h"
#include "pipeline/grade/config_check.h"
#include "pipeline/grade/grader.h"
#include "pipeline/sources/colour/colour_space.h"
#include "tests/pipeline/image/test_folder.h"
#include "tests/source_tree.h"

namespace domefall {
namespace {

using testing::AllOf;
using testing::EndsWith;
using testing::HasSubstr;
using testing::StartsWith;

class StrangeConfig : public TestFolder {
 protected:
  // A configuration whose only view is the space `out`, made from the reference by `transform`.
  GradeSettings config(const std::string& transform, const std::string& more = "",
                       const std::string& head = "search_path: luts\n") const {
    GradeSettings settings;
    settings.config = folder_ / "config.ocio";
    put(settings.config, "ocio_profile_version: 2\n" + head +
                             "roles: {default: ACEScg, scene_linear: ACEScg}\n"
                             "displays: {Dome: [!<View> {name: Plain, colorspace: out}]}\n"
                             "colorspaces:\n"
                             "  - !<ColorSpace> {name: ACEScg}\n"
                             "  - !<ColorSpace> {name: out, from_scene_reference: " +
                             transform + "}\n" + more);
    return settings;
  }
  template <class Error = InputError>
  void refused(const GradeSettings& settings, const std::string& what) const {
    EXPECT_THAT(message_of<Error>([&] { Grader grader(settings); }),
                AllOf(StartsWith(settings.config.string() + ": "), HasSubstr(what)))
        << contents(settings.config);
  }
  static std::string matrix(const std::string& first) {
    return "!<MatrixTransform> {matrix: [" + first +
           ", 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1]}";
  }
};

TEST_F(StrangeConfig, ThatIsSoundIsTriedAndUsed) {
  const Grader grader(config(matrix("0.5")));
  HalfFrame frame(1, 1);
  for (int c = 0; c < 3; ++c) frame.row(0)[c] = 0.5f;
  EXPECT_NEAR(grader.grade(frame).row(0)[0], 16384, 1);
}

// A configuration of one linear space of its own, whose view shows it as it is.
class ConfigByRoles : public TestFolder {
 protected:
  std::array<double, 3> graded(const std::string& roles, const std::string& transform,
                               const std::string& name = "scene") const {
    GradeSettings settings;
    settings.config = folder_ / "config.ocio";
    put(settings.config, "ocio_profile_version: 2\nroles: {default: raw, " + roles +
                             "}\ndisplays: {Dome: [!<View> {name: Plain, colorspace: shown}]}\n"
                             "colorspaces:\n"
                             "  - !<ColorSpace> {name: reference}\n"
                             "  - !<ColorSpace> {name: raw, isdata: true}\n"
                             "  - !<ColorSpace> {name: " +
                             name + transform +
                             "}\n"
                             "  - !<ColorSpace> {name: shown}\n");
    HalfFrame frame(1, 1);
    frame.pixels = {Imath::half(0.5f), Imath::half(0.25f), Imath::half(0.125f)};
    const GradedFrame out = Grader(settings).grade(frame);
    return {out.pixels[0] / 65535.0, out.pixels[1] / 65535.0, out.pixels[2] / 65535.0};
  }
  static constexpr std::array<double, 3> kFrame{0.5, 0.25, 0.125};

  static void expect_near(const std::array<double, 3>& found,
                          const std::array<double, 3>& expected) {
    for (std::size_t c = 0; c < 3; ++c) EXPECT_NEAR(found[c], expected[c], 3e-4) << c;
  }
};

// The reference is AP0, and what is shown is the reference: the matrix is S-2014-004's.
TEST_F(ConfigByRoles, IsEnteredByTheInterchangeSpace) {
  const std::array<double, 3> ap0{0.6954522414 * 0.5 + 0.1406786965 * 0.25 + 0.1638690622 * 0.125,
                                  0.0447945634 * 0.5 + 0.8596711185 * 0.25 + 0.0955343182 * 0.125,
                                  -0.0055258826 * 0.5 + 0.0040252103 * 0.25 + 1.0015006723 * 0.125};
  expect_near(graded("aces_interchange: reference, scene_linear: scene", ""), ap0);
  // A space that is called ACEScg and is none is not asked.
  expect_near(graded("aces_interchange: reference, scene_linear: ACEScg", "", "ACEScg"), ap0);
}

TEST_F(ConfigByRoles, WithoutInterchangeIsEnteredByItsSceneLinearSpace) {
  // ACEScg by its name, in a role.
  expect_near(graded("scene_linear: ACES - ACEScg", "", "ACES - ACEScg"), kFrame);
  // And linear Rec.709 by any other.
  const Imath::M33d rec709 = working_from_rec709().inverse();
  std::array<double, 3> expected{};
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j)
      expected[static_cast<std::size_t>(i)] += rec709[i][j] * kFrame[static_cast<std::size_t>(j)];
  expect_near(graded("scene_linear: linear", "", "linear"), expected);
}

TEST_F(ConfigByRoles, WithoutAnyIsRefused) {
  EXPECT_THAT(message_of([&] { graded("color_picking: scene", ""); }),
              HasSubstr("has none of the roles aces_interchange"));
}

// It follows the circle until its stack is full.
TEST_F(StrangeConfig, WhoseSpacesReferToThemselvesIsRefused) {
  const std::string crash = "crashes the reader";
  refused(config("!<ColorSpaceTransform> {src: ACEScg, dst: out}"), crash);
  refused(
      config("!<ColorSpaceTransform> {src: ACEScg, dst: other}",
             "  - !<ColorSpace> {name: other, from_scene_reference: !<ColorSpaceTransform> {src: "
             "ACEScg, dst: out}}\n"),
      crash);
  refused(config("!<LookTransform> {src: ACEScg, dst: ACEScg, looks: again}",
                 "looks:\n  - !<Look> {name: again, process_space: out, transform: "
                 "!<ColorSpaceTransform> {src: out, dst: ACEScg}}\n"),
          crash);
  refused(config("!<DisplayViewTransform> {src: ACEScg, display: Dome, view: Plain}"), crash);
}

// It puts them in their own place until its stack or an hour is full.
TEST_F(StrangeConfig, WhoseVariablesReferToThemselvesIsRefused) {
  const std::string file = "!<FileTransform> {src: \"${A}.cube\"}";
  for (const char* variables :
       {"{A: \"${A}x\"}", "{A: \"$A$A\"}", "{A: \"%B%\", B: \"${C}${C}\", C: \"$A$A\"}"})
    refused(config(file, "", "environment: " + std::string(variables) + "\n"),
            "the variable A refers to itself");
  refused<TemporaryError>(config(file, "", "environment: {A: x, B: \"$A\"}\n"), "/x.cube'");
}

TEST_F(StrangeConfig, WhoseTableIsAPipeOrOfNoSizeIsRefused) {
  std::filesystem::create_directory(folder_ / "luts");
  ASSERT_EQ(mkfifo((folder_ / "luts/pipe.cube").c_str(), 0600), 0);
  refused(config("!<FileTransform> {src: pipe.cube}"), "luts/pipe.cube: this is a pipe; only");
  refused(config("!<GroupTransform> {children: [!<FileTransform> {src: pipe.cube}]}"), "is a pipe");
  refused(config(matrix("1"),
                 "looks:\n  - !<Look> {name: look, process_space: ACEScg, transform: "
                 "!<FileTransform> {src: pipe.cube}}\n"),
          "is a pipe");
  std::filesystem::create_symlink("/proc/kmsg", folder_ / "luts/news.cube");
  refused(config("!<FileTransform> {src: news.cube}"), "luts/news.cube: the file is empty");
  // Another machine may have it.
  refused<TemporaryError>(config("!<FileTransform> {src: none.cube}"),
                          "none.cube' could not be located");
}

TEST_F(StrangeConfig, ThatMakesNoNumbersOfLightIsRefusedThoughALaterStepHidesIt) {
  refused(config(matrix(".nan")),
          "step 1 of 1 of the view makes (nan, 1, 1) of the pixel (1, 1, 1)");
  refused(config(matrix(".inf")), "makes (inf, 1, 1)");
  refused(config("!<GroupTransform> {children: [" + matrix(".nan") +
                 ", !<RangeTransform> {min_in_value: 0, min_out_value: 0, max_in_value: 1, "
                 "max_out_value: 1}]}"),
          "makes (nan, 1, 1)");
  refused(config("!<ExponentTransform> {value: [.nan, 1, 1, 1]}"), "makes (nan, ");
}

TEST_F(StrangeConfig, ThatIsNoFileOrEmptyIsRefusedAndOneThatIsMissingMayBeElsewhere) {
  GradeSettings settings;
  settings.config = folder_ / "pipe";
  ASSERT_EQ(mkfifo(settings.config.c_str(), 0600), 0);
  for (const bool shipped : {false, true}) {
    settings.shipped = shipped;
    refused(settings, "this is a pipe");
  }
  settings.config = "/proc/kmsg";
  refused(settings, "the file is empty");
  settings.config = folder_ / "none";
  refused<TemporaryError>(settings, "");
}

// Each view of every display, as it would be tried if it were not ours.
TEST_F(StrangeConfig, IsNoneOfTheViewsThatAreShipped) {
  GradeSettings settings;
  settings.config = source_file("shows/assets/dome.ocio");
  for (const char* display :
       {"Dome G2.2 Rec.709", "Dome G2.6 P3-D65", "sRGB - Display", "Rec.1886 Rec.709 - Display"})
    for (const char* view : {"Dome", "ACES SDR", "Star field", "Un-tone-mapped", "Raw"}) {
      settings.display = display, settings.view = view;
      EXPECT_NO_THROW(Grader{settings}) << display << ", " << view;
    }
}

TEST(Trial, LeavesThisProcessAsItWas) {
  int here = 1;
  try_in_child("file", [&] { here = 2; });
  EXPECT_EQ(here, 1);
}

TEST(Trial, ThrowsWhatTheStepThrows) {
  EXPECT_EQ(message_of([] { try_in_child("file", [] { throw InputError("wrong"); }); }), "wrong");
  EXPECT_EQ(message_of<TemporaryError>(
                [] { try_in_child("file", [] { throw TemporaryError("full"); }); }),
            "full");
  EXPECT_EQ(message_of([] { try_in_child("file", [] { throw std::runtime_error("odd"); }); }),
            "odd");
  const std::string long_text(100000, 'x');
  EXPECT_EQ(message_of([&] { try_in_child("file", [&] { throw InputError(long_text); }); }),
            long_text);
}

TEST(Trial, SurvivesWhatCrashesTakesTooMuchOrWaits) {
  for (const int number : {SIGSEGV, SIGABRT, SIGKILL})
    EXPECT_THAT(
        message_of([&] { try_in_child("file", [&] { std::raise(number); }); }),
        StartsWith("file: to read it crashes the reader (" + std::string(strsignal(number)) + ")"));
  EXPECT_THAT(message_of([] { try_in_child("file", [] { _exit(0); }); }),
              HasSubstr("crashes the reader (it ended)"));
  EXPECT_EQ(message_of([] {
              volatile bool on = true;
              try_in_child("file",
                           [&] {
                             while (on) continue;
                           },
                           {.cpu_seconds = 1});
            }),
            "file: to read it takes more than 1 s of processor time");
  EXPECT_EQ(
      message_of<TemporaryError>([] { try_in_child("file", [] { pause(); }, {.seconds = 1}); }),
      "file: to read it takes more than 1 s");
  EXPECT_THROW(try_in_child("file",
                            [] {
                              std::string large(std::size_t{3} << 30, 'x');
                              if (large.back() != 'x') throw TemporaryError("never");
                            },
                            {.gibibytes = 1}),
               InputError);
}

}  // namespace
}  // namespace domefall
