// Tests of how a disc enters the keys of frames.
#include <gtest/gtest.h>

#include <functional>
#include <set>

#include "pipeline/render/frame_key.h"
#include "tests/pipeline/render/scenes.h"

namespace domefall {
namespace {

std::string key_with(const std::optional<Disc>& disc) {
  Show show = show_of(StaticObserver{10}, Domemaster{64});
  show.mass_solar = 1;
  show.disc = disc;
  return FrameKeys(show).scene(frame_state(show, 0));
}

TEST(DiscInFrameKeys, EachOfItsPropertiesMatters) {
  const std::vector<std::function<void(Disc&)>> changes{
      [](Disc&) {},
      [](Disc& d) { d.inner = 7; },
      [](Disc& d) { d.outer = 21; },
      [](Disc& d) { d.normal = {V3d(0, 1, 0)}; },
      [](Disc& d) { d.t_max_k = 9000; },
      [](Disc& d) { d.luminance = 2e-3; },
      [](Disc& d) { d.opacity = 0.5; },
      [](Disc& d) { d.plunging = true; },
      [](Disc& d) { d.node = {V3d(0, 1, 0)}; },
      [](Disc& d) { d.pattern = TurbulencePattern{}; },
      [](Disc& d) {
        d.pattern = TurbulencePattern{0.5, 2, 1};
      },
      [](Disc& d) {
        d.pattern = TurbulencePattern{1, 3, 1};
      },
      [](Disc& d) {
        d.pattern = TurbulencePattern{1, 2, 2};
      },
      [](Disc& d) { d.pattern = RingPattern{}; },
      [](Disc& d) {
        d.pattern = RingPattern{3, 0.8, 0.02};
      },
      [](Disc& d) {
        d.pattern = RingPattern{2, 0.7, 0.02};
      },
      [](Disc& d) {
        d.pattern = RingPattern{2, 0.8, 0};
      },
      [](Disc& d) { d.pattern = SpotPattern{}; },
      [](Disc& d) {
        d.pattern = SpotPattern{9, 0, 0.7, 5};
      },
      [](Disc& d) {
        d.pattern = SpotPattern{8, 1, 0.7, 5};
      },
      [](Disc& d) {
        d.pattern = SpotPattern{8, 0, 0.5, 5};
      },
      [](Disc& d) {
        d.pattern = SpotPattern{8, 0, 0.7, 6};
      },
      [](Disc& d) {
        d.pattern = SpotPattern{};
        d.slow_light = false;
      }};
  std::set<std::string> keys{key_with(std::nullopt)};
  for (const auto& change : changes) {
    Disc disc;
    change(disc);
    keys.insert(key_with(disc));
  }
  EXPECT_EQ(keys.size(), changes.size() + 1);
}

// Without a pattern the disc looks the same at all times.
TEST(DiscInFrameKeys, TheTimeMattersToPatternsAlone) {
  Show show = show_of(StaticObserver{10}, Domemaster{64});
  show.mass_solar = 1;
  show.disc.emplace();
  FrameState now = frame_state(show, 0), later = now;
  later.observer.null_time += 3;
  EXPECT_EQ(FrameKeys(show).scene(now), FrameKeys(show).scene(later));
  show.disc->pattern = TurbulencePattern{};
  EXPECT_NE(FrameKeys(show).scene(now), FrameKeys(show).scene(later));
}

// The last bit of a sine differs between processors.
TEST(DiscInFrameKeys, TheLastBitOfItsAxisDoesNot) {
  Disc disc;
  const double z = std::sqrt(0.5);
  disc.normal = {V3d(z, 0, z)};
  const std::string key = key_with(disc);
  disc.normal = {V3d(std::nextafter(z, 1), 0, z)};
  EXPECT_EQ(key_with(disc), key);
}

}  // namespace
}  // namespace domefall
