#include "pipeline/render/stars/star_trail.h"

#include <gtest/gtest.h>

#include <map>

#include "tests/pipeline/render/stars/star_scene.h"
#include "tests/pipeline/show/show_file.h"
#include "trajectories/static_observer.h"

namespace domefall {
namespace {

constexpr double kRadius = 1e-6;

// Sources behind the hole, or above the observer, and their way in half a window.
struct TrailCase {
  double r;
  V3d source, way;
};
const std::vector<TrailCase> kCases{
    {10, V3d(-1, 0.003, 0.001), V3d(0, -0.004, 0.002)},  // at a moderate distance
    {10, V3d(-1, 1e-5, 0), V3d(0, 0, 0.005)},            // through the middle of the ring
    {10, V3d(-1, 0, 0), V3d(0, 0.003, 0.003)},           // straight through the axis
    {1000, V3d(-1, 0.02, 0.01), V3d(0, 0.001, 0.003)},   // past it
    {3.5, V3d(1, 0.002, 0.001), V3d(0, 0.004, -0.003)},  // above the observer
};

SkyTable table_at(double r) { return SkyTable(schwarzschild_zone(r, Critical::kFirst)); }

StarTrail::ImageOf image_at(const SkyTable& table, int order) {
  return [&table, order](const V3d& source) { return image_of(&table, source, order, 0); };
}

// A trail in pieces that are at most so many radians apart.
std::vector<SkyImage> trail_of(const SkyTable& table, const AxisPassage& passage, int order,
                               double spacing) {
  const StarTrail trail(image_at(table, order), passage);
  std::vector<SkyImage> pieces;
  for (std::size_t k = 0; k < trail.parts(); ++k)
    trail.split(
        k,
        static_cast<int>(std::ceil(1.1 * (trail.begin(k + 1) - trail.begin(k)).length() / spacing)),
        pieces);
  return pieces;
}

// The mean over many instants has the light of the trail, and its middle.
TEST(StarTrail, IsTheMeanOverManyInstants) {
  for (const TrailCase& c : kCases)
    for (int order = 0; order < 4; ++order) {
      if (!on_caustic(c.source, order)) continue;
      const SkyTable table = table_at(c.r);
      const AxisPassage passage(c.source, c.way, kRadius);
      double light = 0, red = 0;
      for (const SkyImage& piece : trail_of(table, passage, order, 1e-3)) {
        light += piece.amplification;
        red += piece.amplification * piece.frequency_ratio;
      }
      // Equal steps of x, with the weight of each: near the axis a mean over time needs far more.
      constexpr int kInstants = 100'000;
      double wanted = 0, wanted_red = 0;
      for (int k = 0; k < kInstants; ++k) {
        const double step = (passage.end() - passage.begin()) / kInstants;
        const double x = passage.begin() + (k + 0.5) * step;
        const V3d source = passage.source(x);
        const V3d moved = source - c.source.normalized();
        const double u = (moved.y * c.way.y + moved.z * c.way.z) / c.way.length2();
        const SkyImage image = image_of(&table, source, order, 0);
        const double time = passage.distance(x) * step / c.way.length();
        wanted += image.amplification * (1 - std::min(1.0, std::abs(u))) * time;
        wanted_red +=
            image.amplification * (1 - std::min(1.0, std::abs(u))) * time * image.frequency_ratio;
      }
      EXPECT_NEAR(light / wanted, 1, 2e-3) << c.r << ", order " << order;
      EXPECT_NEAR(red / wanted_red, 1, 2e-3) << c.r << ", order " << order;
    }
}

// However the window falls, its weights add up to 1: far from the axis the mean is the instant's.
TEST(StarTrail, HasTheLightOfTheInstantFarFromTheAxis) {
  const SkyTable table = table_at(10);
  const V3d source = V3d(-1, 0.2, 0.1).normalized();
  const double instant = image_of(&table, source, 0, 0).amplification;
  for (const double sharpness : {1.0, 1.7, 3.0, 5.0}) {
    double sum = 0;
    for (const SkyImage& piece :
         trail_of(table, AxisPassage(source, V3d(0, 0.002, -0.003), kRadius, sharpness), 0, 1e-4))
      sum += piece.amplification;
    EXPECT_NEAR(sum / instant, 1, 2e-3) << sharpness;
  }
}

// The pieces lie where the lens has the images of their instants: to a hundredth of a pixel of 4k.
TEST(StarTrail, LiesWhereItsInstantsDo) {
  for (const TrailCase& c : kCases)
    for (int order = 0; order < 3; ++order) {
      const SkyTable table = table_at(c.r);
      const AxisPassage passage(c.source.normalized(), c.way, kRadius);
      const StarTrail trail(image_at(table, order), passage);
      // The sources of the passage, as close as they are to one another here.
      std::vector<V3d> way;
      for (int k = 0; k <= 4000; ++k) {
        const double x = passage.begin() + (passage.end() - passage.begin()) * k / 4000;
        way.push_back(image_of(&table, passage.source(x), order, 0).direction.v);
      }
      std::size_t at = 0;
      for (std::size_t k = 0; k < trail.parts(); ++k) {
        std::vector<SkyImage> pieces;
        trail.split(k, 3, pieces);
        for (const SkyImage& piece : pieces) {
          const auto away = [&](std::size_t n) { return (way[n] - piece.direction.v).length(); };
          while (at + 1 < way.size() && away(at + 1) <= away(at)) ++at;
          // What the neighbours are apart is known; across the way nothing is.
          const V3d next = way[at + 1 < way.size() ? at + 1 : at - 1] - way[at];
          EXPECT_LT((piece.direction.v - way[at]).cross(next.normalized()).length(), 8e-6)
              << c.r << ", order " << order << ", part " << k;
        }
      }
    }
}

// The camera's views of all pieces at once are those of the pieces one by one.
TEST(StarTrail, IsSeenAtOnceAsPieceByPiece) {
  const FrameState state = frame_state(show_of(StaticObserver{}, Domemaster{64}), 0);
  const M33d& camera = state.observer.tetrad_from_camera;
  for (const V3d& celerity : {V3d(0, 0, 0), V3d(-0.2, 0.6, 0.1), V3d(1, 3, -2)})
    for (const TrailCase& c : kCases)
      for (int order = 0; order < 3; ++order) {
        const Aberration boost(celerity);
        const SkyTable table = table_at(c.r);
        const StarTrail trail(image_at(table, order),
                              AxisPassage(c.source.normalized(), c.way, kRadius, 4));
        for (std::size_t k = 0; k < trail.parts(); ++k) {
          constexpr int kPieces = 5, kFirst = 2, kAt = 7;
          std::vector<SkyImage> pieces;
          trail.split(k, kPieces, pieces);
          StarViews views;
          trail.store(k, kPieces, kFirst, kPieces - kFirst, boost, camera, views, kAt);
          for (std::size_t n = 0; n < kPieces - kFirst; ++n) {
            const SkyImage& piece = pieces[kFirst + n];
            const AberratedLight seen = boost.to_rest(piece.direction.v);
            const double doppler = seen.frequency_ratio, g = piece.frequency_ratio * doppler;
            const V3d direction(views.x[kAt + n], views.y[kAt + n], views.z[kAt + n]);
            const double flux = piece.amplification / (doppler * doppler) * std::pow(g, 4);
            EXPECT_LT((direction - apply_transposed(camera, seen.direction)).length(), 1e-8);
            EXPECT_NEAR(views.temperature[kAt + n], g, 1e-9 * g);
            EXPECT_NEAR(views.flux[kAt + n], flux, 1e-9 * flux);
          }
        }
      }
}

TEST(StarTrail, HasNoGaps) {
  for (const TrailCase& c : kCases) {
    const SkyTable table = table_at(c.r);
    const double spacing = 2e-3;
    V3d before(0, 0, 0);
    for (const SkyImage& piece :
         trail_of(table, AxisPassage(c.source, c.way, kRadius), 1, spacing)) {
      if (before.length2() > 0) {
        EXPECT_LT((piece.direction.v - before).length(), spacing * 1.1);
      }
      before = piece.direction.v;
    }
  }
}

// Over a whole passage the trails of successive instants have the light of the time between them,
// wherever the instants lie.
TEST(StarTrail, OfSuccessiveInstantsLoseNoLight) {
  const SkyTable table = table_at(10);
  const double step = 0.004, from_axis = 0.0007;
  const auto passing = [&](double first) {
    double sum = 0;
    for (int k = -40; k <= 40; ++k) {
      const V3d source(-1, from_axis, (k + first) * step);
      for (const SkyImage& piece :
           trail_of(table, AxisPassage(source.normalized(), V3d(0, 0, 2 * step), kRadius), 0, 1e-3))
        sum += piece.amplification;
    }
    return sum;
  };
  const double at_first = passing(0);
  for (const double first : {0.1, 0.25, 0.5, 0.7}) EXPECT_NEAR(passing(first) / at_first, 1, 5e-3);
}

// A faint star's trail takes fewer blobs than a bright one's and has as much light for its flux.
TEST(StarTrail, OfAFaintStarIsTheSameInFewerPieces) {
  StarScene scene({Region::kI, Tetrad::kRain, 10, {0.5, 0, 0}}, Domemaster{1024});
  scene.motion.turn = V3d(0, 0, 0.004);
  std::vector<double> per_flux;
  std::vector<std::size_t> pieces;
  for (const float magnitude : {0.f, 4.f, 8.f, 12.f}) {
    const std::vector<Star> stars{{scene.sky(V3d(-1, 0.004, 0.003)), magnitude, 6000}};
    const auto images = all_images(scene.images(), SceneStars(stars));
    per_flux.push_back(total_light(images) * std::pow(10, 0.4 * magnitude));
    pieces.push_back(images.size());
  }
  for (std::size_t k = 1; k < pieces.size(); ++k) {
    EXPECT_LT(pieces[k], 0.8 * static_cast<double>(pieces[k - 1]));
    // Of the faintest, orders are left out that no display shows.
    EXPECT_NEAR(per_flux[k] / per_flux[0], 1, k < 3 ? 5e-3 : 0.05) << k;
  }
}

// Where the sky is seen as at rest and shifted as it moves, images are not found in batches: the
// pieces of a trail are then found one by one.  For who is at rest but for 1e-12 nothing else
// changes.
TEST(StarTrail, InBatchesHasThePiecesFoundOneByOne) {
  const auto rest = resting_celerity(10, Tetrad::kRain);
  StarScene batches({Region::kI, Tetrad::kRain, 10, rest}, Domemaster{1024});
  batches.motion.turn = V3d(0.001, -0.004, 0.002);
  StarScene singles = {
      {Region::kI, Tetrad::kRain, 10, Celerity<ReferenceTetrad>(rest + V3d(1e-12, 0, 0))},
      Domemaster{1024}};
  singles.motion = batches.motion;
  singles.show.effects.aberration = false;
  for (const double from_axis : {1e-5, 1e-3, 0.02}) {
    const SceneStar star{batches.sky(V3d(-1, from_axis, 0.003)), 4, 1e-10, 6000, 1e-9};
    const auto inside = [&](const StarScene& scene) {
      auto images = all_images(scene.images(), SceneStars({star}));
      std::erase_if(images, [&](const StarImage& image) {
        return !is_inside(scene.state.projection, {image.x + 1.0, image.y + 1.0});
      });
      return images;
    };
    const auto one = inside(batches), other = inside(singles);
    ASSERT_EQ(one.size(), other.size()) << from_axis;
    EXPECT_GT(one.size(), 20u);
    EXPECT_NE(total_light(one), total_light(other)) << "both were found in the same way";
    for (std::size_t k = 0; k < one.size(); ++k) {
      EXPECT_NEAR(one[k].x, other[k].x, 1e-3);
      EXPECT_NEAR(one[k].y, other[k].y, 1e-3);
      EXPECT_NEAR(light(one[k]), light(other[k]), 1e-4 * light(other[k]));
    }
  }
}

// The light of a star in cells about as large as a degree.
using Cells = std::map<std::pair<int, int>, double>;

Cells cells_at(const StarScene& scene, const V3d& source) {
  std::vector<StarImage> images;
  const SceneStar star{scene.sky(source), 4, 1e-10, 6000, 1e-9};
  for (const StarImage& image : all_images(scene.images(), SceneStars({star})))
    images.push_back(image);
  Cells cells;
  for (const StarImage& image : images)
    cells[{static_cast<int>(std::floor(image.x / 6)), static_cast<int>(std::floor(image.y / 6))}] +=
        light(image);
  return cells;
}

// The largest part of a frame's light in one cell that is in neither neighbour, as a star passes
// the axis in steps.
double largest_flash(const StarScene& scene, double from_axis, double step) {
  std::vector<Cells> frames;
  for (int k = -4; k <= 4; ++k)
    frames.push_back(cells_at(scene, V3d(-1, from_axis, (k + 0.1) * step)));
  double most = 0;
  for (std::size_t k = 1; k + 1 < frames.size(); ++k)
    for (const auto& [cell, light_now] : frames[k]) {
      const auto in = [at = cell](const Cells& cells) {
        const auto found = cells.find(at);
        return found == cells.end() ? 0 : found->second;
      };
      most = std::max(most, light_now - std::max(in(frames[k - 1]), in(frames[k + 1])));
    }
  double before = 0;
  for (const auto& [cell, light_now] : frames.front()) before = std::max(before, light_now);
  return most / before;
}

// However close a star passes behind the hole, no frame flashes: what is in one frame alone is no
// more than the star has a step away from the axis, which is four times what it has at first.
TEST(StarTrail, MakesNoFrameFlash) {
  const double step = 0.004;
  StarScene scene({Region::kI, Tetrad::kRain, 10, {0, 0, 0}}, Domemaster{1024});
  for (const double from_axis : {1e-6, 1e-4, 2e-3}) {
    scene.motion = {};
    const double still = largest_flash(scene, from_axis, step);
    scene.motion = {V3d(0, -step, 0)};
    EXPECT_LT(largest_flash(scene, from_axis, step), std::min(4.0, 0.3 * still)) << from_axis;
  }
}

// Far from the axis, and where the sky stands still, an image is that of the instant.
TEST(StarTrail, IsOneImageWhereTheSkyMovesLittle) {
  StarScene scene({Region::kI, Tetrad::kRain, 10, {0, 0, 0}}, Domemaster{1024});
  const SceneStar star{scene.sky(V3d(-1, 0.05, 0.02)), 4, 1e-10, 6000, 1e-9};
  const auto still = all_images(scene.images(), SceneStars({star}));
  scene.motion = {V3d(0, 0.001, 0)};
  const auto moving = all_images(scene.images(), SceneStars({star}));
  ASSERT_EQ(moving.size(), still.size());
  for (std::size_t k = 0; k < still.size(); ++k) {
    EXPECT_EQ(moving[k].x, still[k].x);
    EXPECT_EQ(moving[k].rgb[0], still[k].rgb[0]);
  }
}

// The light of a star near the axis does not depend on the size of the frame.
TEST(StarTrail, HasTheSameLightAtEverySize) {
  for (const V3d& turn : {V3d(0, 0, 0), V3d(0, -0.004, 0)})
    for (const double from_axis : {1e-5, 1e-3}) {
      double small = 0;
      for (const int size : {512, 1024, 4096}) {
        StarScene scene({Region::kI, Tetrad::kRain, 10, {0, 0, 0}}, Domemaster{size});
        scene.motion = {turn};
        const SceneStar star{scene.sky(V3d(-1, from_axis, 0.001)), 4, 1e-10, 6000, 1e-9};
        const double total = total_light(all_images(scene.images(), SceneStars({star})));
        if (small == 0) small = total;
        EXPECT_NEAR(total / small, 1, 0.01) << size << " " << from_axis;
      }
    }
}

class SpinStarTrail : public ShowFile {};

// Past a caustic about a spin a star's images race along the ring as rows of pieces without gaps, with the
// mean light of the times about the frame.
TEST_F(SpinStarTrail, HasNoGapsAndTheMeanLight) {
  const Show show = read(
      "black_hole: {mass_solar: 4e6, spin: 0.9}\nsize: [300, 300]\n"
      "camera: {projection: rectilinear, fov_deg: 80, look_at: hole}\n"
      "sky: {region_I: {background: black, stars: none}}\n"
      "timeline: [{duration_s: 1, trajectory: {type: static, r: 20}}]\n");
  FrameState state = frame_state(show, 0);
  state.settings.sky[SkyRegion::kI].max_magnitude = 99;
  const FrameScene still = scene_with(show, state);
  // The place on the sky of the brightest of many pixels, next to the caustic.
  V3d source(0, 0, 0);
  double least = HUGE_VAL;
  for (double x = 200; x < 300; x += 0.05) {
    const ViewRay ray = still.tracer.trace(direction_at(state.projection, {x, 150.5}));
    const double area = ray.scale_along * ray.scale_across;
    if (ray.known && area < least) least = area, source = ray.sky_direction;
  }
  const V3d turn = V3d(0.3, -1, 0.5) * 2e-3;
  const auto star_at = [&](double time) {
    const V3d in_tetrad = apply_transposed(state.observer.sky_from_tetrad, source);
    const V3d moved = (in_tetrad + turn.cross(in_tetrad) * time).normalized();
    return SceneStar{{apply(state.observer.sky_from_tetrad, moved)}, 4, 1e-7, 6000, 1e-9};
  };
  const FrameScene moving = scene_with(show, state, {}, {turn});
  std::vector<StarImage> trail;
  StarImageFinder(moving, SkyRegion::kI).append(star_at(0), trail);
  ASSERT_GT(trail.size(), 200u);
  std::size_t alone = 0;
  for (const StarImage& a : trail) {
    int near = -1;  // but for itself
    for (const StarImage& b : trail) near += std::hypot(a.x - b.x, a.y - b.y) < 1.5;
    alone += near == 0;
  }
  EXPECT_LE(alone, 4u);
  const StarImageFinder instants(still, SkyRegion::kI);
  constexpr int kTimes = 4000;
  double mean = 0;
  std::vector<StarImage> images;
  for (int k = 0; k < kTimes; ++k) {
    const double time = (2 * k + 1.0) / kTimes - 1;
    images.clear();
    instants.append(star_at(time), images);
    mean += 2 * (1 - std::abs(time)) / kTimes * total_light(images);
  }
  EXPECT_NEAR(total_light(trail) / mean, 1, 0.02);
}

}  // namespace
}  // namespace domefall
