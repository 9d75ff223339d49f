// A million stars bring the light of the even sky that they make up.
#include <gtest/gtest.h>

#include <cstdio>

#include "pipeline/render/rays/view_tracer.h"
#include "pipeline/render/scene/seen_magnitude.h"
#include "pipeline/render/scene/star_sight.h"
#include "pipeline/sources/colour/blackbody.h"
#include "pipeline/sources/stars/star_colour.h"
#include "tests/pipeline/render/stars/star_scene.h"
#include "tests/sanitized.h"

namespace domefall {
namespace {

using std::numbers::pi;

constexpr int kStars = tries(1'000'000, 50'000), kSize = tries(1024, 256);
constexpr double kTolerance = kSanitized ? 0.04 : 0.01, kNoise = kTolerance / 2;
constexpr int kDrawn = kStars / 3;  // the stars of a whole frame
constexpr double kMagnitude = 8, kColour = 0.6;
// Stops of exposure.  With so many the ghosts that are left out as too faint, millions of them,
// carry a negligible part of the light.  At 0 stops they carry 4 per cent of what is seen within 50
// degrees of the hole at 6 M.
constexpr double kExposure = kSize < 1024 ? 8 : 4;

// Sums of light by the angle from the hole, or in flat space from the axis of the boost.  The unit
// is that of StarImage::rgb.
struct Bins {
  explicit Bins(const std::vector<double>& degrees)
      : limits(degrees), sum(degrees.size() + 1), square(degrees.size() + 1) {}
  void add(double angle, double light) {
    const auto after = std::upper_bound(limits.begin(), limits.end(), angle / kDegree);
    const auto k = static_cast<std::size_t>(after - limits.begin());
    sum[k] += light;
    square[k] += light * light;
    total += light;
  }
  std::vector<double> limits, sum, square;
  double total = 0;
};

double angle_between_stars(const V3d& a, const V3d& b) {
  return 2 * std::asin((a - b).length() / 2);
}

V3d hole_of(const FrameState& state) {
  return apply_transposed(state.observer.tetrad_from_camera,
                          to_observer(state.observer.celerity, V3d(-1, 0, 0)).direction);
}

// The light of a sky of this bolometric radiance and temperature everywhere, ray by ray.
Bins even_sky_bins(const StarScene& scene, double radiance, double temperature,
                   const std::vector<double>& limits) {
  constexpr int kFine = 3;  // rays along each side of a pixel
  const Projection fine = refined(scene.state.projection, kFine);
  const ViewTracer tracer(scene.state, WantedSkies{});
  const double scale = scene.exposure();
  const V3d hole = hole_of(scene.state);
  Bins bins(limits);
  std::vector<CameraDirection> n(static_cast<std::size_t>(kSize) * kFine);
  ViewRayBatch batch;
  for (int row = 0; row < rows(fine); ++row) {
    const ColumnRange range = inside_columns(fine, row);
    for (int i = range.first; i <= range.last; ++i)
      n[static_cast<std::size_t>(i - range.first)] = direction_at(fine, {i + 1.0, row + 1.0});
    for (int first = range.first; first <= range.last; first += ViewRayBatch::kSize) {
      const int count = std::min(ViewRayBatch::kSize, range.last + 1 - first);
      const CameraDirection* at = &n[static_cast<std::size_t>(first - range.first)];
      tracer.trace(at, count, batch);
      for (int k = 0; k < count; ++k) {
        const auto i = static_cast<std::size_t>(k);
        if (batch.sky[i] == SkyRegion::kIV) continue;
        const double g = batch.frequency_ratio[i];
        const double shine =
            luminance(blackbody_colours().per_flux(temperature * g)) * g * g * g * g;
        const double angle = pixel_solid_angle(fine, {first + k + 1.0, row + 1.0});
        bins.add(angle_between_stars(at[k].v, hole), radiance * shine * angle * scale);
      }
    }
  }
  return bins;
}

void compare_bins(const Bins& stars, const Bins& sky) {
  EXPECT_NEAR(stars.total / sky.total, 1, kTolerance);
  for (std::size_t k = 0; k < sky.sum.size(); ++k) {
    SCOPED_TRACE("bin " + std::to_string(k));
    EXPECT_NEAR(stars.sum[k] / sky.sum[k], 1, kTolerance);
    EXPECT_LT(std::sqrt(stars.square[k]) / stars.sum[k], kNoise) << "too few stars to tell";
  }
}

// The mean radiance of a sky with so many stars of this flux each.
double radiance_of(double flux, int stars) { return stars * flux / (4 * pi); }

struct Place {
  const char* name;
  GivenVelocity at;
  std::vector<double> limits;  // degrees
};

TEST(StarPhotometry, StarsAreAsBrightAsTheSkyTheyMakeUp) {
  const double s = std::sqrt(2 / 6.0), outward = s / std::sqrt(1 - s * s);
  const std::vector<Place> places{
      {"at rest", {Region::kI, Tetrad::kRain, kFlatSpace, {0, 0, 0}}, {30, 60, 90}},
      {"0.6 c", {Region::kI, Tetrad::kRain, kFlatSpace, {-0.75, 0, 0}}, {25, 50, 75}},
      {"static at 6 M", {Region::kI, Tetrad::kRain, 6, {outward, 0, 0}}, {50, 75, 100}},
      {"inside", {Region::kII, Tetrad::kRain, 1, {0, 0, 0}}, {40, 80}}};
  const double temperature = temperature_from_b_v(kColour);
  const double flux = std::pow(10, -0.4 * kMagnitude) * bolometric_flux_at_v_zero(temperature);
  std::mt19937 random(7);
  std::vector<Star> list;
  for (int k = 0; k < kStars; ++k)
    list.push_back({{random_direction(random)}, kMagnitude, static_cast<float>(temperature)});
  const SceneStars stars(list);
  for (const Place& place : places) {
    SCOPED_TRACE(place.name);
    const StarScene scene(place.at, Domemaster{kSize}, kExposure);
    const V3d hole = hole_of(scene.state);
    Bins bins(place.limits);
    for (const bool far : {false, true}) {
      if (far && !scene.has(true)) continue;
      for (const StarImage& image : all_images(scene.images(far), stars)) {
        const PixelPosition at{image.x + 1.0, image.y + 1.0};
        if (is_inside(scene.state.projection, at))
          bins.add(angle_between_stars(direction_at(scene.state.projection, at).v, hole),
                   light(image));
      }
    }
    compare_bins(bins, even_sky_bins(scene, radiance_of(flux, kStars), temperature, place.limits));
  }
}

// The part of an image's light that its blob has beyond an edge `to_edge` radians away, which is as
// good as straight.  There the blob is cut.
double part_beyond_edge(const PointSpreadParts& parts, double to_edge) {
  const auto beyond = [&](double sigma) { return std::erfc(to_edge / sigma / std::sqrt(2)) / 2; };
  double part = 0, halo = 0;
  for (const PointSpreadParts::Halo& h : parts.halo) {
    halo += h.share;
    part += h.share * (h.share > 0 ? beyond(h.sigma) : 0);
  }
  return part + (1 - halo) * beyond(parts.sigma);
}

// The parts of all images' light, by the angle from the hole, that are drawn on the sky.
std::vector<double> kept_parts(const StarScene& scene, const std::vector<Star>& stars,
                               const std::vector<double>& limits) {
  const V3d hole = hole_of(scene.state);
  const ViewTracer tracer(scene.state, WantedSkies{});
  const PointSpread point_spread = scene.point_spread();
  Bins all(limits), cut(limits);
  for (const StarImage& image : all_images(scene.images(), SceneStars(stars))) {
    const PixelPosition at{image.x + 1.0, image.y + 1.0};
    if (!is_inside(scene.state.projection, at)) continue;
    const CameraDirection n = direction_at(scene.state.projection, at);
    ViewRayBatch ray;
    tracer.trace(&n, 1, ray);
    const double angle = angle_between_stars(n.v, hole);
    all.add(angle, light(image));
    cut.add(angle, light(image) * part_beyond_edge(point_spread.parts(image), ray.to_edge[0]));
  }
  std::vector<double> kept;
  for (std::size_t k = 0; k < all.sum.size(); ++k) kept.push_back(1 - cut.sum[k] / all.sum[k]);
  return kept;
}

// The whole way from a catalogue's file to the half floats of a frame keeps the light too.
TEST(StarPhotometry, SoAreTheirBlobs) {
  const auto file = std::filesystem::temp_directory_path() /
                    ("domefall_stars_" + std::to_string(getpid()) + ".csv");
  std::mt19937 random(9);
  std::FILE* out = std::fopen(file.c_str(), "w");
  ASSERT_NE(out, nullptr);
  std::fputs("ra_deg,dec_deg,v_mag,b_v\n", out);
  const double temperature = temperature_from_b_v(kColour);
  std::vector<Star> list;
  for (int k = 0; k < kDrawn; ++k) {
    const V3d n = random_direction(random);
    list.push_back({{n}, kMagnitude, static_cast<float>(temperature)});
    std::fprintf(out, "%.5f,%.5f,8,0.6\n", std::atan2(n.y, n.x) / kDegree + 180,
                 std::asin(n.z) / kDegree);
  }
  std::fclose(out);
  const double s = std::sqrt(2 / 6.0), outward = s / std::sqrt(1 - s * s);
  StarScene scene({Region::kI, Tetrad::kRain, 6, {outward, 0, 0}}, Domemaster{kSize}, kExposure);
  scene.show.point_spread = {};
  scene.show.sky[SkyRegion::kI].background = BlackSky{};
  scene.show.sky[SkyRegion::kI].stars = StarField{file, 9};
  scene.state.settings.sky[SkyRegion::kI].max_magnitude = 9;
  const HalfFrame frame = Renderer(scene.show, 0).render(scene.state);
  std::filesystem::remove(file);

  const std::vector<double> limits{50, 75, 100};
  const double flux = std::pow(10, -0.4 * kMagnitude) * bolometric_flux_at_v_zero(temperature);
  const Bins sky = even_sky_bins(scene, radiance_of(flux, kDrawn), temperature, limits);
  const V3d hole = hole_of(scene.state);
  Bins drawn(limits);
  for (int row = 0; row < kSize; ++row)
    for (int column = 0; column < kSize; ++column) {
      const PixelPosition at{column + 1.0, row + 1.0};
      if (!is_inside(scene.state.projection, at)) continue;
      const Imath::half* p = frame.row(row) + 3 * column;
      drawn.add(angle_between_stars(direction_at(scene.state.projection, at).v, hole),
                luminance({float{p[0]}, float{p[1]}, float{p[2]}}) *
                    pixel_solid_angle(scene.state.projection, at));
    }
  const std::vector<double> kept = kept_parts(scene, list, limits);
  for (std::size_t k = 0; k < sky.sum.size(); ++k)
    EXPECT_NEAR(drawn.sum[k] / sky.sum[k], kept[k], kTolerance) << k;
  // Beside the silhouette something was cut, and elsewhere nothing.
  EXPECT_LT(kept[0], 0.995);
  EXPECT_GT(kept[0], 0.8);
  EXPECT_GT(kept[1], 0.9999);
}

// The illuminance over V of Planck's law at a temperature, in steps of 1 nm, with the V of Bessell
// (1990) as straight lines between its points.  It shares no code with the renderer.
double light_in_v(double temperature) {
  constexpr double kV[]{0,     0.03,  0.163, 0.458, 0.78,  0.967, 1,     0.973,
                        0.898, 0.792, 0.684, 0.574, 0.461, 0.359, 0.27,  0.197,
                        0.135, 0.081, 0.045, 0.025, 0.017, 0.013, 0.009, 0};
  double sum = 0;
  for (int nm = 470; nm < 700; ++nm) {
    const int k = (nm - 470) / 10;
    const double v = kV[k] + (kV[k + 1] - kV[k]) * (nm - 470 - 10 * k) / 10;
    sum += v / std::pow(nm, 5) / std::expm1(1.438776877e7 / (nm * temperature));
  }
  return sum;
}

// A star that moves brings g^4 of its flux, most of it perhaps beyond V.
TEST(StarPhotometry, AShiftedStarIsSeenAsTheVOfItsNewTemperature) {
  for (const double temperature : {2500.0, 6000.0, 20000.0})
    for (const double g : {0.4, 0.8, 1.0, 1.5, 4.0}) {
      SCOPED_TRACE(std::to_string(temperature) + " K, g = " + std::to_string(g));
      const double v = seen_magnitude(Effects{}, 3, temperature, g * g * g * g, g);
      // The sum over V of the shifted Planck law has the factor g^4/g^4 against that of gT.
      const double ratio = light_in_v(g * temperature) / light_in_v(temperature);
      EXPECT_NEAR(v, 3 - 2.5 * std::log10(ratio), 0.01);
      Effects grey;
      grey.doppler_colour = false;
      EXPECT_NEAR(seen_magnitude(grey, 3, temperature, g * g * g * g, g), 3 - 10 * std::log10(g),
                  1e-9);
    }
  EXPECT_EQ(seen_magnitude(Effects{}, 3, 6000, 0, 0), HUGE_VAL);
}

// The drawn image has the light of a star at rest that has the V and the temperature of the image.
TEST(StarPhotometry, TheSeenVIsThatOfThePixels) {
  for (const double speed : {-0.75, 0.75, -3.0}) {
    const StarScene moving({Region::kI, Tetrad::kRain, kFlatSpace, {speed, 0, 0}}, Domemaster{256});
    const StarScene resting({Region::kI, Tetrad::kRain, kFlatSpace, {0, 0, 0}}, Domemaster{256});
    const Star star{moving.sky(V3d(-1, 0.3, 0.1)), 2, 5000};
    const auto image =
        StarSight(moving.state, moving.show.effects).image(SkyRegion::kI, star.direction, 0);
    const double g = image.frequency_ratio;
    EXPECT_GT(std::abs(std::log(g)), 0.3);
    const double v = seen_magnitude(moving.show.effects, 2, 5000, image.brightening, g);
    const auto light_of = [](const StarScene& scene, const Star& at) {
      std::vector<StarImage> images;
      scene.images().append(SceneStars({at})[0], images);
      return total_light(images);
    };
    const double seen = light_of(moving, star);
    const double known =
        light_of(resting, {star.direction, static_cast<float>(v), static_cast<float>(5000 * g)});
    EXPECT_NEAR(seen / known, 1, 1e-3) << speed;
  }
}

}  // namespace
}  // namespace domefall
