// Shows without some of their effects, after the appendix of [Riazuelo], app. app_img.
#include <gtest/gtest.h>

#include <functional>
#include <set>

#include "pipeline/colour/blackbody.h"
#include "pipeline/render/frame_key.h"
#include "pipeline/render/photometry.h"
#include "pipeline/render/star_images.h"
#include "pipeline/render/view_tracer.h"
#include "pipeline/show/attitude.h"
#include "scenes.h"

namespace domefall {
namespace {

constexpr double kV = 0.5;
const double kGamma = 1 / std::sqrt(1 - kV * kV);
const V3d kAhead(0, 0, 1);  // along Phi

// Half the speed of light in flat space, looking ahead or back, as in figs. fig_aberr2 to fig_int.
Show ship(const Effects& effects, double speed = kV, double look = 1) {
  const double c = speed / std::sqrt(1 - speed * speed);
  Show show = show_of(GivenVelocity{Region::kI, Tetrad::kRain, kFlatSpace, kAhead * c},
                      Stereographic{96, 72, 90 * kDegree});
  show.effects = effects;
  // Phi, Theta and back: Z along +-Phi.
  show.timeline[0].camera.attitude = EulerAngles{90 * kDegree, look * 90 * kDegree, 0};
  show.sky_one = {GridSky{}, 1, std::nullopt, 1};
  return show;
}

HalfFrame render(const Show& show) { return Renderer(show, 1).render(frame_state(show, 0)); }

struct Traced {
  explicit Traced(const Show& show)
      : state(frame_state(show, 0)),
        optics(make_hole_optics(state.observer.r, state.observer.tetrad, {true, true, true, true})),
        tracer(state, optics, show.effects) {}
  FrameState state;
  HoleOptics optics;
  ViewTracer tracer;
};

const Effects kNoAberration{false, true, true, true, Amplification::kStars};
const Effects kOnlyAberration{true, false, false, true, Amplification::kStars};
const Effects kOnlyColour{false, true, false, true, Amplification::kStars};
const Effects kOnlyIntensity{false, false, true, true, Amplification::kStars};
const Effects kNoLensing{true, true, true, false, Amplification::kStars};
const Effects kNothing{false, false, false, false, Amplification::kNone};

// [Riazuelo] eq. eq_inv_aberr as tan(alpha/2) = sqrt((1 + v)/(1 - v)) tan(alpha'/2).
TEST(Effects, AberrationMovesTheSkyByTheHalfAngleAndItsLackByNothing) {
  std::mt19937 random(1);
  const Traced with(ship(kOnlyAberration)), without(ship(kNoAberration));
  const M33d& axes = with.state.observer.tetrad_from_camera;
  const V3d ahead = apply(with.state.observer.sky_from_tetrad, kAhead);
  const auto half_tangent = [](const V3d& a, const V3d& b) {
    return (a - b).length() / (a + b).length();
  };
  for (int k = 0; k < 200; ++k) {
    const CameraDirection n{random_direction(random)};
    const V3d m = apply(axes, n.v);
    const Look moved = with.tracer.look(n), unmoved = without.tracer.look(n);
    EXPECT_NEAR(half_tangent(moved.sky_direction, ahead) / half_tangent(m, kAhead), std::sqrt(3),
                1e-13);
    EXPECT_LT((unmoved.sky_direction - apply(with.state.observer.sky_from_tetrad, m)).length(),
              1e-15);
    // eq. omprime_aber, by the direction at rest; eq. zkin, by the one that is seen.
    EXPECT_NEAR(unmoved.frequency_ratio, kGamma * (1 + kV * m.dot(kAhead)), 1e-14);
    EXPECT_NEAR(moved.frequency_ratio, 1 / (kGamma * (1 - kV * m.dot(kAhead))), 1e-14);
    EXPECT_NEAR(unmoved.radial_scale, 1, 1e-15);
  }
}

// Aberration and nothing else is a picture of blackbodies at rest: no light but that of the grid.
TEST(Effects, AberrationAloneKeepsColourAndIntensity) {
  const HalfFrame rest = render(ship({}, 0)), moving = render(ship(kOnlyAberration));
  const auto largest = [](const HalfFrame& f, int c) {
    float most = 0;
    for (int y = 0; y < f.height; ++y)
      for (int x = 0; x < f.width; ++x) most = std::max(most, float(f.row(y)[3 * x + c]));
    return most;
  };
  for (int c = 0; c < 3; ++c) EXPECT_EQ(largest(rest, c), largest(moving, c)) << c;
}

// Pixel by pixel, against the same picture at rest.
void expect_ratios(const Show& moving, double look,
                   const std::function<double(double g, int channel)>& expected) {
  const HalfFrame rest = render(ship({}, 0, look)), frame = render(moving);
  const Projection& p = moving.projection;
  const ObserverState o = frame_state(moving, 0).observer;
  const M33d &axes = o.tetrad_from_camera, &sky_from_tetrad = o.sky_from_tetrad;
  for (int y = 0; y < frame.height; ++y)
    for (int x = 0; x < frame.width; ++x) {
      const V3d m = apply(axes, direction_at(p, {x + 1.0, y + 1.0}).v);
      if (std::abs(apply(sky_from_tetrad, m).z) > 0.99) continue;  // the polar discs' other colour
      const double cosine = m.dot(kAhead);
      for (int c = 0; c < 3; ++c) {
        const double ratio = frame.row(y)[3 * x + c] / double(rest.row(y)[3 * x + c]);
        const double g = kGamma * (1 + kV * cosine);
        // Two roundings to half a float; the shift varies within a pixel of many looks.
        ASSERT_NEAR(ratio / expected(g, c), 1, 2e-3) << x << ' ' << y;
      }
    }
}

// [Riazuelo] fig. fig_int: from 9 in the front direction to 1/9 in the rear one.
TEST(Effects, IntensityAloneIsNineInFrontAndANinthInTheRear) {
  for (const double look : {1.0, -1.0})
    expect_ratios(ship(kOnlyIntensity, kV, look), look,
                  [](double g, int) { return g * g * g * g; });
  const auto middle = [](const Show& show) {
    const HalfFrame f = render(show);
    return double(f.row(f.height / 2)[3 * (f.width / 2)]);
  };
  EXPECT_NEAR(middle(ship(kOnlyIntensity, kV, 1)) / middle(ship({}, 0, 1)), 9, 0.02);
  EXPECT_NEAR(middle(ship(kOnlyIntensity, kV, -1)) / middle(ship({}, 0, -1)), 1 / 9.0, 3e-4);
}

// [Riazuelo] fig. fig_dop.  Of a blackbody at g T with the bolometric intensity of one at T.
TEST(Effects, ColourAloneKeepsTheBolometricIntensity) {
  for (const double look : {1.0, -1.0})
    expect_ratios(ship(kOnlyColour, kV, look), look, [](double g, int c) {
      const double t = 8000;
      const auto channels = [](const Xyz& xyz) {
        const WorkingRgb rgb = to_working(xyz);
        return std::array<double, 3>{rgb.r, rgb.g, rgb.b};
      };
      const auto k = static_cast<std::size_t>(c);
      return channels(blackbody_xyz(g * t))[k] / blackbody_radiance(g * t) /
             (channels(blackbody_xyz(t))[k] / blackbody_radiance(t));
    });
}

TEST(Effects, AllThreeTogetherAreTheirProductAndNature) {
  // What nature shows of a place on the sky is what colour and intensity do to it one by one.
  const Effects both{false, true, true, true, Amplification::kStars};
  const double t = 8000;
  for (const double look : {1.0, -1.0})
    expect_ratios(ship(both, kV, look), look, [t](double g, int c) {
      const WorkingRgb shifted = blackbody_colours().surface(g * t),
                       still = blackbody_colours().surface(t);
      return c == 0   ? double(shifted.r) / still.r
             : c == 1 ? double(shifted.g) / still.g
                      : double(shifted.b) / still.b;
    });
}

TEST(Effects, APanoramaWithoutIntensityOrAberrationIsTheOneAtRest) {
  Show moving = ship(kOnlyColour), rest = ship({}, 0);
  moving.sky_one.background = rest.sky_one.background = PanoramaSky{small_panorama()};
  const HalfFrame a = render(moving), b = render(rest);
  for (int y = 0; y < a.height; ++y)
    for (int k = 0; k < 3 * a.width; ++k) ASSERT_EQ(a.row(y)[k], b.row(y)[k]);
}

// Observers outside and inside, in all four regions.
std::vector<Trajectory> observers() {
  return {StaticObserver{3},
          StaticObserver{2 + 1e-9},
          RadialInfall{2 + 1e-12},
          CircularOrbit{6},
          RadialInfall{2.001},
          RadialInfall{2},
          RadialInfall{1.2},
          RadialInfall{0.05},
          GivenVelocity{Region::kI, Tetrad::kRain, 30, V3d(300, -800, 500)},
          GivenVelocity{Region::kI, Tetrad::kOutgoing, 5, V3d(1, 2, 3)},
          GivenVelocity{Region::kII, Tetrad::kRain, 1.3, V3d(0, 1e4, 0)},
          GivenVelocity{Region::kIII, Tetrad::kRainOfThree, 4, V3d(2, 0, 1)},
          GivenVelocity{Region::kIV, Tetrad::kOutgoing, 0.2, V3d(0, 1, 0)},
          GivenVelocity{Region::kI, Tetrad::kRain, kFlatSpace, V3d(0, 1, 2)}};
}

std::vector<Effects> settings(bool outside) {
  std::vector<Effects> all{kNoAberration, kOnlyAberration, kOnlyColour, kOnlyIntensity};
  all.push_back({true, true, true, true, Amplification::kEverything});
  all.push_back({false, false, true, true, Amplification::kEverything});
  if (!outside) return all;
  all.push_back(kNoLensing);
  all.push_back(kNothing);
  all.push_back({true, false, true, false, Amplification::kEverything});
  return all;
}

bool is_outside(const Trajectory& t) { return point_at(t, 0).r > 2; }

TEST(Effects, WithoutAberrationEveryPlaceKeepsItsFrequencyAndOnlyStandsElsewhere) {
  std::mt19937 random(2);
  for (const Trajectory& t : observers()) {
    Show show = show_of(t, Domemaster{64});
    const Traced nature(show);
    show.effects = kNoAberration;
    const Traced resting(show);
    const ObserverState &o = nature.state.observer, &r = resting.state.observer;
    const V3d rest = vantage_of(o, {}).rest;
    for (int k = 0; k < 100; ++k) {
      const CameraDirection n{random_direction(random)};
      const Look there = nature.tracer.look(n);
      const V3d tetrad = to_tetrad(o.celerity, apply(o.tetrad_from_camera, n.v)).direction;
      const CameraDirection moved{
          apply_transposed(r.tetrad_from_camera, to_observer(rest, tetrad).direction)};
      const Look here = resting.tracer.look(moved);
      // A boost by a Lorentz factor of 1e3 or 1e4 and back loses digits by it, at the edge all.
      if (there.to_edge < 1e-6 || here.to_edge < 1e-6) continue;
      ASSERT_EQ(here.sky, there.sky);
      const double scale = 1 + there.radial_scale + there.tangential_scale + here.radial_scale +
                           here.tangential_scale;
      EXPECT_LT((here.sky_direction - there.sky_direction).length(), 1e-11 * scale);
      EXPECT_NEAR(here.frequency_ratio / there.frequency_ratio, 1, 1e-8);
    }
  }
}

TEST(Effects, TheBatchSeesWhatTheSingleLookSees) {
  std::mt19937 random(3);
  for (const Trajectory& t : observers())
    for (const Effects& effects : settings(is_outside(t))) {
      Show show = show_of(t, Domemaster{64});
      show.effects = effects;
      const Traced traced(show);
      LookBatch batch;
      std::array<CameraDirection, LookBatch::kSize> n;
      for (auto& direction : n) direction.v = random_direction(random);
      traced.tracer.look(n.data(), LookBatch::kSize, batch);
      for (int k = 0; k < LookBatch::kSize; ++k) {
        const Look look = traced.tracer.look(n[static_cast<std::size_t>(k)]);
        ASSERT_EQ(batch.sky[k], look.sky);
        const double scale = 1 + look.radial_scale + look.tangential_scale;
        ASSERT_LT((batch.sky_direction(k) - look.sky_direction).length(), 4e-15 * scale);
        ASSERT_NEAR(batch.frequency_ratio[k] / look.frequency_ratio, 1, 1e-12);
      }
    }
}

TEST(Effects, LeaveNoPixelThatIsNotFinite) {
  for (const Trajectory& t : observers())
    for (const Effects& effects : settings(is_outside(t)))
      for (const bool grid : {true, false}) {
        Show show = starry(show_of(t, Domemaster{48}));
        if (grid) show.sky_one.background = show.sky_three.background = GridSky{};
        show.sky_one.stars->max_magnitude = show.sky_three.stars->max_magnitude = 3;
        show.effects = effects;
        EXPECT_NO_THROW(render(show));
      }
}

// ---- lensing ----

Show at_rest_at(double r, const Effects& effects) {
  Show show = show_of(StaticObserver{r}, Stereographic{120, 90, 90 * kDegree});
  show.timeline[0].camera.attitude = EulerAngles{0.3, std::numbers::pi - 0.2, 0.1};
  show.sky_one = {GridSky{}, 1, std::nullopt, 1};
  show.effects = effects;
  return show;
}

// [Riazuelo] fig. fig_dev2: z = -0.0339 at r = 30.
TEST(Effects, WithoutLensingTheSkyIsThatOfFlatSpaceABitBrighter) {
  const Effects straight{true, false, true, false, Amplification::kStars};
  const HalfFrame flat = render(at_rest_at(kFlatSpace, {})),
                  near = render(at_rest_at(30, straight));
  const double z = std::sqrt(1 - 2 / 30.0) - 1;
  ASSERT_NEAR(z, -0.0339, 5e-5);
  for (int y = 0; y < flat.height; ++y)
    for (int k = 0; k < 3 * flat.width; ++k)
      ASSERT_NEAR(near.row(y)[k] / double(flat.row(y)[k]), std::pow(1 + z, -4), 2e-3);
  StageTimes times;
  Renderer(at_rest_at(30, straight), 1).render(frame_state(at_rest_at(30, straight), 0), &times);
  EXPECT_EQ(times.table_nodes, 0u);
}

// An orbit at half the speed of light, r = 6: aberration and Doppler shift are those of flat space.
TEST(Effects, WithoutLensingMotionIsThatAgainstTheObserverAtRest) {
  Show show = show_of(CircularOrbit{6}, Domemaster{64});
  show.effects = kNoLensing;
  show.timeline[0].camera.attitude = LookAlongMotion{};
  const Traced traced(show);
  const ObserverState& o = traced.state.observer;
  const V3d ahead = target_direction(LookAlongMotion{}, o, show.effects).value();
  for (const double angle : {0.0, 0.4, 1.5, 3.0}) {
    const V3d m =
        ahead * std::cos(angle) + ahead.cross(V3d(1, 0, 0)).normalized() * std::sin(angle);
    const Look look = traced.tracer.look({apply_transposed(o.tetrad_from_camera, m)});
    const V3d motion = apply(o.sky_from_tetrad, V3d(0, 0, 1));  // along Phi
    EXPECT_NEAR(look.sky_direction.dot(motion), (std::cos(angle) - kV) / (1 - kV * std::cos(angle)),
                1e-14);
    EXPECT_NEAR(look.frequency_ratio, std::sqrt(6 / 4.0) / (kGamma * (1 - kV * std::cos(angle))),
                1e-14);
    EXPECT_EQ(look.sky, SeenSky::kOne);
  }
}

// What is looked at stands in the middle, wherever the effects that are left put it.
TEST(Effects, CamerasFindTheirTargetWhereItIsDrawn) {
  const SkyDirection target{V3d(0.6, -0.64, 0.48)};
  for (const Trajectory& t : observers())
    for (const Effects& effects : settings(is_outside(t))) {
      if (point_at(t, 0).region == Region::kIV) continue;  // sees no sky
      Show show = show_of(t, Stereographic{64, 48, 1});
      show.effects = effects;
      show.timeline[0].camera.attitude = LookAtSky{target};
      const Look look = Traced(show).tracer.look({V3d(0, 0, 1)});
      const double scale = 1 + look.radial_scale + look.tangential_scale;
      EXPECT_LT((look.sky_direction - target.v).length(), 1e-8 * scale);
    }
}

TEST(Effects, WithoutAberrationMotionIsStillAhead) {
  Show show = show_of(CircularOrbit{6}, Stereographic{64, 48, 1});
  show.effects = {false, true, true, false, Amplification::kStars};
  show.timeline[0].camera.attitude = LookAlongMotion{};
  const Traced traced(show);
  const Look look = traced.tracer.look({V3d(0, 0, 1)});
  const V3d along_phi = apply(traced.state.observer.sky_from_tetrad, V3d(0, 0, 1));
  EXPECT_LT((look.sky_direction - along_phi).length(), 1e-14);
  EXPECT_NEAR(look.frequency_ratio, std::sqrt(6 / 4.0) * std::sqrt(3), 1e-14);
}

// ---- stars ----

std::vector<StarImage> images_of(const Show& show, const V3d& sky) {
  const FrameState state = frame_state(show, 0);
  const HoleOptics optics = make_hole_optics(state.observer.r, state.observer.tetrad, {});
  const bool bent = show.effects.lensing && optics.home_sky;
  const SceneStar star{{sky}, 5, 1e-6, 6500, 1e-9};
  std::vector<StarImage> images;
  StarImages(show, state, state.picture.sky_one, bent ? &*optics.home_sky : nullptr)
      .append(star, images);
  return images;
}

V3d centre_of(const StarImage& image, const Projection& projection) {
  return direction_at(projection, {image.x + 1.0, image.y + 1.0}).v;
}

// A star stands where the background has its place, and shines as the background's law says.
TEST(Effects, StarsAndBackgroundsObeyTheSameOptions) {
  std::mt19937 random(5);
  const Trajectory orbit = CircularOrbit{6};
  for (const Trajectory& t :
       {orbit, Trajectory(GivenVelocity{Region::kI, Tetrad::kRain, kFlatSpace, V3d(0, 1, 2)})})
    for (const Effects& effects : settings(true)) {
      Show show = show_of(t, Stereographic{2000, 2000, 300 * kDegree});
      show.effects = effects;
      const Traced traced(show);
      int seen = 0;
      for (int k = 0; k < 40; ++k) {
        const CameraDirection n{random_direction(random)};
        const Look look = traced.tracer.look(n);
        if (n.v.z < -0.5 || look.sky != SeenSky::kOne || look.bundle.azimuth > 2.5) continue;
        const auto images = images_of(show, look.sky_direction);
        ASSERT_FALSE(images.empty());
        const StarImage& image = images[0];
        EXPECT_LT((centre_of(image, show.projection) - n.v).length(), 1e-6);
        const double g = look.frequency_ratio;
        double flux = 1e-6 * exposure_scale(frame_state(show, 0).picture);
        if (effects.intensity) flux *= g * g * g * g;
        if (effects.amplification != Amplification::kNone)
          flux /= look.radial_scale * look.tangential_scale;
        const WorkingRgb c = blackbody_colours().per_flux(effects.doppler_colour ? 6500 * g : 6500);
        EXPECT_NEAR(image.rgb[1] / (flux * c.g), 1, 1e-5);
        ++seen;
      }
      EXPECT_GT(seen, 8);
    }
}

TEST(Effects, WithoutAmplificationBothImagesOfAStarAreAsBrightAsTheStar) {
  Show show = show_of(StaticObserver{30}, Stereographic{1000, 1000, 90 * kDegree});
  show.effects = {true, false, false, true, Amplification::kNone};
  const FrameState state = frame_state(show, 0);
  const V3d sky = apply(state.observer.sky_from_tetrad, V3d(-std::cos(0.1), std::sin(0.1), 0));
  const auto images = images_of(show, sky);
  ASSERT_EQ(images.size(), 2u);
  const V3d ahead(0, 0, 1);
  EXPECT_LT(centre_of(images[0], show.projection)
                .cross(ahead)
                .dot(centre_of(images[1], show.projection).cross(ahead)),
            0)
      << "on either side of the hole";
  const double flux = 1e-6 * exposure_scale(frame_state(show, 0).picture);
  for (const StarImage& image : images)
    EXPECT_NEAR(image.rgb[1] / (flux * blackbody_colours().per_flux(6500).g), 1, 1e-6);
  show.effects.amplification = Amplification::kStars;
  EXPECT_GT(images_of(show, sky)[0].rgb[1], 1.5 * images[0].rgb[1]);
}

// ---- amplification of backgrounds ----

// [Riazuelo] fig. fig_dev3.
TEST(Effects, AnAmplifiedBackgroundHasASmoothRingAndNoSpecks) {
  Show show = at_rest_at(30, {});
  show.projection = Stereographic{480, 360, 90 * kDegree};
  show.timeline[0].camera.attitude = LookAtHole{};
  show.sky_one.background = PanoramaSky{small_panorama()};
  const HalfFrame plain = render(show);
  show.effects.amplification = Amplification::kEverything;
  const HalfFrame amplified = render(show);
  const Traced traced(show);
  const double pixel = central_pixel_angle(show.projection);
  std::vector<double> peaks(360, 0);  // by the angle about the hole
  for (int y = 0; y < 360; ++y)
    for (int x = 0; x < 480; ++x) {
      const Look look = traced.tracer.look(direction_at(show.projection, {x + 1.0, y + 1.0}));
      if (look.sky != SeenSky::kOne || look.to_edge < 15 * pixel) continue;
      const double ratio = amplified.row(y)[3 * x + 1] / double(plain.row(y)[3 * x + 1]);
      const double off = std::abs(look.bundle.azimuth - std::numbers::pi) /
                         (look.bundle.slope * look.bundle.doppler * pixel);
      if (off > 5) {
        const double expected = 1 / (look.radial_scale * look.tangential_scale);
        // The two are blurred alike, but by different numbers of looks.
        ASSERT_NEAR(ratio / expected, 1, 0.04) << x << ' ' << y;
      } else {
        const double degrees = std::atan2(y - 179.5, x - 239.5) / kDegree;
        double& peak = peaks[static_cast<std::size_t>(std::lround(degrees + 360) % 360)];
        peak = std::max(peak, ratio);
      }
    }
  const double faintest = *std::min_element(peaks.begin(), peaks.end());
  const double brightest = *std::max_element(peaks.begin(), peaks.end());
  EXPECT_GT(faintest, 50);
  EXPECT_LT(brightest / faintest, 1.5);
}

// ---- the key of a frame ----

TEST(Effects, EnterTheKeysOfFramesOnlyWhereTheyAreNotNature) {
  const Show nature = at_rest_at(30, {});
  const auto key = [](const Show& show) { return FrameKeys(show).scene(frame_state(show, 0)); };
  EXPECT_EQ(key(nature), key(at_rest_at(30, Effects{})));
  std::set<std::string> keys{key(nature)};
  for (const Effects& e : {Effects{false, true, true, true}, Effects{true, false, true, true},
                           Effects{true, true, false, true}, Effects{true, true, true, false},
                           Effects{true, true, true, true, Amplification::kNone},
                           Effects{true, true, true, true, Amplification::kEverything}})
    EXPECT_TRUE(keys.insert(key(at_rest_at(30, e))).second);
}

}  // namespace
}  // namespace domefall
