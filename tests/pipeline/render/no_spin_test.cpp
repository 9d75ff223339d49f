// A hole of hardly any spin is drawn by charts, one of none by tables, and their pictures are alike.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>

#include "tests/pipeline/render/scenes.h"

namespace domefall {
namespace {

struct Unlike {
  int lit = 0, differ = 0, far = 0;  // pixels' values; beyond one step of half floats; beyond 1 %
};

Unlike unlike(const HalfFrame& a, const HalfFrame& b) {
  Unlike out;
  for (std::size_t k = 0; k < a.pixels.size(); ++k) {
    const int steps = std::abs(int{a.pixels[k].bits()} - int{b.pixels[k].bits()});
    out.lit += a.pixels[k].bits() > 0;
    out.differ += steps > 1;
    out.far += steps > 20;
  }
  return out;
}

// Those that differ are at the edge of the hole and along the Einstein ring.  There a pixel is a mean over
// many rays or over a long footprint, which table and chart know to 1e-4 of itself.
TEST(NoSpin, FramesAreThoseOfLittleSpin) {
  for (const double r : {10.0, 3.5})
    for (const bool stars : {false, true}) {
      Show show = starry(show_of(StaticObserver{r}, Domemaster{128}));
      if (!stars) show.sky[SkyRegion::kI].stars.reset();
      FrameState state = state_near_charge(show, {1e-12, r});
      show.spacetime = ChargedHole(1, 1e-12);
      const HalfFrame still = Renderer(show, 1).render(state);
      show.spacetime = state.observer.spacetime = SpinningHole{1, {1e-9L}};
      const HalfFrame spinning = Renderer(show, 1).render(state);
      const Unlike u = unlike(still, spinning);
      EXPECT_GT(u.lit, 20000);
      EXPECT_LT(u.differ, 0.03 * u.lit) << r << " " << stars;
      EXPECT_LT(u.far, 0.002 * u.lit) << r << " " << stars;
    }
}

// A draft is by a chart of wider cells.
TEST(NoSpin, DraftsAreNearlyTheFrames) {
  for (const int size : {64, 256}) {
    const Show show = starry(show_of(StaticObserver{6}, Domemaster{size}));
    FrameState state = state_near_charge(show, {1e-12, 6});
    state.observer.spacetime = SpinningHole{1, {0.9L}};
    Show spinning = show;
    spinning.spacetime = state.observer.spacetime;
    StageTimes times, of_draft;
    HalfFrame frame, draft;
    Renderer(spinning, 1).render(state, frame, &times);
    state.draft = true;
    Renderer(spinning, 1).render(state, draft, &of_draft);
    EXPECT_LT(of_draft.table_nodes, times.table_nodes / 3);
    double off = 0, light = 0;
    for (std::size_t k = 0; k < frame.pixels.size(); ++k)
      off += std::abs(float{frame.pixels[k]} - float{draft.pixels[k]}), light += frame.pixels[k];
    EXPECT_GT(light, 0);
    EXPECT_LT(off, 0.01 * light) << size;
  }
}

}  // namespace
}  // namespace domefall
