// Cameras that other programs have animated, and the world in which they are turned.
#include "pipeline/show/file/camera_file.h"

#include <cmath>

#include "pipeline/base/errors.h"
#include "pipeline/show/camera_world.h"
#include "tests/pipeline/show/show_file.h"

namespace domefall {
namespace {

class CameraFiles : public ShowFile {
 protected:
  std::vector<CameraSample> samples(const std::string& name, const std::string& text) {
    return read_camera_file(write(name, text), 25);
  }
  std::string complaint_of(const std::string& name, const std::string& text) {
    try {
      samples(name, text);
    } catch (const InputError& error) {
      const std::string said = error.what();
      return said.substr(said.find(name));
    }
    return "";
  }
};

void expect_axes(const M33d& m, const V3d& x, const V3d& y, const V3d& z) {
  const V3d axes[] = {x, y, z};
  for (int k = 0; k < 3; ++k) EXPECT_LT((column(m, k) - axes[k]).length(), 1e-12) << column(m, k);
}

TEST_F(CameraFiles, OfNukeTurnAboutZThenXThenY) {
  const auto found = samples("a.chan",
                             "# a camera\n0 1 2 3 0 0 0\n\n"
                             "50\t0 0 0\t90 0 90 30\r\n75 0 0 0 90 90 0\n");
  ASSERT_EQ(found.size(), 3U);
  expect_axes(found[0].world_from_camera, {1, 0, 0}, {0, 1, 0}, {0, 0, 1});
  EXPECT_EQ(found[1].at_s, 2);
  // About z, x goes to y and y to -x; then, about x, y goes to z and z to -y.
  expect_axes(found[1].world_from_camera, {0, 0, 1}, {-1, 0, 0}, {0, -1, 0});
  expect_axes(found[2].world_from_camera, {0, 0, -1}, {1, 0, 0}, {0, -1, 0});
}

const char* const kHead = "#usda 1.0\n(\n  timeCodesPerSecond = 50\n)\n";

TEST_F(CameraFiles, OfUsdTurnWithAllThatTheyHangOn) {
  const auto found =
      samples("a.usda",
              std::string(kHead) +
                  "def Xform \"Rig\" (\n  kind = \"group\"\n)\n{\n"
                  "  double3 xformOp:translate = (1, 2, 3)\n"
                  "  float xformOp:rotateY.timeSamples = { 0: 0, 100: 90, }\n"
                  "  uniform token[] xformOpOrder = [\"xformOp:translate\", \"xformOp:rotateY\"]\n"
                  "  def Camera \"Eye\"\n  {\n"
                  "    float focalLength = 35 # mm\n"
                  "    rel target = </Rig>\n"
                  "    float3 xformOp:rotateXYZ:aim = (90, 0, 90) ( doc = \"a ) b\" )\n"
                  "    uniform token[] xformOpOrder = [\"xformOp:rotateXYZ:aim\"]\n  }\n"
                  "}\n"
                  "def Camera \"Still\" { }\n");
  ASSERT_EQ(found.size(), 2U);
  // About x, y goes to z and z to -y; then, about z, x goes to y and y to -x.
  expect_axes(found[0].world_from_camera, {0, 1, 0}, {0, 0, 1}, {1, 0, 0});
  EXPECT_EQ(found[1].at_s, 2);
  expect_axes(found[1].world_from_camera, {0, 1, 0}, {1, 0, 0}, {0, 0, -1});
}

TEST_F(CameraFiles, OfUsdKnowMatricesQuaternionsAndTheAxisThatIsUp) {
  const std::string quarter =
      "  quatd xformOp:orient = (0.7071067811865476, 0, 0.7071067811865476, 0)\n"
      "  uniform token[] xformOpOrder = [\"xformOp:orient\"]\n}\n";
  const auto turned = samples("a.usda", "#usda 1.0\ndef Camera \"A\"\n{\n" + quarter);
  ASSERT_EQ(turned.size(), 1U);
  expect_axes(turned[0].world_from_camera, {0, 0, -1}, {0, 1, 0}, {1, 0, 0});
  const auto matrix = samples(
      "b.usda",
      "#usda 1.0\n( upAxis = \"Z\" )\ndef Camera \"A\"\n{\n"
      "  matrix4d xformOp:transform = ( (2, 0, 0, 0), (0, 0, 2, 0), (0, -2, 0, 0), (5, 6, 7, 1) )\n"
      "  uniform token[] xformOpOrder = [\"xformOp:transform\"]\n}\n");
  // Its y is up and it looks along y, which leads away.
  expect_axes(matrix[0].world_from_camera, {1, 0, 0}, {0, 1, 0}, {0, 0, 1});
}

TEST_F(CameraFiles, ThatCannotBeReadAreToldWithTheirLine) {
  for (const auto& [name, text, told] : std::initializer_list<std::array<std::string, 3>>{
           {"a.chan", "0 0 0 0 0 0 0\n1 0 0 0 0\n", "a.chan:2: a camera has a frame"},
           {"a.chan", "0 0 0 0 0 0 0\n0 0 0 0 0 0 0\n", "a.chan:2: frame 0 does not come after"},
           {"a.chan", "0 0 0 0 nan 0 0\n", "a.chan:1: 'nan' is no number"},
           {"a.chan", "# none\n", "a.chan: holds no frames"},
           {"a.usda", "#usda 1.0\ndef Xform \"A\"\n{\n", "a.usda:4: '}' is missing"},
           {"a.usda", "#usda 1.0\ndef Xform \"A\" {}\n", "a.usda: holds no camera"},
           {"a.usda", "#usda 1.0\nfoo\n", "a.usda:2: 'foo' stands where an object should begin"},
           {"a.usda", "#usda 1.0\ndef Camera \"A\" {}\ndef Camera \"B\" {}\n",
            "a.usda: holds 2 cameras, among them /A and /B"},
           {"a.usda",
            "#usda 1.0\ndef Camera \"A\"\n{\n  float3 xformOp:scale = (1, 1, -1)\n"
            "  uniform token[] xformOpOrder = [\"xformOp:scale\"]\n}\n",
            "a.usda:2: /A mirrors the camera"},
           {"a.usda",
            "#usda 1.0\ndef Camera \"A\"\n{\n"
            "  uniform token[] xformOpOrder = [\"xformOp:rotateX\"]\n}\n",
            "a.usda:2: /A lacks the operation xformOp:rotateX"},
           {"a.usdc", "PXR-USDC", "a.usdc: is a packed USD file"}})
    EXPECT_TRUE(complaint_of(name, text).starts_with(told)) << complaint_of(name, text);
}

// Any part of a file may be missing or garbled.
TEST_F(CameraFiles, ThatAreCutOffAreReadOrRefused) {
  const std::string text =
      std::string(kHead) +
      "def Camera \"A\"\n{\n  float xformOp:rotateX.timeSamples = { 0: 1, 5: -2e1 }\n"
      "  uniform token[] xformOpOrder = [\"xformOp:rotateX\"]\n}\n";
  for (std::size_t length = 5; length <= text.size(); ++length) {
    complaint_of("a.usda", text.substr(0, length));
    complaint_of("a.usda", text.substr(0, length) + "}" + text.substr(length));
  }
  EXPECT_EQ(complaint_of("a.usda", text), "");
}

TEST_F(CameraFiles, LookAtTheHoleWhereTheyAreNotTurned) {
  const std::string hole = "black_hole: {mass_solar: 4e6}\n";
  write("still.chan", "0 0 0 0 0 0 0\n");
  for (const char* size : {"camera: {projection: rectilinear, file: still.chan}\nsize: [64, 36]\n",
                           "camera: {projection: equirectangular, file: still.chan}\nsize: 64\n",
                           "camera: {file: still.chan}\nsize: 64\n"}) {
    const Show show =
        read(hole + size + "timeline: [{duration_s: 1, trajectory: {type: static, r: 9}}]\n");
    const FrameState state = frame_state(show, 0);
    // The middle of the picture, which is a dome's zenith, shows the hole.
    const bool dome = traits_of(show.projection).is_dome;
    const PixelPosition middle{columns(show.projection) / 2.0 + 0.5,
                               rows(show.projection) / 2.0 + 0.5};
    const V3d ahead =
        apply(state.observer.tetrad_from_camera, direction_at(show.projection, middle).v);
    EXPECT_LT((ahead - V3d(-1, 0, 0)).length(), 1e-12) << size << dome;
  }
}

TEST_F(CameraFiles, ReplaceTheCameraOfAShowOrOfASegment) {
  write("a.chan", "0 0 0 0 0 0 0\n24 0 0 0 0 90 0\n");
  const std::string segments =
      "timeline:\n  - {duration_s: 1, trajectory: {type: static, r: 9}}\n"
      "  - {duration_s: 1, trajectory: {type: static, r: 9}, camera: {look_at: outward}}\n";
  const Show show = read(
      "black_hole: {mass_solar: 4e6}\nframes_per_second: 24\nsize: [64, 36]\n"
      "camera: {projection: rectilinear, file: a.chan}\n" +
      segments);
  const auto ahead = [&](int frame) {
    return column(frame_state(show, frame).observer.tetrad_from_camera, 2);
  };
  const double half = std::sqrt(0.5);
  EXPECT_LT((ahead(0) - V3d(-1, 0, 0)).length(), 1e-12);
  EXPECT_LT((ahead(12) - V3d(-half, 0, -half)).length(), 1e-12);  // to the left, against Phi
  EXPECT_LT((ahead(24) - V3d(1, 0, 0)).length(), 1e-12);
}

TEST_F(CameraFiles, ThatAShowCannotTakeAreToldWithTheirPlace) {
  write("a.chan", "0 0 0 0 0 0 0\n");
  write("b.chan", "zero\n");
  const std::string rest = "timeline: [{duration_s: 1, camera: {";
  EXPECT_NE(
      complaint("camera: {file: b.chan}\ntimeline: [{duration_s: 1}]\n").find("1:16: camera.file"),
      std::string::npos);
  EXPECT_NE(complaint("camera: {file: a.chan, look_at: Vega}\ntimeline: [{duration_s: 1}]\n"), "");
  EXPECT_NE(
      complaint("camera: {file: a.chan}\n" + rest + "roll_deg: 4}}]\n").find("turned by a file"),
      std::string::npos);
  EXPECT_NE(
      complaint("keyframes: [{at_s: 0, camera: {file: a.chan}}]\ntimeline: [{duration_s: 1}]\n")
          .find("is for the camera of a show or a segment"),
      std::string::npos);
}

}  // namespace
}  // namespace domefall
