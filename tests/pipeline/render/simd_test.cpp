#include <set>

#include "pipeline/base/errors.h"
#include "pipeline/base/simd/dispatch.h"
#include "pipeline/base/temporary_file.h"
#include "pipeline/render/sky/ray_grid.h"
#include "pipeline/render/sky/sky_pass.h"
#include "pipeline/sources/sky/sky_file.h"
#include "tests/pipeline/render/scenes.h"
#include "tests/pipeline/render/simd_levels.h"

namespace domefall {
namespace {

TEST(Simd, IsWhatAWordAsksForOrTheWidestThereIs) {
  EXPECT_TRUE(processor_has(Simd::kPortable));
  EXPECT_EQ(simd_named("portable"), Simd::kPortable);
  Simd widest = Simd::kPortable;
  for (const Simd level : kEverySimd) {
    if (processor_has(level)) {
      EXPECT_EQ(simd_named(name_of(level)), level);
      widest = level;
    } else {
      EXPECT_THROW(simd_named(name_of(level)), InputError);
      EXPECT_THROW(use_simd(level), InputError);
    }
  }
  EXPECT_EQ(simd_named(""), widest);
  for (const char* word : {"sse2", "AVX2", "avx", " avx2", "2"})
    EXPECT_THROW(simd_named(word), InputError) << word;
}

#if DOMEFALL_X86
// Returns where the loop that runs stands in memory.
[[gnu::always_inline]] inline std::uintptr_t place_loop() {
  std::uintptr_t here = 0;
  asm volatile("lea (%%rip), %0" : "=r"(here));
  return here;
}
Dispatched<place_loop> place_of_code;

TEST(Simd, RunsCodeOfItsOwnAtEachLevel) {
  std::set<std::uintptr_t> places;
  std::size_t levels = 0;
  for (const Simd level : kEverySimd) {
    if (!processor_has(level)) continue;
    const ScopedSimd scoped(level);
    EXPECT_EQ(simd_in_use(), level);
    places.insert(place_of_code());
    EXPECT_EQ(places.size(), ++levels) << name_of(level) << " runs another level's code";
  }
}
#endif

// ---- whole frames ----

class SimdFrames : public SimdLevel {};
INSTANTIATE_TEST_SUITE_P(Every, SimdFrames, kLevels, level_name);

// A map in a file that goes with the process.
PanoramaSky noisy_sky(SkyMapKind kind, const std::string& name, double unit) {
  static const ScratchFolder folder;
  NewSkyFile file(folder / name, kind, unit, 128, {});
  noise(file.pyramid());
  file.finish();
  return {folder / name};
}

const PanoramaSky& colour_sky() {
  static const PanoramaSky sky = noisy_sky(SkyMapKind::kColour, "colour.sky", 1e-7);
  return sky;
}

const PanoramaSky& thermal_sky() {
  static const PanoramaSky sky = noisy_sky(SkyMapKind::kThermal, "thermal.sky", 1e-9);
  return sky;
}

// Panoramas, thermal maps and stars, for observers of all kinds.
std::vector<std::pair<std::string, Show>> scenes(const Projection& projection) {
  const auto with = [&](const Trajectory& trajectory, const SkyBackground& one,
                        const SkyBackground& three, const SkyBackground& four) {
    Show show = starry(show_of(trajectory, projection));
    show.sky[SkyRegion::kI].background = one, show.sky[SkyRegion::kIII].background = three;
    show.sky[SkyRegion::kIV].background = four;
    return show;
  };
  const PanoramaSky &colour = colour_sky(), &thermal = thermal_sky();
  const BlackSky black;
  const GridSky grid;
  Show haloes = with(StaticObserver{7}, colour, black, black);
  haloes.point_spread.halo = 0.4, haloes.point_spread.halo_sigma = 2 * kDegree;
  haloes.point_spread.white_core = 10;
  haloes.timeline[0].camera.elevation = 80 * kDegree;
  return {
      {"7 M", with(StaticObserver{7}, colour, black, black)},
      {"7 M, thermal", with(RadialInfall{7}, thermal, black, black)},
      {"haloes", haloes},
      {"1.2 M, both skies", with(RadialInfall{1.2}, colour, thermal, black)},
      {"0.1 M, both skies", with(RadialInfall{0.1}, thermal, colour, black)},
      {"flat space", with(StaticObserver{}, colour, black, black)},
      {"flat space, brisk", with(GivenVelocity{Region::kI, Tetrad::kRain, kFlatSpace, {0, 1, 2}},
                                 thermal, black, black)},
      {"far away", with(StaticObserver{1e4}, thermal, black, black)},
      {"fast",
       with(GivenVelocity{Region::kI, Tetrad::kRain, 8, {-30, 40, 5}}, colour, black, black)},
      {"region III",
       with(GivenVelocity{Region::kIII, Tetrad::kRainOfThree, 4, {2, 0, 0}}, black, colour, grid)},
      {"region IV, grid",
       with(GivenVelocity{Region::kIV, Tetrad::kOutgoing, 0.7, {0, 0, 0}}, grid, grid, grid)},
      {"region IV, rings", with(GivenVelocity{Region::kIV, Tetrad::kOutgoing, 1.5, {0, 1, 0}}, grid,
                                grid, RingsSky{})}};
}

Bytes bytes_of_frame(const Show& show) {
  const HalfFrame frame = Renderer(show, 2).render(frame_state(show, 0));
  Bytes bytes;
  bytes.add(frame.pixels.data(), frame.pixels.size());
  return bytes;
}

TEST_P(SimdFrames, MakesTheSameDomes) {
  for (const auto& [name, show] : scenes(Domemaster{200}))
    compare(name, [&show = show] { return bytes_of_frame(show); });
}

TEST_P(SimdFrames, MakesTheSameFlatImages) {
  for (const auto& [name, show] : scenes(Stereographic{250, 141, 100 * kDegree}))
    compare(name, [&show = show] { return bytes_of_frame(show); });
}

// Which have loops of their own for directions and caps, so that one scene is enough.
TEST_P(SimdFrames, MakesTheSameFramesInOtherProjections) {
  for (const Projection& p :
       {Projection(Equirectangular{128}), Projection(Fisheye{96, 80, 300 * kDegree, 1}),
        Projection(Rectilinear{96, 64, 120 * kDegree})}) {
    Show show = scenes(p).front().second;
    show.sky[SkyRegion::kI].stars->max_magnitude = 4;
    compare(std::string(projection_name(p)), [&show] { return bytes_of_frame(show); });
  }
}

Bytes grid_of(const Show& show, const SkyMap& map) {
  const FrameState state = frame_state(show, 0);
  const Sky sky{std::make_shared<const SkyMap>(map), nullptr, {}};
  const FrameScene scene = scene_with(show, state, {&sky, &sky, nullptr});
  const PixelShader shader(scene);
  RayGrid grid;
  grid.make(shader, special_directions(scene));
  Bytes bytes;
  for (int j = 0; j < grid.cell_rows(); ++j)
    for (int i = 0; i < grid.cell_columns(); ++i) {
      const RayGrid::Cell& cell = grid.cell(j, i);
      bytes.add(&cell, 1);
      if (cell.kind != RayGrid::Kind::kSmooth) continue;
      SampleBatch batch{};
      grid.interpolate_row(j, j % RayGrid::kStep, i, i + 1, batch);
      for (const auto* column : {&batch.x, &batch.y, &batch.z, &batch.gain, &batch.tone})
        bytes.add(column->data(), RayGrid::kStep);
      grid.interpolate_block(j, i, i + 1, batch);
      for (const auto* column : {&batch.x, &batch.y, &batch.z, &batch.gain, &batch.tone,
                                 &batch.wide, &batch.narrow, &batch.ax, &batch.ay, &batch.az})
        bytes.add(column->data(), std::size_t{RayGrid::kStep} * RayGrid::kStep);
    }
  return bytes;
}

// The interpolated rays are compared too, whose differences half floats could hide.
TEST_P(SimdFrames, InterpolatesTheSameRays) {
  for (const PanoramaSky& sky : {colour_sky(), thermal_sky()}) {
    const SkyMap map = SkyFile(sky.image).map();
    for (const Trajectory& trajectory :
         {Trajectory(StaticObserver{7}), Trajectory(RadialInfall{1.2}),
          Trajectory(StaticObserver{}), Trajectory(StaticObserver{1e4}),
          Trajectory(CircularOrbit{4})}) {
      const Show show = show_of(trajectory, Domemaster{512});
      EXPECT_GT(compare("grid", [&] { return grid_of(show, map); }), 50000u);
    }
  }
}

// No scene is black, and no two are the same.
TEST(Simd, IsTriedOnScenesThatDiffer) {
  std::vector<Bytes> frames;
  for (const auto& [name, show] : scenes(Domemaster{64})) {
    const HalfFrame frame = Renderer(show, 2).render(frame_state(show, 0));
    EXPECT_GT(std::ranges::count_if(frame.pixels, [](Imath::half value) { return value > 0; }),
              1000)
        << name;
    Bytes bytes;
    bytes.add(frame.pixels.data(), frame.pixels.size());
    for (const Bytes& other : frames) EXPECT_NE(bytes.difference(other), -1) << name;
    frames.push_back(bytes);
  }
}

}  // namespace
}  // namespace domefall
