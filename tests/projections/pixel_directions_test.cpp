#include "projections/pixel_directions.h"

#include <gtest/gtest.h>

#include <random>
#include <vector>

namespace domefall {
namespace {

TEST(PixelDirections, AreThoseOfTheProjection) {
  std::mt19937 random(1);
  for (const Projection& p :
       {Projection(Domemaster{1}), Projection(Domemaster{777}),
        Projection(Stereographic{64, 40, 2.0}), Projection(Stereographic{500, 500, 6.0}),
        Projection(Rectilinear{640, 360, 2.5}), Projection(Fisheye{801, 600, 4.2, 0.25}),
        Projection(Fisheye{500, 500, 6.28, 0}), Projection(Equirectangular{800}),
        Projection(Cubemap{77}), Projection(Rectilinear{640, 360, 2.5, 2}),
        Projection(Stereographic{500, 300, 4.0, 0.75}),
        Projection(Fisheye{300, 590, 3, 0.25, 2})}) {
    std::uniform_real_distribution<double> i(0.5, columns(p) + 0.5), j(0.5, rows(p) + 0.5);
    constexpr int kCount = 1003;
    std::vector<double> at_i, at_j, angle(kCount);
    for (int k = 0; k < kCount; ++k) {
      at_i.push_back(i(random));
      at_j.push_back(j(random));
    }
    std::vector<CameraDirection> n(kCount);
    find_directions(p, at_i.data(), at_j.data(), kCount, n.data(), angle.data());
    for (std::size_t k = 0; k < kCount; ++k) {
      const PixelPosition at{at_i[k], at_j[k]};
      // A dome's corners are 0.71 pi from its middle.
      EXPECT_LT((n[k].v - direction_at(p, at).v).length(), is_inside(p, at) ? 1e-15 : 1e-14);
      EXPECT_NEAR(angle[k], pixel_angle(p, at), 1e-15 * angle[k]);
    }
  }
}

}  // namespace
}  // namespace domefall
