#include "pipeline/render/sky/ray_grid.h"

#include <gtest/gtest.h>

#include <utility>

#include "pipeline/render/sky/sky_pass.h"
#include "pipeline/sources/sky/panorama.h"
#include "tests/pipeline/render/scenes.h"
#include "tests/sanitized.h"
#include "trajectories/equatorial.h"

namespace domefall {
namespace {

FloatImage clouds() {
  FloatImage image(256, 128);
  for (std::size_t k = 0; k < image.pixels.size(); ++k)
    image.pixels[k] = static_cast<float>(1.1 + std::sin(static_cast<double>(k) * 0.05) *
                                                   std::cos(static_cast<double>(k) * 7e-4));
  return image;
}

struct GridScene {
  Show show;
  FrameState state;
  Sky sky;
  FrameScene scene;
  PixelShader shader;
  RayGrid grid;

  explicit GridScene(const Show& shown) : GridScene(shown, frame_state(shown, 0)) {}
  GridScene(Show shown, FrameState at)
      : show(std::move(shown)),
        state(std::move(at)),
        sky{std::make_shared<const SkyMap>(map_of_panorama(clouds())), nullptr, {}},
        scene(scene_with(show, state, {&sky, &sky, nullptr, &sky})),
        shader(scene) {
    grid.make(shader, special_directions(scene));
  }
};

// The error, in radians, of a direction whose components are floats: a thousandth of a texel of a
// map 16k wide.
constexpr double kGridRounding = 3e-7;

struct Worst {
  double direction = 0, gain = 0;  // pixels, relative
  std::size_t pixels = 0;
};

// Traces every pixel of the cells that are interpolated, three rows of pixels in eight.
Worst worst_of(const GridScene& g) {
  Worst worst;
  SampleBatch batch;
  for (int j = 0; j < g.grid.cell_rows(); ++j)
    for (int row = 0; row < RayGrid::kStep; row += 3) {
      const int y = j * RayGrid::kStep + row;
      if (y >= rows(g.state.projection)) continue;
      const ColumnRange inside = inside_columns(g.state.projection, y);
      for (int i = 0; i < g.grid.cell_columns(); ++i) {
        if (g.grid.cell(j, i).kind != RayGrid::Kind::kSmooth) continue;
        g.grid.interpolate_row(j, row, i, i + 1, batch);
        for (std::size_t k = 0; k < RayGrid::kStep; ++k) {
          const int x = i * RayGrid::kStep + static_cast<int>(k);
          if (x < inside.first || x > inside.last) continue;
          const PixelPosition pixel{x + 1.0, y + 1.0};
          const ViewRay ray = g.scene.tracer.trace(direction_at(g.state.projection, pixel));
          const double width =
              pixel_angle(g.state.projection, pixel) * std::max(ray.shorter(), 0.1 * ray.longer());
          V3d interpolated(batch.x[k], batch.y[k], batch.z[k]);
          EXPECT_NEAR(interpolated.length(), 1, 0.01);
          interpolated.normalize();
          EXPECT_EQ(ray.sky, g.grid.cell(j, i).sky);
          const double error = (interpolated - ray.sky_direction).length() - kGridRounding;
          worst.direction = std::max(worst.direction, error / width);
          const LightShift shift = g.scene.background[ray.sky]->shift(ray.frequency_ratio);
          if (shift.gain > 1e-9f)
            worst.gain =
                std::max(worst.gain, std::abs(double{batch.gain[k]} / double{shift.gain} - 1));
          ++worst.pixels;
        }
      }
    }
  return worst;
}

void expect_close(const GridScene& g, const std::string& what, double least_part = 0) {
  const Worst worst = worst_of(g);
  EXPECT_LT(worst.direction, RayGrid::kTolerance) << what;
  EXPECT_LT(worst.gain, 2e-3) << what;
  EXPECT_GE(1 - g.grid.traced_fraction(), least_part) << what;
  EXPECT_GT(worst.pixels + (least_part > 0 ? 0u : 1u), 0u) << what;
}

void expect_close(const Show& show, const std::string& what, double least_part = 0) {
  expect_close(GridScene(show), what, least_part);
}

const std::vector<Projection>& projections() {
  static const std::vector<Projection> all{
      Domemaster{tries(512, 256)}, Domemaster{tries(1500, 400)},
      Stereographic{tries(640, 320), tries(360, 180), 2.0},
      Stereographic{tries(700, 350), tries(700, 350), 300 * kDegree}};
  return all;
}

TEST(RayGrid, IsRightToAHundredthOfAPixelOutsideTheHole) {
  for (const double r : {2.0001, 2.5, 3.0, 7.0, 30.0, 1e4, 1e8})
    for (const Projection& p : projections())
      expect_close(show_of(StaticObserver{r}, p), "r = " + std::to_string(r));
}

TEST(RayGrid, IsRightToAHundredthOfAPixelOnTheWayIn) {
  for (const double r : {30.0, 6.0, 2.1, 2.0, 1.9, 1.0, 0.1, 1e-3})
    for (const Projection& p : projections())
      expect_close(show_of(RadialInfall{r}, p), "r = " + std::to_string(r));
}

TEST(RayGrid, IsRightToAHundredthOfAPixelAtAnySpeed) {
  for (const double celerity : {0.1, 1.0, 3.1, 30.0, 1e3, 1e6})
    for (const double r : {kFlatSpace, 10.0, 1.0})
      for (const Projection& p : projections()) {
        const Celerity<ReferenceTetrad> along(V3d(0.3, 1, -0.5).normalized() * celerity);
        expect_close(
            show_of(GivenVelocity{r < 2 ? Region::kII : Region::kI, Tetrad::kRain, r, along}, p),
            "u = " + std::to_string(celerity) + ", r = " + std::to_string(r));
      }
}

TEST(RayGrid, IsRightToAHundredthOfAPixelBeyondTheHorizonsOfACharge) {
  constexpr Tetrad kOut = Tetrad::kOutgoing;
  const Celerity<ReferenceTetrad> fast(0.3, -2, 5);
  for (const ChargedPlace& place :
       {ChargedPlace{0.8, 0.3999, Region::kV}, ChargedPlace{0.8, 0.399, Region::kV},
        ChargedPlace{0.8, 0.399, Region::kV, kOut}, ChargedPlace{0.8, 0.2, Region::kV},
        ChargedPlace{0.8, 0.3, Region::kV, kOut, 0, fast},
        ChargedPlace{0.8, 0.9, Region::kIV, kOut, 1}, ChargedPlace{0.8, 1.7, Region::kI, kOut, 1},
        ChargedPlace{0.8, 4, Region::kI, kOut, 1, fast}, ChargedPlace{0.8, 7, Region::kI, kOut, 1},
        ChargedPlace{1, 0.9, Region::kV}, ChargedPlace{1.02, 3}, ChargedPlace{1.06066, 4},
        ChargedPlace{1.0607, 4}, ChargedPlace{1.2, 1.4}, ChargedPlace{5, 2}})
    for (const Projection& p : projections()) {
      const Show show = show_of(StaticObserver{10}, p);
      expect_close(GridScene(show, state_near_charge(show, place)),
                   std::to_string(place.charge) + " " + std::to_string(place.r));
    }
}

// A block of cells holds the same pixels as their rows.
TEST(RayGrid, BlocksAreMadeOfRows) {
  const GridScene g(show_of(StaticObserver{10}, Domemaster{512}));
  SampleBatch block, line;
  int blocks = 0;
  for (int j = 0; j < g.grid.cell_rows(); ++j)
    for (int i = 0; i + RayGrid::kBlock <= g.grid.cell_columns(); i += RayGrid::kBlock) {
      int end = i;
      while (end < i + RayGrid::kBlock && g.grid.cell(j, end).kind == RayGrid::Kind::kSmooth) ++end;
      if (end == i) continue;
      g.grid.interpolate_block(j, i, end, block);
      ++blocks;
      for (int row = 0; row < RayGrid::kStep; ++row) {
        g.grid.interpolate_row(j, row, i, end, line);
        for (int k = 0; k < (end - i) * RayGrid::kStep; ++k) {
          const int cell = k / RayGrid::kStep, column = k % RayGrid::kStep;
          const auto at =
              static_cast<std::size_t>((cell * RayGrid::kStep + row) * RayGrid::kStep + column);
          const auto in_line = static_cast<std::size_t>(k);
          ASSERT_EQ(block.x[at], line.x[in_line]);
          ASSERT_EQ(block.gain[at], line.gain[in_line]);
          // The axis is as long as the footprint, up to the error of its linear interpolation.
          const V3d along(block.ax[at], block.ay[at], block.az[at]);
          ASSERT_NEAR(along.length(), block.wide[at], 0.02 * block.wide[at]);
        }
      }
    }
  EXPECT_GT(blocks, 100);
}

TEST(RayGrid, SparesNearlyAllViewRaysOfALargeImage) {
  // Edges, at which rays are traced, take a larger part of a smaller image.
  const Projection dome = Domemaster{tries(4096, 1536)};
  expect_close(show_of(StaticObserver{10}, dome), "a dome", kSanitized ? 0.85 : 0.95);
  expect_close(show_of(RadialInfall{1}, dome), "inside", kSanitized ? 0.6 : 0.85);
}

Show without_stars(const Trajectory& t, const Projection& p) {
  Show show = starry(show_of(t, p));
  for (const SkyRegion sky : {SkyRegion::kI, SkyRegion::kIII}) {
    show.sky[sky].stars.reset();
    // Next to black a small error of the light is a large part of what is left.
    std::get<PanoramaSky>(show.sky[sky].background).black = 0;
  }
  return show;
}

TEST(SkyPass, MakesTheFrameThatTracingEveryPixelMakes) {
  for (const Projection& p : projections())
    for (const Trajectory& t :
         {Trajectory(StaticObserver{10}), Trajectory(RadialInfall{1}),
          Trajectory(GivenVelocity{Region::kI, Tetrad::kRain, kFlatSpace, {0, 1, 2}})}) {
      const Show show = without_stars(t, p);
      const FrameState state = frame_state(show, 0);
      const HalfFrame quick = Renderer(show, 2).render(state),
                      slow = Renderer(show, 2, {4, false, true}).render(state);
      for (std::size_t k = 0; k < quick.pixels.size(); ++k)
        ASSERT_NEAR(quick.pixels[k], slow.pixels[k], 0.01 * slow.pixels[k] + 1e-6)
            << k / 3 % static_cast<std::size_t>(quick.width) << " "
            << k / 3 / static_cast<std::size_t>(quick.width);
    }
}

// These are a frame's errors against one whose view rays are all traced, as parts of the larger
// value.
struct PixelErrors {
  double worst = 0;
  std::size_t large = 0, all = 0;  // pixels with an error above a hundredth, lit pixels

  explicit PixelErrors(const Show& show) {
    const FrameState state = frame_state(show, 0);
    const HalfFrame quick = Renderer(show, 2).render(state),
                    slow = Renderer(show, 2, {4, false, true}).render(state);
    for (std::size_t k = 0; k < quick.pixels.size(); k += 3) {
      const double a = quick.pixels[k], b = slow.pixels[k],
                   error = std::abs(a - b) / std::max(a, b);
      if (!(std::max(a, b) > 1e-5)) continue;
      ++all;
      large += error > 0.01;
      worst = std::max(worst, error);
    }
  }
};

// A border may lie on either side of a sample, and one of 16 samples is three quarters of a light
// square's share.
TEST(SkyPass, MakesTheBordersOfAGridWhereTracingEveryPixelMakesThem) {
  for (const Projection& p : {projections()[0], projections()[3]})
    for (const Trajectory& t :
         {Trajectory(StaticObserver{10}), Trajectory(RadialInfall{1}), Trajectory(CircularOrbit{6}),
          Trajectory(GivenVelocity{Region::kI, Tetrad::kRain, kFlatSpace, {0, 1, 2}})}) {
      Show show = show_of(t, p);
      show.sky[SkyRegion::kI].background = show.sky[SkyRegion::kIII].background = GridSky{};
      const PixelErrors errors(show);
      EXPECT_LT(errors.worst, 0.4);
      // Borders take a larger part of a smaller image.
      EXPECT_LT(static_cast<double>(errors.large), 0.02 * static_cast<double>(errors.all));
      EXPECT_GT(errors.all, 10'000u);
    }
}

TEST(SkyPass, MakesTheRingsThatTracingEveryPixelMakes) {
  for (const Projection& p : {projections()[0], projections()[3]})
    for (const double period : {0.02, 0.2, 4.0})
      for (const double r : {0.3, 1.9, 4.0}) {
        Show show = show_of(
            GivenVelocity{r < 2 ? Region::kIV : Region::kI, Tetrad::kOutgoing, r, {0.1, 0, 0.2}},
            p);
        show.sky[SkyRegion::kIV].background = RingsSky{period};
        const PixelErrors errors(show);
        // A hundredth of a pixel that covers half a period changes the cosine by a thirtieth.
        EXPECT_LT(errors.worst, 0.03) << period << ' ' << r;
        EXPECT_LT(static_cast<double>(errors.large), 0.01 * static_cast<double>(errors.all));
        EXPECT_GT(errors.all, 1000u) << period << ' ' << r;
      }
}

// A telescope sees directions that differ by less than a float's rounding.
TEST(SkyPass, ResolvesABorderOfAGridAtAnyMagnification) {
  Show show = show_of(StaticObserver{1e6}, Stereographic{128, 96, 1e-7});
  show.sky[SkyRegion::kI].background = GridSky{};
  show.timeline[0].camera.attitude = LookAtSky{sky_direction(35, 12)};
  const PixelErrors errors(show);
  EXPECT_LT(errors.worst, 0.4);
  EXPECT_LT(static_cast<double>(errors.large), 0.01 * static_cast<double>(errors.all));
}

// Memory that is used again keeps nothing of the frame before.
TEST(SkyPass, LeavesNothingBehindForTheNextFrame) {
  const Show show = without_stars(RadialInfall{0.5}, Domemaster{256});
  Show other = without_stars(StaticObserver{3}, Domemaster{256});
  const FrameState state = frame_state(show, 0), before = frame_state(other, 0);
  Renderer renderer(show, 2);
  const HalfFrame fresh = renderer.render(state);
  HalfFrame frame;
  renderer.render(before, frame);
  renderer.render(state, frame);
  EXPECT_EQ(std::memcmp(frame.pixels.data(), fresh.pixels.data(), 2 * fresh.pixels.size()), 0);
}

}  // namespace
}  // namespace domefall
