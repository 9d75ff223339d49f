// Titles stand where the show says, upright for the audience, and no other frame knows of them.
#include "pipeline/render/overlay/frame_titles.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <set>

#include "pipeline/render/frame_key.h"
#include "pipeline/render/scene/body_sight.h"
#include "tests/pipeline/render/scenes.h"

namespace domefall {
namespace {

Title title_of(const std::string& text, double azimuth_deg, double elevation_deg,
               double height_deg) {
  Title title;
  title.text = text;
  title.style.font = "DejaVu Sans";
  title.end_s = 1;
  title.azimuth = azimuth_deg * kDegree;
  title.elevation = elevation_deg * kDegree;
  title.height = height_deg * kDegree;
  return title;
}

Show titled(const Title& title, const Projection& projection, double tilt = 0) {
  Show show = show_of(StaticObserver{10}, projection);
  show.timeline[0].camera.dome_tilt = tilt;
  show.titles = {title};
  return show;
}

// The sum of `value` of all pixels, weighted by their light and solid angle.
double integral(const HalfFrame& frame, const Projection& projection,
                const std::function<double(const CameraDirection&)>& value) {
  double sum = 0;
  for (int y = 0; y < frame.height; ++y)
    for (int x = 0; x < frame.width; ++x) {
      const float light = frame.row(y)[3 * x + 1];
      const PixelPosition pixel{x + 1.0, y + 1.0};
      if (light > 0)
        sum +=
            light * pixel_solid_angle(projection, pixel) * value(direction_at(projection, pixel));
    }
  return sum;
}

CameraDirection middle_of_light(const HalfFrame& frame, const Projection& projection) {
  V3d middle;
  for (int k = 0; k < 3; ++k)
    middle[k] = integral(frame, projection, [k](const CameraDirection& n) { return n.v[k]; });
  return {middle.normalized()};
}

// The letter O is symmetric about its middle but for its overshoot.
TEST(FrameTitles, StandWhereTheShowSays) {
  const Domemaster dome{256};
  for (const double azimuth : {0., 90., 180., -90., 37.})
    for (const double elevation : {12., 45., 75., 90.}) {
      const auto middle =
          middle_of_light(frame_of(titled(title_of("O", azimuth, elevation, 8), dome)), dome);
      const auto expected = on_dome(azimuth, elevation);
      // Mercator's scale grows towards the pole, so that the upper half is smaller: by some
      // hundredths of the letter's height.
      EXPECT_LT((middle.v - expected.v).length(), 0.35 * kDegree) << azimuth << ", " << elevation;
    }
}

TEST(FrameTitles, LeanWithTheDome) {
  const Domemaster dome{256};
  const auto middle =
      middle_of_light(frame_of(titled(title_of("O", 0, 30, 8), dome, 20 * kDegree)), dome);
  EXPECT_LT((middle.v - on_dome(0, 50).v).length(), 0.35 * kDegree);
  // To the right of a dome that leans to the front a level place is no higher.
  const auto right =
      middle_of_light(frame_of(titled(title_of("O", 90, 30, 8), dome, 20 * kDegree)), dome);
  EXPECT_NEAR(right.v.x, std::cos(30 * kDegree), 0.005);
}

TEST(FrameTitles, CountFromTheLineOfSightOfAFlatImage) {
  const Stereographic flat{256, 144, 100 * kDegree};
  const auto middle = middle_of_light(frame_of(titled(title_of("O", 20, 10, 6), flat)), flat);
  const V3d expected(std::cos(10 * kDegree) * std::sin(20 * kDegree), -std::sin(10 * kDegree),
                     std::cos(10 * kDegree) * std::cos(20 * kDegree));
  EXPECT_LT((middle.v - expected).length(), 0.3 * kDegree);
}

// An L has its stem at the left, its foot at the bottom, and nothing where they are not.
TEST(FrameTitles, AreUprightForThoseWhoTurnTowardsThem) {
  const Domemaster dome{256};
  for (const double azimuth : {0., 90., 180., 270., 130.})
    for (const double tilt : {0., 20.}) {
      const Title title = title_of("L", azimuth, 30, 10);
      const Show show = titled(title, dome, tilt * kDegree);
      const FrameState state = frame_state(show, 0);
      const M33d& audience = state.camera_from_audience;
      const double a = azimuth * kDegree;
      const V3d middle = apply(audience, on_dome(azimuth, 30).v),
                right = apply(audience, V3d(std::cos(a), -std::sin(a), 0)),
                up = middle.cross(right) *
                     (middle.cross(right).dot(column(audience, 2)) > 0 ? 1 : -1);
      double quarter[2][2] = {{0, 0}, {0, 0}};  // [upper][right]
      const HalfFrame frame = frame_of(show);
      integral(frame, dome, [&](const CameraDirection& n) {
        ++quarter[n.v.dot(up) > 0.3 * kDegree][n.v.dot(right) > 0.3 * kDegree];
        return 0.0;
      });
      EXPECT_EQ(quarter[1][1], 0) << azimuth << " tilt " << tilt;
      EXPECT_GT(quarter[1][0], 10) << azimuth << " tilt " << tilt;
      EXPECT_GT(quarter[0][0], 10) << azimuth << " tilt " << tilt;
      EXPECT_GT(quarter[0][1], 10) << azimuth << " tilt " << tilt;
    }
}

TEST(FrameTitles, HaveTheSameLightAtEverySize) {
  const Title title = title_of("Sgr A*", 20, 35, 3);
  const auto light = [&](int size) {
    const Domemaster dome{size};
    return integral(frame_of(titled(title, dome)), dome,
                    [](const CameraDirection&) { return 1.0; });
  };
  const double large = light(512);
  EXPECT_GT(large, 0);
  // Half floats hold 11 bits.
  for (const int size : {64, 128, 256}) EXPECT_NEAR(light(size) / large, 1, 2e-3) << size;
}

TEST(FrameTitles, FadeEvenlyToTheEyeAndEndWithTheirTime) {
  Title title = title_of("█", 0, 30, 20);
  title.begin_s = 0.2;
  title.end_s = 0.8;
  title.fades = {0.2, 0.1};
  Show show = titled(title, Domemaster{64});
  const auto opacity = [&](double t) {
    FrameState state = frame_state(show, 0);
    state.show_time_s = t;
    const auto seen = seen_titles(show, state);
    return seen.empty() ? 0 : seen[0].opacity;
  };
  EXPECT_EQ(opacity(0.1), 0);
  EXPECT_EQ(opacity(0.2), 0);
  EXPECT_NEAR(opacity(0.3), 0.25, 1e-12);
  EXPECT_EQ(opacity(0.5), 1);
  EXPECT_NEAR(opacity(0.75), 0.25, 1e-12);
  EXPECT_EQ(opacity(0.8), 0);
  // The pixel in the middle of the letter has that part of the light.
  show.titles[0].light = {2, 1, 0.5f};
  show.frames_per_second = 40;
  const HalfFrame half = frame_of(show, 12), whole = frame_of(show, 20);
  const auto pixel = pixel_of(show.projection, on_dome(0, 30));
  const int at = 3 * (static_cast<int>(pixel->i) - 1), row = static_cast<int>(pixel->j) - 1;
  EXPECT_NEAR(whole.row(row)[at], 2, 1e-3);
  EXPECT_NEAR(whole.row(row)[at + 2], 0.5, 1e-3);
  EXPECT_NEAR(half.row(row)[at], 0.5, 1e-3);
}

TEST(FrameTitles, GoWithTheDirectImageOfABody) {
  const double height = 3 * kDegree;
  Title title = title_of("O", 0, 0, 3);
  title.body = 0;
  Show show = titled(title, Domemaster{256});
  show.timeline[0].trajectory = StaticObserver{40};
  show.bodies.resize(1);
  show.bodies[0].magnitude = 30;  // too faint to be drawn itself
  const double below = (1 + title_letters("O", title.style)->half_height) * height;
  for (const double azimuth : {0.3, 2.0, 4.0}) {
    show.bodies[0].azimuth = azimuth;
    const FrameState state = frame_state(show, 0);
    const BodySight sight(state, show.effects, show.least_star_radius);
    const V3d image = sight.seen(sight.image(show.bodies[0], 0)->at).direction.v,
              middle = middle_of_light(frame_of(show), show.projection).v;
    EXPECT_NEAR(std::acos(image.dot(middle)), below, 0.1 * height) << azimuth;
    EXPECT_LT(middle.z, image.z) << "farther from the zenith";
  }
  // Without a lens no body is seen, and none is named.
  show.effects.lensing = false;
  EXPECT_EQ(integral(frame_of(show), show.projection, [](const CameraDirection&) { return 1; }), 0);
}

TEST(FrameTitles, HaveThePartOfTheirLightThatAKeyframeLeaves) {
  Title title = title_of("█", 0, 45, 20);
  title.light = {2, 1, 0.5f};
  Show show = titled(title, Domemaster{64});
  const auto pixel = pixel_of(show.projection, on_dome(0, 45));
  const int at = 3 * (static_cast<int>(pixel->i) - 1), row = static_cast<int>(pixel->j) - 1;
  const auto light = [&] { return static_cast<float>(frame_of(show).row(row)[at]); };
  const auto key = [&] { return FrameKeys(show).scene(frame_state(show, 0)); };
  std::set<std::string> keys{key()};
  EXPECT_EQ(light(), 2);
  show.timeline[0].curves[Channel::kTitleGain] = Curve{{{0, 0.25}}};
  keys.insert(key());
  EXPECT_EQ(light(), 0.5);
  show.timeline[0].curves[Channel::kTitleOpacity] = Curve{{{0, 0.5}}};
  keys.insert(key());
  EXPECT_EQ(light(), 0.25);
  EXPECT_EQ(keys.size(), 3U);
  // At 0 there is no title.
  show.timeline[0].curves[Channel::kTitleOpacity] = Curve{{{0, 0}}};
  EXPECT_EQ(titles_key(show, frame_state(show, 0)), "");
  EXPECT_EQ(light(), 0);
}

TEST(FrameTitles, CoverWhatIsBehindAndAreNotFadedWithIt) {
  Title title = title_of("█", 0, 45, 20);
  title.light = {0, 0, 0};
  Show show = titled(title, Domemaster{64});
  show.sky[SkyRegion::kI].background = GridSky{};
  show.timeline[0].trajectory = StaticObserver{1000};
  const auto pixel = pixel_of(show.projection, on_dome(0, 45));
  const int at = 3 * (static_cast<int>(pixel->i) - 1), row = static_cast<int>(pixel->j) - 1;
  EXPECT_EQ(static_cast<float>(frame_of(show).row(row)[at]), 0);
  show.titles[0].light = {1, 1, 1};
  show.fades.in_s = 0.5;
  const HalfFrame black = frame_of(show);
  EXPECT_EQ(static_cast<float>(black.row(row)[at]), 1);
  EXPECT_EQ(static_cast<float>(black.row(5)[3 * 32]), 0);
}

TEST(FrameTitles, EnterTheKeysOfTheFramesThatShowThem) {
  Title title = title_of("I", 0, 45, 10);
  title.begin_s = 0.3;
  title.end_s = 0.6;
  Show plain = show_of(StaticObserver{10}, Domemaster{64});
  plain.frames_per_second = 10;
  Show show = plain;
  show.titles = {title};
  const auto key = [](const Show& s, int frame) {
    return FrameKeys(s).scene(frame_state(s, frame));
  };
  for (const int frame : {0, 2, 6, 9}) EXPECT_EQ(key(plain, frame), key(show, frame)) << frame;
  for (const int frame : {3, 5}) EXPECT_NE(key(plain, frame), key(show, frame)) << frame;

  const auto changes = [&](const std::function<void(Title&)>& change) {
    Show other = show;
    change(other.titles[0]);
    return key(other, 4) != key(show, 4);
  };
  EXPECT_FALSE(changes([](Title& t) { t.end_s = 0.7; }));
  EXPECT_TRUE(changes([](Title& t) { t.text = "J"; }));
  EXPECT_TRUE(changes([](Title& t) { t.style.font = "DejaVu Sans Bold"; }));
  EXPECT_TRUE(changes([](Title& t) { t.azimuth += 0.01; }));
  EXPECT_TRUE(changes([](Title& t) { t.elevation += 0.01; }));
  EXPECT_TRUE(changes([](Title& t) { t.height *= 1.01; }));
  EXPECT_TRUE(changes([](Title& t) { t.light.g = 0.9f; }));
  EXPECT_TRUE(changes([](Title& t) { t.plate = 0.5; }));
  EXPECT_TRUE(changes([](Title& t) { t.shadow = 0.5; }));
  EXPECT_TRUE(changes([](Title& t) { t.fades.out_s = 0.3; }));
  // A segment's title is the same title.
  Show moved = plain;
  moved.timeline[0].titles = {title};
  EXPECT_EQ(key(moved, 4), key(show, 4));
  // Without its titles a show has the frames of one that has none.
  show.draws_titles = false;
  EXPECT_EQ(key(show, 4), key(plain, 4));
}

TEST(FrameTitles, EnterTheKeysWithWhatTheirCountersShow) {
  Title title = title_of("{time}", 0, 45, 10);
  title.end_s = 3;
  Show show = show_of(StaticObserver{10}, Domemaster{64});
  show.timeline[0].duration_s = 3;
  show.frames_per_second = 10;
  show.titles = {title};
  FrameState state = frame_state(show, 12);
  const auto key = [&](double t) {
    state.show_time_s = t;
    return titles_key(show, state);
  };
  EXPECT_EQ(key(1.1), key(1.9));
  EXPECT_NE(key(1.1), key(2.1));
  state.show_time_s = 2.1;
  EXPECT_EQ(seen_titles(show, state).at(0).text, "0:02");
  show.overlays = {OverlayKind::kNoTitles};
  EXPECT_EQ(key(1.1), "");
  EXPECT_TRUE(seen_titles(show, state).empty());
}

// The value of the pixel at a place of a dome, in degrees.
double seen_at(const HalfFrame& frame, const Projection& projection, double azimuth,
               double elevation) {
  const auto pixel = pixel_of(projection, on_dome(azimuth, elevation));
  return frame.row(static_cast<int>(std::lround(pixel->j)) -
                   1)[3 * (static_cast<int>(std::lround(pixel->i)) - 1)];
}

// A title over light of 1 everywhere.
HalfFrame on_white(const Title& title, const Projection& projection) {
  HalfFrame frame(columns(projection), rows(projection));
  std::ranges::fill(frame.pixels, Imath::half(1));
  const Show show = titled(title, projection);
  draw_titles(show, frame_state(show, 0), frame);
  return frame;
}

TEST(TitleGround, APlateDimsTheWholeTextAndFallsOffSoftly) {
  const Domemaster dome{512};
  for (const double azimuth : {0., 90., 180.}) {
    Title title = title_of("I I", azimuth, 30, 6);
    title.plate = 0.75;
    const HalfFrame frame = on_white(title, dome);
    const double top = 33;  // of the letters
    EXPECT_NEAR(seen_at(frame, dome, azimuth, 30), 0.25, 2e-3) << "between the letters";
    EXPECT_NEAR(seen_at(frame, dome, azimuth, top + 1), 0.25, 2e-3);
    // From half a capital above the text to 1.7 of them it falls off.
    double last = 0.25;
    for (const double up : {4.5, 6., 7.5, 9.}) {
      const double light = seen_at(frame, dome, azimuth, top + up);
      EXPECT_GT(light, last) << up;
      last = light;
    }
    EXPECT_EQ(seen_at(frame, dome, azimuth, top + 13), 1);
    EXPECT_EQ(seen_at(frame, dome, azimuth + 120, 30), 1);
    EXPECT_EQ(seen_at(frame, dome, azimuth, 80), 1);
  }
}

// It lies on the dome and not in the picture, so it is the same in pictures of all kinds, also
// where a seam goes through it.
TEST(TitleGround, IsTheSameInEveryProjectionAndAtEverySize) {
  Title title = title_of("Light", 180, 25, 6);
  title.plate = 0.75;
  title.shadow = 0.5;
  const auto taken = [&](const Projection& projection) {
    const HalfFrame frame = on_white(title, projection);
    double sum = 0;
    for (int row = 0; row < frame.height; ++row) {
      const ColumnRange inside = inside_columns(projection, row);
      for (int column = inside.first; column <= inside.last; ++column)
        sum += (1 - frame.row(row)[3 * column]) *
               pixel_solid_angle(projection, {column + 1.0, row + 1.0});
    }
    return sum;
  };
  const double expected = taken(Domemaster{768});
  EXPECT_GT(expected, 0.02);
  EXPECT_NEAR(taken(Domemaster{192}) / expected, 1, 0.01);
  EXPECT_NEAR(taken(Equirectangular{768}) / expected, 1, 0.01);
  EXPECT_NEAR(taken(Fisheye{300, 300, std::numbers::pi * 1.9}) / expected, 1, 0.01);
}

TEST(TitleGround, AShadowIsDarkAroundLettersAndNotBetweenFarOnes) {
  Title title = title_of("I          I", 0, 30, 6);
  const Domemaster dome{512};
  const auto darkest = [&](double shadow) {
    title.shadow = shadow;
    const HalfFrame frame = on_white(title, dome);
    EXPECT_EQ(seen_at(frame, dome, 0, 30), 1) << "between the letters";
    double least = 1;
    for (double azimuth = -30; azimuth < 0; azimuth += 0.25)
      least = std::min(least, seen_at(frame, dome, azimuth, 30));
    return least;
  };
  EXPECT_EQ(darkest(0), 1);
  // Beside a single stroke, which covers the darkest pixels.
  EXPECT_NEAR(darkest(0.8), 0.2, 0.06);
  EXPECT_NEAR(darkest(0.4), 0.6, 0.03);
}

// What mattes say of a title is what is missing of the light behind it, if its letters are black.
TEST(TitleGround, CountsInMattes) {
  Title title = title_of("Light", 20, 35, 7);
  title.light = {0, 0, 0};
  title.plate = 0.5;
  title.shadow = 0.7;
  title.fades.in_s = 4;
  title.end_s = 8;
  const Show show = titled(title, Domemaster{256});
  FrameState state = frame_state(show, 0);
  state.show_time_s = 2;
  FloatImage frame(256, 256);
  std::ranges::fill(frame.pixels, 1.0f);
  draw_titles(show, state, frame);
  const auto seen = seen_titles(show, state);
  ASSERT_EQ(seen.size(), 1u);
  const std::vector<float> covered = covered_by(show, seen[0], state);
  int touched = 0;
  for (std::size_t k = 0; k < covered.size(); ++k) {
    ASSERT_NEAR(frame.pixels[3 * k], 1 - covered[k], 1e-6) << k;
    touched += covered[k] > 0.1;
  }
  EXPECT_GT(touched, 200);
}

}  // namespace
}  // namespace domefall
