// The rings of a sphere against rays that are followed by steps, and against flat space.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "pipeline/light/sphere_surface.h"
#include "tests/pipeline/light/resting_body.h"
#include "tests/pipeline/light/sphere_scene.h"

namespace domefall {
namespace {

using std::numbers::pi;

const V3d kTilted = V3d(0.3, 0.5, 0.8).normalized();

RingedSphere ringed(const SphereScene& scene, int order, const RingPlane& rings, double pieces) {
  const PlaceView view{scene.observer, false, false};
  const auto image = image_of_body(view, 0, scene.motion, order, scene.radius);
  const Spacetime spacetime{Schwarzschild{}};
  const auto place = [&](double r, double psi) { return seen_place(view, 0, r, psi); };
  const double spacing = std::min(size_of_sphere(*image, scene.radius), 1.0) / pieces;
  auto found = traced_with_rings({place, spacetime, scene.observer}, scene.motion, *image,
                                 scene.radius, rings, [&](const V3d&) { return spacing; });
  EXPECT_TRUE(found);
  return found ? std::move(*found) : RingedSphere{};
}

struct Seen {
  explicit Seen(const RingPiece& piece) : at(piece.at.direction.v) {}
  double angle() const { return std::atan2(std::hypot(at.y, at.z), -at.x); }
  V3d e() const { return V3d(0, at.y, at.z) / std::hypot(at.y, at.z); }
  V3d at;
};

// Places are where rays meet the plane, and ring ends are where those meet its edges.
void expect_rings(const SphereScene& scene, int order) {
  SCOPED_TRACE(testing::Message() << scene.observer << " " << scene.radius << " " << order);
  const RingPlane rings{kTilted, {{1.3, 1.7}, {1.8, 2.2}}};
  const std::vector<RingPiece> pieces = ringed(scene, order, rings, 150).rings;
  ASSERT_GT(pieces.size(), 200u);
  int edges = 0;
  for (std::size_t k = 2; k + 3 < pieces.size(); k += 41) {
    const Seen a(pieces[k]), b(pieces[k + 1]), c(pieces[k + 2]);
    const double apart = (pieces[k + 1].place - pieces[k].place).length(),
                 angle = std::abs(b.angle() - a.angle());
    const auto is_chord = [&](const Seen& other) { return a.e().cross(other.e()).length() < 1e-9; };
    if (!is_chord(b) || !is_chord(c) || std::sin(a.angle()) < 1e-3) continue;
    if (pieces[k].ring != pieces[k + 1].ring || pieces[k].ring != pieces[k + 2].ring) continue;
    const double pixel = kPixel * apart / angle;  // in radii
    const V3d met = scene.on_plane(a.e(), a.angle(), kTilted, pieces[k].place);
    EXPECT_LT((met - pieces[k].place).length(), 0.1 * pixel) << k;
    EXPECT_NEAR(met.dot(kTilted), 0, 1e-9);
  }
  // The first pieces of a ring's chord are next to its edge, by a parabola half a piece after it.
  const auto try_edge = [&](std::size_t before, std::size_t first, std::size_t second,
                            std::size_t third) {
    const Seen a(pieces[first]), b(pieces[second]), c(pieces[third]);
    const auto is_part = [&](std::size_t k) {
      return pieces[k].ring == pieces[first].ring &&
             a.e().cross(Seen(pieces[k]).e()).length() < 1e-9;
    };
    const double step = b.angle() - a.angle();
    if (is_part(before) || !is_part(second) || !is_part(third) || edges > 100 ||
        std::abs((c.angle() - b.angle()) / step - 1) > 0.05)
      return;
    const double rim = (15 * a.angle() - 10 * b.angle() + 3 * c.angle()) / 8,
                 pixel = kPixel * (pieces[second].place - pieces[first].place).length() /
                         std::abs(step),
                 met = scene.on_plane(a.e(), rim, kTilted, pieces[first].place).length();
    const auto& [inner, outer] = rings.edges[static_cast<std::size_t>(pieces[first].ring)];
    const double off = std::min(std::abs(met - inner), std::abs(met - outer));
    // What is left of it may begin at the sphere's limb.
    if (scene.meets(a.e(), rim - 0.2 * step, 0, 2 * pi)) return;
    EXPECT_LT(off, 0.1 * pixel) << first << " " << met;
    ++edges;
  };
  for (std::size_t k = 1; k + 3 < pieces.size(); ++k) {
    try_edge(k - 1, k, k + 1, k + 2);
    try_edge(k + 3, k + 2, k + 1, k);
  }
  EXPECT_GT(edges, 20);
}

TEST(SphereRings, AreWhereRaysMeetTheirPlane) {
  for (const int order : {0, 1}) {
    expect_rings({12, resting_body(10, V3d(std::cos(1.5), std::sin(1.5), 0)), 1.5}, order);
    expect_rings({30, circling(8, 1), 1}, order);
    expect_rings({30, resting_body(10, V3d(std::cos(3.0), std::sin(3.0), 0)), 1.5}, order);
  }
}

// Returns the solid angles in the picture of a sphere and a ring from far away, by counting places.
struct Flat {
  double sphere = 0, through = 0, ring = 0;
};
Flat flat_picture(double tilt, double inner, double outer) {
  constexpr int kSide = 2000;
  const double step = 2 * outer / kSide, cosine = std::cos(tilt), sine = std::sin(tilt);
  Flat seen;
  for (int i = 0; i < kSide; ++i)
    for (int j = 0; j < kSide; ++j) {
      const double x = (i + 0.5) * step - outer, y = (j + 0.5) * step - outer;
      // The ring is y = d cosine in the picture and d sine nearer.
      const double d = y / cosine, radius = std::hypot(x, d);
      const bool ball =
          std::hypot(x, y)<1, ring = radius> inner && radius<outer, before = d * sine> 0;
      seen.sphere += ball ? step * step : 0;
      seen.through += ball && ring && before ? step * step : 0;
      seen.ring += ring && !(ball && !before) ? step * step : 0;
    }
  return seen;
}

TEST(SphereRings, HideTheSphereAndAreHiddenByIt) {
  const double observer = 4e6, r = 2e6, tilt = 1.3, inner = 1.2, outer = 2.3;
  const V3d body(std::cos(0.3), std::sin(0.3), 0);
  const V3d view = (V3d(observer, 0, 0) - body * r).normalized(), aside(-view.y, view.x, 0);
  const RingPlane rings{view * std::cos(tilt) + aside * std::sin(tilt), {{inner, outer}}};
  const double radius = 100, distance2 = (V3d(observer, 0, 0) - body * r).length2();
  const RingedSphere seen = ringed({observer, resting_body(r, body), radius}, 0, rings, 200);
  const Flat flat = flat_picture(tilt, inner, outer);
  double sphere = 0, through = 0, ring = 0;
  for (const SpherePiece& piece : seen.sphere) {
    sphere += piece.at.amplification;
    if (piece.through.ring < 0) continue;
    through += piece.at.amplification;
    EXPECT_NEAR(piece.through.steepness, std::cos(tilt), 2e-3);
  }
  for (const RingPiece& piece : seen.rings) ring += piece.at.amplification;
  const double unit = radius * radius / distance2;
  EXPECT_NEAR(sphere / unit, flat.sphere, 0.01);
  EXPECT_NEAR(through / unit, flat.through, 0.01);
  EXPECT_NEAR(ring / unit, flat.ring, 0.02);
  EXPECT_GT(flat.through, 0.1);
}

}  // namespace
}  // namespace domefall
