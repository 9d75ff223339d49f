#include <gtest/gtest.h>

#include <cstring>

#include "pipeline/base/errors.h"
#include "pipeline/render/sky/anti_aliasing_settings.h"
#include "tests/pipeline/render/scenes.h"

namespace domefall {
namespace {

HalfFrame rendered(const Show& show, AntiAliasing anti_aliasing) {
  return Renderer(show, 2, anti_aliasing).render(frame_state(show, 0));
}

// Inside the horizon, with two panoramas.
Show two_skies(int size) {
  Show show = starry(show_of(RadialInfall{0.5}, Domemaster{size}));
  show.sky[SkyRegion::kI].stars = show.sky[SkyRegion::kIII].stars = std::nullopt;
  return show;
}

Show grid(const Trajectory& trajectory, const Projection& projection) {
  Show show = show_of(trajectory, projection);
  show.sky[SkyRegion::kI].background = show.sky[SkyRegion::kIII].background = GridSky{};
  return show;
}

bool same_bytes(const HalfFrame& a, const HalfFrame& b) {
  return a.pixels.size() == b.pixels.size() &&
         std::memcmp(a.pixels.data(), b.pixels.data(), a.pixels.size() * sizeof a.pixels[0]) == 0;
}

double largest_value(const HalfFrame& frame) {
  double most = 0;
  for (const Imath::half value : frame.pixels) most = std::max(most, double{value});
  return most;
}

// What a display would show of a pixel value: the brightest are alike.
double shown(Imath::half value) { return value / (1 + double{value}); }

// Root of the mean square of the differences of all values, as they are shown: inside the horizon a
// few pixels, blueshifted without bound, would outweigh all others.
double distance(const HalfFrame& a, const HalfFrame& b) {
  double sum = 0;
  for (std::size_t k = 0; k < a.pixels.size(); ++k)
    sum += std::pow(shown(a.pixels[k]) - shown(b.pixels[k]), 2);
  return std::sqrt(sum / static_cast<double>(a.pixels.size()));
}

// The oracle is an image with as many more pixels, of one view ray each, whose pixels are
// averaged.  The samples of a panorama are filtered alike in both.  A batch of 128 view rays is not
// a multiple of 3 or 5; 16 by 16 of them fill two batches.
TEST(AntiAliasing, EverywhereIsTheMeanOfAsManyPixelsOfALargerImage) {
  constexpr int kSize = 48;
  for (const int samples : {2, 3, 5, 16}) {
    const HalfFrame frame = rendered(two_skies(kSize), {samples, true}),
                    large = rendered(two_skies(kSize * samples), {1, false, true});
    const double scale = largest_value(frame);
    int seen = 0;
    for (int y = kSize / 4; y < 3 * kSize / 4; ++y)
      for (int x = 3 * (kSize / 4); x < 3 * (3 * kSize / 4); ++x, ++seen) {
        double sum = 0;
        for (int b = 0; b < samples; ++b)
          for (int a = 0; a < samples; ++a)
            sum += large.row(samples * y + b)[3 * (samples * (x / 3) + a) + x % 3];
        // Both frames hold half floats, which are right to 2^-11 of the value.
        ASSERT_NEAR(frame.row(y)[x], sum / (samples * samples),
                    1e-3 * frame.row(y)[x] + 1e-6 * scale)
            << samples << " samples at " << x / 3 << " " << y;
      }
    EXPECT_GT(seen, 1000);
  }
}

TEST(AntiAliasing, HasFourSamplesAlongEachAxisByDefault) {
  const Show show = grid(StaticObserver{6}, Domemaster{96});
  const HalfFrame usual = Renderer(show, 2).render(frame_state(show, 0));
  EXPECT_TRUE(same_bytes(usual, rendered(show, {4, false})));
  EXPECT_FALSE(same_bytes(usual, rendered(show, {5, false})));
}

// An observer at rest sees one shift everywhere.  Then pixels that no border crosses have one
// colour, and nothing is lost by sampling them once.  Maps are filtered instead.
TEST(AntiAliasing, OfAGridIsThatOfSamplingEverywhere) {
  for (const double r : {2.1, 6.0, 30.0}) {
    const Show show = grid(StaticObserver{r}, Domemaster{96});
    EXPECT_TRUE(same_bytes(rendered(show, {4, false, true}), rendered(show, {4, true})));
  }
  EXPECT_FALSE(same_bytes(rendered(two_skies(96), {4, false}), rendered(two_skies(96), {4, true})));
}

TEST(AntiAliasing, WithOneSampleIsOneViewRayEverywhere) {
  const Show show = grid(StaticObserver{6}, Domemaster{96});
  EXPECT_TRUE(same_bytes(rendered(show, {1, false}), rendered(show, {1, true})));
}

TEST(AntiAliasing, RefusesNumbersOfSamplesThatItCannotTake) {
  const Show show = grid(StaticObserver{6}, Domemaster{16});
  for (const int samples : {-1, 0, kMostSamples + 1})
    EXPECT_THROW(Renderer(show, 1, {samples, false}), InputError) << samples;
  EXPECT_NO_THROW(rendered(show, {kMostSamples, true}));
}

TEST(AntiAliasing, MoreSamplesComeNearerToTheReference) {
  for (const Show& show :
       {grid(StaticObserver{10}, Domemaster{128}), grid(RadialInfall{0.5}, Domemaster{128}),
        grid(StaticObserver{30}, Stereographic{128, 128, 24 * kDegree})}) {
    const HalfFrame reference = rendered(show, kReferenceAntiAliasing);
    double before = HUGE_VAL;
    for (const int samples : {1, 2, 4}) {
      const double error = distance(rendered(show, {samples, false}), reference);
      EXPECT_LT(error, before) << samples << " at r = " << frame_state(show, 0).observer.r;
      before = error;
    }
  }
}

// The part of each pixel that is further than `edge` from the middle of the image, row by row.
std::vector<double> covered(int size, double fov, double edge) {
  constexpr int kPoints = 128;
  const Stereographic projection{size, size, fov};
  const auto beyond = [&](double i, double j) {
    return direction_at(projection, {i, j}).v.z < std::cos(edge) ? 1 : 0;
  };
  std::vector<double> parts;
  for (int y = 0; y < size; ++y)
    for (int x = 0; x < size; ++x) {
      const int corners = beyond(x + 0.5, y + 0.5) + beyond(x + 1.5, y + 0.5) +
                          beyond(x + 0.5, y + 1.5) + beyond(x + 1.5, y + 1.5);
      int points = 0;
      for (int k = 0; corners % 4 != 0 && k < kPoints * kPoints; ++k)
        points += beyond(x + 0.5 + (k % kPoints + 0.5) / kPoints,
                         y + 0.5 + (k / kPoints + 0.5) / kPoints);
      parts.push_back(corners % 4 == 0 ? corners / 4 : points / double{kPoints * kPoints});
    }
  return parts;
}

// An observer at rest sees an even sky as even.  What is left of a pixel's light is therefore the
// part of the pixel that the silhouette does not cover, a circle of sin(delta) = 3 sqrt 3 sqrt(1 -
// 2/r)/r.
TEST(AntiAliasing, TheSilhouettesEdgeComesNearerToTheCircleWithEachDoubling) {
  constexpr int kSize = 64;
  const double r = 10, edge = std::asin(3 * std::sqrt(3.0) / r * std::sqrt(1 - 2 / r));
  const PanoramaFile panorama(64, [](int) { return 1.0f; });
  Show show = show_of(StaticObserver{r}, Stereographic{kSize, kSize, 3 * edge});
  show.sky[SkyRegion::kI].background = PanoramaSky{panorama.path()};
  const std::vector<double> exact = covered(kSize, 3 * edge, edge);
  double before = HUGE_VAL;
  for (const int samples : {1, 2, 4, 8, 16}) {
    const HalfFrame frame = rendered(show, {samples, false});
    const double sky = frame.row(0)[0];
    double worst = 0, squares = 0;
    int pixels = 0;
    for (std::size_t k = 0; k < exact.size(); ++k) {
      const double error = frame.pixels[3 * k] / sky - exact[k];
      worst = std::max(worst, std::abs(error));
      if (exact[k] <= 0 || exact[k] >= 1) continue;
      squares += error * error;
      ++pixels;
    }
    ASSERT_GT(pixels, 100);
    const double rms = std::sqrt(squares / pixels);
    EXPECT_LT(rms, before / 1.5) << samples;
    // Samples stand 1/samples apart, so that a straight edge is misplaced by up to half of that.
    // The circle bends by 0.006 of a pixel within one, and a half float adds 0.0005.
    EXPECT_LT(worst, 0.5 / samples + 0.0065) << samples;
    before = rms;
  }
}

// The renderer throws if a pixel is not finite.  The observers are beside the singularity, where
// the hole fills half the sky, just above the horizon, where the whole sky is a disc of 0.07
// degrees, far away, and next to the circular orbit of light.
TEST(AntiAliasing, LeavesNoPixelThatIsNotFinite) {
  std::vector<Show> shows;
  for (const Trajectory& trajectory :
       {Trajectory(RadialInfall{1e-3}), Trajectory(StaticObserver{2.0000001}),
        Trajectory(StaticObserver{1e6}), Trajectory(CircularOrbit{3.0000001})})
    shows.push_back(grid(trajectory, Domemaster{64}));
  shows.push_back(grid(StaticObserver{2.0000001}, Stereographic{64, 64, 0.1 * kDegree}));
  shows.back().timeline[0].camera.attitude = LookAtSky{{-shows.back().hole_at.v}};
  for (Show& show : shows)
    for (const AntiAliasing setting : {AntiAliasing{1, false}, AntiAliasing{2, false},
                                       AntiAliasing{8, false}, AntiAliasing{5, true}}) {
      const double r = frame_state(show, 0).observer.r;
      // The disc is behind the audience of the dome.
      const bool dark = r < 2.1 && r > 2 && std::holds_alternative<Domemaster>(show.projection);
      show.sky[SkyRegion::kI].background = show.sky[SkyRegion::kIII].background = GridSky{};
      EXPECT_NO_THROW(EXPECT_EQ(largest_value(rendered(show, setting)) == 0, dark)) << r;
      show.sky[SkyRegion::kI].background = show.sky[SkyRegion::kIII].background =
          PanoramaSky{small_panorama()};
      EXPECT_NO_THROW(EXPECT_EQ(largest_value(rendered(show, setting)) == 0, dark)) << r;
    }
}

}  // namespace
}  // namespace domefall
