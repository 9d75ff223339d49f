// The disc against Gyoto, another program for the same physics (tests/reference/gyoto_discs.csv).
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <fstream>
#include <optional>
#include <sstream>
#include <string>
#include <vector>

#include "pipeline/disc/page_thorne.h"
#include "tests/pipeline/disc/disc_tracer.h"
#include "tests/source_tree.h"

namespace domefall {
namespace {

struct GyotoPixel {
  double inclination, right, up, frequency_ratio, flux;
};

std::vector<GyotoPixel> gyoto_pixels() {
  std::ifstream file(source_file("tests/reference/gyoto_discs.csv"));
  std::vector<GyotoPixel> pixels;
  for (std::string line; std::getline(file, line);) {
    std::istringstream cells(line);
    std::array<double, 5> v{};
    std::size_t read = 0;
    for (std::string cell; read < v.size() && std::getline(cells, cell, ',');) {
      if (cell.find_first_of("#abcdefghijklmnopqrstuvwxyz") == 0) break;
      v[read++] = std::stod(cell);
    }
    if (read == v.size()) pixels.push_back({v[0], v[1], v[2], v[3], v[4]});
  }
  return pixels;
}

struct SeenGas {
  double ratio, flux;
};

// The first gas between r = 6 and 20 on the ray, as who rests at r = 10,000 sees it.
std::optional<SeenGas> seen_at(const GyotoPixel& pixel, const PageThorneProfile& profile) {
  constexpr double kAt = 1e4;
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

TEST(GyotoDiscs, AreTheSame) {
  const std::vector<GyotoPixel> pixels = gyoto_pixels();
  ASSERT_EQ(pixels.size(), 800u);
  const PageThorneProfile profile(false);
  for (const double inclination : {1.0, 80.0}) {
    double brightest = 0;
    for (const GyotoPixel& pixel : pixels)
      if (pixel.inclination == inclination)
        if (const auto seen = seen_at(pixel, profile)) brightest = std::max(brightest, seen->flux);
    int met = 0;
    for (const GyotoPixel& pixel : pixels) {
      if (pixel.inclination != inclination) continue;
      const auto seen = seen_at(pixel, profile);
      ASSERT_EQ(seen.has_value(), pixel.flux > 0) << pixel.right << " " << pixel.up;
      if (!seen) continue;
      ++met;
      // What Gyoto's steps leave.
      EXPECT_NEAR(seen->ratio / pixel.frequency_ratio, 1, 1e-5);
      EXPECT_NEAR(seen->flux / brightest / pixel.flux, 1, 3e-4) << pixel.right << " " << pixel.up;
    }
    EXPECT_GT(met, 60);
  }
}

}  // namespace
}  // namespace domefall
