// Images of points through the lens of a charge.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <random>

#include "pipeline/light/lens_store.h"
#include "pipeline/light/spherical_lens.h"
#include "tests/pipeline/light/charged_places.h"
#include "tests/pipeline/light/random_rays.h"

namespace domefall {
namespace {

using std::numbers::pi;

// Images of sources at all places bring the solid angle that their sky has in the view, which the
// borders tell.
TEST(ChargedImages, FillTheSolidAngleOfTheirSkies) {
  const std::vector<ChargedPlace> places = charged_places();
  for (std::size_t n = 0; n < places.size(); n += 3) {
    const ChargedPlace& place = places[n];
    const HoleOptics optics = optics_at(place);
    const auto lens = LensStore().lens(place.observer(), {});
    for (const SkyRegion sky : kExteriorSkies) {
      double seen = 0;
      for (const SkyPart& part : optics.parts) {
        // 1 - cos of the far end's angle, which is from the axis to the edge.
        const double half = std::sin(part.zone.reach / 2);
        if (part.sky == sky) seen += 4 * pi * half * half;
      }
      const auto points = lens->points(sky, {});
      ASSERT_EQ(points != nullptr, seen > 0) << place;
      if (!points) continue;
      // The light is singular at both ends and where images merge on a level edge.
      const double most = optics.parts.front().table->most_azimuth();
      const bool level = std::isfinite(most);
      const double fold = level ? std::abs(std::remainder(most, 2 * pi)) : pi;
      double sum = 0;
      for (const auto& [from, to] : {std::pair(0.0, fold), std::pair(fold, pi)}) {
        // The substitution phi* = from + (to - from)/(1 + exp(-v)) spreads out both ends.
        constexpr int kSources = 300;
        constexpr double kRange = 30;
        for (int k = 0; k < kSources; ++k) {
          const double v = kRange * ((2 * k + 1.0) / kSources - 1);
          const double part = 1 / (1 + std::exp(-v)), rest = 1 / (1 + std::exp(v));
          const double phi = part < 0.5 ? from + (to - from) * part : to - (to - from) * rest;
          double light = 0;
          for (int order = 0; order < points->orders(); ++order)
            light += points->image({std::cos(phi), std::sin(phi), 0}, order, 0).amplification;
          sum += light * 2 * pi * std::sin(phi) * (to - from) * part * rest * 2 * kRange / kSources;
        }
      }
      EXPECT_NEAR(sum / seen, 1, 2e-4) << place << " " << name_of(sky);
    }
  }
}

// Returns the light, amplification and shift, of the rays of a zone that come from a ring about the
// axis of the sky.
double light_of_rays(const Lens& lens, const SkyZone& zone, SkyRegion sky, double phi,
                     double size) {
  constexpr int kRays = 60'000;
  constexpr double kRange = 30;  // the offset is reach/(1 + exp(-v)), with v from -kRange to kRange
  const double edge = zone.edge.half.angle(), dv = 2 * kRange / kRays;
  double light = 0;
  DirectionBatch n;
  ViewRayBatch rays;
  for (int k = 0; k < kRays; k += DirectionBatch::kSize) {
    std::array<double, DirectionBatch::kSize> area{};
    for (int j = 0; j < DirectionBatch::kSize; ++j) {
      const double v = (k + j + 0.5) * dv - kRange;
      const double part = 1 / (1 + std::exp(-v)), rest = 1 / (1 + std::exp(v));
      // From whichever end is nearer.
      const bool ahead = zone.edge.sign < 0;
      const double alpha = part < 0.5 ? edge + zone.edge.sign * zone.reach * part
                           : ahead    ? zone.reach * rest
                                      : pi - zone.reach * rest;
      n.x[j] = -zone.inward * std::cos(alpha), n.z[j] = 0;
      n.y[j] = part < 0.5 || ahead ? std::sin(alpha) : std::sin(zone.reach * rest);
      area[j] = 2 * pi * n.y[j] * zone.reach * part * rest * dv;
    }
    lens.rays(n, DirectionBatch::kSize, rays);
    for (int j = 0; j < DirectionBatch::kSize; ++j)
      if (rays.sky[j] == sky && std::abs(std::acos(rays.sky_x[j]) - phi) < size)
        light += area[j] * std::pow(rays.frequency_ratio[j], 4);
  }
  return light;
}

// Returns the same light from images of points of the ring.
double light_of_images(const SkyPoints& points, double phi, double size) {
  constexpr int kSources = 200;
  double light = 0;
  for (int k = 0; k < kSources; ++k) {
    const double at = phi + size * ((2 * k + 1.0) / kSources - 1);
    const double width = 2 * pi * std::sin(at) * 2 * size / kSources;
    for (int order = 0; order < points.orders(); ++order) {
      const SkyImage image = points.image({std::cos(at), std::sin(at), 0}, order, 0);
      light += image.amplification * std::pow(image.frequency_ratio, 4) * width;
    }
  }
  return light;
}

TEST(ChargedImages, BringTheLightThatTheViewShows) {
  std::mt19937_64 random(14);
  std::uniform_real_distribution<double> unit;
  int compared = 0;
  for (const ChargedPlace& place : charged_places()) {
    if (unit(random) < 0.8) continue;
    const auto lens = LensStore().lens(place.observer(), {});
    const HoleOptics optics = optics_at(place, false);
    for (const SkyRegion sky : kExteriorSkies) {
      const auto points = lens->points(sky, {});
      if (!points) continue;
      const double phi = 0.4 + 2.3 * unit(random), size = 0.1;
      const double most =
          optics.parts.front().zone.level ? optics.parts.front().zone.azimuth(0) : 0;
      if (std::abs(std::abs(std::remainder(most, 2 * pi)) - phi) < 3 * size) continue;
      double seen = 0;
      for (const SkyPart& part : optics.parts)
        if (part.sky == sky) seen += light_of_rays(*lens, part.zone, sky, phi, size);
      if (!(seen > 0)) continue;
      ++compared;
      EXPECT_NEAR(light_of_images(*points, phi, size) / seen, 1, 0.02)
          << place << " " << name_of(sky) << " " << phi;
    }
  }
  EXPECT_GT(compared, 20);
}

// Images in batches are those of single points, and none is brighter than its bound.
TEST(ChargedImages, AreFoundInBatchesToo) {
  std::mt19937_64 random(15);
  const PointTolerance tolerance;
  std::size_t found = 0, alone = 0;
  for (const ChargedPlace& place : charged_places()) {
    const auto lens = LensStore().lens(place.observer(), {});
    for (const SkyRegion sky : kExteriorSkies) {
      const auto points = lens->points(sky, tolerance);
      if (!points) continue;
      constexpr int kCount = 40;
      PointBatch batch{};
      std::array<int, kCount> chosen{};
      for (int k = 0; k < kCount; ++k) {
        const V3d source = random_direction(random);
        batch.x[k] = source.x, batch.y[k] = source.y, batch.z[k] = source.z, chosen[k] = k;
      }
      points->locate(batch, kCount);
      for (int order = 0; order < points->orders_in_batches(); ++order) {
        std::array<float, kCount> bounds{};
        points->bounds(order, batch, chosen.data(), kCount, bounds.data());
        PointImageBatch images;
        points->images(order, batch, kCount, images);
        for (int k = 0; k < kCount; ++k) {
          const SkyImage one = points->image({batch.x[k], batch.y[k], batch.z[k]}, order, 0);
          const double light = one.amplification * batch.sine[k] * std::pow(one.frequency_ratio, 4);
          ASSERT_TRUE(std::isfinite(light)) << place;
          ASSERT_LE(light, points->most_light(order) * 1.0001) << place << " order " << order;
          ++(bounds[k] < 0 ? alone : found);
          if (bounds[k] < 0 || bounds[k] > 1e36f) continue;
          ASSERT_LE(light, bounds[k] * 1.0001) << place << " order " << order;
          if (bounds[k] == 0) continue;
          const double off =
              (V3d(images.x[k], images.y[k], images.z[k]) - one.direction.v).length();
          EXPECT_LT(off, tolerance.position) << place << " order " << order;
          EXPECT_NEAR(images.amplification[k] / one.amplification *
                          std::pow(images.frequency_ratio[k] / one.frequency_ratio, 4),
                      1, 3 * tolerance.flux)
              << place << " order " << order << " " << one.amplification;
        }
      }
    }
  }
  EXPECT_GT(found, 20 * alone);
}

}  // namespace
}  // namespace domefall
