// Frames in every projection against Domemasters, upwards and downwards, of the same instant.
#include <gtest/gtest.h>

#include <set>

#include "pipeline/render/frame_key.h"
#include "pipeline/render/renderer.h"
#include "tests/pipeline/render/scenes.h"

namespace domefall {
namespace {

using std::numbers::pi;

constexpr int kDome = 256;

// Both half spheres about an observer, as Domemasters.
class WholeSphere {
 public:
  WholeSphere(Renderer& renderer, FrameState state, int size) : dome_(Domemaster{size}) {
    state.projection = dome_;
    renderer.render(state, up_);
    const M33d axes = state.observer.tetrad_from_camera;
    state.observer.tetrad_from_camera =
        from_columns(column(axes, 0), -column(axes, 1), -column(axes, 2));
    renderer.render(state, down_);
  }

  // The mean over the square of a pixel of another frame, by the cubic through 4 by 4 pixels for
  // each of many points; nothing beside the rim.
  std::optional<float> at(const CameraDirection& n, int channel) const {
    const bool upper = n.v.z >= 0;
    const auto pixel = pixel_of(dome_, upper ? n : CameraDirection{{n.v.x, -n.v.y, -n.v.z}});
    const FloatImage& image = upper ? up_ : down_;
    const double x = pixel->i - 1, y = pixel->j - 1;
    const int i = static_cast<int>(std::floor(x)), j = static_cast<int>(std::floor(y));
    double sum = 0;
    for (int dy = -1; dy <= 2; ++dy)
      for (int dx = -1; dx <= 2; ++dx) {
        if (!is_inside(dome_, {i + dx + 1.0, j + dy + 1.0})) return std::nullopt;
        sum += cubic(x - i - dx) * cubic(y - j - dy) *
               static_cast<double>(image.row(j + dy)[3 * (i + dx) + channel]);
      }
    return static_cast<float>(sum);
  }

 private:
  // Catmull and Rom's.
  static double cubic(double x) {
    const double t = std::abs(x);
    return t < 1 ? 1 + t * t * (1.5 * t - 2.5) : t < 2 ? 2 + t * (-4 + t * (2.5 - 0.5 * t)) : 0;
  }

  Projection dome_;
  FloatImage up_, down_;
};

// With a sky, and stars wide enough to be interpolated.
Show show_for(const Projection& p) {
  Show show = starry(show_of(StaticObserver{12}, Domemaster{kDome}));
  show.sky[SkyRegion::kI].stars->max_magnitude = 4;
  // A law's widths are parts of a flat image's.
  const double sigma = 2.2 * kDegree * (has_zenith(p) ? 1 : pi / *field_of_view(p));
  show.point_spread.min_sigma = show.point_spread.max_sigma = sigma;
  return show;
}

// The part of the pixels that differ by more than a twentieth, and the mean difference.
struct Compared {
  double different = 0, mean = 0;
};

Compared compare_with_sphere(const WholeSphere& sphere, const FloatImage& image,
                             const Projection& p) {
  Compared found;
  int count = 0;
  for (int row = 0; row < rows(p); ++row) {
    const ColumnRange in = inside_columns(p, row);
    for (int i = 0; i < columns(p); ++i) {
      const double value = image.row(row)[3 * static_cast<std::ptrdiff_t>(i) + 1];
      if (i < in.first || i > in.last) {
        EXPECT_EQ(value, 0) << projection_name(p);
        continue;
      }
      const auto expected = sphere.at(direction_at(p, {i + 1.0, row + 1.0}), 1);
      if (!expected) continue;
      const double error = std::abs(value - *expected) / (0.05 + value);
      found.different += error > 0.05 ? 1 : 0;
      found.mean += error;
      ++count;
    }
  }
  EXPECT_GT(count, rows(p) * columns(p) / 2) << projection_name(p);
  found.different /= count;
  found.mean /= count;
  return found;
}

TEST(FramesInEveryProjection, HaveKeysOfTheirOwn) {
  const std::vector<Projection> all{Domemaster{256},
                                    Fisheye{256, 256, pi, 0},
                                    Fisheye{256, 256, 1.1 * pi, 0},
                                    Fisheye{256, 192, pi, 0},
                                    Fisheye{256, 192, pi, 1},
                                    Equirectangular{256},
                                    Cubemap{64},
                                    Rectilinear{256, 256, 1.5},
                                    Rectilinear{256, 256, 1.6},
                                    Cubemap{65},
                                    Stereographic{256, 256, 1.5},
                                    Equirectangular{258}};
  std::set<std::string> keys;
  for (const Projection& p : all) {
    const Show show = show_for(p);
    FrameState state = frame_state(show, 0);
    state.projection = p;
    keys.insert(FrameKeys(show, "").scene(state));
  }
  EXPECT_EQ(keys.size(), all.size());
}

// An edge of a sky is not interpolated, and pixels of other shapes blur an Einstein ring otherwise.
TEST(FramesInEveryProjection, AreThoseOfDomes) {
  for (const Projection& p :
       {Projection(Equirectangular{256}), Projection(Cubemap{64}),
        Projection(Fisheye{160, 160, 220 * kDegree, 0}),
        Projection(Fisheye{160, 120, 240 * kDegree, 1}), Projection(Fisheye{200, 200, 2 * pi, 0}),
        Projection(Rectilinear{120, 90, 100 * kDegree})}) {
    const Show show = show_for(Domemaster{kDome}), own = show_for(p);
    FrameState state = frame_state(show, 0);
    Renderer renderer(show, 2);
    const WholeSphere sphere(renderer, state, kDome);
    state.projection = p;
    FloatImage image;
    Renderer(own, 2).render(state, image);
    const Compared found = compare_with_sphere(sphere, image, p);
    EXPECT_LT(found.mean, 0.01) << projection_name(p);
    EXPECT_LT(found.different, 0.03) << projection_name(p);
  }
}

}  // namespace
}  // namespace domefall
