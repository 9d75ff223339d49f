// The lenses of charged holes and of wormholes, which are that of one class with other zones.
#include "pipeline/light/spherical_lens.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

#include "pipeline/light/aberration.h"
#include "pipeline/light/charged_lens.h"
#include "pipeline/light/lens_store.h"
#include "pipeline/light/wormhole_azimuth.h"
#include "tests/pipeline/light/random_rays.h"
#include "trajectories/static_observer.h"

namespace domefall {
namespace {

ObserverState near_charge(double charge, double r, Region region = Region::kI,
                          Tetrad tetrad = Tetrad::kRain, int universe = 0) {
  ObserverState o;
  o.spacetime = ChargedHole(1, charge);
  o.r = r, o.region = region, o.tetrad = tetrad, o.universe = universe;
  return o;
}

ObserverState in_wormhole(const Wormhole& wormhole, double l) {
  ObserverState o;
  o.spacetime = wormhole;
  o.r = wormhole.radius(l), o.l = l, o.region = Wormhole::side(l);
  return o;
}

std::vector<ObserverState> observers() {
  std::vector<ObserverState> all;
  for (const double q : {1e-3, 0.5, 0.8, 0.99, 1.0}) {
    const double outer = ChargedHole(1, q).horizon(), inner = ChargedHole(1, q).inner_horizon();
    for (const double r : {outer * 1.01, 2.9, 8.0, 1e4}) {
      all.push_back(near_charge(q, r));
      all.push_back(near_charge(q, r, Region::kI, Tetrad::kOutgoing));
      all.push_back(near_charge(q, r, Region::kIII, Tetrad::kRainOfThree));
      for (const Tetrad tetrad : {Tetrad::kRain, Tetrad::kOutgoing})
        all.push_back(near_charge(q, r, Region::kI, tetrad, 1));
    }
    if (q < 1)
      for (const double part : {0.05, 0.5, 0.98}) {
        const double r = inner + part * (outer - inner);
        all.push_back(near_charge(q, r, Region::kII));
        all.push_back(near_charge(q, r, Region::kII, Tetrad::kRainOfThree, 1));
        all.push_back(near_charge(q, r, Region::kIV, Tetrad::kOutgoing, 1));
        all.push_back(near_charge(q, r, Region::kIV, Tetrad::kOutgoingToThree, 2));
      }
    for (const double part : {0.05, 0.8, 0.9, 0.999}) {
      all.push_back(near_charge(q, part * inner, Region::kV));
      all.push_back(near_charge(q, part * inner, Region::kV, Tetrad::kOutgoing));
      all.push_back(near_charge(q, part * inner, Region::kVI, Tetrad::kOutgoingToThree, 1));
    }
  }
  for (const double q : {1.0001, 1.05, 1.2, 5.0})
    for (const double r : {0.05, 0.7, 1.2, 1.9, 6.0, 1e3}) all.push_back(near_charge(q, r));
  for (const Wormhole& w :
       {Wormhole{1, Wormhole::Profile::kEllis}, Wormhole{1, Wormhole::Profile::kDngr, 0.01, 0.05},
        Wormhole{1, Wormhole::Profile::kDngr, 3, 0.8}})
    for (const double l : {-300.0, -2.5, -1e-3, 0.0, 0.2, 4.0, 1e4})
      all.push_back(in_wormhole(w, l));
  return all;
}

std::string name_of(const ObserverState& o) {
  std::string name = "kind " + std::to_string(o.spacetime.kind().index());
  for (const double p : o.spacetime.parameters()) name += " " + std::to_string(p);
  return name + " r " + std::to_string(o.r) + " l " + std::to_string(o.l) + " " +
         region_name(o.region);
}

// The exact azimuth of a direction, and the energy of its light, without any table.
struct Exact {
  SkyRegion sky = SkyRegion::kIV;
  double azimuth = 0, energy = 1;
};

Exact exact_of(const ObserverState& o, const V3d& d) {
  const double across = std::hypot(d.y, d.z);
  if (const auto* w = std::get_if<Wormhole>(&o.spacetime.kind())) {
    const double alpha = std::atan2(across, o.l < 0 ? d.x : -d.x);
    const double offset = alpha - throat_edge(*w, o.l).angle();
    const bool own = offset > 0;
    return {own == (o.l >= 0) ? SkyRegion::kI : SkyRegion::kIII, wormhole_azimuth(*w, o.l, offset),
            1};
  }
  const auto& hole = std::get<ChargedHole>(o.spacetime.kind());
  const bool outgoing = is_outgoing(o.tetrad);
  const ChargedView view(hole, hole.at(o.r), outgoing);
  const ChargedRay ray =
      view.ray_at(polar_angle(std::atan2(static_cast<long double>(across), outgoing ? d.x : -d.x)));
  Exact exact{SkyRegion::kIV, 0, std::abs(static_cast<double>(view.energy(ray)))};
  const ChargedOrigin origin = view.origin_of(ray);
  exact.sky = sky_of(origin, o).value_or(SkyRegion::kIV);
  if (exact.sky != SkyRegion::kIV) exact.azimuth = view.azimuth(ray);
  return exact;
}

TEST(SphericalLens, FollowsLightAsTheExactAzimuthDoes) {
  std::mt19937_64 random(3);
  for (const ObserverState& o : observers()) {
    const auto lens = LensStore().lens(o, {});
    double worst = 0;
    for (int k = 0; k < 100; ++k) {
      const V3d d = random_direction(random);
      const ViewRay ray = lens->ray(d);
      const Exact exact = exact_of(o, d);
      ASSERT_EQ(ray.sky, exact.sky) << name_of(o);
      if (ray.sky == SkyRegion::kIV) continue;
      const double sine = std::hypot(d.y, d.z);
      const V3d place =
          V3d(std::cos(exact.azimuth), 0, 0) + V3d(0, d.y, d.z) * (std::sin(exact.azimuth) / sine);
      const V3d off = ray.sky_direction - apply(sky_axes(o, ray.sky), place);
      worst = std::max(worst, off.length() / std::max(1.0, ray.longer()));
      EXPECT_NEAR(ray.frequency_ratio * exact.energy, 1, 1e-9) << name_of(o);
    }
    EXPECT_LT(worst, 2e-9) << name_of(o);
  }
}

TEST(SphericalLens, TracesManyRaysAsItTracesOne) {
  std::mt19937_64 random(4);
  for (const ObserverState& o : observers()) {
    const auto lens = LensStore().lens(o, {});
    DirectionBatch directions;
    constexpr int kCount = 60;
    for (int k = 0; k < kCount; ++k) {
      const V3d d = random_direction(random);
      directions.x[k] = d.x, directions.y[k] = d.y, directions.z[k] = d.z;
    }
    ViewRayBatch batch;
    lens->rays(directions, kCount, batch);
    for (int k = 0; k < kCount; ++k) {
      const ViewRay ray = lens->ray({directions.x[k], directions.y[k], directions.z[k]});
      ASSERT_EQ(batch.sky[k], ray.sky) << name_of(o);
      if (!ray.known) continue;
      EXPECT_LT((batch.sky_direction(k) - ray.sky_direction).length(),
                1e-11 * std::max(1.0, ray.longer()))
          << name_of(o);
      EXPECT_NEAR(batch.frequency_ratio[k], ray.frequency_ratio, 1e-12 * ray.frequency_ratio);
      EXPECT_NEAR(batch.longer(k), ray.longer(), 1e-9 * ray.longer());
    }
  }
}

// Each image of a point is where a ray in its direction comes from that point, and its light is as
// many times larger as a small circle of view is smaller on the sky.
TEST(SphericalLens, SeesPointsWhereRaysComeFromThem) {
  std::mt19937_64 random(5);
  for (const ObserverState& o : observers()) {
    const auto lens = LensStore().lens(o, {});
    for (const SkyRegion sky : kExteriorSkies) {
      const auto points = lens->points(sky, PointTolerance{});
      if (!points) continue;
      const V3d source = random_direction(random);
      for (const int order : {0, 1, 2, 3, 4}) {
        const SkyImage image = points->image(source, order, 0);
        if (image.amplification == 0) continue;  // no light sweeps so much
        const ViewRay ray = lens->ray(image.direction.v);
        // Light of high orders is crowded beside the edge, where a double cannot name a direction.
        if (ray.to_edge < 1e-6) continue;
        ASSERT_EQ(ray.sky, sky) << name_of(o);
        const V3d off = ray.sky_direction - apply(sky_axes(o, sky), source);
        EXPECT_LT(off.length(), 1e-9 * std::max(1.0, ray.longer()))
            << name_of(o) << " order " << order;
        EXPECT_NEAR(image.amplification * ray.scale_along * ray.scale_across, 1, 1e-5)
            << name_of(o) << " order " << order;
      }
    }
  }
}

// Without lensing stars and sky stand alike, on the sky of the observer's side.
TEST(StraightLens, OfAWormholeHasTheSkyOfItsSideTheRightWayRound) {
  std::mt19937_64 random(6);
  for (const double l : {3.0, -3.0}) {
    const ObserverState o = in_wormhole({1, Wormhole::Profile::kDngr, 1, 0.5}, l);
    const SkyRegion sky = l < 0 ? SkyRegion::kIII : SkyRegion::kI;
    const auto lens = LensStore().lens(o, {}, StraightLight{{}, 1});
    const V3d source = random_direction(random);
    const auto points = lens->points(sky, std::nullopt);
    ASSERT_TRUE(points) << l;
    const ViewRay ray = lens->ray(points->image(source, 0, 0).direction.v);
    EXPECT_EQ(ray.sky, sky) << l;
    EXPECT_LT((ray.sky_direction - apply(sky_axes(o, sky), source)).length(), 1e-15) << l;
  }
}

// In a cylinder of ten radii light winds dozens of times, and what is seen beside the edge after
// many half turns is nearly as large as what is seen after few.
TEST(SphericalLens, FindsPointsAfterManyHalfTurnsInALongCylinder) {
  const ObserverState o = in_wormhole({1, Wormhole::Profile::kDngr, 10, 0.014}, 2);
  const auto lens = LensStore().lens(o, {});
  const auto points = lens->points(SkyRegion::kI, PointTolerance{});
  ASSERT_GT(points->orders_in_batches(), 400);
  EXPECT_EQ(points->orders(), points->orders_in_batches());
  const V3d source = V3d(0.3, -0.5, 0.4).normalized();
  PointBatch batch;
  batch.x[0] = source.x, batch.y[0] = source.y, batch.z[0] = source.z;
  points->locate(batch, 1);
  for (const int order : {1, 20, 101, 400}) {
    PointImageBatch images;
    points->images(order, batch, 1, images);
    const SkyImage image = points->image(source, order, 0);
    const V3d& d = image.direction.v;
    EXPECT_LT((V3d(images.x[0], images.y[0], images.z[0]) - d).length(), 1e-6) << order;
    EXPECT_NEAR(images.amplification[0] / image.amplification, 1, 1e-4) << order;
    const ViewRay ray = lens->ray(d);
    EXPECT_NEAR(ray.swept, order * std::numbers::pi, std::numbers::pi) << order;
    EXPECT_LT((ray.sky_direction - source).length(), 1e-8) << order;
  }
}

// The zones of a wormhole fill the view, and the dark of a hole is what its edges say.
TEST(SphericalLens, SeesTheSkiesWithinTheirBorders) {
  std::mt19937_64 random(6);
  for (const ObserverState& o : observers()) {
    const auto lens = LensStore().lens(o, {});
    const auto borders = lens->borders();
    for (int k = 0; k < 30; ++k) {
      const V3d d = random_direction(random);
      const SkyRegion sky = lens->ray(d).sky;
      int within = borders.empty() ? 1 : 0;
      for (const SkyBorder& border : borders) {
        const auto& circle = std::get<ViewCircle>(border.curve);
        if ((circle.axis.dot(d) > circle.cosine) != border.sky_within) continue;
        ++within;
        EXPECT_EQ(border.sky, sky) << name_of(o);
      }
      EXPECT_EQ(within, sky == SkyRegion::kIV ? 0 : 1) << name_of(o);
      EXPECT_TRUE(within == 1 || !o.spacetime.is<Wormhole>());
    }
  }
}

// With hardly any charge the light is Schwarzschild's, seen by the observer at rest.
TEST(SphericalLens, OfLittleChargeIsThatOfSchwarzschild) {
  std::mt19937_64 random(7);
  for (const double r : {2.2, 3.5, 12.0, 1.3}) {
    const Region region = r < 2 ? Region::kII : Region::kI;
    const ObserverState charged = near_charge(1e-8, r, region);
    ObserverState plain = charged;
    plain.spacetime = Schwarzschild{};
    const auto one = LensStore().lens(charged, {}), two = LensStore().lens(plain, {});
    const auto rest = [](const ObserverState& o) {
      return resting_celerity(o.spacetime, o.r, o.tetrad);
    };
    for (int k = 0; k < 50; ++k) {
      const V3d n = random_direction(random);
      const ViewRay a = one->ray(to_tetrad(rest(charged), n).direction),
                    b = two->ray(to_tetrad(rest(plain), n).direction);
      if (b.to_edge < 1e-3) continue;
      ASSERT_EQ(a.sky == SkyRegion::kIV, b.sky == SkyRegion::kIV) << r;
      if (a.sky == SkyRegion::kIV) continue;
      EXPECT_LT((a.sky_direction - b.sky_direction).length(), 1e-8) << r;
    }
  }
}

}  // namespace
}  // namespace domefall
