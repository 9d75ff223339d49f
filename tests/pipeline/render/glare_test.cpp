#include "pipeline/render/glare.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <boost/math/special_functions/legendre.hpp>
#include <cmath>
#include <numbers>
#include <random>

#include "pipeline/render/sphere_blur.h"
#include "trajectories/degree.h"

namespace domefall {
namespace {

using std::numbers::pi;

std::vector<double> gaussian_kernel(double sigma, int orders) {
  std::vector<double> kernel;
  for (int l = 0; l < orders; ++l) kernel.push_back(std::exp(-l * (l + 1) * sigma * sigma / 2));
  return kernel;
}

// The blur of a point by its series in Legendre polynomials of the angle from it.
double blurred_point(std::span<const double> kernel, double angle) {
  double sum = 0;
  for (int l = 0; l < static_cast<int>(kernel.size()); ++l)
    sum += (2 * l + 1) / (4 * pi) * kernel[static_cast<std::size_t>(l)] *
           boost::math::legendre_p(l, std::cos(angle));
  return sum;
}

TEST(SphereBlur, SpreadsPointsAlikeEverywhere) {
  const double sigma = 4 * kDegree;
  std::mt19937 random(3);
  for (int k = 0; k < 12; ++k) {
    SphereBlur blur(sigma);
    const auto kernel = gaussian_kernel(sigma, blur.orders());
    // Points of the grid themselves, next to the poles too, of which adding makes none wider.
    const auto on_grid = [&](int row) {
      return SphereBlur::Place{row, static_cast<int>(random() % 100), 0, 0};
    };
    const auto direction = [&](const SphereBlur::Place& place) {
      const double step = std::sqrt(3 * blur.own_variance());
      const double theta = (place.row + 0.5) * step, phi = place.column * step - pi;
      return V3d(std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi), std::cos(theta));
    };
    const SphereBlur::Place source = on_grid(k < 3 ? k : static_cast<int>(random() % 80));
    blur.add(source, {1, 2, 0});
    blur.blur(kernel);
    const double peak = blurred_point(kernel, 0);
    for (int n = 0; n < 40; ++n) {
      const SphereBlur::Place seen = on_grid(n < 3 ? n : static_cast<int>(random() % 80));
      const V3d a = direction(source), b = direction(seen);
      const double angle = std::atan2(a.cross(b).length(), a.dot(b));
      const SphereBlur::Rgb found = blur.at(seen);
      EXPECT_NEAR(found[0] / peak, blurred_point(kernel, angle) / peak, 1e-5);
      EXPECT_NEAR(found[1], 2 * found[0], 1e-5 * peak);
      EXPECT_NEAR(found[2], 0, 1e-6 * peak);
    }
  }
}

// A bright cap of five degrees, 40 degrees from Z, which is the zenith of some and the front of others.
LayeredFloatFrame frame_with_cap(const Projection& projection) {
  LayeredFloatFrame frame;
  frame.set_size(columns(projection), rows(projection));
  for (int row = 0; row < frame.picture.height; ++row) {
    const ColumnRange inside = inside_columns(projection, row);
    for (int column = inside.first; column <= inside.last; ++column) {
      const V3d n = direction_at(projection, {column + 1.0, row + 1.0}).v;
      const double off = std::acos(
          std::clamp(n.dot(V3d(std::sin(40 * kDegree), 0, std::cos(40 * kDegree))), -1.0, 1.0));
      // The rim is as soft as a coarse pixel, so that all sizes have the same light.
      const double light = 50 / (1 + std::exp((off - 5 * kDegree) / (0.5 * kDegree)));
      float* pixel = frame.picture.row(row) + 3 * column;
      pixel[0] = static_cast<float>(light), pixel[1] = static_cast<float>(light / 2);
    }
  }
  return frame;
}

double light_of(const LayeredFloatFrame& frame, const Projection& projection) {
  double sum = 0;
  for (int row = 0; row < frame.picture.height; ++row)
    for (int column = 0; column < frame.picture.width; ++column)
      sum += pixel_solid_angle(projection, {column + 1.0, row + 1.0}) *
             static_cast<double>(frame.picture.row(row)[3 * column]);
  return sum;
}

TEST(Glare, KeepsAllLightOfAWholeSphere) {
  const Projection projection = with_width(Projection(Equirectangular{}), 1024);
  LayeredFloatFrame frame = frame_with_cap(projection);
  const double before = light_of(frame, projection);
  add_glare(Glare{0.3, 0.5 * kDegree}, projection, frame);
  EXPECT_NEAR(light_of(frame, projection) / before, 1, 1e-4);
}

float red_at(const LayeredFloatFrame& frame, const Projection& projection, const V3d& n) {
  const PixelPosition at = *pixel_of(projection, CameraDirection{n});
  return frame.picture.row(static_cast<int>(std::lround(at.j)) -
                           1)[3 * (static_cast<int>(std::lround(at.i)) - 1)];
}

// The law is one of angles.
TEST(Glare, LooksTheSameAtAllSizesAndInAllProjections) {
  const Glare glare{0.2, 0.5 * kDegree};
  const Projection large = with_width(Projection(Domemaster{}), 2048);
  LayeredFloatFrame best = frame_with_cap(large);
  add_glare(glare, large, best);
  for (const Projection& usual : kUsualProjections) {
    for (const int width : {512, 1536}) {
      const Projection projection = with_width(usual, width);
      LayeredFloatFrame frame = frame_with_cap(projection);
      add_glare(glare, projection, frame);
      for (const double off : {10.0, 15.0, 30.0, 60.0})
        for (const double turn : {0.5, 2.0, 4.0}) {
          const V3d z(std::sin(40 * kDegree), 0, std::cos(40 * kDegree)), x(z.z, 0, -z.x),
              y(0, 1, 0);
          const V3d n = std::cos(off * kDegree) * z +
                        std::sin(off * kDegree) * (std::cos(turn) * x + std::sin(turn) * y);
          if (n.z < 0.2) continue;  // beyond the dome's edge, or that of a flat picture
          const auto at = pixel_of(projection, CameraDirection{n});
          if (!at || at->i < 1 || at->j < 1 || at->i > columns(projection) ||
              at->j > rows(projection) || !is_inside(projection, *at))
            continue;
          const float expected = red_at(best, large, n);
          EXPECT_NEAR(red_at(frame, projection, n) / expected, 1, width < 1000 ? 0.08 : 0.03)
              << projection_name(projection) << ' ' << width << ' ' << off << ' ' << turn;
        }
    }
  }
}

// At this size the narrowest Gaussian is that of 0.85 pixels.  What is scattered falls all the way, and
// beyond that Gaussian as the law does.  Of so few pixels the sum is right to 1e-3.
TEST(Glare, OfAPointHasNoRingsInASmallFrame) {
  constexpr int kOrders = 160;
  const double share = 0.3, sigma = 0.5 * kDegree;
  const Projection projection = with_width(Projection(Equirectangular{}), 192);
  const double least = 0.85 * largest_pixel_angle(projection);
  std::vector<double> kernel(kOrders);
  for (const GlareGaussian& part : kGlareGaussians) {
    const auto own = gaussian_kernel(std::max(part.width * sigma, least), kOrders);
    for (std::size_t l = 0; l < kernel.size(); ++l) kernel[l] += part.share * own[l];
  }
  for (const auto& [row, column] : {std::pair{48, 30}, std::pair{30, 190}, std::pair{4, 100}}) {
    LayeredFloatFrame frame({Layer::kGlare});
    frame.set_size(192, 96);
    frame.picture.row(row)[3 * column] = 1000;
    const double before = light_of(frame, projection);
    add_glare(Glare{share, sigma}, projection, frame);
    EXPECT_NEAR(light_of(frame, projection) / before, 1, 1e-3) << row;
    const ImageRgb<float>& glare = frame.layers[0].light;
    for (const float light : glare.pixels) EXPECT_GE(light, 0);
    const V3d bright = direction_at(projection, {column + 1.0, row + 1.0}).v;
    const double peak = share * before * blurred_point(kernel, 0);
    for (const auto& [down, on] : {std::pair{0, 1}, {0, -1}, {1, 0}, {-1, 0}}) {
      double nearer = HUGE_VAL;
      for (int k = 0; k < 96; ++k) {
        const int y = row + k * down, x = (column + k * on + 192) % 192;
        if (y < 0 || y >= 96) break;
        const V3d n = direction_at(projection, {x + 1.0, y + 1.0}).v;
        const double angle = std::atan2(n.cross(bright).length(), n.dot(bright)),
                     found = glare.row(y)[3 * x];
        EXPECT_LT(found, nearer + 1e-4 * peak) << row << ' ' << angle / kDegree;
        nearer = found;
        if (angle < 5 * least) continue;
        EXPECT_NEAR(found, share * before * blurred_point(kernel, angle), 1e-3 * peak)
            << row << ' ' << angle / kDegree;
      }
    }
  }
}

TEST(Glare, GivesItsLayerWhatTheOthersLose) {
  const Projection projection = with_width(Projection(Domemaster{}), 256);
  const LayeredFloatFrame cap = frame_with_cap(projection);
  LayeredFloatFrame frame({Layer::kDisc, Layer::kBodies, Layer::kGlare});
  frame.set_size(256, 256);
  frame.picture = cap.picture;
  frame.layers[0].light = cap.picture;  // no bodies are drawn
  add_glare(Glare{0.25, 0.5 * kDegree}, projection, frame);
  EXPECT_TRUE(frame.layers[1].light.pixels.empty());
  for (std::size_t k = 0; k < cap.picture.pixels.size(); ++k) {
    EXPECT_FLOAT_EQ(frame.layers[0].light.pixels[k], 0.75f * cap.picture.pixels[k]);
    EXPECT_FLOAT_EQ(frame.layers[0].light.pixels[k] + frame.layers[2].light.pixels[k],
                    frame.picture.pixels[k]);
  }
}

}  // namespace
}  // namespace domefall
