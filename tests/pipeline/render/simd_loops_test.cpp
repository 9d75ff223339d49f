// The loops one by one: each width of SIMD gives the same bits, also for counts that fill no
// register.

#include <gtest/gtest.h>

#include <bit>

#include "pipeline/base/simd/half_row.h"
#include "pipeline/render/blobs/ellipse_blob.h"
#include "pipeline/render/rays/view_tracer.h"
#include "pipeline/render/sky/sky_sampler.h"
#include "pipeline/sources/colour/blackbody.h"
#include "tests/pipeline/render/blobs/drawn_blobs.h"
#include "tests/pipeline/render/simd_levels.h"
#include "tests/pipeline/render/stars/star_scene.h"
#include "tests/sanitized.h"

namespace domefall {
namespace {

class SimdLoops : public SimdLevel {};
INSTANTIATE_TEST_SUITE_P(Every, SimdLoops, kLevels, level_name);

TEST_P(SimdLoops, MakesTheSameHalves) {
  std::mt19937 random(5);
  std::uniform_int_distribution<std::uint32_t> bits(0, 0x47800000);  // 0 to 65536
  std::vector<float> values{0,        -0.0f,      1e-9f,    -1e-9f,       0x1p-24f,
                            0x1p-25f, 0x1.8p-24f, 0x1p-14f, 0x1.ffep-15f, 65504,
                            65519,    65520,      1e30f,    0x1p-149f,    0x1.8p-127f};
  while (values.size() < 20000) values.push_back(std::bit_cast<float>(bits(random)));
  // All halves, and what lies half way between them.
  for (std::uint32_t k = 0; k < 0x7c00; ++k) {
    Imath::half half;
    half.setBits(static_cast<std::uint16_t>(k));
    const float step = std::max(0x1p-24f, half * 0x1p-10f) / 2;
    for (const float off : {-step, 0.0f, step}) values.push_back(half + off);
  }
  const auto halves = [](const std::vector<float>& from, int count, std::size_t at = 0) {
    std::vector<std::uint16_t> out(at + from.size());
    const bool finite = to_half(from.data(), count, &out[at]);
    Bytes bytes;
    bytes.add(out);
    bytes.add(&finite, 1);
    return bytes;
  };
  for (const int less : {0, 1, 7, 31})
    compare("halves", [&] { return halves(values, static_cast<int>(values.size()) - less); });
  // Halves are written in blocks that begin at certain addresses.
  for (std::size_t at = 1; at < 40; ++at)
    for (const int count : {static_cast<int>(at), 70})
      compare("halves in between", [&] { return halves(values, count, at); });
  for (const float bad : {NAN, -NAN, INFINITY, -INFINITY})
    for (std::size_t at = 0; at < 70; ++at) {
      std::vector<float> few(values.begin(), values.begin() + 70);
      few[at] = bad;
      compare("not finite", [&] { return halves(few, 70); });
    }
}

SampleBatch random_samples(std::mt19937& random, double gain) {
  std::uniform_real_distribution<double> octave(-14, 1);
  SampleBatch batch{};
  for (std::size_t k = 0; k < SampleBatch::kSize; ++k) {
    const V3d d = random_direction(random) * (1 + 1e-3 * octave(random));
    batch.x[k] = static_cast<float>(d.x), batch.y[k] = static_cast<float>(d.y);
    batch.z[k] = static_cast<float>(d.z);
    batch.gain[k] = static_cast<float>(gain * std::exp2(octave(random)));
    batch.tone[k] = static_cast<float>(octave(random) + 7);
    batch.wide[k] = static_cast<float>(std::exp2(octave(random)));
    batch.narrow[k] = batch.wide[k] * 0.1f;
    const V3d along = d.cross(random_direction(random)).normalized() * batch.wide[k];
    batch.ax[k] = static_cast<float>(along.x), batch.ay[k] = static_cast<float>(along.y);
    batch.az[k] = static_cast<float>(along.z);
  }
  // Edges and corners of the cube.
  batch.x[0] = batch.y[0] = batch.x[1] = batch.z[2] = 1, batch.y[1] = batch.x[2] = -1;
  batch.z[0] = batch.z[1] = batch.y[2] = 0;
  return batch;
}

TEST_P(SimdLoops, SamplesTheSameInSkyMaps) {
  for (const SkyMapKind kind : {SkyMapKind::kColour, SkyMapKind::kThermal}) {
    const SkyPyramid pyramid(kind, 1e-9, 64);
    noise(pyramid);
    pyramid.finish();
    const SkyMap map = pyramid.map();
    const SkySampler sampler(map), above_black(map, 50);
    std::mt19937 random(1);
    const SampleBatch batch = random_samples(random, 1e-9);
    std::array<SampleFilter, SampleBatch::kSize> filters;
    for (const int count : {SampleBatch::kSize, SampleBatch::kSize - 3, 17, 1}) {
      const auto colours = [&](const auto& sample) {
        std::vector<float> rgb(3 * SampleBatch::kSize + 1);
        sample(rgb.data());
        Bytes bytes;
        bytes.add(rgb);
        return bytes;
      };
      for (const int taps : {1, 2, 4, 8, SkySampler::kMostTaps})
        for (const bool minified : {false, true}) {
          filters.fill(SampleFilter(taps, minified));
          compare(std::to_string(taps) + " taps of " + std::to_string(count), [&] {
            return colours([&](float* rgb) { sampler.sample(batch, count, filters.data(), rgb); });
          });
        }
      compare("plain", [&] {
        return colours([&](float* rgb) { sampler.sample_plain(batch, count, rgb); });
      });
      compare("plain, above black", [&] {
        return colours([&](float* rgb) { above_black.sample_plain(batch, count, rgb); });
      });
      compare("four taps above black", [&] {
        filters.fill(SampleFilter(4, true));
        return colours([&](float* rgb) { above_black.sample(batch, count, filters.data(), rgb); });
      });
      compare("every filter", [&] {
        sampler.choose_filters(batch.wide.data(), batch.narrow.data(), count, SkySampler::kMostTaps,
                               0.7f, filters.data());
        return colours([&](float* rgb) { sampler.sample(batch, count, filters.data(), rgb); });
      });
    }
  }
}

std::vector<Trajectory> loop_trajectories() {
  return {StaticObserver{3},
          StaticObserver{1e7},
          StaticObserver{},
          CircularOrbit{6},
          RadialInfall{1.2},
          RadialInfall{0.05},
          GivenVelocity{Region::kI, Tetrad::kRain, 30, {300, -800, 500}},
          GivenVelocity{Region::kI, Tetrad::kOutgoing, 2.01, {0, 0, 0}},
          GivenVelocity{Region::kIII, Tetrad::kRainOfThree, 4, {2, 0, 0}},
          GivenVelocity{Region::kIV, Tetrad::kOutgoing, 0.2, {0, 0, 0}},
          GivenVelocity{Region::kI, Tetrad::kRain, kFlatSpace, {0, 1, 2}}};
}

Bytes rays_of(const ViewTracer& tracer, const std::vector<CameraDirection>& n) {
  Bytes bytes;
  ViewRayBatch b;
  const auto count = static_cast<int>(n.size());
  // A ray from a sky without a table leaves most columns as they are.
  for (auto* column :
       {&b.sky_x, &b.sky_y, &b.sky_z, &b.along_x, &b.along_y, &b.along_z, &b.frequency_ratio,
        &b.scale_along, &b.scale_across, &b.to_edge, &b.emission_time, &b.time_scale})
    column->fill(0);
  tracer.trace(n.data(), count, b);
  for (const auto* column :
       {&b.sky_x, &b.sky_y, &b.sky_z, &b.along_x, &b.along_y, &b.along_z, &b.frequency_ratio,
        &b.scale_along, &b.scale_across, &b.to_edge, &b.emission_time, &b.time_scale})
    bytes.add(column->data(), n.size());
  bytes.add(b.sky.data(), n.size());
  return bytes;
}

TEST_P(SimdLoops, TracesTheSameRays) {
  std::mt19937 random(4);
  for (const Trajectory& trajectory : loop_trajectories()) {
    const Show show = show_of(trajectory, Domemaster{64});
    const FrameState state = frame_state(show, 0);
    const ViewTracer tracer(state, WantedSkies{{true, true, true}, true});
    for (const std::size_t count : {128, 127, 61, 3, 1}) {
      std::vector<CameraDirection> n(count);
      for (auto& direction : n) direction.v = random_direction(random);
      n[0].v = apply_transposed(state.observer.tetrad_from_camera, V3d(-1, 0, 0));
      compare("observer " + std::to_string(trajectory.index()) + ", " + std::to_string(count),
              [&] { return rays_of(tracer, n); });
    }
  }
}

SceneStars random_stars(int count) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> magnitude(-1, 9), temperature(2500, 30000);
  std::vector<SceneStar> stars;
  for (int k = 0; k < count; ++k) {
    const double t = temperature(random), v = magnitude(random);
    stars.push_back({{random_direction(random)},
                     v,
                     std::pow(10, -0.4 * v) * bolometric_flux_at_v_zero(t),
                     t,
                     1e-9});
  }
  return SceneStars(std::move(stars));
}

Bytes images_at(const Trajectory& trajectory, const SceneStars& stars) {
  Bytes bytes;
  for (const Projection& p :
       {Projection(Domemaster{512}), Projection(Stereographic{640, 360, 2.0})}) {
    const Show show = show_of(trajectory, p);
    FrameState state = frame_state(show, 0);
    for (const SkyRegion sky : kExteriorSkies) state.settings.sky[sky].max_magnitude = 99;
    state.settings.ev = 8;
    const ObserverState& o = state.observer;
    const FrameScene scene = scene_with(show, state);
    const SkyRegion own = own_sky(o);
    for (const SkyRegion sky : {own, own == SkyRegion::kI ? SkyRegion::kIII : SkyRegion::kI})
      if (scene.tracer.lens()->points(sky, {}))
        bytes.add(all_images(StarImageFinder(scene, sky), stars));
  }
  return bytes;
}

TEST_P(SimdLoops, FindsTheSameImagesOfStars) {
  const SceneStars stars = random_stars(2000);
  std::size_t bytes = 0;
  for (const Trajectory& trajectory : loop_trajectories())
    bytes += compare("observer " + std::to_string(trajectory.index()),
                     [&] { return images_at(trajectory, stars); });
  EXPECT_GT(bytes, 10000 * sizeof(StarImage));
}

Bytes views_of(const StarFrame& frame, const SkyPoints& points, const SceneStars& stars,
               int count) {
  Bytes bytes;
  StarSources s;
  find_sources(frame, stars, kStarBatch, count, s);
  points.locate(s, count);
  const auto number = static_cast<std::size_t>(count);
  for (const auto* column : {&s.x, &s.y, &s.z, &s.sine, &s.v, &s.flux, &s.temperature})
    bytes.add(column->data(), number);
  const auto place = [&](StarViews& v) {
    for (const Projection& p :
         {Projection(Domemaster{512}), Projection(Stereographic{640, 360, 2.0})}) {
      std::array<int, kStarBatch> listed{};
      const int there = StarPlane(p, 0.02).place(v, count, listed.data());
      for (const auto* column : {&v.x, &v.y, &v.z, &v.flux, &v.temperature, &v.i, &v.j})
        bytes.add(column->data(), number);
      bytes.add(listed.data(), static_cast<std::size_t>(there));
    }
  };
  StarViews views;
  PointImageBatch images;
  for (int order = 0; order < std::min(points.orders_in_batches(), 4); ++order) {
    points.images(order, s, count, images);
    receive_images(frame, images, s, count, views);
    place(views);
  }
  return bytes;
}

TEST_P(SimdLoops, BendsTheSameLight) {
  const SceneStars stars = random_stars(3 * kStarBatch);
  for (const Trajectory& trajectory : loop_trajectories()) {
    const FrameState state = frame_state(show_of(trajectory, Domemaster{64}), 0);
    const ObserverState& o = state.observer;
    StarFrame frame{o.sky_from_tetrad, o.tetrad_from_camera, Aberration(-o.celerity)};
    frame.gain = 1e3, frame.limit = 5.5, frame.inverse_fade = 2;
    const auto lens = lens_of(o, WantedSkies{}, {});
    const auto points = lens->points(own_sky(o), PointTolerance{});
    if (!points) continue;
    for (const int count : {kStarBatch, kStarBatch - 1, 13, 1})
      compare("observer " + std::to_string(trajectory.index()) + ", " + std::to_string(count),
              [&] { return views_of(frame, *points, stars, count); });
  }
}

TEST_P(SimdLoops, SeesTheSameTrails) {
  const SkyTable table = SkyTable(schwarzschild_zone(10, Critical::kFirst));
  const AxisPassage passage(V3d(-1, 0.003, 0.001), V3d(0, -0.04, 0.02), 1e-5, 3.7);
  const StarTrail trail([&](const V3d& at) { return image_of(&table, at, 1, 0); }, passage);
  const Aberration boost(V3d(0.3, -0.8, 0.1));
  const FrameState state = frame_state(show_of(StaticObserver{}, Domemaster{64}), 0);
  for (const int count : {kStarBatch, kStarBatch - 1, 13, 1})
    compare(std::to_string(count), [&] {
      Bytes bytes;
      StarViews v;
      for (std::size_t k = 0; k < trail.parts(); ++k) {
        trail.store(k, kStarBatch, kStarBatch - count, count, boost,
                    state.observer.tetrad_from_camera, v, 0);
        for (const auto* column : {&v.x, &v.y, &v.z, &v.flux, &v.temperature})
          bytes.add(column->data(), static_cast<std::size_t>(count));
      }
      return bytes;
    });
}

std::vector<StarImage> random_images(const Projection& p, int count) {
  std::mt19937 random(11);
  std::uniform_real_distribution<double> u(0, 1);
  std::vector<StarImage> images;
  for (int k = 0; k < count; ++k) {
    const auto light = static_cast<float>(1e-8 * std::pow(10, 7 * u(random)));
    images.push_back({static_cast<float>((1.2 * u(random) - 0.1) * columns(p)),
                      static_cast<float>((1.2 * u(random) - 0.1) * rows(p)),
                      {light, light * static_cast<float>(u(random)), light / 3}});
  }
  return images;
}

TEST_P(SimdLoops, PlacesAndDrawsTheSameBlobs) {
  for (const Projection& p :
       {Projection(Domemaster{1024}), Projection(Stereographic{900, 510, 1.5})}) {
    const std::vector<StarImage> images = random_images(p, tries(3001, 701));
    std::mt19937 random(12);
    std::uniform_real_distribution<double> width(0.9, 2);
    std::vector<double> sigma;
    for (std::size_t k = 0; k < images.size(); ++k)
      sigma.push_back(width(random) * largest_pixel_angle(p));
    compare("places", [&] {
      std::vector<EllipseBlob> blobs(images.size());
      std::vector<int> first_row(images.size());
      std::vector<BlobKind> kind(images.size());
      place_ellipses(p, images.data(), sigma.data(), images.size(), 50, blobs.data(),
                     first_row.data(), kind.data());
      EXPECT_GT(std::count(kind.begin(), kind.end(), BlobKind::kEllipse), tries(500, 100));
      Bytes bytes;
      bytes.add(blobs);
      bytes.add(first_row);
      bytes.add(kind);
      return bytes;
    });
    PointSpreadLaw plain{0.05 * kDegree, 0.3, 2, 3 * kDegree}, haloes = plain;
    haloes.halo = 0.3, haloes.halo_sigma = 2 * kDegree, haloes.white_core = 10;
    for (const PointSpreadLaw& law : {plain, haloes})
      compare("drawn", [&] {
        Bytes bytes;
        bytes.add(drawn(images, p, PointSpread(law, p, 1e3)).rgb);
        return bytes;
      });
  }
}

}  // namespace
}  // namespace domefall
