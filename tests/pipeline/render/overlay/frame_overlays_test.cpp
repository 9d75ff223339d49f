// Overlays are drawn where the dome and the hole are, and frames with them have keys of their own.
#include "pipeline/render/overlay/frame_overlays.h"

#include <gtest/gtest.h>

#include <cmath>

#include "pipeline/render/frame_key.h"
#include "pipeline/render/overlay/burn_in_text.h"
#include "pipeline/render/overlay/frame_marks.h"
#include "pipeline/render/rays/view_tracer.h"
#include "tests/pipeline/image/test_folder.h"
#include "tests/pipeline/render/scenes.h"

namespace domefall {
namespace {

Show overlaid(OverlayKind overlay, const Projection& projection,
              const Trajectory& trajectory = StaticObserver{10}) {
  Show show = show_of(trajectory, projection);
  show.overlays = {overlay};
  return show;
}

float light_at(const HalfFrame& frame, const Projection& projection, const CameraDirection& n) {
  const auto pixel = pixel_of(projection, n);
  const int x = static_cast<int>(std::lround(pixel->i)) - 1,
            y = static_cast<int>(std::lround(pixel->j)) - 1;
  const Imath::half* rgb = frame.row(y) + 3 * x;
  return std::max(
      {static_cast<float>(rgb[0]), static_cast<float>(rgb[1]), static_cast<float>(rgb[2])});
}

TEST(FrameMarks, OfADomeLieAtTheirElevations) {
  const Domemaster dome{256};
  const HalfFrame rim = frame_of(overlaid(OverlayKind::kRim, dome)),
                  safe = frame_of(overlaid(OverlayKind::kSafeArea, dome)),
                  sweet = frame_of(overlaid(OverlayKind::kSweetSpot, dome)),
                  grid = frame_of(overlaid(OverlayKind::kGrid, dome));
  for (const double azimuth : {0., 33., 90., 180., -70.}) {
    EXPECT_GT(light_at(rim, dome, on_dome(azimuth, 0.4)), 0.3) << azimuth;
    EXPECT_EQ(light_at(rim, dome, on_dome(azimuth, 3)), 0) << azimuth;
    EXPECT_GT(light_at(safe, dome, on_dome(azimuth, kSafeElevationDeg)), 0.3) << azimuth;
    EXPECT_EQ(light_at(safe, dome, on_dome(azimuth, kSafeElevationDeg + 2)), 0) << azimuth;
    EXPECT_GT(light_at(grid, dome, on_dome(azimuth, 45)), 0.05) << azimuth;
    EXPECT_EQ(light_at(grid, dome, on_dome(azimuth + 17, 38)), 0) << azimuth;
  }
  for (const double azimuth : {-kSweetAzimuthDeg, -20., 0., 20., kSweetAzimuthDeg}) {
    EXPECT_GT(light_at(sweet, dome, on_dome(azimuth, kSweetLowestDeg)), 0.2) << azimuth;
    EXPECT_GT(light_at(sweet, dome, on_dome(azimuth, kSweetHighestDeg)), 0.2) << azimuth;
    EXPECT_EQ(light_at(sweet, dome, on_dome(azimuth + 180, 40)), 0) << azimuth;
  }
  for (const double elevation : {20., 35., 50.})
    for (const double side : {-kSafeAzimuthDeg, kSafeAzimuthDeg})
      EXPECT_GT(light_at(safe, dome, on_dome(side, elevation)), 0.2) << elevation;
  for (const double azimuth : {-45., 0., 45.})
    EXPECT_GT(light_at(safe, dome, on_dome(azimuth, kSafeHighestDeg)), 0.2) << azimuth;
  EXPECT_EQ(light_at(safe, dome, on_dome(180, 60)), 0);
  for (int y = 0; y < 256; ++y)
    for (const int x : {0, 255})
      if (!is_inside(dome, {x + 1.0, y + 1.0})) {
        EXPECT_EQ(rim.row(y)[3 * x], 0) << y;
      }
}

TEST(FrameMarks, OfAFlatImageAreFrames) {
  const Stereographic flat{200, 100, 90 * kDegree};
  const HalfFrame rim = frame_of(overlaid(OverlayKind::kRim, flat)),
                  safe = frame_of(overlaid(OverlayKind::kSafeArea, flat));
  for (const int x : {0, 100, 199}) {
    EXPECT_GT(rim.row(0)[3 * x], 0.9f);
    EXPECT_GT(rim.row(99)[3 * x], 0.9f);
  }
  EXPECT_EQ(rim.row(50)[3 * 100], 0);
  // 90 % of 100 rows begin at row 5, 80 % at row 10; the line is a pixel wide about the border.
  for (const int y : {5, 10}) {
    const float both = safe.row(y - 1)[3 * 100 + 1] + safe.row(y)[3 * 100 + 1];
    EXPECT_NEAR(both, static_cast<float>(safe.row(50)[3 * 10 + 1]) * 2, 0.01) << y;
    EXPECT_GT(both, 0.5) << y;
  }
}

TEST(FrameMarks, OfTheHoleAreDrawnWhereItIs) {
  for (const OverlayKind overlay : {OverlayKind::kSilhouette, OverlayKind::kEinsteinRing}) {
    const Show show = overlaid(overlay, Domemaster{256},
                               GivenVelocity{Region::kI, Tetrad::kRain, 8, {0, 0.5, 0}});
    const FrameState state = frame_state(show, 0);
    const ViewTracer tracer(state, WantedSkies{});
    const ViewCircle c =
        std::get<ViewCircle>(overlay == OverlayKind::kSilhouette ? tracer.borders().at(0).curve
                                                                 : tracer.einstein_rings().at(0));
    const V3d e1 = c.axis.cross(V3d(1, 0, 0)).normalized(), e2 = c.axis.cross(e1);
    const HalfFrame frame = frame_of(show);
    int seen = 0;
    for (int k = 0; k < 40; ++k) {
      const double t = k * 2 * std::numbers::pi / 40;
      const V3d n = c.axis * c.cosine + (e1 * std::cos(t) + e2 * std::sin(t)) * c.sine;
      if (n.z < 0.05) continue;
      ++seen;
      EXPECT_GT(light_at(frame, show.projection, {n}), 0.2) << k;
      const V3d off = (n + c.axis * 0.15).normalized();
      EXPECT_EQ(light_at(frame, show.projection, {off}), 0) << k;
    }
    EXPECT_GT(seen, 20);
    // Where light goes straight there is nothing to draw.
    Show straight = show;
    straight.effects.lensing = false;
    for (const Imath::half value : frame_of(straight).pixels) ASSERT_EQ(value, 0);
  }
}

TEST(FrameOverlays, EnterTheKey) {
  const auto key = [](const Show& show) { return FrameKeys(show).scene(frame_state(show, 0)); };
  Show show = show_of(StaticObserver{10}, Domemaster{64});
  show.spacetime = Schwarzschild{10};
  const std::string bare = key(show);
  std::vector<std::string> keys{bare};
  for (const auto& [overlay, name] : kOverlays) {
    show.overlays = {overlay};
    for (const std::string& other : keys) EXPECT_NE(key(show), other) << name;
    keys.push_back(key(show));
  }
  // The hole's mass is in the numbers that are burnt in, and nowhere else in a frame.
  Show heavier = show;
  heavier.spacetime = Schwarzschild{20};
  show.overlays = heavier.overlays = {OverlayKind::kBurnIn};
  show.timeline[0].timing = heavier.timeline[0].timing = {1, 2};
  EXPECT_NE(key(show), key(heavier));
  show.overlays = heavier.overlays = {};
  EXPECT_EQ(key(show), key(heavier));
}

TEST(FrameOverlays, BurnInStandsInTheCorners) {
  const Show show = overlaid(OverlayKind::kBurnIn, Domemaster{256});
  const HalfFrame frame = frame_of(show);
  const auto light = [&](int x0, int y0, int x1, int y1) {
    double sum = 0;
    for (int y = y0; y < y1; ++y)
      for (int x = x0; x < x1; ++x) sum += frame.row(y)[3 * x];
    return sum;
  };
  for (const int x : {0, 186})
    for (const int y : {0, 224}) EXPECT_GT(light(x, y, x + 70, y + 32), 20) << x << ", " << y;
  EXPECT_EQ(light(0, 40, 256, 216), 0);
}

TEST(FrameOverlays, BurnInOfADissolveTellsOfTheViewThatIsSeenBetter) {
  Show show = overlaid(OverlayKind::kBurnIn, Domemaster{64});
  show.frames_per_second = 10;
  show.timeline.push_back(show.timeline[0]);
  show.timeline[1].trajectory = StaticObserver{20};
  show.timeline[1].dissolve_s = 1;
  const FrameState before = frame_state(show, 4), after = frame_state(show, 6);
  ASSERT_TRUE(before.vanishing && after.vanishing);
  const BurnInText early = burn_in_text(show, before), late = burn_in_text(show, after);
  EXPECT_EQ(early.top_right, "region I\nr = 10.00 M");
  EXPECT_EQ(late.top_right, "region I\nr = 20.00 M");
  EXPECT_EQ(early.bottom_right, burn_in_text(show, *before.vanishing).bottom_right);
  EXPECT_NE(early.bottom_right, late.bottom_right);
  EXPECT_EQ(early.top_left, "frame 4\n0:00.4");
  // The key is that of the numbers that are written.
  FrameState other = before;
  other.observer.proper_time += 1;
  EXPECT_EQ(overlays_key(show, other), overlays_key(show, before));
  FrameState vanishing = *before.vanishing;
  vanishing.observer.proper_time += 1;
  other.vanishing = std::make_shared<const FrameState>(vanishing);
  EXPECT_NE(overlays_key(show, other), overlays_key(show, before));
}

class StarLabelImages : public TestFolder {};

// Of stars alone in a black sky each named image in the frame has light.
TEST_F(StarLabelImages, LieWhereTheRendererDrawsTheStar) {
  put(folder_ / "two.csv",
      "ra_deg,dec_deg,v_mag,b_v,name,designation\n"
      "250,-20,0,0.3,Near,alpha One\n"
      "70,20,1,0.3,,beta Two\n"
      "71,20,5,0.3,Faint,\n");
  for (const auto& [observer, effects] :
       {std::pair{GivenVelocity{Region::kI, Tetrad::kRain, 12, {0.1, 0.3, 0.5}}, Effects{}},
        {GivenVelocity{Region::kII, Tetrad::kRain, 1.7, {0, 0.2, 0}}, Effects{}},
        {GivenVelocity{Region::kI, Tetrad::kOutgoing, 9, {0.1, 0, 0.2}}, Effects{}},
        {GivenVelocity{Region::kI, Tetrad::kRain, 12, {0.1, 0.3, 0.5}},
         Effects{.aberration = false}},
        {GivenVelocity{Region::kI, Tetrad::kRain, 12, {0.1, 0.3, 0.5}}, Effects{.lensing = false}},
        {GivenVelocity{Region::kI, Tetrad::kRain, 12, {0.1, 0.3, 0.5}},
         Effects{.intensity = false, .amplification = Amplification::kNone}},
        {GivenVelocity{}, Effects{}}}) {
    Show show = show_of(observer, Domemaster{256});
    show.effects = effects;
    show.sky[SkyRegion::kI].stars = StarField{folder_ / "two.csv", 9};
    const FrameState state = frame_state(show, 0);
    StarLabels labels(show);
    const auto images = labels.images(state);
    EXPECT_GE(images.size(), 2u);
    // Both are brighter than what has no name, and each is seen where its image is.
    const HalfFrame frame = frame_of(show);
    int seen = 0;
    for (const NamedImage& image : images) {
      EXPECT_TRUE(image.name.starts_with("Near") || image.name.starts_with("beta Two"))
          << image.name;
      EXPECT_EQ(image.name.ends_with("\u2032"), image.secondary);
      const auto pixel = pixel_of(show.projection, image.direction);
      // At the rim its pixel may be none of the dome's.
      if (!pixel || image.direction.v.z < 0.03) continue;
      ++seen;
      EXPECT_GT(light_at(frame, show.projection, image.direction), 1e-3)
          << image.name << " of magnitude " << image.magnitude << " at r = " << observer.r << ", "
          << image.direction.v;
    }
    EXPECT_GT(seen, 0);
  }
}

class StarLabelLight : public StarLabelImages {
 protected:
  StarLabelLight() {
    put(folder_ / "one.csv", "ra_deg,dec_deg,v_mag,b_v,name\n250,-20,1,0.3,Near\n");
    show_ = show_of(GivenVelocity{Region::kI, Tetrad::kRain, 12, {0.1, 0.3, 0.5}}, Domemaster{256});
    show_.overlays = {OverlayKind::kStarNames};
    show_.sky[SkyRegion::kI].stars = StarField{folder_ / "one.csv", 9};
    show_.sky[SkyRegion::kIII] = show_.sky[SkyRegion::kI];
  }

  void set_gain(double gain) {
    for (const SkyRegion region : kExteriorSkies) show_.sky[region].star_gain = gain;
  }
  std::vector<NamedImage> images() { return StarLabels(show_).images(frame_state(show_, 0)); }
  std::string key() { return FrameKeys(show_).scene(frame_state(show_, 0)); }

  Show show_;
};

TEST_F(StarLabelLight, HasTheGainOverTheDefaultOfTheLaw) {
  const double bare = images().at(0).magnitude;
  const std::string key_of_bare = key();
  set_gain(0.1);
  EXPECT_NEAR(images().at(0).magnitude, bare + 2.5, 1e-9);
  EXPECT_NE(key(), key_of_bare);
  set_gain(0);
  EXPECT_TRUE(images().empty());
  EXPECT_NE(key(), key_of_bare);
  // The other law draws stars fainter by default, and names the same.
  show_.point_spread.halo = 0.1;
  set_gain(0.4);
  EXPECT_NEAR(images().at(0).magnitude, bare, 1e-9);
}

TEST_F(StarLabelLight, OfAKeyframedGainIsTheFrames) {
  Curve curve;
  curve.keys = {{0, 0}, {1, 1}};
  show_.timeline[0].curves[star_gain_channel(SkyRegion::kI)] = curve;
  EXPECT_TRUE(images().empty());
  StarLabels labels(show_);
  EXPECT_FALSE(labels.images(frame_state(show_, frame_count(show_) - 1)).empty());
}

TEST_F(StarLabelLight, IsThatOfTheEffectsThatTheShowKeeps) {
  show_.effects = {
      .doppler_colour = false, .intensity = false, .amplification = Amplification::kNone};
  const auto even = images();
  ASSERT_EQ(even.size(), 2u);
  for (const NamedImage& image : even) EXPECT_NEAR(image.magnitude, 1, 1e-6) << image.name;
  // Light of the same flux and another colour has another V.
  show_.effects = {.intensity = false, .amplification = Amplification::kNone};
  EXPECT_GT(std::abs(images().at(0).magnitude - 1), 0.05);
  // Who moves sees the same light of a star wherever it stands.
  show_.effects = {.amplification = Amplification::kNone};
  const double moved = images().at(0).magnitude;
  show_.effects.aberration = false;
  EXPECT_NEAR(images().at(0).magnitude, moved, 1e-9);
  EXPECT_GT(std::abs(moved - 1), 0.05);
}

}  // namespace
}  // namespace domefall
