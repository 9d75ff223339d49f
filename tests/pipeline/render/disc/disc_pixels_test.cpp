// Single pixels of discs against the rays that end in them, followed step by step.
#include <gtest/gtest.h>

#include <random>

#include "pipeline/sources/colour/blackbody.h"
#include "tests/pipeline/render/disc/disc_views.h"
#include "tests/pipeline/render/disc/reference_disc.h"
#include "tests/sanitized.h"

namespace domefall {
namespace {

Vector3 array_of(const V3d& v) { return {v.x, v.y, v.z}; }

// The disc as one direction of view shows it, without the tables that frames are made from.
class FollowedDisc {
 public:
  FollowedDisc(const Show& show, const FrameState& state, double charge)
      : state_(state), disc_(*show.disc), scale_(disc_.luminance / luminance_of(disc_.t_max_k)) {
    const ObserverState& o = state.observer;
    view_ = {o.r,
             is_outgoing(o.tetrad),
             array_of(o.celerity),
             array_of(apply_transposed(o.sky_from_tetrad, disc_.normal.v)),
             disc_.inner,
             disc_.outer,
             disc_.plunging,
             charge};
  }

  struct Sight {
    int orders = 0;  // a bit for each image
    double nits = 0;
  };
  Sight at(const PixelPosition& pixel) const {
    const V3d n =
        apply(state_.observer.tetrad_from_camera, direction_at(state_.projection, pixel).v);
    Sight sight;
    double left = 1;
    for (const ReferenceDiscPlace& place : reference_disc(view_, array_of(n))) {
      sight.orders |= 1 << place.order;
      const double t = disc_.t_max_k * place.temperature / place.one_plus_z;
      const double absorbed = disc_.opacity * absorbed_at(place);
      sight.nits += left * absorbed * scale_ * luminance_of(t);
      left *= 1 - absorbed;
    }
    return sight;
  }

 private:
  // A slab of even gas, summed in layers from the back to the front.
  double absorbed_at(const ReferenceDiscPlace& place) const {
    if (std::isinf(disc_.optical_depth)) return 1;
    const auto thinned = [](double x) { return x < 1 ? x * x * x * (10 - 15 * x + 6 * x * x) : 1; };
    double depth = disc_.optical_depth / place.steepness;
    if (disc_.rim > 0)
      depth *= thinned((disc_.outer - place.r) / (disc_.rim * disc_.outer)) *
               thinned((place.r - disc_.inner) / (disc_.rim * disc_.inner));
    constexpr int kLayers = 2000;
    double light = 0;
    for (int k = 0; k < kLayers; ++k) light += (1 - light) * depth / (kLayers + depth / 2);
    return light;
  }
  static double luminance_of(double temperature) {
    return temperature > 500 ? blackbody_xyz(temperature).y : 0;
  }

  const FrameState& state_;
  Disc disc_;
  double scale_;
  ReferenceDiscView view_;
};

Disc disc_from(double inner, double outer, double opacity, bool plunging = false) {
  return {.inner = inner, .outer = outer, .opacity = opacity, .plunging = plunging};
}

// Outside, between the images, next to the light circle, inside both horizons, at rest, in free
// fall and fast, above the plane, close to it and within.
std::vector<DiscView> twenty_views() {
  constexpr Region kI = Region::kI, kII = Region::kII;
  constexpr Tetrad kRain = Tetrad::kRain, kOut = Tetrad::kOutgoing;
  std::mt19937 random(11);
  std::vector<DiscView> views;
  const Disc usual = disc_from(6, 20, 1), thin = disc_from(6, 20, 0.5);
  for (const double degrees : {80.0, 30.0, 10.0, 1.0})
    views.push_back({{kI, kRain, 60, celerity_of_rest(60)}, normal_seen_from(degrees), usual});
  for (const double r : {15.0, 9.0, 6.5})
    views.push_back({{kI, kRain, r, celerity_of_rest(r)}, normal_seen_from(20), thin});
  // Who is amid the gas, in the plane to rounding, may be on either side of it.
  views.push_back({{kI, kRain, 15, celerity_of_rest(15)}, normal_seen_from(0.05), usual});
  views.push_back({{kI, kRain, 4, celerity_of_rest(4)}, normal_seen_from(0), usual});
  for (const double r : {4.0, 3.0, 2.5, 2.05})
    views.push_back({{kI, kRain, r, {0, 0, 0}}, random_direction(random), thin});
  const Disc falling = disc_from(2.5, 12, 0.7, true);
  for (const double r : {1.9, 1.0, 0.4})
    views.push_back({{kII, kRain, r, {0, 0, 0}}, random_direction(random), falling});
  views.push_back({{kI, kRain, 12, {0.4, -0.2, 0.5}}, V3d(0.3, -1, 0), usual});
  views.push_back({{kI, kRain, 10, {3, 1, -2}}, V3d(0.01, -1, 0), disc_from(6, 30, 0.6)});
  views.push_back({{kI, kOut, 10, {-0.5, 0.3, 0.1}}, V3d(0.7, 0.7, 0.1), usual});
  views.push_back({{kI, kOut, 2.5, {0.1, 0, 0.2}}, V3d(-0.5, 0.7, 0.1), falling});
  return views;
}

// Gas that lets light through, the more of it the steeper the ray, and thins out at its rims.
std::vector<DiscView> translucent_views() {
  std::vector<DiscView> views;
  for (const double depth : {0.3, 1.0, 3.0}) {
    Disc disc = disc_from(6, 20, 1);
    disc.optical_depth = depth, disc.rim = 0.3;
    for (const double degrees : {80.0, 25.0, 6.0})
      views.push_back(
          {{Region::kI, Tetrad::kRain, 40, celerity_of_rest(40)}, normal_seen_from(degrees), disc});
    views.push_back({{Region::kI, Tetrad::kRain, 12, {0.4, -0.2, 0.5}}, V3d(0.3, -1, 0), disc});
    Disc falling = disc_from(2.5, 12, 0.8, true);
    falling.optical_depth = depth, falling.rim = 0.1;
    views.push_back({{Region::kII, Tetrad::kRain, 1.5, {0, 0, 0}}, V3d(0.2, -1, 0.4), falling});
  }
  return views;
}

// How near to each other these are, whatever is 0.
double ratio(double a, double b) { return std::min(a, b) / std::max({a, b, 1e-300}); }

struct Compared {
  int pixels = 0, from_beneath = 0, dark = 0;
};

// Compares pixels of views with the rays that end in them.  The pictures are half as wide again as
// high.
Compared compare_with_rays(const std::vector<DiscView>& views, unsigned seed, int height) {
  std::mt19937 random(seed);
  Compared compared;
  for (std::size_t v = 0; v < views.size(); ++v) {
    const double fov = views[v].at.r > 30 ? 44 : 140;
    const Show show = disc_show(views[v], Stereographic{height * 3 / 2, height, fov * kDegree});
    const FrameState state = frame_state(show, 0);
    const FollowedDisc followed(show, state, views[v].charge);
    const FloatImage frame = render_floats(show);
    const double scale = exposure_scale(state.settings);
    for (int k = 0; k < tries(24, 6); ++k) {
      const auto rows = static_cast<unsigned>(height);
      const int column = static_cast<int>(random() % (rows * 3 / 2)),
                row = static_cast<int>(random() % rows);
      const PixelPosition middle{column + 1.0, row + 1.0};
      const FollowedDisc::Sight centre = followed.at(middle);
      double corners = 0, evenness = 1;
      bool same = true;
      for (const double i : {-0.5, 0.5})
        for (const double j : {-0.5, 0.5}) {
          const FollowedDisc::Sight corner = followed.at({middle.i + i, middle.j + j});
          same = same && corner.orders == centre.orders;
          evenness = std::min(evenness, ratio(corner.nits, centre.nits));
          corners += corner.nits / 4;
        }
      const double seen = luminance(pixel_at(frame, column, row)) / scale;
      SCOPED_TRACE(testing::Message() << "view " << v << ", pixel " << column << ", " << row);
      EXPECT_GE(seen, 0);
      // Rims and thin rings are judged by the light of whole frames (disc_light_test.cpp).
      if (!same || (centre.orders != 0 && evenness < 0.7)) continue;
      if (centre.orders == 0) {
        // What is left may be a ring that no corner meets.
        EXPECT_LT(seen, 0.3 * show.disc->luminance);
        compared.dark += seen == 0;
        continue;
      }
      // Simpson's rule in two dimensions.  A pixel also sees a little of its neighbours, and these
      // pixels are more than a degree wide.
      const double mean = (2 * centre.nits + corners) / 3;
      EXPECT_NEAR(seen / mean, 1, 0.02 + 0.1 * (1 - evenness)) << centre.nits;
      ++compared.pixels;
      compared.from_beneath += centre.orders > 1;
    }
  }
  return compared;
}

TEST(DiscPixels, AreThoseOfTheRaysInTwentyViews) {
  const std::vector<DiscView> views = twenty_views();
  ASSERT_EQ(views.size(), 20u);
  const Compared compared = compare_with_rays(views, 3, 80);
  EXPECT_GT(compared.pixels, tries(100, 20));
  EXPECT_GT(compared.from_beneath, tries(3, -1));
  EXPECT_GT(compared.dark, tries(40, 8));
}

TEST(DiscPixels, OfGasThatLetsLightThroughAreThoseOfTheRays) {
  const Compared compared = compare_with_rays(translucent_views(), 4, 80);
  EXPECT_GT(compared.pixels, tries(60, 12));
  EXPECT_GT(compared.from_beneath, tries(3, -1));
}

TEST(DiscPixels, OfDeepGasAreThoseOfAnOpaqueDisc) {
  DiscView view{{Region::kI, Tetrad::kRain, 15, {0.1, 0.2, 0}}, normal_seen_from(12), Disc{}};
  const FloatImage opaque = render_floats(disc_show(view, Domemaster{tries(200, 64)}));
  view.disc.optical_depth = 1e6;
  const FloatImage deep = render_floats(disc_show(view, Domemaster{tries(200, 64)}));
  for (std::size_t k = 0; k < opaque.pixels.size(); ++k)
    ASSERT_NEAR(deep.pixels[k], opaque.pixels[k], 1e-4f * opaque.pixels[k]);
}

// From afar and near, amid the gas, next to the circle of light, beside the horizon and behind it.
TEST(DiscPixels, AreThoseOfTheRaysNearACharge) {
  constexpr Tetrad kRain = Tetrad::kRain;
  std::mt19937 random(5);
  std::vector<DiscView> views;
  for (const double charge : {0.5, 0.95, 1.0}) {
    const ChargedHole hole(1, charge);
    const double edge = hole.last_stable_orbit(), end = hole.horizon();
    const Disc stable = disc_from(edge, 20, 0.7), falling = disc_from(end * 1.2, 12, 0.7, true);
    const auto add = [&](double r, const Celerity<ReferenceTetrad>& celerity, const V3d& normal,
                         const Disc& disc) {
      views.push_back(
          {{r > end ? Region::kI : Region::kII, kRain, r, celerity}, normal, disc, charge});
    };
    add(60, celerity_of_rest(60, charge), normal_seen_from(10), stable);
    add(8, celerity_of_rest(8, charge), normal_seen_from(20), stable);
    add(12, {0.4, -0.2, 0.5}, V3d(0.3, -1, 0), stable);
    add(hole.light_circle(), {0, 0, 0}, random_direction(random), falling);
    add(end * 1.01, {0, 0, 0}, random_direction(random), falling);
    if (charge < 1) add(end * 0.9, {0, 0, 0}, random_direction(random), falling);
  }
  const Compared compared = compare_with_rays(views, 4, 160);
  EXPECT_GT(compared.pixels, tries(60, 12));
  EXPECT_GT(compared.dark, tries(20, 4));
}

// Who is the same observer sees the same, whichever frame the motion is given against.
TEST(DiscPixels, AreTheSameInBothFramesOfReference) {
  const Disc disc = disc_from(6, 20, 0.8);
  for (const double r : {12.0, 3.5}) {
    const auto rest = celerity_of_rest(r);
    const Projection projection = Equirectangular{128};
    const DiscView falling{{Region::kI, Tetrad::kRain, r, rest}, normal_seen_from(25), disc};
    const DiscView rising{{Region::kI, Tetrad::kOutgoing, r, Celerity<ReferenceTetrad>(-rest)},
                          normal_seen_from(25),
                          disc};
    const FloatImage a = render_floats(disc_show(falling, projection)),
                     b = render_floats(disc_show(rising, projection));
    float brightest = 0;
    for (std::size_t k = 0; k < a.pixels.size(); ++k) {
      EXPECT_NEAR(a.pixels[k], b.pixels[k], 2e-3f * a.pixels[k] + 1e-4f) << r << " " << k;
      brightest = std::max(brightest, a.pixels[k]);
    }
    EXPECT_GT(brightest, 0.5f);
  }
}

// A disc of region I sends no light to region III, and none to region IV.
TEST(DiscPixels, AreDarkWhereTheDiscIsNotSeen) {
  const Disc disc = disc_from(6, 20, 1);
  const std::vector<GivenVelocity> observers{{Region::kIII, Tetrad::kRainOfThree, 9, {0.1, 0, 0.3}},
                                             {Region::kIV, Tetrad::kOutgoing, 1.2, {0, 0.2, 0}}};
  for (const GivenVelocity& at : observers) {
    const FloatImage frame = render_floats(
        disc_show({at, normal_seen_from(30), disc}, Stereographic{48, 32, 150 * kDegree}));
    for (const float value : frame.pixels) ASSERT_EQ(value, 0) << region_name(at.region);
  }
}

// Who rests in t between the horizons is as far from region I as from III, and may be said to have
// fallen from either.
TEST(DiscPixels, AreTheSameToWhoIsSaidToFallFromTheOtherSide) {
  constexpr double kR = 0.8;
  const Celerity<ReferenceTetrad> rest(1 / std::sqrt(2 / kR - 1), 0, 0);
  const auto light = [&](Tetrad tetrad) {
    const Show show =
        disc_show({{Region::kII, tetrad, kR, rest}, V3d(0.4, -1, 0), disc_from(6, 20, 1)},
                  Equirectangular{256});
    return illuminance(show, render_floats(show));
  };
  const double rain = light(Tetrad::kRain);
  EXPECT_GT(rain, 0);
  EXPECT_NEAR(light(Tetrad::kRainOfThree) / rain, 1, 1e-2);  // of pixels of 1.4 degrees
}

TEST(DiscPixels, AreTheSameBytesForAnyNumberOfThreads) {
  const Show show = disc_show(
      {{Region::kI, Tetrad::kRain, 9, {0.2, 0.1, 0.4}}, normal_seen_from(3), disc_from(6, 20, 0.9)},
      Domemaster{tries(160, 64)});
  const FloatImage alone = render_floats(show, 1);
  for (const int threads : {2, 5}) EXPECT_EQ(alone.pixels, render_floats(show, threads).pixels);
}

}  // namespace
}  // namespace domefall
