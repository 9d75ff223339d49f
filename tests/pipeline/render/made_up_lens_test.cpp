// A lens with rays in closed form and no symmetry about the line to the hole.  Sky, stars, grid and
// borders are drawn through it as through any other, and held against brute force.
#include <gtest/gtest.h>

#include <optional>

#include "pipeline/light/aberration.h"
#include "pipeline/render/frame_bands.h"
#include "pipeline/render/frame_stars.h"
#include "pipeline/render/stars/star_image_finder.h"
#include "pipeline/sources/colour/blackbody.h"
#include "tests/pipeline/render/scenes.h"

namespace domefall {
namespace {

// The map A takes a direction d to the place A d/|A d|, with the shift g = 1/(1 + b.d).
const M33d kMap = from_columns(V3d(1, 0.1, -0.15), V3d(0.3, 0.8, 0.2), V3d(-0.2, 0.25, 1.3));
const V3d kShift(0.1, 0.25, -0.15);
// No sky is seen within a cone about kAxis, whose section at the distance 1 is an ellipse.
const V3d kAxis = V3d(-0.8, 0.5, 0.3).normalized();
const V3d kLong = kAxis.cross(V3d(0, 0.2, 1)).normalized(), kShort = kAxis.cross(kLong);
constexpr double kHalfLong = 0.6, kHalfShort = 0.25;

double ratio_of(const V3d& d) { return 1 / (1 + kShift.dot(d)); }

// This is negative within the cone.
double off_cone(const V3d& d) {
  const double x = d.dot(kLong) / kHalfLong, y = d.dot(kShort) / kHalfShort, z = d.dot(kAxis);
  return z > 0 ? x * x + y * y - z * z : HUGE_VAL;
}

double angle_to_cone(const V3d& d) {
  const V3d gradient =
      (kLong * (d.dot(kLong) / (kHalfLong * kHalfLong)) +
       kShort * (d.dot(kShort) / (kHalfShort * kHalfShort)) - kAxis * d.dot(kAxis)) *
      2;
  const double off = off_cone(d);
  return off < HUGE_VAL ? std::abs(off) / (gradient - d * gradient.dot(d)).length() : HUGE_VAL;
}

class MadeUpPoints : public SkyPoints {
 public:
  SkyImage image(const V3d& source, int, double) const override {
    const V3d d = apply(kMap.inverse(), source).normalized();
    const double length = apply(kMap, d).length();
    const double seen = off_cone(d) < 0 ? 0 : 1;
    return {{d}, ratio_of(d), seen * length * length * length / std::abs(kMap.determinant())};
  }
  // |A d| is at most 1.5, and the ratio at most 1/(1 - |b|).
  double most_light(int) const override {
    return std::pow(1.5, 3) / std::abs(kMap.determinant()) * std::pow(1 - kShift.length(), -4);
  }
  void images(int order, const PointBatch& points, int count,
              PointImageBatch& images) const override {
    for (std::size_t k = 0; k < static_cast<std::size_t>(count); ++k) {
      const SkyImage at = image({points.x[k], points.y[k], points.z[k]}, order, 0);
      images.x[k] = at.direction.v.x;
      images.y[k] = at.direction.v.y;
      images.z[k] = at.direction.v.z;
      images.frequency_ratio[k] = at.frequency_ratio;
      images.amplification[k] = at.amplification;
    }
  }
};

class MadeUpLens : public Lens {
 public:
  explicit MadeUpLens(const M33d& sky_from_tetrad) : sky_from_tetrad_(sky_from_tetrad) {}

  ViewRay ray(const V3d& d) const override {
    ViewRay ray;
    ray.to_edge = angle_to_cone(d);
    const V3d image = apply(kMap, d), place = image.normalized();
    // The derivative of the place by the direction, along two vectors across d.
    const V3d first = d.cross(std::abs(d.x) < 0.6 ? V3d(1, 0, 0) : V3d(0, 1, 0)).normalized();
    const auto by = [&](const V3d& way) {
      const V3d moved = apply(kMap, way);
      return (moved - place * place.dot(moved)) / image.length();
    };
    // Its singular values and the axes of the ellipse on the sky.
    const V3d second = d.cross(first), u = by(first), v = by(second);
    const double turn = std::atan2(2 * u.dot(v), u.length2() - v.length2()) / 2;
    const V3d longer = u * std::cos(turn) + v * std::sin(turn);
    const V3d shorter = v * std::cos(turn) - u * std::sin(turn);
    ray.known = off_cone(d) > 0;
    ray.sky = ray.known ? SkyRegion::kI : SkyRegion::kIV;
    ray.sky_direction = apply(sky_from_tetrad_, place);
    ray.frequency_ratio = ratio_of(d);
    ray.scale_along = longer.length();
    ray.scale_across = shorter.length();
    ray.axis = first * std::cos(turn) + second * std::sin(turn);
    ray.along = apply(sky_from_tetrad_, longer.normalized());
    ray.mirrored = place.cross(longer).dot(shorter) < 0;
    // No image of the map is on a caustic.
    ray.bundle.patch = SkyPatch{ray.scale_along * ray.scale_across};
    return ray;
  }
  void rays(const DirectionBatch& n, int count, ViewRayBatch& rays) const override {
    for (std::size_t k = 0; k < static_cast<std::size_t>(count); ++k) {
      const ViewRay ray = this->ray({n.x[k], n.y[k], n.z[k]});
      rays.sky[k] = ray.sky;
      rays.sky_x[k] = ray.sky_direction.x;
      rays.sky_y[k] = ray.sky_direction.y;
      rays.sky_z[k] = ray.sky_direction.z;
      rays.along_x[k] = ray.along.x;
      rays.along_y[k] = ray.along.y;
      rays.along_z[k] = ray.along.z;
      rays.frequency_ratio[k] = ray.frequency_ratio;
      rays.scale_along[k] = ray.scale_along;
      rays.scale_across[k] = ray.scale_across;
      rays.to_edge[k] = ray.to_edge;
      rays.emission_time[k] = rays.time_scale[k] = 0;
    }
  }
  std::vector<SkyBorder> borders() const override {
    constexpr int kCorners = 400;
    std::vector<V3d> corners;
    for (int k = 0; k < kCorners; ++k) {
      const double t = 2 * std::numbers::pi * k / kCorners;
      corners.push_back(
          (kAxis + kLong * (kHalfLong * std::cos(t)) + kShort * (kHalfShort * std::sin(t)))
              .normalized());
    }
    return {{corners, false, SkyRegion::kI}};
  }
  std::unique_ptr<const SkyPoints> points(SkyRegion sky,
                                          const std::optional<PointTolerance>&) const override {
    return sky == SkyRegion::kI ? std::make_unique<MadeUpPoints>() : nullptr;
  }
  V3d primary_image(const V3d& source) const override {
    return apply(kMap.inverse(), source).normalized();
  }

 private:
  M33d sky_from_tetrad_;
};

// A show whose observer moves, and its scene through the lens.
struct MadeUpScene {
  explicit MadeUpScene(Show s)
      : show(std::move(s)),
        state(frame_state(show, 0)),
        store(show),
        plan(plan_frame(show, state)),
        lens(std::make_shared<MadeUpLens>(state.observer.sky_from_tetrad)),
        scene(show, state, plan, lens, store.skies_of(plan)) {}

  HalfFrame drawn() const {
    ImageLists lists;
    BlobLayer stars(scene.projection());
    lay_stars(scene, lists, stars);
    stars.sort_into_bands();
    const std::optional<SkyBorders> borders(std::in_place, scene.tracer, scene.projection());
    EXPECT_TRUE(borders->usable());
    RayGrid grid;
    const SkyPass sky(scene, {}, {}, grid);
    BandMemory memory;
    LayeredHalfFrame frame;
    frame.set_size(columns(scene.projection()), rows(scene.projection()));
    draw_bands(scene, sky, {.stars = &stars, .borders = &*borders}, memory, frame);
    return frame.picture;
  }
  // The direction in the tetrad, and the ratio of frequencies there and here.
  AberratedLight in_tetrad(const V3d& n) const {
    return to_tetrad(state.observer.celerity, apply(state.observer.tetrad_from_camera, n));
  }

  Show show;
  FrameState state;
  SkyStore store;
  FramePlan plan;
  std::shared_ptr<const Lens> lens;
  FrameScene scene;
};

constexpr int kSize = 192;
Show moving_show() {
  return show_of(GivenVelocity{Region::kI, Tetrad::kRain, 8, {0.2, -0.3, 0.15}}, Domemaster{kSize});
}

// Pixels are held against the mean of the light of many closed-form rays.  A pixel on a line of a grid
// takes fewer samples than that.
void expect_frame_of_background(const SkyBackground& background, double typical, double worst) {
  Show show = moving_show();
  show.sky[SkyRegion::kI].background = background;
  const MadeUpScene made(show);
  const HalfFrame frame = made.drawn();
  constexpr int kFine = 10;
  double sum = 0, most = 0, light = 0;
  int dark = 0, pixels = 0;
  for (int row = 0; row < kSize; ++row) {
    const ColumnRange inside = inside_columns(made.scene.projection(), row);
    // Pixels of a slice are enough.
    for (int column = inside.first; column <= inside.last; column += row % 3 + 1) {
      double mean = 0;
      int seen = 0;
      for (int k = 0; k < kFine * kFine; ++k) {
        const PixelPosition at{column + 0.5 + (k % kFine + 0.5) / kFine,
                               row + 0.5 + (k / kFine + 0.5) / kFine};
        const AberratedLight in = made.in_tetrad(direction_at(made.scene.projection(), at).v);
        if (off_cone(in.direction) < 0) continue;
        ++seen;
        const double g = ratio_of(in.direction) / in.frequency_ratio;
        mean += luminance(made.scene.background[SkyRegion::kI]->at(
            apply(made.state.observer.sky_from_tetrad, apply(kMap, in.direction).normalized()),
            largest_pixel_angle(made.scene.projection()) / kFine, g));
      }
      mean /= kFine * kFine;
      const Imath::half* p = frame.row(row) + 3 * column;
      const double error = std::abs(luminance({p[0], p[1], p[2]}) - mean);
      sum += error, light += mean, most = std::max(most, error), ++pixels;
      if (seen == 0) {
        EXPECT_EQ(p[1], 0) << column << ", " << row;
        ++dark;
      }
    }
  }
  EXPECT_GT(dark, 100);
  EXPECT_LT(sum, typical * light);
  EXPECT_LT(most, worst * light / pixels);
}

TEST(MadeUpLens, HasRaysWithTheDerivativeThatTheirNeighboursHave) {
  const MadeUpScene made(moving_show());
  std::mt19937 random(5);
  for (int k = 0; k < 300; ++k) {
    const V3d n = random_direction(random);
    expect_derivative_of_neighbours(made.scene.tracer, n, random_direction(random), 1e-6);
    const ViewRay ray = made.scene.tracer.trace({n});
    if (!ray.known) continue;
    EXPECT_NEAR(amplification(ray.bundle, 1e-3) * ray.scale_along * ray.scale_across, 1, 1e-13);
  }
}

TEST(MadeUpLens, ShowsAGridAsBruteForceDoes) { expect_frame_of_background(GridSky{}, 0.01, 3); }

TEST(MadeUpLens, ShowsASkyAsBruteForceDoes) {
  expect_frame_of_background(PanoramaSky{small_panorama()}, 0.02, 0.4);
}

// The forward ray through each image ends on its star, and the light is that of the star times the
// ratio of the small solid angles there and the power of the shift.
TEST(MadeUpLens, ShowsStarsWhereRaysThroughTheirImagesEnd) {
  Show show = moving_show();
  show.sky[SkyRegion::kI].stars = StarField{kTestAssets + "stars_to_9.stars", 6.5};
  const MadeUpScene made(show);
  const StarImageFinder finder(made.scene, SkyRegion::kI);
  std::mt19937 random(3);
  int seen = 0, dark = 0;
  for (int k = 0; k < 300; ++k) {
    const SceneStars one({SceneStar{{random_direction(random)}, 2, 1e-8, 6000, 1e-9}});
    std::vector<StarImage> images, single;
    finder.append(one, 0, 1, images);
    finder.append(one[0], single);
    // Images outside the frame are left out of batches only.
    if (images.empty()) {
      dark += single.empty();
      continue;
    }
    ASSERT_EQ(images.size(), 1u);
    ASSERT_EQ(single.size(), 1u);
    EXPECT_NEAR(images[0].x, single[0].x, 1e-3);
    const PixelPosition pixel{images[0].x + 1.0, images[0].y + 1.0};
    if (!is_inside(made.scene.projection(), pixel)) continue;
    ++seen;
    const ViewRay ray = made.scene.tracer.trace(direction_at(made.scene.projection(), pixel));
    ASSERT_TRUE(ray.known);
    EXPECT_LT((ray.sky_direction - one[0].direction.v).length(), 1e-6);
    const double g = ray.frequency_ratio;
    const double light = luminance(blackbody_colours().per_flux(6000 * g)) * 1e-8 * std::pow(g, 4) /
                         (ray.scale_along * ray.scale_across) * made.scene.exposure;
    const StarImage& image = images[0];
    EXPECT_NEAR(luminance({image.rgb[0], image.rgb[1], image.rgb[2]}) / light, 1, 2e-3);
  }
  EXPECT_GT(seen, 60);
  EXPECT_GT(dark, 5);
}

// Blobs of stars end at the border, a curve that is no circle.
TEST(MadeUpLens, EndsStarsAtItsBorder) {
  Show show = moving_show();
  show.sky[SkyRegion::kI].stars = StarField{kTestAssets + "stars_to_9.stars", 6.5};
  show.point_spread.halo = 0.5;
  show.point_spread.halo_sigma = 1 * kDegree;
  show.exposure.ev = 8;
  const MadeUpScene made(show);
  const HalfFrame frame = made.drawn();
  int lit = 0, dark = 0;
  for (int row = 0; row < kSize; ++row)
    for (int column = 0; column < kSize; ++column) {
      const PixelPosition pixel{column + 1.0, row + 1.0};
      if (!is_inside(made.scene.projection(), pixel)) continue;
      const ViewRay ray = made.scene.tracer.trace(direction_at(made.scene.projection(), pixel));
      if (ray.to_edge < 1.5 * pixel_angle(made.scene.projection(), pixel)) continue;
      const float green = frame.row(row)[3 * column + 1];
      if (!ray.known) {
        ASSERT_EQ(green, 0) << column << " " << row;
        ++dark;
      } else if (ray.to_edge < 0.1) {
        lit += green > 0 ? 1 : 0;
      }
    }
  EXPECT_GT(dark, 100);
  EXPECT_GT(lit, 50);
}

// The line of an overlay runs where rays stop seeing a sky.
TEST(MadeUpLens, HasItsBorderMarked) {
  const MadeUpScene made(moving_show());
  for (const SkyBorder& border : made.scene.tracer.borders())
    for (const V3d& n : std::get<std::vector<V3d>>(border.curve))
      EXPECT_LT(std::abs(off_cone(made.in_tetrad(n).direction)), 1e-12);
}

}  // namespace
}  // namespace domefall
