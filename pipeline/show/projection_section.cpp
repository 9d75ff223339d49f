#include "pipeline/show/projection_section.h"

#include <fmt/format.h>

#include <algorithm>

#include "pipeline/show/lookup.h"
#include "pipeline/show/nearest_word.h"

namespace domefall {
namespace {

// These are the defaults of fov_deg, which a camera section may replace (read_show_camera).
constexpr double kFlatFovDeg = 90, kDomeFovDeg = 180;
// A flat image without distortion stretches its edges beyond use long before 180 degrees.
constexpr double kWidestRectilinearDeg = 170;
// frame_size.cpp has the same bounds for --size.
constexpr int kFewestPixels = 16, kMostPixels = 16384;
constexpr Range kPixels = Range{"pixels"}.within(kFewestPixels, kMostPixels);
constexpr std::array<std::string_view, 4> kSizeNames{"1k", "2k", "4k", "8k"};

enum class ProjectionKind {
  kDomemaster,
  kFisheye,
  kEquirectangular,
  kCubemap,
  kStereographic,
  kRectilinear
};

// Reads 1k, 2k, 4k, 8k or a number of pixels, at most `most`.  `why` tells why it is one number.
int read_one_size(const Item* size, int fallback, int most, std::string_view why) {
  if (!size) return fallback;
  if (!size->node.IsScalar()) {
    size->fail(fmt::format("must be 1k, 2k, 4k, 8k or a number of pixels ({}), got {}", why,
                           kind_of(*size)));
    return fallback;
  }
  const Range range = kPixels.at_most(most);
  for (std::size_t k = 0; k < kSizeNames.size(); ++k)
    if (size->node.Scalar() == kSizeNames[k]) {
      // The names double from 1024 pixels on.
      const int pixels = 1024 << k;
      if (pixels > most)
        size->fail(
            fmt::format("must be at most {} (pixels; {}), got {}", most, why, kSizeNames[k]));
      return pixels;
    }
  // For a word, and for '3k', the message names the sizes.  For a number it names the bounds.  A
  // sign and a point are let through, so that -5 and 0.5 are told the bounds.
  if (size->node.Scalar().find_first_not_of("+-.0123456789") == std::string::npos)
    return read_whole_number(*size, range).value_or(fallback);
  size->fail(fmt::format("must be 1k, 2k, 4k, 8k or a number of pixels from {} to {}, got '{}'{}",
                         kFewestPixels, most, shown(size->node.Scalar()),
                         did_you_mean(size->node.Scalar(), kSizeNames)));
  return fallback;
}

struct ImageSides {
  int width, height;
};

// Reads [width, height].  A side in error leaves the one that is given as its fallback.
ImageSides read_sides(const Item& size, ImageSides sides) {
  const std::vector<Item> items = *read_list(size);
  sides.width = read_whole_number(items[0], kPixels).value_or(sides.width);
  sides.height = read_whole_number(items[1], kPixels).value_or(sides.height);
  return sides;
}

// Reads the size of a flat image, which is a list of width and height.
ImageSides read_flat_size(const Item* size) {
  // The default is the picture of an HD screen.
  const ImageSides sides{1920, 1080};
  if (!size) return sides;
  if (size->node.IsSequence() && size->node.size() == 2) return read_sides(*size, sides);
  size->fail("must be [width, height] in pixels (this projection is flat), got " + kind_of(*size));
  return sides;
}

// Reads the size of a fisheye, which is a square, or lower where a part of it is cut off.
ImageSides read_fisheye_size(const Item* size) {
  if (!size || !size->node.IsSequence() || size->node.size() != 2) {
    const int side =
        read_one_size(size, 4096, kMostPixels, "of a square, or [width, height] of a part of it");
    return {side, side};
  }
  const ImageSides sides = read_sides(*size, {4096, 4096});
  if (sides.height <= sides.width) return sides;
  size->fail("must be at most as high as wide (the circle of a fisheye touches both sides), got " +
             fmt::format("[{}, {}]", sides.width, sides.height));
  return {sides.width, sides.width};
}

// Reads a fisheye.  The key `cut` says where the rows that a lower image lacks are cut off.
Projection read_fisheye(const Item* size, const Section& camera) {
  const ImageSides sides = read_fisheye_size(size);
  // This part of the missing rows is cut off at the back of the dome, and the rest at the front.
  const auto cut_back = camera.word<double>("cut", {{"back", 1.0}, {"front", 0.0}, {"both", 0.5}});
  if (const Item* cut = camera.find("cut"); cut && sides.height == sides.width)
    cut->fail("is for a size of [width, height] that is lower than wide; this one is a square");
  return Fisheye{sides.width, sides.height, radians(kDomeFovDeg), cut_back.value_or(1)};
}

// Reads a whole sphere, whose width is even since it is half as high as wide.
Projection read_equirectangular(const Item* size) {
  const int width =
      read_one_size(size, 4096, kMostPixels, "the width; a whole sphere is half as high as wide");
  if (size && width % 2 != 0)
    size->fail(fmt::format("must be even (a whole sphere is half as high as wide), got {}", width));
  // An odd width has been reported, and the rest of the show is checked with an even one.
  return Equirectangular{width + width % 2};
}

}  // namespace

Projection read_projection(const Section& show, const Section& camera) {
  using enum ProjectionKind;
  const Item* size = show.find("size");
  // The projection comes before the size, since it decides which form that has.
  const ProjectionKind kind =
      camera
          .word<ProjectionKind>("projection", {{Domemaster::kName, kDomemaster},
                                               {Fisheye::kName, kFisheye},
                                               {Equirectangular::kName, kEquirectangular},
                                               {Cubemap::kName, kCubemap},
                                               {Stereographic::kName, kStereographic},
                                               {Rectilinear::kName, kRectilinear}})
          .value_or(kDomemaster);
  if (const Item* cut = camera.find("cut"); cut && kind != kFisheye)
    cut->fail("goes with the fisheye projection only");
  switch (kind) {
    case kDomemaster:
      break;
    case kFisheye:
      return read_fisheye(size, camera);
    case kEquirectangular:
      return read_equirectangular(size);
    case kCubemap:
      return Cubemap{read_one_size(size, 1024, kMostPixels / 3,
                                   "the edge of a face, of which three make the width")};
    case kStereographic: {
      const ImageSides sides = read_flat_size(size);
      return Stereographic{sides.width, sides.height, radians(kFlatFovDeg)};
    }
    case kRectilinear: {
      const ImageSides sides = read_flat_size(size);
      return Rectilinear{sides.width, sides.height, radians(kFlatFovDeg)};
    }
  }
  return Domemaster{read_one_size(size, 4096, kMostPixels, "a domemaster is square")};
}

std::optional<Range> fov_range(const Projection& projection) {
  // The radius of a stereographic image goes as tan(fov/4), which is infinite at 360 degrees.  That
  // of a fisheye goes as the angle, so that a fisheye can show the whole sphere.
  const Range range = kDegrees.above(0);
  if (std::holds_alternative<Stereographic>(projection)) return range.below(360);
  if (std::holds_alternative<Rectilinear>(projection)) return range.at_most(kWidestRectilinearDeg);
  if (std::holds_alternative<Fisheye>(projection)) return range.at_most(360);
  // All other projections show the same part of the sphere at any size.
  return std::nullopt;
}

}  // namespace domefall
