// Small shows for the tests of rendering.
#pragma once

#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfOutputFile.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <random>
#include <vector>

#include "pipeline/base/temporary_file.h"
#include "pipeline/render/renderer.h"
#include "pipeline/render/scene/frame_scene.h"
#include "tests/source_tree.h"
#include "trajectories/degree.h"

namespace domefall {

inline const std::string kTestAssets = source_file("shows/assets/");

// An OpenEXR file of floats, which is removed at the end of its life.  OpenEXR writes it, since
// OpenImageIO takes longer to load than most tests run.
class PanoramaFile {
 public:
  // value(k) is the number at k in an array [width / 2][width][3].
  template <class Value>
  PanoramaFile(int width, Value value) {
    std::vector<float> rgb;
    for (int k = 0; k < width * width / 2 * 3; ++k) rgb.push_back(value(k));
    Imf::Header header(width, width / 2);
    Imf::FrameBuffer buffer;
    const char* names[] = {"R", "G", "B"};
    for (int c = 0; c < 3; ++c) {
      header.channels().insert(names[c], Imf::Channel(Imf::FLOAT));
      const std::size_t pixel = 3 * sizeof(float);
      buffer.insert(names[c], Imf::Slice(Imf::FLOAT, reinterpret_cast<char*>(rgb.data() + c), pixel,
                                         pixel * static_cast<std::size_t>(width)));
    }
    Imf::OutputFile file(path().c_str(), header);
    file.setFrameBuffer(buffer);
    file.writePixels(width / 2);
  }

  std::filesystem::path path() const { return folder_ / "panorama.exr"; }

 private:
  ScratchFolder folder_;
};

// A small panorama of a few clouds, which costs little time to read.  Its file is removed with the
// process.
inline std::filesystem::path small_panorama() {
  static const PanoramaFile panorama(128, [](int k) {
    return static_cast<float>(1 + std::sin(k * 0.05) * std::cos(k * 0.0007)) / 2 + 0.1f;
  });
  return panorama.path();
}

inline Show show_of(const Trajectory& trajectory, const Projection& projection) {
  Show show;
  if (reach(trajectory).first != kFlatSpace) show.spacetime = Schwarzschild{};
  show.projection = projection;
  show.output.graded.reset();
  show.hole_at = {V3d(-0.0547, -0.872, -0.484).normalized()};
  Segment segment;
  segment.duration_s = 1;
  segment.trajectory = trajectory;
  segment.camera.elevation = 45 * kDegree;
  show.timeline = {segment};
  show.point_spread.min_sigma = 0.05 * kDegree;
  show.point_spread.max_sigma = 0.3 * kDegree;
  return show;
}

// At rest in a wormhole whose mouth is seen at the show's place.
inline Show show_in_wormhole(double l, const Projection& projection) {
  const Wormhole wormhole{1, Wormhole::Profile::kDngr, 0.5, 0.3};
  Show show = show_of(WormholeCircle{wormhole, l}, projection);
  show.spacetime = wormhole;
  return show;
}

inline Show starry(Show show) {
  show.sky[SkyRegion::kI].background = PanoramaSky{small_panorama()};
  show.sky[SkyRegion::kI].stars = StarField{kTestAssets + "stars_to_9.stars", 6.5};
  show.sky[SkyRegion::kIII] = show.sky[SkyRegion::kI];
  return show;
}

// A place near a charge, in any region and universe.
struct ChargedPlace {
  double charge, r;
  Region region = Region::kI;
  Tetrad tetrad = Tetrad::kRain;
  int universe = 0;
  Celerity<ReferenceTetrad> celerity{0, 0, 0};
};

// The first frame of a show, seen from there.
inline FrameState state_near_charge(const Show& show, const ChargedPlace& place) {
  FrameState state = frame_state(show, 0);
  ObserverState& o = state.observer;
  o.spacetime = ChargedHole(1, place.charge);
  o.r = place.r, o.region = place.region, o.tetrad = place.tetrad, o.universe = place.universe;
  o.celerity = place.celerity;
  return state;
}

// The plan of a frame that shows these skies, whatever the show has instead of them.
inline FramePlan plan_with(const Show& show, const FrameState& state,
                           const PerSky<const Sky*>& skies) {
  FramePlan plan = plan_frame(show, state);
  for (const SkyRegion sky : kEverySky)
    plan.sky[sky] = {skies[sky] && !std::holds_alternative<Black>(skies[sky]->background),
                     skies[sky] && skies[sky]->stars, false};
  return plan;
}

inline FrameScene scene_with(const Show& show, const FrameState& state,
                             const PerSky<const Sky*>& skies = {}, const SkyMotion& motion = {}) {
  return FrameScene(show, state, plan_with(show, state, skies),
                    lens_of(state.observer, WantedSkies{}, show.effects), skies, motion);
}

inline HalfFrame frame_of(const Show& show, int number = 0) {
  return Renderer(show, 1).render(frame_state(show, number));
}

// Where the audience's azimuth and elevation are, for a dome that is level: the zenith in the
// middle, the front at the bottom, the right hand at the right.
inline CameraDirection on_dome(double azimuth_deg, double elevation_deg) {
  const double a = azimuth_deg * kDegree, e = elevation_deg * kDegree;
  return {{std::cos(e) * std::sin(a), std::cos(e) * std::cos(a), std::sin(e)}};
}

inline V3d random_direction(std::mt19937& random) {
  std::normal_distribution<double> normal;
  return V3d(normal(random), normal(random), normal(random)).normalized();
}

// Holds the derivative that a ray has against the places of two rays beside it, `step` radians to
// either side of it, in the direction `way`.  The error is of the second order in the step, and of
// the rounding of places over the step.
inline void expect_derivative_of_neighbours(const ViewTracer& tracer, const V3d& n, const V3d& way,
                                            double step) {
  const V3d across = (way - n * n.dot(way)).normalized();
  const ViewRay ray = tracer.trace({n});
  const ViewRay ahead = tracer.trace({(n + across * step).normalized()});
  const ViewRay behind = tracer.trace({(n - across * step).normalized()});
  if (!ray.known || !ahead.known || !behind.known || ray.to_edge < 1e-2) return;
  EXPECT_NEAR(ray.axis.length(), 1, 1e-10);
  EXPECT_NEAR(ray.axis.dot(n), 0, 1e-10);
  const V3d moved = (ahead.sky_direction - behind.sky_direction) / (2 * step);
  EXPECT_LT((ray.moved(n, across) - moved).length(), 1e-5 * (1 + ray.longer()));
}

}  // namespace domefall
