// What the keys of frames depend on, and what they do not.
#include <gtest/gtest.h>

#include <functional>
#include <set>

#include "pipeline/render/frame_key.h"
#include "pipeline/show/observer_track.h"
#include "tests/pipeline/render/effect_shows.h"
#include "trajectories/charged_orbit.h"

namespace domefall {
namespace {

std::string key_of(const Show& show) { return FrameKeys(show).scene(frame_state(show, 0)); }

Show at_ten() { return show_of(StaticObserver{10}, Domemaster{64}); }

// Each change of the show gives a key of its own.
using Changes = std::vector<std::function<void(Show&)>>;
void expect_other_keys(const Show& show, const Changes& changes) {
  std::set<std::string> keys{key_of(show)};
  for (const auto& change : changes) {
    Show other = show;
    change(other);
    EXPECT_TRUE(keys.insert(key_of(other)).second) << "change " << keys.size();
  }
}

TEST(FrameKeys, KnowPixelsThatAreNotSquare) {
  const Show show = show_of(StaticObserver{10}, Stereographic{64, 48, 1.5});
  expect_other_keys(show, {[](Show& s) { s.projection = with_pixel_aspect(s.projection, 2); },
                           [](Show& s) { s.projection = with_pixel_aspect(s.projection, 0.9); }});
  Show again = show;
  again.projection = with_pixel_aspect(show.projection, 1);
  EXPECT_EQ(key_of(again), key_of(show));
}

// Throughout a cylinder r is the same.
TEST(FrameKeys, KnowTheLengthInAWormholeAndWhereItsMouthWas) {
  std::set<std::string> keys;
  for (const double l : {0.0, 0.1, 0.2, -0.1, 3.0, -3.0})
    EXPECT_TRUE(keys.insert(key_of(show_in_wormhole(l, Domemaster{64}))).second) << l;
  const Show show = show_in_wormhole(1, Domemaster{64});
  FrameState state = frame_state(show, 0);
  state.observer.mouth_at_start = {0, 0, 1};
  EXPECT_NE(FrameKeys(show).scene(state), key_of(show));
}

TEST(FrameKeys, KnowThePeriodOfRingsAndTheObserversTime) {
  Show show = at_ten();
  show.sky[SkyRegion::kIV].background = RingsSky{4};
  const std::string key = key_of(show);
  FrameState later = frame_state(show, 0);
  later.observer.null_time = 1;
  EXPECT_NE(FrameKeys(show).scene(later), key);
  expect_other_keys(show, {[](Show& s) { s.sky[SkyRegion::kIV].background = RingsSky{5}; }});
  show.sky[SkyRegion::kIV].background = GridSky{};
  EXPECT_EQ(FrameKeys(show).scene(later), key_of(show));
}

// A fall from 9 M to the same r of the next universe, at the first frame and at the last.
TEST(FrameKeys, KnowTheNextSkyWhereItIsSeen) {
  const ChargedHole hole(1, 0.9L);
  Show show = show_of(ChargedOrbit::falling(hole, 9, 0, 0), Domemaster{64});
  show.spacetime = hole;
  show.timeline[0].timing = {0, 24};
  const auto last_key = [](const Show& s) { return FrameKeys(s).scene(frame_state(s, 29)); };
  Show other = show;
  other.sky[SkyRegion::kNext].background = GridSky{};
  EXPECT_EQ(key_of(other), key_of(show));
  EXPECT_NE(last_key(other), last_key(show));
  Show brighter = other;
  brighter.sky[SkyRegion::kNext].background_gain = 2;
  EXPECT_NE(last_key(brighter), last_key(other));
  // Where nothing else differs, two universes are two views.
  FrameState state = frame_state(show, 0);
  state.observer.universe = 2;
  EXPECT_NE(FrameKeys(show).scene(state), key_of(show));
}

// Stars near the axis are drawn by how fast the sky turns, so two shows that pass one instant at
// different speeds have different frames there.
TEST(FrameKeys, KnowHowFastTheSkyTurns) {
  Show show = show_of(CircularOrbit{10}, Domemaster{64});
  show.sky[SkyRegion::kI].stars = StarField{kTestAssets + "stars_to_9.stars", 6.5};
  show.timeline[0].timing = {0, 10};
  Show faster = show;
  faster.timeline[0].timing = {0, 20};
  join_segments(show);
  join_segments(faster);
  EXPECT_NE(key_of(show), key_of(faster));
}

TEST(FrameKeys, KnowThePlanetsAmongTheStars) {
  Show show = at_ten();
  show.sky[SkyRegion::kI].stars = StarField{kTestAssets + "stars_to_9.stars", 6.5};
  expect_other_keys(show, {[](Show& s) { s.sky[SkyRegion::kI].stars->planets_year = 2020; },
                           [](Show& s) { s.sky[SkyRegion::kI].stars->planets_year = 2021; }});
}

TEST(FrameKeys, KnowHowStarsAreDrawn) {
  Show show = at_ten();
  expect_other_keys(
      show, {[](Show& s) { s.point_spread.white_core = 10; },
             [](Show& s) { s.star_saturation = 0.5; }, [](Show& s) { s.least_star_radius *= 2; }});
  const std::string key = key_of(show);
  show.point_spread.halo_sigma = 0.01;
  EXPECT_EQ(key_of(show), key) << "without a halo it has no effect";
  show.point_spread.halo = 0.1;
  EXPECT_NE(key_of(show), key);
  expect_other_keys(show, {[](Show& s) { s.point_spread.halo_sigma = 0.02; }});
}

TEST(FrameKeys, AreOfAllThatAFrameDependsOnAndNothingElse) {
  const Show show = starry(at_ten());
  const std::string key = key_of(show);
  EXPECT_EQ(key_of(show), key);
  EXPECT_NE(FrameKeys(show).scene(frame_state(show, 1)), key);
  expect_other_keys(show, {[](Show& s) { s.exposure.ev = 0.5; },
                           [](Show& s) { s.sky[SkyRegion::kI].stars->max_magnitude = 5; },
                           [](Show& s) { s.timeline[0].camera.roll = 0.1; }});
  Show other = show;
  other.sky[SkyRegion::kIII].background_gain = 2;
  EXPECT_EQ(key_of(other), key) << "not seen from outside";
  other = show;
  other.timeline.push_back(show.timeline[0]);
  other.timeline[1].trajectory = StaticObserver{5};
  EXPECT_EQ(key_of(other), key) << "another segment";
}

TEST(FrameKeys, KnowOfEffectsOnlyWhereTheyAreNotNature) {
  const Show nature = at_rest_at(30, {});
  EXPECT_EQ(key_of(nature), key_of(at_rest_at(30, Effects{})));
  Changes changes;
  for (const Effects& e : {Effects{false, true, true, true}, Effects{true, false, true, true},
                           Effects{true, true, false, true}, Effects{true, true, true, false},
                           Effects{true, true, true, true, Amplification::kNone},
                           Effects{true, true, true, true, Amplification::kEverything}})
    changes.emplace_back([e](Show& s) { s.effects = e; });
  expect_other_keys(nature, changes);
}

Show with_disc() {
  Show show = at_ten();
  show.spacetime = Schwarzschild{1};
  show.disc.emplace();
  return show;
}

TEST(FrameKeys, KnowEachPropertyOfADisc) {
  Changes changes{[](Show& s) { s.disc.reset(); },
                  [](Show& s) { s.disc->inner = 7; },
                  [](Show& s) { s.disc->outer = 21; },
                  [](Show& s) { s.disc->normal = {V3d(0, 1, 0)}; },
                  [](Show& s) { s.disc->t_max_k = 9000; },
                  [](Show& s) { s.disc->luminance = 2e-3; },
                  [](Show& s) { s.disc->opacity = 0.5; },
                  [](Show& s) { s.disc->plunging = true; },
                  [](Show& s) { s.disc->node = {V3d(0, 1, 0)}; },
                  [](Show& s) { s.disc->patterns = {SpotPattern{}}, s.disc->slow_light = false; }};
  for (const PatternKind& pattern : std::initializer_list<PatternKind>{
           TurbulencePattern{}, TurbulencePattern{0.5, 2, 1}, TurbulencePattern{1, 3, 1},
           TurbulencePattern{1, 2, 2}, RingPattern{}, RingPattern{3, 0.8, 0.02},
           RingPattern{2, 0.7, 0.02}, RingPattern{2, 0.8, 0}, SpotPattern{},
           SpotPattern{9, 0, 0.7, 5}, SpotPattern{8, 1, 0.7, 5}, SpotPattern{8, 0, 0.5, 5},
           SpotPattern{8, 0, 0.7, 6}})
    changes.emplace_back([pattern](Show& s) { s.disc->patterns = {pattern}; });
  changes.emplace_back([](Show& s) { s.disc->patterns = {TurbulencePattern{}, SpotPattern{}}; });
  changes.emplace_back([](Show& s) { s.disc->height = 0.1; });
  expect_other_keys(with_disc(), changes);
}

TEST(FrameKeys, KnowEachPropertyOfThinGas) {
  Show show = with_disc();
  show.disc->height = 0.1;
  show.halo.emplace(), show.jet.emplace();
  const auto normal = SkyDirection{V3d(0, 1, 0)};
  expect_other_keys(
      show, {[](Show& s) { s.halo.reset(); }, [](Show& s) { s.jet.reset(); },
             [=](Show& s) { s.halo->normal = normal; }, [](Show& s) { s.halo->r = 7; },
             [](Show& s) { s.halo->height = 0.2; }, [](Show& s) { s.halo->luminance = 1; },
             [](Show& s) { s.halo->temperature = 4000; }, [=](Show& s) { s.jet->normal = normal; },
             [](Show& s) { s.jet->lorentz = 7; }, [](Show& s) { s.jet->opening = 0.2; },
             [](Show& s) { s.jet->r = 7; }, [](Show& s) { s.jet->length = 70; },
             [](Show& s) { s.jet->luminance = 1; }, [](Show& s) { s.jet->temperature = 4000; }});
}

TEST(FrameKeys, KnowTheLightThatAKeyframeGivesToDiscAndBodies) {
  Show show = with_disc();
  show.bodies.resize(2);
  const FrameState now = frame_state(show, 0);
  std::set<std::string> keys{FrameKeys(show).scene(now)};
  FrameState dim = now, thin = now, fainter = now;
  dim.settings.disc_gain = 0.5;
  thin.settings.disc_opacity = 0.5;
  fainter.settings.magnitudes = {0, 1};
  for (const FrameState& other : {dim, thin, fainter}) keys.insert(FrameKeys(show).scene(other));
  EXPECT_EQ(keys.size(), 4U);
}

TEST(FrameKeys, KnowTheLayersOfTheirFiles) {
  Show two = at_ten();
  two.output.layers = {Layer::kSky, Layer::kStars};
  expect_other_keys(
      two, {[](Show& s) { s.output.layers.clear(); }, [](Show& s) { s.output.layers.pop_back(); },
            [](Show& s) { s.output.layers.back() = Layer::kDisc; },
            [](Show& s) { s.output.layer_files = true; }});
}

// Without a pattern the disc looks the same at all times.
TEST(FrameKeys, KnowTheTimeOfADiscsPatternAlone) {
  Show show = with_disc();
  const FrameState now = frame_state(show, 0);
  FrameState later = now;
  later.observer.null_time += 3;
  EXPECT_EQ(FrameKeys(show).scene(now), FrameKeys(show).scene(later));
  show.disc->patterns = {TurbulencePattern{}};
  EXPECT_NE(FrameKeys(show).scene(now), FrameKeys(show).scene(later));
}

// The last bit of a sine differs between processors.
TEST(FrameKeys, DoNotKnowTheLastBitOfADiscsAxis) {
  Show show = with_disc();
  const double z = std::sqrt(0.5);
  show.disc->normal = {V3d(z, 0, z)};
  const std::string key = key_of(show);
  show.disc->normal = {V3d(std::nextafter(z, 1), 0, z)};
  EXPECT_EQ(key_of(show), key);
}

}  // namespace
}  // namespace domefall
