// Discs against Gyoto, another program for the same physics (tests/reference/gyoto_discs.csv).
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <fstream>
#include <numbers>
#include <optional>
#include <sstream>
#include <string>
#include <vector>

#include "pipeline/light/aberration.h"
#include "pipeline/light/kerr_ray.h"
#include "pipeline/sources/disc/disc_light.h"
#include "tests/pipeline/sources/disc/disc_tracer.h"
#include "tests/source_tree.h"

namespace domefall {
namespace {

struct GyotoPixel {
  double spin, inclination, right, up, frequency_ratio, flux;
};

std::vector<GyotoPixel> gyoto_pixels() {
  std::ifstream file(source_file("tests/reference/gyoto_discs.csv"));
  std::vector<GyotoPixel> pixels;
  for (std::string line; std::getline(file, line);) {
    std::istringstream cells(line);
    std::array<double, 6> v{};
    std::size_t read = 0;
    for (std::string cell; read < v.size() && std::getline(cells, cell, ',');) {
      if (cell.find_first_of("#abcdefghijklmnopqrstuvwxyz") == 0) break;
      v[read++] = std::stod(cell);
    }
    if (read == v.size()) pixels.push_back({v[0], v[1], v[2], v[3], v[4], v[5]});
  }
  return pixels;
}

constexpr double kAt = 1e4;

struct SeenGas {
  double ratio, flux;
};

// The first gas up to r = 20 on the ray, as who rests at r = 10,000 sees it.
std::optional<SeenGas> seen_without_spin(const GyotoPixel& pixel,
                                         const PageThorneProfile& profile) {
  const double delta = std::asin(std::hypot(pixel.right, pixel.up));
  const double chi = std::atan2(pixel.right, -pixel.up);
  const V3d normal = normal_at(pixel.inclination * std::numbers::pi / 180);
  const NullRay ray = ray_at(kAt, delta, {false, true});
  double psi = first_crossing(kPlace, tangent_at(chi), normal);
  for (int order = 0; order < 3; ++order, psi += std::numbers::pi) {
    const auto r = exact_position(ray, psi);
    if (!r || *r < 6 || *r > 20) continue;
    const double g = 1 / shift_at_rest(kAt, delta, chi, normal, *r);
    return SeenGas{g, profile.flux(*r) * g * g * g * g};
  }
  return std::nullopt;
}

std::optional<SeenGas> seen_about_spin(const GyotoPixel& pixel, const PageThorneProfile& profile) {
  const KerrHole hole{pixel.spin};
  const KerrPlace at{hole, kAt, pixel.inclination * std::numbers::pi / 180};
  // From who rests to the tetrad T, against which that one falls back, and turns back about the axis.
  const double sine = std::sin(static_cast<double>(at.theta)), a = pixel.spin;
  const auto sigma = static_cast<double>(at.r * at.r + at.sigma()),
             above = static_cast<double>(at.delta());
  const double time2 = 1 - 2 * kAt / sigma, energy = std::sqrt(time2),
               momentum = -2 * a * kAt * sine * sine / (sigma * energy);
  const double p = (kAt * kAt + a * a) * energy - a * momentum;
  const V3d rest((p / above - p / sigma) / 2, 0,
                 (momentum / sine - a * energy * sine) / std::sqrt(sigma));
  const double away = std::sqrt(1 - pixel.right * pixel.right - pixel.up * pixel.up);
  const AberratedLight light = to_tetrad(rest, V3d(-away, -pixel.up, pixel.right));
  const V3d& n = light.direction;
  const double delta = std::atan2(std::hypot(n.y, n.z), -n.x), eta = std::atan2(-n.z, -n.y);
  const GasOrbits gas(hole, false);
  for (const KerrPassage& passage : kerr_passages(at, {delta, eta}, 3)) {
    if (passage.r < gas.last_stable() || passage.r > 20) continue;
    const double g = 1 / (light.frequency_ratio * circling_shift(hole, passage, true).value());
    return SeenGas{g, profile.flux(passage.r) * g * g * g * g};
  }
  return std::nullopt;
}

TEST(GyotoDiscs, AreTheSame) {
  const std::vector<GyotoPixel> pixels = gyoto_pixels();
  ASSERT_EQ(pixels.size(), 1600u);
  int views = 0;
  for (const double spin : {0.0, 0.9})
    for (const double inclination : {1.0, 20.0, 80.0}) {
      const GasOrbits gas = spin > 0 ? GasOrbits(KerrHole{spin}, false) : GasOrbits();
      const PageThorneProfile profile(false, gas);
      const auto seen_at = [&](const GyotoPixel& pixel) {
        return spin > 0 ? seen_about_spin(pixel, profile) : seen_without_spin(pixel, profile);
      };
      double brightest = 0;
      int met = 0;
      for (const GyotoPixel& pixel : pixels)
        if (pixel.inclination == inclination && pixel.spin == spin)
          if (const auto seen = seen_at(pixel)) brightest = std::max(brightest, seen->flux);
      for (const GyotoPixel& pixel : pixels) {
        if (pixel.inclination != inclination || pixel.spin != spin) continue;
        const auto seen = seen_at(pixel);
        ASSERT_EQ(seen.has_value(), pixel.flux > 0) << pixel.right << " " << pixel.up;
        if (!seen) continue;
        ++met;
        // What Gyoto's steps leave.
        EXPECT_NEAR(seen->ratio / pixel.frequency_ratio, 1, spin > 0 ? 5e-5 : 1e-5)
            << inclination << ' ' << pixel.right << " " << pixel.up;
        EXPECT_NEAR(seen->flux / brightest / pixel.flux, 1, spin > 0 ? 2e-3 : 3e-4)
            << inclination << ' ' << pixel.right << " " << pixel.up;
      }
      if (met == 0) continue;
      EXPECT_GT(met, 60);
      ++views;
    }
  EXPECT_EQ(views, 4);
}

}  // namespace
}  // namespace domefall
