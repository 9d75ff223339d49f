#include "pipeline/sources/sky/panorama.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "pipeline/base/catmull_rom.h"
#include "pipeline/sources/sky/sky_pyramid.h"

namespace domefall {
namespace {

using std::numbers::pi;

constexpr int kLargestFaceOfImage = 4096;

// Interpolates by cubics in an equirectangular image with its middle at +x, its left quarter at +y
// and its top at +z.  A row beyond a pole is the row on the other side of the pole, turned by half
// the image's width.
template <class T>
std::array<double, 3> equirectangular_at(const ImageRgb<T>& image, const V3d& d) {
  const int w = image.width, h = image.height;
  // x and y count pixels from the centre of the first one, at the left and the top.
  const double x = (0.5 - std::atan2(d.y, d.x) / (2 * pi)) * w - 0.5;
  const double y = (0.5 - std::atan2(d.z, std::hypot(d.x, d.y)) / pi) * h - 0.5;
  const double x0 = std::floor(x), y0 = std::floor(y);
  const auto wx = catmull_rom(x - x0), wy = catmull_rom(y - y0);
  std::array<double, 3> sum{};
  for (int j = 0; j < 4; ++j) {
    // The cubic reaches two rows beyond a pole, which an image of two rows still has.
    int row = static_cast<int>(y0) - 1 + j, turn = 0;
    if (row < 0 || row >= h) {
      row = row < 0 ? -1 - row : 2 * h - 1 - row;
      turn = w / 2;
    }
    const T* line = image.row(row);
    for (int i = 0; i < 4; ++i) {
      const int column = (static_cast<int>(x0) - 1 + i + turn + 2 * w) % w;
      const T* texel = line + 3 * column;
      for (int c = 0; c < 3; ++c) sum[c] += wx[i] * wy[j] * static_cast<float>(texel[c]);
    }
  }
  for (double& c : sum) c = std::max(c, 0.0);  // a cubic undershoots beside a bright star
  return sum;
}

// Returns the greatest value of any channel in the working space.  Cubic interpolation exceeds it
// by a factor below 1.6, for which sky_unit() leaves room.  The negative weights sum to -t (1 -
// t)/2 >= -1/8, and all weights sum to 1.  Their absolute values therefore sum to at most 5/4 along
// each axis, and (5/4)^2 < 1.6.
template <class T>
double greatest_working(const ImageRgb<T>& image, const ColourMatrix& m) {
  double greatest = 0;
  for (std::size_t k = 0; k < image.pixels.size(); k += 3) {
    const float r = image.pixels[k], g = image.pixels[k + 1], b = image.pixels[k + 2];
    for (int c = 0; c < 3; ++c)
      greatest = std::max(greatest, m[c][0] * r + m[c][1] * g + m[c][2] * b);
  }
  return greatest;
}

// Paints a level from an image.  `scale` is the light of the value 1 in units of the map.
template <class T>
void paint_image(const ImageRgb<T>& image, const ColourMatrix& m, const M33d& to_panorama,
                 double scale, const SkyPyramid::Level& level) {
  // A texel of the face that panorama_face() asks for is half a pixel wide.  A wider texel gets as
  // many samples along its side as it covers pixels.
  const int across = std::max(panorama_face(image.width) / 2 / level.size, 1);
  const auto painter = [&image, &to_panorama, &m, scale](const V3d& d, float* channel) {
    const auto c = equirectangular_at(image, apply(to_panorama, d));
    for (int k = 0; k < 3; ++k)
      channel[k] = static_cast<float>(
          scale * std::max(m[k][0] * c[0] + m[k][1] * c[1] + m[k][2] * c[2], 0.0));
  };
  paint(level, painter, across);
}

FloatImage shrunk(const FloatImage& image, int by) {
  FloatImage small(image.width / by, image.height / by);
  const float part = 1.0f / static_cast<float>(by * by);
  for (int y = 0; y < image.height; ++y) {
    const float* from = image.row(y);
    float* to = small.row(y / by);
    for (int x = 0; x < image.width; ++x)
      for (int c = 0; c < 3; ++c) to[3 * (x / by) + c] += part * from[3 * x + c];
  }
  return small;
}

}  // namespace

int panorama_face(int width) {
  int size = 4;
  while (size < width / 2) size *= 2;
  return std::min(size, kLargestFaceOfImage);
}

double panorama_unit(const LightImage& image, double luminance) {
  return sky_unit(luminance * image.unit *
                  greatest_working(image.pixels, working_from_rgb(image.xy)));
}

void paint_panorama(const LightImage& image, const Orientation& orientation, double luminance,
                    const SkyPyramid& pyramid) {
  paint_image(image.pixels, working_from_rgb(image.xy), panorama_from_equatorial(orientation),
              luminance * image.unit / pyramid.unit, pyramid.levels[0]);
}

SkyMap map_of_panorama(const FloatImage& image, int largest_face, const ColourMatrix& to_working) {
  int by = 1;
  // The image is halved only as long as its sides stay whole, which shrunk() needs.
  while (panorama_face(image.width / by) > largest_face && image.height % (2 * by) == 0) by *= 2;
  if (by > 1) return map_of_panorama(shrunk(image, by), kLargestFace, to_working);
  const double unit = sky_unit(kPanoramaUnit * greatest_working(image, to_working));
  const SkyPyramid pyramid(SkyMapKind::kColour, unit, panorama_face(image.width));
  paint_image(image, to_working, M33d(), kPanoramaUnit / unit, pyramid.levels[0]);
  pyramid.finish();
  return pyramid.map();
}

}  // namespace domefall
