// The lens of a charge in all regions and universes, and of naked singularities.
#include "pipeline/light/charged_lens.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

#include "pipeline/light/lens_store.h"
#include "pipeline/light/spherical_lens.h"
#include "tests/pipeline/light/charged_places.h"
#include "tests/pipeline/light/charged_rays.h"
#include "tests/pipeline/light/random_rays.h"

namespace domefall {
namespace {

using std::numbers::pi;

// Returns the angles of a zone as parts of its reach, close to both ends.
double random_part(std::mt19937_64& random, double decades) {
  std::uniform_real_distribution<double> unit;
  const double small = std::pow(10, -decades * unit(random)) / 2;
  return unit(random) < 0.5 ? small : 1 - small;
}

TEST(ChargedSky, IsThatOfItsUniverse) {
  const auto sky = [](ChargedOrigin origin, Tetrad tetrad, int universe) {
    return sky_of(origin, ChargedPlace{0.5, 3, Region::kI, tetrad, universe}.observer());
  };
  for (const Tetrad tetrad : {Tetrad::kRain, Tetrad::kOutgoing})
    for (const int n : {0, 1, 2, 3}) {
      EXPECT_EQ(sky(ChargedOrigin::kDark, tetrad, n), std::nullopt);
      EXPECT_EQ(sky(ChargedOrigin::kParallel, tetrad, n), SkyRegion::kIII);
      EXPECT_EQ(sky(ChargedOrigin::kOwn, mirror_of(tetrad), n), SkyRegion::kIII);
      EXPECT_EQ(sky(ChargedOrigin::kOwn, tetrad, n), n % 2 == 0 ? SkyRegion::kI : SkyRegion::kNext);
      EXPECT_EQ(sky(ChargedOrigin::kBefore, tetrad, n + 1), sky(ChargedOrigin::kOwn, tetrad, n));
      EXPECT_EQ(sky(ChargedOrigin::kParallelBefore, tetrad, n + 1), SkyRegion::kIII);
      EXPECT_EQ(sky(ChargedOrigin::kParallelBefore, mirror_of(tetrad), n + 1),
                sky(ChargedOrigin::kOwn, tetrad, n));
    }
  EXPECT_EQ(sky(ChargedOrigin::kBefore, Tetrad::kRain, 0), std::nullopt);
  EXPECT_EQ(sky(ChargedOrigin::kParallelBefore, Tetrad::kOutgoing, 0), std::nullopt);
}

TEST(ChargedSky, IsSeenWhereTheStateSaysSo) {
  const auto compare = [](ChargedPlace place) {
    for (const int universe : {0, 1, 2})
      for (const bool mirrored : {false, true}) {
        place.universe = universe;
        ObserverState o = place.observer();
        if (mirrored) o.region = mirror_of(o.region), o.tetrad = mirror_of(o.tetrad);
        PerSky<bool> in_view;
        for (const SkyPart& part : optics_of(o).parts) in_view[part.sky] = true;
        EXPECT_EQ(seen_skies(o).values, in_view.values) << place << " " << mirrored;
      }
  };
  for (const ChargedPlace& place : charged_places()) compare(place);
  for (const ChargedPlace& place : marked_places()) compare(place);
}

// ---- reference rays ----

Region region_of(const ChargedHole& hole, const ChargedRadius& at) {
  if (hole.is_naked() || at.above_outer > 0) return Region::kI;
  return at.above_inner > 0 ? Region::kII : Region::kV;
}

std::optional<SkyRegion> sky_of(const ChargedReference& row, const ObserverState& o) {
  if (row.origin == "III") return sky_of(ChargedOrigin::kParallel, o);
  if (row.beyond == "E") return sky_of(ChargedOrigin::kBefore, o);
  return row.origin == "I" ? sky_of(ChargedOrigin::kOwn, o) : std::nullopt;
}

// A direction holds an angle to 1e-16, which next to an edge is a larger one on the sky.
TEST(ChargedReferenceRows, AreSeenThroughTheLens) {
  int skies = 0;
  double worst = 0;
  for (const ChargedReference& row : charged_references()) {
    const ChargedHole hole(1, row.charge);
    ObserverState o =
        ChargedPlace{hole.charge, static_cast<double>(row.r), region_of(hole, hole.at(row.r))}
            .observer();
    o.spacetime = hole;
    o.sky_from_tetrad = from_columns({std::sin(row.theta), 0, std::cos(row.theta)},
                                     {std::cos(row.theta), 0, -std::sin(row.theta)}, {0, 1, 0});
    const auto s = static_cast<double>(std::sin(row.delta)),
               c = static_cast<double>(std::cos(row.delta));
    const V3d light(c, s * std::cos(row.eta), s * std::sin(row.eta));
    const ViewRay ray = LensStore().lens(o, {})->ray(-light);
    // On an edge itself, to a double, either side will do.
    if (std::abs(row.offset) < 1e-14L && row.offset != 0) continue;
    ASSERT_EQ(ray.sky, sky_of(row, o).value_or(SkyRegion::kIV)) << row.line;
    if (!row.has_sky) continue;
    ++skies;
    // The observer's r is a double, of which edges next to a horizon take a part.
    const ChargedRadius at = hole.at(row.r);
    const auto rounded = static_cast<double>(std::abs(row.r - o.r)) /
                         std::min(std::abs(at.above_inner), std::abs(at.above_outer));
    const double angle = 2e-15 + 2 * static_cast<double>(row.delta) * rounded;
    const double error = (ray.sky_direction - row.place).length(), longer = ray.longer();
    worst = std::max(worst, error / std::max(1.0, longer));
    EXPECT_LT(error, 1e-10 + 1e-9 * std::min(longer, 100.0) + angle * longer) << row.line;
    EXPECT_NEAR(ray.frequency_ratio * row.one_plus_z, 1, 1e-11 + 2 * rounded) << row.line;
    if (s < 1e-6) continue;
    EXPECT_NEAR(ray.scale_along * ray.scale_across * row.amplification, 1,
                1e-6 + 10 * angle / ray.to_edge)
        << row.line;
  }
  EXPECT_GT(skies, 290);
  RecordProperty("worst", std::to_string(worst));
}

TEST(ChargedReferenceRows, AreInTheTables) {
  int rows = 0;
  double worst = 0;
  for (const ChargedReference& row : charged_references()) {
    if (row.edge.empty() || !row.has_sky) continue;
    const ChargedHole hole(1, row.charge);
    ObserverState o =
        ChargedPlace{hole.charge, static_cast<double>(row.r), region_of(hole, hole.at(row.r))}
            .observer();
    o.spacetime = hole;
    HoleOptics optics = make_charged_optics(hole, o);
    add_tables(optics, {});
    const auto part = std::ranges::find_if(optics.parts, [&](const SkyPart& p) {
      return p.sky == sky_of(row, o) && p.zone.edge.sign * static_cast<double>(row.offset) > 0;
    });
    ASSERT_NE(part, optics.parts.end()) << row.line;
    const auto offset = static_cast<double>(std::abs(row.offset));
    const double phi = row.mino * std::sqrt(row.k);
    const double error = std::abs(part->table->azimuth(2 * std::tan(offset / 4)) - phi);
    ++rows;
    worst = std::max(worst, error);
    EXPECT_LT(error, 3e-11) << row.line;
  }
  EXPECT_GT(rows, 100);
  RecordProperty("worst", std::to_string(worst));
}

// ---- tables ----

TEST(ChargedZones, HaveOneSkyEachWhoseAzimuthFallsFromTheEdge) {
  std::mt19937_64 random(11);
  for (const ChargedPlace& place : charged_places()) {
    const ObserverState o = place.observer();
    const auto& hole = std::get<ChargedHole>(o.spacetime.kind());
    const ChargedView view(hole, hole.at(o.r), is_outgoing(o.tetrad));
    for (const SkyPart& part : optics_at(place, false).parts) {
      const SkyZone& zone = part.zone;
      double before = HUGE_VAL;
      for (int k = 1; k < 60; ++k) {
        const double offset = zone.reach * std::pow(10, -6.0 * (60 - k) / 60);
        const double phi = zone.azimuth(offset);
        ASSERT_TRUE(std::isfinite(phi)) << place;
        ASSERT_LT(phi, before + 1e-14) << place << " at " << offset;
        before = phi;
      }
      ASSERT_NEAR(zone.azimuth(zone.reach), 0, 1e-5) << place;
      if (!zone.end) continue;
      for (const double off : {0.5, 0.3, 1e-2}) {
        const double from_edge = zone.azimuth(zone.reach * (1 - off));
        EXPECT_NEAR(zone.end->azimuth(zone.reach * off), from_edge,
                    1e-12 * std::max(1.0, from_edge))
            << place;
      }
    }
  }
}

// The error is a part of the pixel that a ray stands for: it is divided by what the ray spans.
TEST(ChargedTables, AgreeWithTheExactAzimuthFromEndToEnd) {
  std::mt19937_64 random(12);
  double worst = 0, worst_slope = 0;
  for (const ChargedPlace& place : charged_places())
    for (const SkyPart& part : optics_at(place).parts) {
      const SkyZone& zone = part.zone;
      const SkyTable& table = *part.table;
      for (int k = 0; k < 200; ++k) {
        const double x = 2 * std::tan(zone.reach * random_part(random, 12) / 4);
        const double y = (table.x_max() - x) / (1 + x * table.x_max() / 4);
        const bool at_end = zone.end && x > table.curve_end();
        const double z = at_end ? y : x;
        const auto exact = [&](double step) {
          const double offset = 4 * std::atan((z + step) / 2);
          return at_end ? zone.end->azimuth(offset) : zone.azimuth(offset);
        };
        const double error = std::abs(table.azimuth(x) - exact(0)), slope = table.slope(x);
        ASSERT_TRUE(std::isfinite(error) && slope > 0 && std::isfinite(slope)) << place;
        worst = std::max(worst, error / std::max(1.0, slope));
        if (k % 10 > 0 || slope < 1e-3 || (at_end && y < 1e-11 * zone.end->least)) continue;
        const double h = 1e-4 * std::min(x, y);
        const double difference = 8 * (exact(h) - exact(-h)) - (exact(2 * h) - exact(-2 * h));
        const double numeric = std::abs(difference) / (12 * h) * (1 + z * z / 4) / 2;
        // Rounding of the azimuth and of x hides the slope.
        const double rounding = 1e-15 * exact(0) / (h * numeric) + 1e-16 * z / h;
        worst_slope = std::max(worst_slope, std::abs(slope / numeric - 1) - 20 * rounding);
      }
    }
  EXPECT_LT(worst, 3e-10);
  EXPECT_LT(worst_slope, 1e-6);
  RecordProperty("worst", std::to_string(worst * 1e12));
}

TEST(ChargedTables, InverseReturnsToTheSameRay) {
  std::mt19937_64 random(13);
  std::uniform_real_distribution<double> unit;
  for (const ChargedPlace& place : charged_places())
    for (const SkyPart& part : optics_at(place).parts) {
      const SkyTable& table = *part.table;
      const double most = std::min(15.0, 0.999999 * table.most_azimuth());
      for (int k = 0; k < 60; ++k) {
        const double phi = most * (k % 2 > 0 ? unit(random) : std::pow(10, -9 * unit(random)));
        const double x = table.distance(phi);
        ASSERT_TRUE(x >= 0 && x <= table.x_max()) << place;
        // By way of the core, azimuths fall to 0 so fast that x cannot tell the last of them.
        const bool last = table.x_max() - x < 1e-9 * table.x_max();
        if (last && table.zone().end && table.zone().end->core) continue;
        EXPECT_NEAR(table.azimuth(x), phi, 1e-11 + 1e-15 * table.slope(x) * table.x_max()) << place;
      }
      if (!std::isfinite(table.most_azimuth())) continue;
      EXPECT_EQ(table.distance(1.001 * table.most_azimuth()), 0) << place;
    }
}

// ---- special places ----

void expect_finite(const ViewRay& ray, const ChargedPlace& place) {
  EXPECT_TRUE(std::isfinite(ray.sky_direction.length()) && std::isfinite(ray.longer()) &&
              std::isfinite(ray.shorter()) && ray.frequency_ratio > 0 &&
              ray.frequency_ratio < 1.01e9 && ray.to_edge >= 0)
      << place << " " << ray.longer() << " " << ray.frequency_ratio;
}

TEST(ChargedLens, IsFiniteAtTheMarksOfAHole) {
  std::mt19937_64 random(16);
  for (const ChargedPlace& place : marked_places()) {
    const auto lens = LensStore().lens(place.observer(), {});
    std::vector<V3d> directions{{1, 0, 0}, {-1, 0, 0}};
    for (const SkyBorder& border : lens->borders()) {
      const auto& c = std::get<ViewCircle>(border.curve);
      ASSERT_TRUE(std::isfinite(c.cosine) && c.sine >= 0) << place;
      for (const double off : {0.0, 1e-16, -1e-16, 1e-9})
        directions.emplace_back(c.axis.x * (c.cosine + off * c.sine), c.sine - off * c.cosine, 0);
    }
    for (int k = 0; k < 20; ++k) directions.push_back(random_direction(random));
    for (double a = 1e-30; a < 1; a *= 1e3)
      for (const double side : {1.0, -1.0}) directions.emplace_back(side, a, 0);
    for (const V3d& n : directions) {
      const ViewRay ray = lens->ray(n.normalized());
      if (ray.known) expect_finite(ray, place);
    }
    EXPECT_LE(lens->einstein_rings().size(), 2u);
    for (const SkyRegion sky : kExteriorSkies) {
      const auto points = lens->points(sky, PointTolerance{});
      if (!points) continue;
      for (const SkySample& sample : lens->divided(sky, 5, 3))
        EXPECT_TRUE(std::isfinite(sample.sky_direction.length()) && sample.solid_angle >= 0 &&
                    std::isfinite(sample.footprint))
            << place;
      for (int order = 0; order < points->orders(); ++order) {
        EXPECT_GE(points->most_light(order), 0) << place;
        for (const V3d& source : {V3d(1, 0, 0), V3d(-1, 0, 0), random_direction(random)}) {
          const SkyImage image = points->image(source, order, 1e-4);
          EXPECT_TRUE(std::isfinite(image.amplification) && image.frequency_ratio < 1.01e9 &&
                      std::abs(image.direction.v.length() - 1) < 1e-12)
              << place << " order " << order;
        }
      }
    }
  }
}

// A horizon is no place that is seen: views on its two sides go over into each other.
TEST(ChargedLens, ChangesWithoutAStepAcrossHorizons) {
  std::mt19937_64 random(17);
  for (const double q : {0.3, 0.8, 0.99}) {
    const ChargedHole hole(1, q);
    const double inner = hole.inner_horizon(), outer = hole.horizon(), off = 1e-12;
    const ChargedPlace crossings[][2] = {
        {{q, inner * (1 + off), Region::kII, Tetrad::kRain, 0},
         {q, inner * (1 - off), Region::kV, Tetrad::kRain, 0}},
        {{q, inner * (1 - off), Region::kV, Tetrad::kOutgoing, 0},
         {q, inner * (1 + off), Region::kIV, Tetrad::kOutgoing, 1}},
        {{q, outer * (1 - off), Region::kIV, Tetrad::kOutgoing, 1},
         {q, outer * (1 + off), Region::kI, Tetrad::kOutgoing, 1}}};
    for (const auto& [from, to] : crossings) {
      const auto one = LensStore().lens(from.observer(), {}),
                 two = LensStore().lens(to.observer(), {});
      for (int k = 0; k < 100; ++k) {
        const V3d n = random_direction(random);
        // What shrinks to a point there lies around one axis.
        if (std::abs(n.x) > 1 - 1e-4) continue;
        const ViewRay a = one->ray(n), b = two->ray(n);
        if (std::min(a.to_edge, b.to_edge) < 1e-4) continue;
        ASSERT_EQ(a.sky, b.sky) << from;
        if (!a.known) continue;
        EXPECT_LT((a.sky_direction - b.sky_direction).length(), 1e-6 * std::max(1.0, a.longer()))
            << from;
        EXPECT_NEAR(a.frequency_ratio / b.frequency_ratio, 1, 1e-6) << from;
      }
    }
  }
}

// Where the two circles of light meet, azimuths follow no logarithm beside a critical ray.
TEST(ChargedTables, FollowTheExactAzimuthWhereNoLogarithmHolds) {
  for (const double q : {kNoCircle * (1 - 1e-15), kNoCircle * (1 - 1e-13)})
    for (const double r : {1.0, 2.0, 30.0}) {
      const HoleOptics optics = optics_at({q, r, Region::kI});
      for (const SkyPart& part : optics.parts) {
        if (part.zone.level) continue;
        const double innermost = part.table->curve().x_min();
        for (const double x : {innermost / 2, innermost / 1e3, innermost / 1e9}) {
          const double phi = part.zone.azimuth(4 * std::atan(x / 2));
          EXPECT_NEAR(part.table->azimuth(x), phi, 1e-9 * phi) << q << ' ' << r << ' ' << x;
          // Nothing is seen closer to an edge than this.
          constexpr double kUnseen = 1e-15;
          EXPECT_NEAR(part.table->distance(phi), x, 1e-6 * x + kUnseen)
              << q << ' ' << r << ' ' << x;
        }
      }
    }
}

}  // namespace
}  // namespace domefall
