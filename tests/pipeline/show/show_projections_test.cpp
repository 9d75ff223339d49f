// Tests of the keys that say what projection a show has, and of what is told of mistakes in them.
#include "tests/pipeline/show/show_file.h"

namespace domefall {
namespace {

using ShowProjections = ShowKeys;

TEST_F(ShowProjections, RectilinearImagesAreAsFlatOnes) {
  const auto plain = std::get<Rectilinear>(with("camera: {projection: rectilinear}").projection);
  EXPECT_EQ(plain.columns, 1920);
  EXPECT_EQ(plain.rows, 1080);
  EXPECT_DOUBLE_EQ(plain.fov, 90 * kDegree);
  const auto given = std::get<Rectilinear>(
      with("size: [640, 480]\ncamera: {projection: rectilinear, fov_deg: 170}").projection);
  EXPECT_EQ(given.columns, 640);
  EXPECT_DOUBLE_EQ(given.fov, 170 * kDegree);
}

TEST_F(ShowProjections, AreThoseOfTheListByTheirNames) {
  for (const ProjectionTraits& traits : kEveryProjectionTraits)
    EXPECT_EQ(
        projection_name(with("camera: {projection: " + std::string(traits.name) + "}").projection),
        traits.name);
}

TEST_F(ShowProjections, AFisheyeIsASquareOrAPartOfIt) {
  const auto plain = std::get<Fisheye>(with("camera: {projection: fisheye}").projection);
  EXPECT_EQ(plain.columns, 4096);
  EXPECT_EQ(plain.rows, 4096);
  EXPECT_DOUBLE_EQ(plain.fov, 180 * kDegree);
  const auto whole =
      std::get<Fisheye>(with("size: 2k\ncamera: {projection: fisheye, fov_deg: 360}").projection);
  EXPECT_EQ(whole.columns, 2048);
  EXPECT_DOUBLE_EQ(whole.fov, 360 * kDegree);
  for (const auto& [word, cut_back] :
       {std::pair{"", 1.0}, {", cut: back", 1.0}, {", cut: front", 0.0}, {", cut: both", 0.5}}) {
    const auto cut = std::get<Fisheye>(
        with("size: [4096, 3072]\ncamera: {projection: fisheye" + std::string(word) + "}")
            .projection);
    EXPECT_EQ(cut.columns, 4096);
    EXPECT_EQ(cut.rows, 3072);
    EXPECT_EQ(cut.cut_back, cut_back);
  }
}

TEST_F(ShowProjections, ImagesOfTheWholeSphereHaveOneSize) {
  for (const auto& [text, width] :
       {std::pair{"", 4096}, {"size: 8k\n", 8192}, {"size: 500\n", 500}})
    EXPECT_EQ(columns(with(text + std::string("camera: {projection: equirectangular}")).projection),
              width);
  for (const auto& [text, face] :
       {std::pair{"", 1024}, {"size: 4k\n", 4096}, {"size: 5461\n", 5461}})
    EXPECT_EQ(columns(with(text + std::string("camera: {projection: cubemap}")).projection),
              3 * face);
}

TEST_F(ShowProjections, PixelsMayBeWiderThanHigh) {
  const std::string flat = "size: [720, 576]\ncamera: {projection: ";
  for (const auto& [written, aspect] : {std::pair{"16:11", 16. / 11},
                                        {"12:11", 12. / 11},
                                        {"\"2:1\"", 2.},
                                        {"0.9", 0.9},
                                        {"1", 1.}})
    for (const char* projection : {"stereographic", "rectilinear", "fisheye"}) {
      const Projection p =
          with(flat + projection + "}\noutput: {pixel_aspect: " + written + "}").projection;
      EXPECT_DOUBLE_EQ(pixel_aspect(p), aspect) << written;
      EXPECT_EQ(columns(p), 720);
      EXPECT_EQ(rows(p), 576);
    }
  EXPECT_EQ(pixel_aspect(with("output: {pixel_aspect: 1}").projection), 1);
  // The circle of a fisheye is round on the screen.
  const std::string fisheye = "camera: {projection: fisheye}\noutput: {pixel_aspect: 2}\n";
  EXPECT_EQ(rows(with("size: [500, 1000]\n" + fisheye).projection), 1000);
  EXPECT_EQ(rows(with("size: 500\n" + fisheye).projection), 1000);
  EXPECT_EQ(rows(with(fisheye).projection), 8192);
}

// One camera serves all images for an audience.
TEST_F(ShowProjections, ImagesWithAZenithHaveTheAxesOfADome) {
  const std::string camera = ", look_at: hole, elevation_deg: 20, dome_tilt_deg: 10, roll_deg: 5}";
  const auto state = [&](const std::string& projection) {
    return frame_state(with("camera: {projection: " + projection + camera), 0);
  };
  const FrameState dome = state("domemaster");
  for (const char* projection : {"fisheye", "equirectangular", "cubemap"}) {
    const FrameState other = state(projection);
    EXPECT_EQ(other.observer.tetrad_from_camera, dome.observer.tetrad_from_camera) << projection;
    EXPECT_EQ(other.camera_from_audience, dome.camera_from_audience) << projection;
  }
}

using ShowErrorsInProjections = ShowMistakes;

TEST_F(ShowErrorsInProjections, AreToldWithTheirPlace) {
  expect_complaints_of_lines({
      {"size: [100, 101]\ncamera: {projection: fisheye}",
       "3:7: size must be at most as high as wide (the circle of a fisheye touches both sides), "
       "got [100, 101]"},
      {"size: [100, 201]\ncamera: {projection: fisheye}\noutput: {pixel_aspect: 2}",
       "3:7: size must be at most as high as wide (the circle of a fisheye touches both sides, "
       "which are 200 pixels), got [100, 201]"},
      {"size: 8193\ncamera: {projection: fisheye}\noutput: {pixel_aspect: 2}",
       "3:7: size must be at most 8192 (pixels), got 8193"},
      {"output: {pixel_aspect: 16:11}",
       "3:24: output.pixel_aspect goes with the projections fisheye, stereographic and "
       "rectilinear; the pixels of a domemaster are square"},
      {"camera: {projection: cubemap}\noutput: {pixel_aspect: 2}",
       "4:24: output.pixel_aspect goes with the projections fisheye, stereographic and "
       "rectilinear; the pixels of a cubemap are square"},
      {"size: [64, 64]\ncamera: {projection: rectilinear}\noutput: {pixel_aspect: 5:2}",
       "5:24: output.pixel_aspect must be at most 2, got 5:2"},
      {"size: [64, 64]\ncamera: {projection: rectilinear}\noutput: {pixel_aspect: 0:2}",
       "5:24: output.pixel_aspect must be a number, or a ratio of two whole numbers up to 10000 "
       "such as 16:11, got '0:2'"},
      {"size: [64, 64]\ncamera: {projection: rectilinear}\noutput: {pixel_aspect: wide}",
       "5:24: output.pixel_aspect must be a number, got 'wide'"},
      {"size: 101\ncamera: {projection: equirectangular}",
       "3:7: size must be even (a whole sphere is half as high as wide), got 101"},
      {"size: 5462\ncamera: {projection: cubemap}",
       "3:7: size must be at most 5461 (pixels), got 5462"},
      {"size: 8k\ncamera: {projection: cubemap}",
       "3:7: size must be at most 5461 (pixels; the edge of a face, of which three make the "
       "width), got 8k"},
      {"camera: {projection: cubemap}\ntitles: [{text: Hello}]",
       "4:9: titles cannot be drawn on a cubemap, whose faces would cut them; an equirectangular "
       "picture shows them, and draw_titles: false leaves them out"},
      {"camera: {projection: equirectangular, fov_deg: 90}",
       "3:48: camera.fov_deg goes with the projections fisheye, stereographic and rectilinear; an "
       "equirectangular shows 360 degrees"},
      {"camera: {projection: fisheye, fov_deg: 361}",
       "3:40: camera.fov_deg must be at most 360 (degrees), got 361"},
      {"camera: {projection: rectilinear, fov_deg: 171}",
       "3:44: camera.fov_deg must be at most 170 (degrees), got 171"},
      {"camera: {projection: rectilinear, elevation_deg: 3}",
       "3:50: camera.elevation_deg is for domes; this projection is flat"},
      {"camera: {projection: fisheye, cut: back}",
       "3:36: camera.cut is for a size of [width, height] that is lower than wide; this one is a "
       "square"},
      {"camera: {cut: back}", "3:15: camera.cut goes with the fisheye projection only"},
      {"camera: {projection: equirectangular}\ndome: {light: simulate}",
       "4:15: dome.light is for a whole half sphere, which the projection domemaster shows"},
      {"dome: {light: on}", "3:15: dome.light must be none, simulate or compensate, got 'on'"},
      {"dome: {light: simulate, reflectance: 1.1}",
       "3:38: dome.reflectance must be at most 1, got 1.1"},
      {"keyframes: [{at_s: 1, grade: {cdl: {power: 0}}}]",
       "3:44: keyframes[1].grade.cdl.power must exceed 0, got 0"},
      {"grade: {cdl: {power: 0}}", "3:22: grade.cdl.power must exceed 0, got 0"},
      {"grade: {cdl: {slope: [1, 1]}}", "3:22: grade.cdl.slope must be a list of 3 numbers, got 2"},
      {"output: {graded: gif}",
       "3:18: output.graded must be png16, png8, jpeg, tiff16, tiff8, png, tiff or none, got "
       "'gif'"},
      {"output: {linear: none, graded: none}",
       "3:32: output.graded and linear are both none, so that nothing would be made"},
      {"output: {linear: none, compression: zip}",
       "3:37: output.compression is that of scene-linear files, of which linear: none makes none; "
       "leave it out"},
      {"output: {compression: dwaa}",
       "3:23: output.compression must be zip, zips, piz or none, got 'dwaa'"},
      {"output: {name: a/b}",
       "3:16: output.name is that of a file and may have no '/'; --out names the folder"},
      {"output: {name: .a}", "3:16: output.name may not begin with a dot, which hides files"},
      {"output: {start: -1}", "3:17: output.start must be at least 0, got -1"},
      {"output: {digits: 0}", "3:18: output.digits must be at least 1, got 0"},
      {"output: {per_folder: 10001}", "3:22: output.per_folder must be at most 10000, got 10001"},
      {"output: {graded: png8, quality: 90}",
       "3:33: output.quality is that of a JPEG; say graded: jpeg, or leave it out"},
      {"output: {graded: jpeg, quality: 0}", "3:33: output.quality must be at least 1, got 0"},
  });
  expect_complaints_behind_hole({
      {"timeline:\n  - duration_s: 1\n    trajectory: {type: static, r: 9}\n    grade: {view: "
       "Dome}",
       "5:13: timeline[1].grade.view is an unknown key; known here: cdl"},
  });
  expect_complaints({
      {kShow + "output: {name: " + std::string(201, 'x') + "}\n",
       "3:16: output.name may have 200 bytes, got 201"},
  });
}

}  // namespace
}  // namespace domefall
