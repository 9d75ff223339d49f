#include "pipeline/show/file/frame_size.h"

#include <gtest/gtest.h>

#include "tests/pipeline/image/test_folder.h"

namespace domefall {
namespace {

TEST(FrameSize, IsByNameOrByPixels) {
  EXPECT_EQ(columns(resized(Domemaster{16}, "4k")), 4096);
  EXPECT_EQ(columns(resized(Domemaster{16}, "1000")), 1000);
  EXPECT_EQ(columns(resized(Domemaster{16}, "")), 16);
  const Projection flat = resized(Stereographic{16, 16, 1.5}, "1920x1080");
  EXPECT_EQ(columns(flat), 1920);
  EXPECT_EQ(rows(flat), 1080);
  const Projection part = Fisheye{4096, 3072, 3.5, 1};
  EXPECT_EQ(rows(resized(part, "1k")), 768);
  EXPECT_EQ(columns(resized(part, "640x100")), 640);
  EXPECT_EQ(rows(resized(part, "640x100")), 100);
  EXPECT_EQ(rows(resized(Equirectangular{16}, "8k")), 4096);
  EXPECT_EQ(columns(resized(Cubemap{16}, "1k")), 3072);
  EXPECT_EQ(field_of_view(resized(Rectilinear{16, 16, 1.5}, "640x480")), 1.5);
  for (const char* text : {"100x101", "15x15", "15", "5k"})
    EXPECT_THROW(resized(part, text), InputError) << text;
  for (const char* text : {"101", "15", "1920x960"})
    EXPECT_THROW(resized(Equirectangular{16}, text), InputError) << text;
  for (const char* text : {"8k", "5462", "15", "300x200"})
    EXPECT_THROW(resized(Cubemap{16}, text), InputError) << text;
  for (const char* text : {"0k", "17k", "15", "16385", "4K", "k", "1920x1080", "-5"})
    EXPECT_THROW(resized(Domemaster{16}, text), InputError) << text;
  for (const char* text : {"4k", "1920", "1920x", "x1080", "1920x8", "1920x1080x3"})
    EXPECT_THROW(resized(Stereographic{16, 16, 1.5}, text), InputError) << text;
}

// A fisheye of wide pixels is higher than wide.
TEST(FrameSize, KeepsTheAspectOfPixels) {
  const Projection fisheye = Fisheye{100, 200, 3, 0.5, 2};
  for (const char* text : {"300", "300x600"}) {
    EXPECT_EQ(columns(resized(fisheye, text)), 300) << text;
    EXPECT_EQ(rows(resized(fisheye, text)), 600) << text;
    EXPECT_EQ(pixel_aspect(resized(fisheye, text)), 2) << text;
  }
  for (const char* text : {"8193", "300x601"})
    EXPECT_THROW(resized(fisheye, text), InputError) << text;
  EXPECT_EQ(pixel_aspect(resized(Rectilinear{16, 16, 1, 0.9}, "720x480")), 0.9);
}

TEST(FrameSize, IsCalledAsItsUserKnowsIt) {
  const auto message = [](const auto&... name) {
    return message_of([&] { (void)resized(Domemaster{16}, "15", name...); });
  };
  EXPECT_TRUE(message().starts_with("--size 15: a dome takes ")) << message();
  EXPECT_TRUE(message("size").starts_with("size 15: a dome takes ")) << message("size");
}

}  // namespace
}  // namespace domefall
