// Shows that leave out some of the effects of motion, as figures of [Riazuelo] app. app_img do.
#include <gtest/gtest.h>

#include <functional>

#include "pipeline/sources/colour/blackbody.h"
#include "tests/pipeline/render/effect_shows.h"
#include "tests/pipeline/sources/sky/grid_is_even.h"
#include "tests/sanitized.h"

namespace domefall {
namespace {

const V3d kAhead(0, 0, 1);  // along Phi

// A camera that moves through flat space, as in the paper's figs. fig_aberr2 to fig_int.  It faces
// ahead (1) or back (-1).
Show ship(const Effects& effects, double speed = kV, double facing = 1) {
  const double c = speed / std::sqrt(1 - speed * speed);
  Show show = show_of(
      GivenVelocity{Region::kI, Tetrad::kRain, kFlatSpace, Celerity<ReferenceTetrad>(kAhead * c)},
      Stereographic{96, 72, 90 * kDegree});
  show.effects = effects;
  // Phi, Theta and back: Z along +-Phi.
  show.timeline[0].camera.attitude = EulerAngles{90 * kDegree, facing * 90 * kDegree, 0};
  show.sky[SkyRegion::kI] = {GridSky{}, 1, std::nullopt, 1};
  return show;
}

// [Riazuelo] eq. eq_inv_aberr is the same as tan(alpha/2) = sqrt((1 + v)/(1 - v)) tan(alpha'/2).
TEST(Effects, AberrationMovesTheSkyByTheHalfAngleAndItsLackByNothing) {
  std::mt19937 random(1);
  const Traced with(ship(kOnlyAberration)), without(ship(kNoAberration));
  const M33d& axes = with.state.observer.tetrad_from_camera;
  const V3d ahead = apply(with.state.observer.sky_from_tetrad, kAhead);
  const auto half_tangent = [](const V3d& a, const V3d& b) {
    return (a - b).length() / (a + b).length();
  };
  for (int k = 0; k < 200; ++k) {
    const CameraDirection n{random_direction(random)};
    const V3d m = apply(axes, n.v);
    const ViewRay moved = with.tracer.trace(n), unmoved = without.tracer.trace(n);
    EXPECT_NEAR(half_tangent(moved.sky_direction, ahead) / half_tangent(m, kAhead), std::sqrt(3),
                1e-13);
    EXPECT_LT((unmoved.sky_direction - apply(with.state.observer.sky_from_tetrad, m)).length(),
              1e-15);
    // The frequency follows from the direction at rest by [Riazuelo] eq. omprime_aber, and from the
    // one that is seen by [Riazuelo] eq. zkin.
    EXPECT_NEAR(unmoved.frequency_ratio, kGamma * (1 + kV * m.dot(kAhead)), 1e-14);
    EXPECT_NEAR(moved.frequency_ratio, 1 / (kGamma * (1 - kV * m.dot(kAhead))), 1e-14);
    EXPECT_NEAR(unmoved.scale_along, 1, 1e-15);
  }
}

// With aberration alone the frame shows blackbodies at rest, so its brightest values are those of
// the grid itself.
TEST(Effects, AberrationAloneKeepsColourAndIntensity) {
  const HalfFrame rest = render(ship({}, 0)), moving = render(ship(kOnlyAberration));
  const auto largest = [](const HalfFrame& f, int c) {
    float most = 0;
    for (int y = 0; y < f.height; ++y)
      for (int x = 0; x < f.width; ++x) most = std::max(most, float(f.row(y)[3 * x + c]));
    return most;
  };
  for (int c = 0; c < 3; ++c) EXPECT_EQ(largest(rest, c), largest(moving, c)) << c;
}

// Expects in each pixel this ratio to the same pixel at rest.
void expect_ratios(const Show& moving, double facing,
                   const std::function<double(double g, int channel)>& expected) {
  const HalfFrame rest = render(ship({}, 0, facing)), frame = render(moving);
  const Projection& p = moving.projection;
  const ObserverState o = frame_state(moving, 0).observer;
  const M33d &axes = o.tetrad_from_camera, &sky_from_tetrad = o.sky_from_tetrad;
  int compared = 0;
  for (int y = 0; y < frame.height; ++y)
    for (int x = 0; x < frame.width; ++x) {
      const V3d m = apply(axes, direction_at(p, {x + 1.0, y + 1.0}).v);
      const SkyDirection sky{apply(sky_from_tetrad, m)};
      // A polar disc has another colour.  Where a border crosses a pixel, its light square may lie
      // to the side that is shifted more.
      if (std::abs(sky.v.z) > 0.99 || !grid_is_even(sky, largest_pixel_angle(p))) continue;
      ++compared;
      const double cosine = m.dot(kAhead);
      for (int c = 0; c < 3; ++c) {
        const double ratio = frame.row(y)[3 * x + c] / double(rest.row(y)[3 * x + c]);
        const double g = kGamma * (1 + kV * cosine);
        // Both are rounded to half floats.
        ASSERT_NEAR(ratio / expected(g, c), 1, 1e-3) << x << ' ' << y;
      }
    }
  EXPECT_GT(compared, 1000);
}

// [Riazuelo] fig. fig_int has 9 in the front direction and 1/9 in the rear one.
TEST(Effects, IntensityAloneIsNineInFrontAndANinthInTheRear) {
  for (const double facing : {1.0, -1.0})
    expect_ratios(ship(kOnlyIntensity, kV, facing), facing,
                  [](double g, int) { return g * g * g * g; });
  const auto middle = [](const Show& show) {
    const HalfFrame f = render(show);
    return double(f.row(f.height / 2)[3 * (f.width / 2)]);
  };
  EXPECT_NEAR(middle(ship(kOnlyIntensity, kV, 1)) / middle(ship({}, 0, 1)), 9, 0.02);
  EXPECT_NEAR(middle(ship(kOnlyIntensity, kV, -1)) / middle(ship({}, 0, -1)), 1 / 9.0, 3e-4);
}

// In [Riazuelo] fig. fig_dop a place has the colour of a blackbody at g T with the bolometric
// intensity of one at T.
TEST(Effects, ColourAloneKeepsTheBolometricIntensity) {
  for (const double facing : {1.0, -1.0})
    expect_ratios(ship(kOnlyColour, kV, facing), facing, [](double g, int c) {
      const double t = 8000;
      const auto channels = [](const Xyz& xyz) {
        const WorkingRgb rgb = to_working(xyz);
        return std::array<double, 3>{rgb.r, rgb.g, rgb.b};
      };
      const auto k = static_cast<std::size_t>(c);
      return channels(blackbody_xyz(g * t))[k] / blackbody_radiance(g * t) /
             (channels(blackbody_xyz(t))[k] / blackbody_radiance(t));
    });
}

TEST(Effects, AllThreeTogetherAreTheirProductAndNature) {
  // In nature a place on the sky changes by the product of what colour and intensity do to it.
  const Effects both{false, true, true, true, Amplification::kStars};
  const double t = 8000;
  for (const double facing : {1.0, -1.0})
    expect_ratios(ship(both, kV, facing), facing, [t](double g, int c) {
      const WorkingRgb shifted = blackbody_colours().surface(g * t),
                       still = blackbody_colours().surface(t);
      return c == 0   ? double(shifted.r) / still.r
             : c == 1 ? double(shifted.g) / still.g
                      : double(shifted.b) / still.b;
    });
}

TEST(Effects, APanoramaWithoutIntensityOrAberrationIsTheOneAtRest) {
  Show moving = ship(kOnlyColour), rest = ship({}, 0);
  moving.sky[SkyRegion::kI].background = rest.sky[SkyRegion::kI].background =
      PanoramaSky{small_panorama()};
  const HalfFrame a = render(moving), b = render(rest);
  for (int y = 0; y < a.height; ++y)
    for (int k = 0; k < 3 * a.width; ++k) ASSERT_EQ(a.row(y)[k], b.row(y)[k]);
}

TEST(Effects, WithoutAberrationEveryPlaceKeepsItsFrequencyAndOnlyStandsElsewhere) {
  std::mt19937 random(2);
  for (const Trajectory& t : observers()) {
    Show show = show_of(t, Domemaster{64});
    const Traced nature(show);
    show.effects = kNoAberration;
    const Traced resting(show);
    const ObserverState &o = nature.state.observer, &r = resting.state.observer;
    const V3d rest = viewer_of(o, {}).rest;
    for (int k = 0; k < 100; ++k) {
      const CameraDirection n{random_direction(random)};
      const ViewRay there = nature.tracer.trace(n);
      const V3d tetrad = to_tetrad(o.celerity, apply(o.tetrad_from_camera, n.v)).direction;
      const CameraDirection moved{
          apply_transposed(r.tetrad_from_camera, to_observer(rest, tetrad).direction)};
      const ViewRay here = resting.tracer.trace(moved);
      // A boost by a Lorentz factor of 1e3 or 1e4 and back loses as many digits, and at an edge
      // all.
      if (there.to_edge < 1e-6 || here.to_edge < 1e-6) continue;
      ASSERT_EQ(here.sky, there.sky);
      const double scale =
          1 + there.scale_along + there.scale_across + here.scale_along + here.scale_across;
      EXPECT_LT((here.sky_direction - there.sky_direction).length(), 1e-11 * scale);
      EXPECT_NEAR(here.frequency_ratio / there.frequency_ratio, 1, 1e-8);
    }
  }
}

TEST(Effects, TheBatchTracesWhatTheSingleRayTraces) {
  std::mt19937 random(3);
  for (const Trajectory& t : observers())
    for (const Effects& effects : combinations(is_outside(t))) {
      Show show = show_of(t, Domemaster{64});
      show.effects = effects;
      const Traced traced(show);
      ViewRayBatch batch;
      std::array<CameraDirection, ViewRayBatch::kSize> n;
      for (auto& direction : n) direction.v = random_direction(random);
      traced.tracer.trace(n.data(), ViewRayBatch::kSize, batch);
      for (int k = 0; k < ViewRayBatch::kSize; ++k) {
        const ViewRay ray = traced.tracer.trace(n[static_cast<std::size_t>(k)]);
        ASSERT_EQ(batch.sky[k], ray.sky);
        const double scale = 1 + ray.scale_along + ray.scale_across;
        ASSERT_LT((batch.sky_direction(k) - ray.sky_direction).length(), 4e-15 * scale);
        ASSERT_NEAR(batch.frequency_ratio[k] / ray.frequency_ratio, 1, 1e-12);
      }
    }
}

TEST(Effects, LeaveNoPixelThatIsNotFinite) {
  for (const Trajectory& t : observers())
    for (const Effects& effects : combinations(is_outside(t)))
      for (const bool grid : {true, false}) {
        Show show = starry(show_of(t, Domemaster{tries(48, 20)}));
        if (grid)
          show.sky[SkyRegion::kI].background = show.sky[SkyRegion::kIII].background = GridSky{};
        show.sky[SkyRegion::kI].stars->max_magnitude =
            show.sky[SkyRegion::kIII].stars->max_magnitude = 3;
        show.effects = effects;
        EXPECT_NO_THROW(render(show));
      }
}

}  // namespace
}  // namespace domefall
