#include "pipeline/render/anti_aliasing.h"

#include <gtest/gtest.h>

#include <cstring>

#include "pipeline/image/errors.h"
#include "scenes.h"

namespace domefall {
namespace {

HalfFrame rendered(const Show& show, AntiAliasing anti_aliasing) {
  return Renderer(show, 2, anti_aliasing).render(frame_state(show, 0));
}

// Inside the horizon, with two panoramas.
Show two_skies(int size) {
  Show show = starry(show_of(RadialInfall{0.5}, Domemaster{size}));
  show.sky_one.stars = show.sky_three.stars = std::nullopt;
  return show;
}

Show grid(const Trajectory& trajectory, const Projection& projection) {
  Show show = show_of(trajectory, projection);
  show.sky_one.background = show.sky_three.background = GridSky{};
  return show;
}

bool same_bytes(const HalfFrame& a, const HalfFrame& b) {
  return a.pixels.size() == b.pixels.size() &&
         std::memcmp(a.pixels.data(), b.pixels.data(), a.pixels.size() * sizeof a.pixels[0]) == 0;
}

double largest(const HalfFrame& frame) {
  double most = 0;
  for (const Imath::half value : frame.pixels) most = std::max(most, double{value});
  return most;
}

// A display's answer to a pixel: the brightest are alike to it.
double shown(Imath::half value) { return value / (1 + double{value}); }

// Root of the mean square of the differences of all values, as they are shown: inside the horizon a
// few pixels, blueshifted without bound, would outweigh the picture.
double distance(const HalfFrame& a, const HalfFrame& b) {
  double sum = 0;
  for (std::size_t k = 0; k < a.pixels.size(); ++k)
    sum += std::pow(shown(a.pixels[k]) - shown(b.pixels[k]), 2);
  return std::sqrt(sum / static_cast<double>(a.pixels.size()));
}

// The oracle: a picture with so many more pixels, each with one look, made smaller.  A panorama's
// looks are filtered alike in both.  3 and 5 leave a rest in a batch of 128 looks, 16 x 16 are two.
TEST(AntiAliasing, EverywhereIsTheMeanOfAsManyPixelsOfALargerPicture) {
  constexpr int kSize = 48;
  for (const int samples : {2, 3, 5, 16}) {
    const HalfFrame frame = rendered(two_skies(kSize), {samples, true}),
                    large = rendered(two_skies(kSize * samples), {1, false});
    const double scale = largest(frame);
    int seen = 0;
    for (int y = kSize / 4; y < 3 * kSize / 4; ++y)
      for (int x = 3 * (kSize / 4); x < 3 * (3 * kSize / 4); ++x, ++seen) {
        double sum = 0;
        for (int b = 0; b < samples; ++b)
          for (int a = 0; a < samples; ++a)
            sum += large.row(samples * y + b)[3 * (samples * (x / 3) + a) + x % 3];
        // Halves: 2^-11 of the value in each picture.
        ASSERT_NEAR(frame.row(y)[x], sum / (samples * samples),
                    1e-3 * frame.row(y)[x] + 1e-6 * scale)
            << samples << " samples at " << x / 3 << " " << y;
      }
    EXPECT_GT(seen, 1000);
  }
}

TEST(AntiAliasing, HasFourSamplesAlongEachAxisUnlessToldOtherwise) {
  const Show show = grid(StaticObserver{6}, Domemaster{96});
  const HalfFrame usual = Renderer(show, 2).render(frame_state(show, 0));
  EXPECT_TRUE(same_bytes(usual, rendered(show, {4, false})));
  EXPECT_FALSE(same_bytes(usual, rendered(show, {5, false})));
  EXPECT_FALSE(same_bytes(usual, rendered(show, {4, true})));
}

TEST(AntiAliasing, WithOneSampleIsOneLookEverywhere) {
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

}  // namespace
}  // namespace domefall
