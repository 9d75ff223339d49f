// What the header of an OpenEXR file says of its picture: windows, layers, parts, primaries.
#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfDeepFrameBuffer.h>
#include <OpenEXR/ImfDeepScanLineOutputFile.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfMultiPartOutputFile.h>
#include <OpenEXR/ImfOutputFile.h>
#include <OpenEXR/ImfOutputPart.h>
#include <OpenEXR/ImfPartType.h>
#include <OpenEXR/ImfStandardAttributes.h>
#include <OpenEXR/ImfStringAttribute.h>
#include <OpenEXR/ImfTiledOutputFile.h>
#include <gmock/gmock.h>

#include <functional>
#include <list>
#include <vector>

#include "pipeline/image/encode/display_colour.h"
#include "pipeline/image/read_image.h"
#include "tests/pipeline/image/test_folder.h"

namespace domefall {
namespace {

using namespace std::literals;
using Imath::Box2i;
using Imath::V2i;
using testing::HasSubstr;

struct Channel {
  std::string name;
  std::function<float(int, int)> value;
  Imf::PixelType type = Imf::FLOAT;
};

Channel constant(const std::string& name, float value, Imf::PixelType type = Imf::FLOAT) {
  return {name, [value](int, int) { return value; }, type};
}

// Channels of the values 1, 2, 3, in the order of the names.
std::vector<Channel> numbered(const std::vector<std::string>& names) {
  std::vector<Channel> channels;
  for (const std::string& name : names)
    channels.push_back(constant(name, static_cast<float>(channels.size() + 1)));
  return channels;
}

Box2i box(int left, int top, int width, int height) {
  return {V2i(left, top), V2i(left + width - 1, top + height - 1)};
}

void insert(Imf::Header& header, const std::vector<Channel>& channels) {
  for (const Channel& c : channels) header.channels().insert(c.name, Imf::Channel(c.type));
}

// The pixels of a data window, kept while they are written.
class Pixels {
 public:
  Pixels(const Box2i& data, const std::vector<Channel>& channels) {
    const auto width = static_cast<std::size_t>(data.max.x - data.min.x + 1);
    for (const Channel& c : channels) {
      std::vector<float>& values = kept_.emplace_back();
      for (int y = data.min.y; y <= data.max.y; ++y)
        for (int x = data.min.x; x <= data.max.x; ++x) values.push_back(c.value(x, y));
      frame.insert(c.name, Imf::Slice::Make(c.type, values.data(), data, sizeof(float),
                                            sizeof(float) * width));
    }
  }
  Imf::FrameBuffer frame;

 private:
  std::list<std::vector<float>> kept_;
};

using More = std::function<void(Imf::Header&)>;

class ExrPictures : public TestFolder {
 protected:
  std::string file() const { return (folder_ / "sky.exr").string(); }

  void write(const std::vector<Channel>& channels, const More& more = {},
             const Box2i& display = box(0, 0, 8, 4), const Box2i& data = box(0, 0, 8, 4),
             bool tiled = false) const {
    Imf::Header header(display, data);
    header.compression() = Imf::ZIP_COMPRESSION;
    insert(header, channels);
    if (more) more(header);
    const Pixels pixels(data, channels);
    if (tiled) {
      header.setTileDescription(Imf::TileDescription(16, 16, Imf::ONE_LEVEL));
      Imf::TiledOutputFile out(file().c_str(), header);
      out.setFrameBuffer(pixels.frame);
      out.writeTiles(0, out.numXTiles() - 1, 0, out.numYTiles() - 1);
    } else {
      Imf::OutputFile out(file().c_str(), header);
      out.setFrameBuffer(pixels.frame);
      out.writePixels(data.max.y - data.min.y + 1);
    }
  }

  struct Part {
    std::string name, view;
    std::vector<Channel> channels;
  };
  void write_parts(const std::vector<Part>& parts) const {
    std::vector<Imf::Header> headers;
    const Box2i window = box(0, 0, 8, 4);
    for (const Part& part : parts) {
      Imf::Header& header = headers.emplace_back(window, window);
      header.setName(part.name);
      header.setType(Imf::SCANLINEIMAGE);
      if (!part.view.empty()) header.setView(part.view);
      insert(header, part.channels);
    }
    Imf::MultiPartOutputFile out(file().c_str(), headers.data(), static_cast<int>(headers.size()));
    for (std::size_t k = 0; k < parts.size(); ++k) {
      const Pixels pixels(window, parts[k].channels);
      Imf::OutputPart part(out, static_cast<int>(k));
      part.setFrameBuffer(pixels.frame);
      part.writePixels(4);
    }
  }

  std::vector<float> colour() const {
    const FloatImage image = read_image(file()).pixels;
    return {image.row(0), image.row(0) + 3};
  }
  std::string refusal() const {
    return message_of([&] { read_image(file()); });
  }
};

// Windows as programs write them: an auto-crop, a sky without its poles, an overscan, and each
// with an origin of its own, in rows and in tiles.
TEST_F(ExrPictures, LieInTheirDisplayWindowAndAreBlackOutsideOfTheirDataWindow) {
  const auto value = [](int x, int y) { return static_cast<float>(1000 + 40 * y + x); };
  const std::vector<Channel> channels{{"R", value}, {"G", value}, {"B", value}};
  struct Windows {
    Box2i display, data;
  };
  for (const auto& [display, data] : {Windows{box(0, 0, 64, 32), box(16, 8, 32, 16)},
                                      Windows{box(0, 0, 64, 32), box(0, 4, 64, 24)},
                                      Windows{box(0, 0, 64, 32), box(-1, -1, 66, 34)},
                                      Windows{box(0, 0, 64, 32), box(-40, 20, 60, 40)},
                                      Windows{box(-10, 7, 64, 32), box(-12, 9, 20, 20)},
                                      Windows{box(5, -9, 64, 32), box(5, -9, 64, 32)}})
    for (const bool tiled : {false, true}) {
      write(channels, {}, display, data, tiled);
      const FloatImage image = read_image(file()).pixels;
      const LightImage light = read_light_image(file(), PixelEncoding::kOfFile);
      ASSERT_EQ(image.width, 64);
      ASSERT_EQ(image.height, 32);
      ASSERT_EQ(light.pixels.width, 64);
      for (int y = 0; y < 32; ++y)
        for (int x = 0; x < 64; ++x) {
          const V2i at = display.min + V2i(x, y);
          const float wanted = data.intersects(at) ? value(at.x, at.y) : 0;
          ASSERT_EQ(image.row(y)[3 * x + 1], wanted) << x << ", " << y << " tiled " << tiled;
          ASSERT_NEAR(light.pixels.row(y)[3 * x + 1] * light.unit, wanted, 1);
        }
    }
}

TEST_F(ExrPictures, WhoseWindowsCannotBeShownAreRefused) {
  const auto grey = numbered({"Y"});
  write(grey, {}, box(0, 0, 8, 4), box(8, 0, 8, 4));
  EXPECT_THAT(refusal(), HasSubstr("its data window lies wholly outside of its display window"));
  write(grey, {}, box(0, 0, 8, 4), box(-1000000000, -1000000000, 8, 4));
  EXPECT_THAT(refusal(), HasSubstr("outside of its display window"));
  write(grey, {}, box(0, 0, 60000, 30000), box(0, 0, 8, 4));
  EXPECT_THAT(refusal(), HasSubstr("1 to 32768 pixels a side, got 60000 x 30000"));
  write(grey, {}, box(0, 0, 32768, 32768), box(0, 0, 8, 4));
  EXPECT_THAT(refusal(), HasSubstr("more than 32768 x 16384 pixels"));
  write(grey, {}, box(-1000000000, 0, 2000000000, 4), box(0, 0, 8, 4));
  EXPECT_THAT(refusal(), HasSubstr("1 to 32768 pixels a side, got 2000000000 x 4"));
}

TEST_F(ExrPictures, OfSeveralLayersAreTheOneThatIsThePicture) {
  struct Case {
    std::vector<std::string> names;
    std::vector<float> taken;
    std::string layer;
  };
  const Case cases[] = {
      {{"R", "G", "B"}, {1, 2, 3}, ""},
      {{"r", "g", "b"}, {1, 2, 3}, ""},
      {{"red", "green", "blue"}, {1, 2, 3}, ""},
      {{"Y"}, {1, 1, 1}, ""},
      {{"Z", "B", "G", "R", "diffuse.R", "diffuse.G", "diffuse.B"}, {4, 3, 2}, ""},
      {{"AO.R", "AO.G", "AO.B", "rgba.R", "rgba.G", "rgba.B"}, {4, 5, 6}, "rgba"},
      {{"AO.R", "AO.G", "AO.B", "Combined.R", "Combined.G", "Combined.B"}, {4, 5, 6}, "Combined"},
      {{"ViewLayer.AO.R", "ViewLayer.AO.G", "ViewLayer.AO.B", "ViewLayer.Combined.R",
        "ViewLayer.Combined.G", "ViewLayer.Combined.B", "ViewLayer.Depth.Z"},
       {4, 5, 6},
       "ViewLayer.Combined"},
      {{"Composite.Combined.R", "Composite.Combined.G", "Composite.Combined.B",
        "ViewLayer.Combined.R", "ViewLayer.Combined.G", "ViewLayer.Combined.B"},
       {1, 2, 3},
       "Composite.Combined"},
      {{"beauty.R", "beauty.G", "beauty.B", "N.X", "N.Y", "N.Z", "P.X", "P.Y", "P.Z", "Z"},
       {1, 2, 3},
       "beauty"},
      {{"sky.red", "sky.green", "sky.blue", "normals.R", "normals.G", "normals.B", "crypto00.r",
        "crypto00.g", "crypto00.b", "uv.R", "uv.G", "uv.B"},
       {1, 2, 3},
       "sky"},
  };
  for (const Case& c : cases) {
    write(numbered(c.names));
    EXPECT_EQ(colour(), c.taken) << c.layer;
    const std::string taken = picture_taken(file());
    EXPECT_THAT(taken, testing::StartsWith(c.layer.empty() ? "8 x 4" : "layer " + c.layer + ", 8"));
  }
}

TEST_F(ExrPictures, WithoutOneLayerOfColoursAreRefusedWithWhatTheyHave) {
  const auto said = [this](const std::vector<std::string>& names) {
    write(numbered(names));
    return refusal();
  };
  EXPECT_THAT(said({"AO.R", "AO.G", "AO.B", "Diffuse.R", "Diffuse.G", "Diffuse.B"}),
              HasSubstr("several of its layers could be the picture: AO, Diffuse"));
  EXPECT_THAT(said({"A.Combined.R", "A.Combined.G", "A.Combined.B", "B.Combined.R", "B.Combined.G",
                    "B.Combined.B"}),
              HasSubstr("could be the picture: A.Combined, B.Combined"));
  const std::vector<std::string> data[] = {
      {"Z"},
      {"A"},
      {"R"},
      {"R", "G"},
      {"X", "Y", "Z"},
      {"Normal.X", "Normal.Y", "Normal.Z"},
      {"Normal.R", "Normal.G", "Normal.B"},
      {"ViewLayer.Depth.R", "ViewLayer.Depth.G", "ViewLayer.Depth.B"},
      {"motionvector.R", "motionvector.G", "motionvector.B"},
      {"Position.R", "Position.G", "Position.B"},
      {"UV.U", "UV.V", "UV.A"},
      {"worldpos.R", "worldpos.G", "worldpos.B"},
      {"ObjID.R", "ObjID.G", "ObjID.B"},
      {"Debug Sample Count.R", "Debug Sample Count.G", "Debug Sample Count.B"},
      {"CryptoObject00.r", "CryptoObject00.g", "CryptoObject00.b", "CryptoObject00.a"},
      {"depth.Y"}};
  for (const auto& names : data) {
    std::vector<std::string> sorted = names;
    const std::string text = said(names);
    EXPECT_THAT(text, HasSubstr("none of its channels are colours: "));
    for (const std::string& name : names) EXPECT_THAT(text, HasSubstr(name));
  }
  write({constant("R", 1, Imf::UINT), constant("G", 1, Imf::UINT), constant("B", 1, Imf::UINT)});
  EXPECT_THAT(refusal(), HasSubstr("none of its channels are colours: R, G, B"));
  write({constant("R", 1), constant("G", 2), constant("B", 3), constant("id", 1, Imf::UINT)});
  EXPECT_EQ(colour(), (std::vector<float>{1, 2, 3}));
  write(numbered({"\x1b[31mlayer.Q", "S"}));
  EXPECT_THAT(refusal(), HasSubstr("\\x1B[31mlayer.Q"));
}

TEST_F(ExrPictures, OfLuminanceAndChromaAreRefused) {
  write(numbered({"BY", "RY", "Y"}));
  EXPECT_THAT(refusal(), HasSubstr("stored as luminance and chroma (Y, RY, BY)"));
  const Box2i window = box(0, 0, 8, 4);
  Imf::Header header(window, window);
  header.channels().insert("Y", Imf::Channel(Imf::HALF));
  header.channels().insert("RY", Imf::Channel(Imf::HALF, 2, 2));
  header.channels().insert("BY", Imf::Channel(Imf::HALF, 2, 2));
  Imf::OutputFile(file().c_str(), header);
  EXPECT_THAT(refusal(), HasSubstr("stored as luminance and chroma (Y, RY, BY)"));
}

TEST_F(ExrPictures, OfSeveralPartsAreTheOneThatIsThePicture) {
  const auto rgb = [](float from) {
    return std::vector{constant("R", from), constant("G", from + 1), constant("B", from + 2)};
  };
  write_parts({{"depth", "", numbered({"Z"})}, {"rgba", "", rgb(4)}, {"diffuse", "", rgb(7)}});
  EXPECT_EQ(colour(), (std::vector<float>{4, 5, 6}));
  EXPECT_THAT(picture_taken(file()), testing::StartsWith("layer rgba, 8 x 4"));
  write_parts({{"normals", "", rgb(1)}, {"ViewLayer.Combined", "", rgb(4)}, {"AO", "", rgb(7)}});
  EXPECT_EQ(colour(), (std::vector<float>{4, 5, 6}));
  write_parts({{"AO", "", rgb(1)}, {"diffuse", "", rgb(4)}});
  EXPECT_THAT(refusal(), HasSubstr("several of its layers could be the picture: AO, diffuse"));
  // A stereo picture: the first view is taken.
  write_parts({{"rgba.left", "left", rgb(1)}, {"rgba.right", "right", rgb(4)}});
  EXPECT_EQ(colour(), (std::vector<float>{1, 2, 3}));
  EXPECT_THAT(picture_taken(file()), testing::StartsWith("layer rgba, view left, 8 x 4"));
  write(numbered({"R", "G", "B", "right.R", "right.G", "right.B"}), [](Imf::Header& header) {
    Imf::addMultiView(header, {"left", "right"});
  });
  EXPECT_EQ(colour(), (std::vector<float>{1, 2, 3}));
  EXPECT_THAT(picture_taken(file()), testing::StartsWith("view left, 8 x 4"));
}

TEST_F(ExrPictures, OfDeepPixelsAreRefused) {
  const Box2i window = box(0, 0, 8, 4);
  Imf::Header header(window, window);
  header.channels().insert("R", Imf::Channel(Imf::FLOAT));
  header.setType(Imf::DEEPSCANLINE);
  header.compression() = Imf::ZIPS_COMPRESSION;
  std::vector<unsigned> counts(32, 0);
  std::vector<float*> samples(32, nullptr);
  Imf::DeepFrameBuffer frame;
  frame.insertSampleCountSlice(
      Imf::Slice(Imf::UINT, reinterpret_cast<char*>(counts.data()), 4, 32));
  frame.insert("R", Imf::DeepSlice(Imf::FLOAT, reinterpret_cast<char*>(samples.data()),
                                   sizeof(float*), 8 * sizeof(float*), sizeof(float)));
  {
    Imf::DeepScanLineOutputFile out(file().c_str(), header);
    out.setFrameBuffer(frame);
    out.writePixels(4);
  }
  EXPECT_THAT(refusal(), HasSubstr("deep pixels"));
}

TEST_F(ExrPictures, HaveThePrimariesThatTheyState) {
  const auto rgb = numbered({"R", "G", "B"});
  EXPECT_EQ((write(rgb), read_image(file()).xy), kRec709Places);
  EXPECT_EQ(picture_taken(file()), "8 x 4, linear (floats), primaries Rec.709 (none are stated)");
  const auto with = [&](const Imf::Chromaticities& stated) {
    write(rgb, [&](Imf::Header& header) { Imf::addChromaticities(header, stated); });
  };
  using Imath::V2f;
  with({V2f(0.713f, 0.293f), V2f(0.165f, 0.83f), V2f(0.128f, 0.044f), V2f(0.32168f, 0.33767f)});
  constexpr std::array<double, 8> kAces{0.713, 0.293, 0.165, 0.83, 0.128, 0.044, 0.32168, 0.33767};
  EXPECT_EQ(read_image(file()).xy, kAces);
  EXPECT_EQ(read_light_image(file(), PixelEncoding::kOfFile).xy, kAces);
  EXPECT_EQ(picture_taken(file()), "8 x 4, linear (floats), primaries ACEScg (chromaticities)");
  with({V2f(0.64f, 0.33f), V2f(0.3f, 0.6f), V2f(0.15f, 0.06f), V2f(0.3127f, 0.329f)});
  EXPECT_EQ(read_image(file()).xy, kRec709Places);
  with({V2f(0.66f, 0.33f), V2f(0.3f, 0.6f), V2f(0.15f, 0.06f), V2f(0.3127f, 0.329f)});
  EXPECT_FLOAT_EQ(static_cast<float>(read_image(file()).xy[0]), 0.66f);

  const auto named = [&](const char* id) {
    write(rgb,
          [&](Imf::Header& header) { header.insert("colorInteropID", Imf::StringAttribute(id)); });
  };
  EXPECT_EQ((named("lin_ap1_scene"), read_image(file()).xy), kAces);
  EXPECT_EQ((named("unknown"), read_image(file()).xy), kRec709Places);
  EXPECT_THAT((named("srgb_rec709_scene"), refusal()),
              HasSubstr("'srgb_rec709_scene' is not known"));
  EXPECT_THAT((named("data"), refusal()), HasSubstr("it is data and no colours"));

  const float nan = std::numeric_limits<float>::quiet_NaN();
  for (const Imf::Chromaticities& absurd :
       {Imf::Chromaticities(V2f(nan, 0.33f), V2f(0.3f, 0.6f), V2f(0.15f, 0.06f), V2f(0.3f, 0.3f)),
        Imf::Chromaticities(V2f(1e30f, 0.33f), V2f(0.3f, 0.6f), V2f(0.15f, 0.06f), V2f(0.3f, 0.3f)),
        Imf::Chromaticities(V2f(0, 0), V2f(0, 0), V2f(0, 0), V2f(0, 0)),
        Imf::Chromaticities(V2f(0.1f, 0.1f), V2f(0.2f, 0.2f), V2f(0.3f, 0.3f), V2f(0.2f, 0.2f)),
        Imf::Chromaticities(V2f(0.64f, 0.33f), V2f(0.3f, 0.6f), V2f(0.15f, 0.06f), V2f(0.3f, 0)),
        Imf::Chromaticities(V2f(0.64f, 0.33f), V2f(0.3f, 0.6f), V2f(0.15f, 0.06f),
                            V2f(0.7f, 0.7f))}) {
    with(absurd);
    EXPECT_THAT(refusal(), HasSubstr("its primaries (chromaticities) can be those of no picture"));
  }
}

TEST_F(ExrPictures, TellWhatOfThemIsNotUsed) {
  write(numbered({"R", "G", "B"}), [](Imf::Header& header) {
    Imf::addWhiteLuminance(header, 100);
    Imf::addAdoptedNeutral(header, {0.34f, 0.35f});
    header.pixelAspectRatio() = 2;
  });
  const std::string taken = picture_taken(file());
  for (const char* note :
       {"whiteLuminance of 100 cd/m^2 is not used", "adoptedNeutral 0.34, 0.35 is not used",
        "aspect ratio of 2 is not used"})
    EXPECT_THAT(taken, HasSubstr(note));
  write(numbered({"R", "G", "B"}),
        [](Imf::Header& header) { Imf::addEnvmap(header, Imf::ENVMAP_CUBE); });
  EXPECT_THAT(refusal(), HasSubstr("it is a map on the faces of a cube"));
}

// The colours of a transparent pixel are light that is there.
TEST_F(ExrPictures, WithAlphaAreLightOverBlack) {
  write({constant("R", 0.5f), constant("G", 0.25f), constant("B", 2), constant("A", 0.5f)});
  EXPECT_EQ(colour(), (std::vector{0.5f, 0.25f, 2.0f}));
  EXPECT_THAT(picture_taken(file()), HasSubstr("transparent in parts, over black"));
  write({constant("R", 0.5f), constant("G", 0.25f), constant("B", 2), constant("A", 1)});
  EXPECT_THAT(picture_taken(file()), Not(HasSubstr("transparent")));
}

}  // namespace
}  // namespace domefall
