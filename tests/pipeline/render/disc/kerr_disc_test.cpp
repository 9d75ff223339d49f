// Discs about a hole that spins.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "pipeline/light/kerr_plane.h"
#include "pipeline/light/kerr_ray.h"
#include "pipeline/light/kerr_view.h"
#include "tests/pipeline/render/disc/disc_views.h"
#include "tests/pipeline/show/show_file.h"

namespace domefall {
namespace {

class KerrDisc : public ShowFile {
 protected:
  Show show(const std::string& spin, const std::string& gas, const std::string& at) {
    return read(
        "size: [96, 96]\ncamera: {projection: rectilinear, fov_deg: 70, look_at: hole}\n"
        "glare: {share: 0}\nsky: {region_I: {background: black, stars: {max_magnitude: -9}}}\n"
        "black_hole: {mass_solar: 1e8" +
        spin + "}\n" + gas + "\ntimeline:\n  - {duration_s: 1, trajectory: {type: static, " + at +
        "}}\n");
  }
  // Returns the mean difference of two frames over the mean light, and the part of the pixels that
  // differ by more than 1 % of that or of themselves.
  static std::pair<double, double> differences(const FloatImage& a, const FloatImage& b) {
    double light = 0, off = 0;
    int differ = 0;
    for (int row = 0; row < a.height; ++row)
      for (int column = 0; column < a.width; ++column) light += double{pixel_at(a, column, row).g};
    const double mean = light / (a.height * a.width);
    for (int row = 0; row < a.height; ++row)
      for (int column = 0; column < a.width; ++column) {
        const double x = double{pixel_at(a, column, row).g}, y = double{pixel_at(b, column, row).g};
        off += std::abs(x - y);
        differ += std::abs(x - y) > 0.01 * std::max({x, y, mean});
      }
    return {off / light, differ / static_cast<double>(a.height * a.width)};
  }
};

TEST_F(KerrDisc, GoesOverIntoThatWithoutSpin) {
  for (const char* const kind :
       {"disc: {outer_r: 20", "disc: {outer_r: 12, plunging: true, optical_depth: 1",
        "disc: {outer_r: 20, height: 0.1, optical_depth: 1", "halo: {r: 5", "jet: {r: 6"}) {
    const std::string gas = kind;
    const FloatImage still =
        render_floats(show("", gas + ", inclination_deg: 20, node_deg: 90}", "r: 30"));
    const FloatImage slow =
        render_floats(show(", spin: 1e-9", gas + "}", "r: 30, latitude_deg: 20"));
    const auto [mean, differ] = differences(still, slow);
    EXPECT_LT(mean, 8e-3) << gas;
    EXPECT_LT(differ, 0.03) << gas;  // along rims, which are a pixel wide
  }
}

// Images thinner than a pixel are lines of as much light as in a frame of smaller pixels, all around.
TEST_F(KerrDisc, HasEvenLightInThinImages) {
  constexpr int kSize = 96, kFiner = 4, kSectors = 36;
  const Show s = show(", spin: 0.9", "disc: {retrograde: true}", "r: 30, latitude_deg: 30");
  Renderer renderer(s, 1);
  const auto frame = [&](int size, double field) {
    FrameState state = frame_state(s, 0);
    state.projection = Rectilinear{size, size, field};
    FloatImage image;
    renderer.render(state, image);
    return image;
  };
  // The second image about the hole, and the third with parts of the second.
  for (const double degrees : {30.0, 20.0}) {
    const FloatImage coarse = frame(kSize, degrees * kDegree),
                     fine = frame(kSize * kFiner, degrees * kDegree);
    std::array<double, kSectors> light{}, truth{};
    for (int row = 0; row < fine.height; ++row)
      for (int column = 0; column < fine.width; ++column) {
        const int i = column / kFiner, j = row / kFiner;
        constexpr double kMiddle = (kSize - 1) / 2.0;
        const double turn = std::atan2(j - kMiddle, i - kMiddle) / (2 * std::numbers::pi) + 0.5;
        const auto sector = static_cast<std::size_t>(turn * kSectors) % kSectors;
        truth[sector] += double{pixel_at(fine, column, row).g};
        light[sector] += double{pixel_at(coarse, i, j).g};
      }
    int seen = 0;
    for (std::size_t k = 0; k < kSectors; ++k) {
      if (truth[k] == 0) continue;  // the images are beyond the frame
      EXPECT_NEAR(light[k] / truth[k], 1, 0.12) << degrees << ' ' << k;
      ++seen;
    }
    EXPECT_GE(seen, 28) << degrees;
  }
}

// Places, shifts and azimuths are those of exact rays.
TEST_F(KerrDisc, IsSeenAlongExactRays) {
  const Show s = show(", spin: 0.9", "disc: {outer_r: 20}", "r: 15, latitude_deg: 30");
  const auto& hole = std::get<SpinningHole>(s.spacetime.kind());
  const KerrPlace at{hole.kerr, 15, std::numbers::pi / 3};
  const KerrPlane plane(at, {s.disc->inner, s.disc->outer});
  int seen = 0;
  for (int k = 0; k < 400; ++k) {
    const double delta = 0.05 + 0.0025 * k, eta = 2.4 * k;
    const KerrPlane::Sight sight = plane.sight(delta, eta);
    const auto passages = kerr_passages(at, {delta, eta}, KerrPlane::kOrders);
    for (std::size_t n = 0; n < passages.size(); ++n) {
      const KerrPassage& exact = passages[n];
      if (exact.r < s.disc->inner || exact.r > s.disc->outer) continue;
      ASSERT_TRUE(sight.crosses[n]) << delta << ' ' << eta;
      const KerrPlane::Crossing& found = sight.at[n];
      EXPECT_NEAR(found.w.value * exact.r, 1, 1e-5);
      EXPECT_NEAR(std::remainder(found.angle.value - exact.phi, 2 * std::numbers::pi), 0, 1e-3);
      EXPECT_NEAR(found.time.value, exact.null_time, 1e-3);
      EXPECT_EQ(found.speed.value > 0, exact.outgoing);
      EXPECT_NEAR(disc_shift(s.disc->orbits, {sight.energy, sight.momentum, sight.about_axis},
                             exact.r, exact.outgoing),
                  circling_shift(hole.kerr, exact, true).value(), 1e-10);
      ++seen;
    }
  }
  EXPECT_GT(seen, 150);
  // Next to the edge no image is lost.
  int beside = 0;
  for (const double way : {-1e-4, -1e-7, -1e-12, 1e-12, 1e-7, 1e-4})
    for (double eta = 0; eta < 6; eta += 0.3) {
      const double delta = kerr_edge_delta(at, eta) + way;
      const KerrPlane::Sight sight = plane.sight(delta, eta);
      const double r = kerr_passages(at, {delta, eta}, 1).at(0).r;
      if (r < s.disc->inner || r > s.disc->outer) continue;
      ++beside;
      ASSERT_TRUE(sight.crosses[0]) << way << ' ' << eta;
      EXPECT_NEAR(sight.at[0].w.value * r, 1, 1e-4) << way << ' ' << eta;
    }
  EXPECT_GT(beside, 50);
}

// Roundings of the place, which is in the plane, do not make its own gas a sheet before the observer.
TEST(KerrPlane, IsSeenEdgeOnFromWithinIt) {
  int seen = 0;
  for (const long double off : {-1e-16L, 0.0L, 1e-16L}) {
    const KerrPlace at{{0.9999L, 0}, 1.2L, std::numbers::pi_v<long double> / 2 + off};
    const KerrPlane plane(at, {static_cast<double>(at.hole.horizon()), 10}, 4);
    for (const double eta : {-2.8, -2.0, -1.0, -0.3, 0.3, 1.0, 2.0, 2.8})
      for (double delta = 0.05; delta < 3.1; delta += 0.05) {
        if (KerrConstants(at, delta, eta).energy > -1e-3) continue;
        const KerrPlane::Sight sight = plane.exact_sight(delta, eta);
        ++seen;
        if (sight.crosses[0]) {
          EXPECT_GT(std::abs(sight.at[0].w.value * 1.2 - 1), 1e-6) << delta << ' ' << eta;
        }
      }
  }
  EXPECT_GT(seen, 100);
}

// All rings may lie between one row or column of nodes and the next.
TEST(KerrPlane, IsSeenFromNextToIt) {
  constexpr double kLatitude = 0.05 * std::numbers::pi / 180, kInner = 2.32, kOuter = 20;
  const KerrPlace at{{0.9L, 0}, 40, std::numbers::pi / 2 - kLatitude};
  const KerrPlane plane(at, {kInner, kOuter});
  int seen = 0;
  for (int k = -40; k <= 40; ++k)
    for (const double down : {5e-4, 6e-4, 7e-4, 8e-4}) {
      const V3d view = V3d(-1, down, 1e-3 * k).normalized();
      const KerrDirection n = kerr_direction_of(view);
      const auto delta = static_cast<double>(n.delta), eta = static_cast<double>(n.eta);
      const auto exact = kerr_passages(at, n, 1);
      if (exact.empty() || exact[0].r < kInner || exact[0].r > kOuter) continue;
      const KerrPlane::Sight sight = plane.sight(delta, eta);
      ASSERT_TRUE(sight.crosses[0]) << k << ' ' << down;
      EXPECT_NEAR(sight.at[0].w.value * exact[0].r, 1, 1e-3) << k << ' ' << down;
      ++seen;
    }
  EXPECT_GT(seen, 150);
}

// Light of E < 0 leaves gas in the ergosphere as that of E > 0 does, and is followed in another way.
TEST(KerrPlane, GoesThroughLightOfNoEnergy) {
  constexpr double kStep = 1e-4;
  constexpr int kSteps = 100;
  constexpr double kEta = -2.2;
  for (const double r : {1.3, 1.6}) {
    const KerrPlace at{{0.9L, 0}, r, 1};
    const KerrPlane plane(at, {static_cast<double>(at.hole.horizon()), 14});
    double still = std::numbers::pi;
    while (still > 0 && KerrConstants(at, still, kEta).energy > 0) still -= kStep;
    ASSERT_GT(still, 0);
    std::vector<KerrPlane::Crossing> seen;
    for (int k = -kSteps; k <= kSteps; ++k) {
      const KerrPlane::Sight sight = plane.exact_sight(still + k * kStep, kEta);
      ASSERT_TRUE(sight.from_region_one && sight.crosses[0]) << r << ' ' << k;
      seen.push_back(sight.at[0]);
    }
    const auto bend = [&seen](KerrPlane::Value KerrPlane::Crossing::*of) {
      double worst = 0;
      for (std::size_t k = 2; k < seen.size(); ++k)
        worst = std::max(worst, std::abs((seen[k].*of).value - 2 * (seen[k - 1].*of).value +
                                         (seen[k - 2].*of).value));
      return worst;
    };
    EXPECT_LT(bend(&KerrPlane::Crossing::w), 1e-7) << r;
    EXPECT_LT(bend(&KerrPlane::Crossing::angle), 1e-3) << r;
    EXPECT_LT(bend(&KerrPlane::Crossing::time), 5e-3) << r;
    EXPECT_LT(bend(&KerrPlane::Crossing::speed), 1e-4) << r;
  }
}

}  // namespace
}  // namespace domefall
