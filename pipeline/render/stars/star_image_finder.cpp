#include "pipeline/render/stars/star_image_finder.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "pipeline/render/scene/effect_ratios.h"
#include "pipeline/render/scene/star_light.h"
#include "pipeline/sources/colour/blackbody.h"

namespace domefall {
namespace {

using std::numbers::pi;

// A blob extends this many pixels beyond its reach.  It is blurred by the squares of the pixels,
// and pixels on the rim of a dome lie partly outside the dome.
constexpr double kBlurPixels = 4;

// Where an effect is left out, this many orders are always tried, since either side of the hole may
// be the bright one.  Beyond these the flux falls by exp(-2 pi) with every second order, so that
// the first faint order ends the series.
constexpr int kAlwaysTried = 4;
constexpr int kOrdersWithoutAmplification = 2;

// The pieces of an arc have this spacing in sigma, and those of a trail have it at least.  By
// Poisson's summation formula a row of Gaussians at the distance s is even to 2 exp(-2 pi^2/s^2),
// which is 3e-4 here.
constexpr double kPieceSigmas = 1.5;
// A row may be this much higher than its mean, as a pixel value.  In the dark, a view transform
// makes half a step of 8 bits of twice this value.
constexpr double kUneven = 5e-4;

// Returns the sine of the angle from the axis within which images may be trails.  Between two
// instants an image turns about the axis by at most way * gap/sine radians.  Farther out than the
// second bound it moves by less than kTrailPixels.
double farthest_passage(const FrameScene& scene, double stretch) {
  const V3d& turn = scene.motion.turn;
  const double way = std::hypot(turn.y, turn.z) + std::abs(turn.x);
  double farthest = kInstant * way;
  if (scene.motion.gap < 1)
    farthest = std::max(farthest, way * scene.motion.gap * stretch /
                                      (kTrailPixels * largest_pixel_angle(scene.projection())));
  return std::min(farthest, kFarthestPassage);
}

// These are the tolerances of images in batches, in pixels and in parts of the light.
constexpr double kPositionError = 0.01, kFluxError = 1e-4;

// A part of a trail is taken to be this much longer than its chord, since it is bent.
constexpr double kWayPerChord = 1.1;

// Returns the spacing, in sigma, of a trail whose pixel value along its middle is `row`.  It solves
// row * 2 exp(-2 pi^2/s^2) = kUneven, with 1 added in the logarithm so that it exists for any row.
// The faintest trails are rows of dots that no display shows.
double spacing_of(double row) {
  return std::max(kPieceSigmas,
                  pi * std::numbers::sqrt2 / std::sqrt(std::log1p(2 * row / kUneven)));
}

// Returns the peak of the smallest blob for a light of 1 lux.  A Gaussian of unit integral has the
// peak 1/(2 pi sigma^2).
double peak_per_lux(double exposure, const PointSpread& point_spread) {
  return exposure / (2 * pi * point_spread.least() * point_spread.least());
}

}  // namespace

StarImageFinder::StarImageFinder(const FrameScene& scene, SkyRegion sky)
    : scene_(scene),
      sky_(scene.state.settings.sky[sky]),
      observer_(scene.state.observer),
      axes_(sky_axes(observer_, sky)),
      viewer_(scene.tracer.viewer()),
      from_tetrad_(-viewer_.celerity),
      to_measured_(-viewer_.measured.value_or(Celerity<RestFrame>())),
      peak_per_lux_(peak_per_lux(scene.exposure, scene.point_spread)),
      stretch_(gamma_of(viewer_.celerity) + viewer_.celerity.length()),
      // The loops know all effects of nature and nothing else.
      in_batches_(scene.tracer.lens()->frame() == V3d(0, 0, 0) && scene.effects.intensity &&
                  scene.effects.doppler_colour &&
                  scene.effects.amplification != Amplification::kNone && !viewer_.measured),
      plane_(scene.projection(),
             scene.point_spread.reach() + kBlurPixels * largest_pixel_angle(scene.projection())) {
  std::optional<PointTolerance> tolerance;
  if (in_batches_)
    tolerance = {kPositionError * largest_pixel_angle(scene.projection()) / stretch_, kFluxError};
  points_ = scene.tracer.lens()->points(sky, tolerance);
  has_caustics_ =
      points_ && points_->has_axis() && scene.effects.amplification != Amplification::kNone;
  near_ = has_caustics_ ? farthest_passage(scene, stretch_) : 0;
  if (in_batches_ && points_) prepare_batches();
}

// Returns the star with the gain and the limit of the frame applied to its flux, or nothing if no
// flux is left.
std::optional<SceneStar> StarImageFinder::with_gain(const SceneStar& catalogued) const {
  const double part = sky_.star_gain * part_within_limit(sky_, catalogued.magnitude);
  if (!(part > 0)) return std::nullopt;
  SceneStar star = catalogued;
  star.flux *= part;
  return star;
}

void StarImageFinder::append(const SceneStar& catalogued, std::vector<StarImage>& images) const {
  const auto star = with_gain(catalogued);
  if (star && points_->lists_images())
    append_listed(*star, images);
  else if (star)
    append_orders(*star, apply_transposed(axes_, star->direction.v), 0, points_->orders(), images);
}

// Appends the images of a lens that has no orders.
void StarImageFinder::append_listed(const SceneStar& star, std::vector<StarImage>& images) const {
  thread_local std::vector<SkyImage> listed, trail;
  const double least = in_batches_ ? 1 / (star.flux * brightness_per_flux_) : 0;
  const V3d source = apply_transposed(axes_, star.direction.v);
  const V3d way = scene_.motion.turn.cross(source);
  // Lists the images at a part of the frame from this one, and returns how fast they move, in sigma a
  // frame.
  const auto list_at = [&](double time) {
    listed.clear();
    points_->list_images((source + way * time).normalized(), radius_of(star), least, listed);
    double fastest = 0;
    for (SkyImage& image : listed) {
      image = out_of_lens(*scene_.tracer.lens(), image);
      if (image.amplification > least)
        fastest = std::max(fastest, image.speed / least_sigma_at(image.direction.v));
    }
    return fastest * way.length();
  };
  // Where the sky turns fast all images move, and only those next to a caustic are not points.
  constexpr double kStill = 2, kBright = 30;
  const auto bright = [](const SkyImage& image) { return image.amplification > kBright; };
  if (!(list_at(0) > kStill && std::ranges::any_of(listed, bright))) {
    for (const SkyImage& image : listed) append_image(star, image, images);
    return;
  }
  // Next to a caustic images move so fast, and are so bright, that the mean over the times about the
  // frame's is drawn, with the weights of a triangle: those of all frames add up to an even exposure.
  // Parts of the time are halved until no image moves far in one, and none comes or goes.
  trail.clear();
  struct Instant {
    double time;
    std::size_t images;
  };
  const auto add = [&](const auto& add_part, Instant from, Instant to) -> void {
    constexpr double kShortest = 1.0 / 16384;
    const double middle = (from.time + to.time) / 2, length = to.time - from.time;
    const bool fast = list_at(middle) * length > kPieceSigmas;
    const std::size_t number = listed.size();
    if (length > kShortest && (fast || number != from.images || number != to.images)) {
      add_part(add_part, from, {middle, number});
      add_part(add_part, {middle, number}, to);
      return;
    }
    for (SkyImage& image : listed) {
      image.amplification *= (1 - std::abs(middle)) * length;
      trail.push_back(image);
    }
  };
  const auto instant = [&](double time) {
    list_at(time);
    return Instant{time, listed.size()};
  };
  const Instant now{0, listed.size()};
  add(add, instant(-1), now);
  add(add, now, instant(1));
  append_pieces(star, trail, images);
}

// Appends the images of the orders from `first` to before `end`.
void StarImageFinder::append_orders(const SceneStar& star, const V3d& source, int first, int end,
                                    std::vector<StarImage>& images) const {
  if (scene_.effects.amplification == Amplification::kNone)
    end = std::min(end, kOrdersWithoutAmplification);
  const std::optional<AxisPassage> passage = passage_of(star, source);
  const double least = in_batches_ ? least_sine(star, source, passage) : 0;
  for (int order = first; order < end; ++order) {
    if (in_batches_ && !(star.flux * bound_[static_cast<std::size_t>(order)] > least)) return;
    const bool bright = append_order(star, source, passage, order, images);
    if (!in_batches_ && !bright && order + 1 >= kAlwaysTried) return;
  }
}

double StarImageFinder::radius_of(const SceneStar& star) const {
  return std::max(scene_.least_star_radius, star.angular_radius);
}

// Returns the sine that stands for the star's distance from the axis where bound_ is used.  The
// amplification of a disc is the mean over its points.  The mean of 1/(distance from the axis) over
// a disc is at most 2/radius, which it reaches where the axis is in the middle of the disc.
double StarImageFinder::least_sine(const SceneStar& star, const V3d& source,
                                   const std::optional<AxisPassage>& passage) const {
  const double sine = std::hypot(source.y, source.z), radius = radius_of(star);
  const double still = sine < kNearAxis * radius ? radius / 2 : sine;
  return passage ? std::min(still, 1 / passage->most_inverse_distance()) : still;
}

bool StarImageFinder::is_arc(const SceneStar& star, const V3d& source) const {
  return has_caustics_ && std::hypot(source.y, source.z) < kNearAxis * radius_of(star);
}

// A star whose own disc is larger than its way has no passage.
std::optional<AxisPassage> StarImageFinder::passage_of(const SceneStar& star,
                                                       const V3d& source) const {
  const double sine = std::hypot(source.y, source.z);
  if (!(sine < near_)) return std::nullopt;
  V3d way = scene_.motion.turn.cross(source);
  way.x = 0;
  const double length = way.length(), radius = radius_of(star);
  if (!(kWindow * length > radius)) return std::nullopt;
  const double ratio = sine / length, instant = std::min(kInstant, near_ / length);
  auto [window, sharpness] = passage_window(ratio, instant);
  // The peak of the weight is (sharpness + 1)/(2 window).  If it is higher than the peak 1/gap of a
  // triangle, the triangle takes its place.  Triangles at the distance of the gap add up to an even
  // exposure.
  if (scene_.motion.gap < 1 && window < scene_.motion.gap * (sharpness + 1) / 2) {
    window = scene_.motion.gap;
    sharpness = 1;
  }
  window = std::min(window, kLongestWay / length);
  if (!(window * length > radius)) return std::nullopt;
  return AxisPassage(source, way * window, radius, sharpness);
}

SkyImage StarImageFinder::image(const SceneStar& star, const V3d& source, int order) const {
  return out_of_lens(*scene_.tracer.lens(), points_->image(source, order, star.angular_radius));
}

// Returns the image as the camera receives it.  By [Riazuelo] sec. sec_stars_eff its temperature is
// T/(1+z).
StarImageFinder::Received StarImageFinder::receive(const SceneStar& star, const SkyImage& at,
                                                   const WorkingRgb& tint) const {
  const AberratedLight seen = from_tetrad_.to_rest(at.direction.v);
  const double doppler = seen.frequency_ratio;
  double g = at.frequency_ratio * doppler;
  if (viewer_.measured) g *= to_measured_.to_rest(seen.direction).frequency_ratio;
  double flux = received_flux(scene_.effects, star.flux, at.amplification, doppler, g);
  if (!scene_.effects.doppler_colour) flux = std::min(flux, kSaturated);
  const WorkingRgb per_flux =
      blackbody_colours().per_flux(star.temperature * colour_ratio(scene_.effects, g));
  const auto pixel = pixel_of(scene_.projection(),
                              {apply_transposed(observer_.tetrad_from_camera, seen.direction)});
  const double bright = luminance(per_flux), pixel_flux = flux * scene_.exposure;
  const WorkingRgb colour = saturated(per_flux, static_cast<float>(bright), scene_.star_saturation);
  Received received{{0, 0, {}}, bright * flux * peak_per_lux_, pixel.has_value()};
  if (!pixel) return received;
  const auto channel = [&](float per_unit) {
    return static_cast<float>(std::min(per_unit * pixel_flux, kSaturated));
  };
  received.image = {
      static_cast<float>(pixel->i - 1),
      static_cast<float>(pixel->j - 1),
      {channel(colour.r * tint.r), channel(colour.g * tint.g), channel(colour.b * tint.b)}};
  return received;
}

// Appends the image of one order.  Returns whether it is bright enough, even if it is outside the
// frame.
bool StarImageFinder::append_order(const SceneStar& star, const V3d& source,
                                   const std::optional<AxisPassage>& passage, int order,
                                   std::vector<StarImage>& images) const {
  const bool caustic = on_caustic(source, order);
  if (caustic && passage) {
    const auto image_of = [&](const V3d& at) { return points_->image(at, order, 0); };
    return append_trail(star, StarTrail(image_of, *passage), images);
  }
  if (caustic && is_arc(star, source)) {
    const auto spacing = [&](const V3d& direction) {
      return kPieceSigmas * least_sigma_at(direction);
    };
    return append_pieces(star, points_->arc(source, order, radius_of(star), spacing), images);
  }
  return append_image(star, image(star, source, order), images);
}

bool StarImageFinder::append_image(const SceneStar& star, const SkyImage& image,
                                   std::vector<StarImage>& images) const {
  const Received received = receive(star, image);
  if (!(received.peak > kFaintestPeak)) return false;
  if (received.placed) images.push_back(received.image);
  return true;
}

double StarImageFinder::least_sigma_at(const V3d& direction) const {
  return scene_.point_spread.least() * from_tetrad_.to_rest(direction).frequency_ratio;
}

// The boost is applied to both ends of the part, whose distance is the chord.
double StarImageFinder::sigmas_of(const StarTrail& trail, std::size_t k) const {
  const V3d begin = from_tetrad_.to_rest(trail.begin(k)).direction;
  const V3d end = from_tetrad_.to_rest(trail.begin(k + 1)).direction;
  return kWayPerChord * (end - begin).length() / scene_.point_spread.least();
}

// In a row of Gaussians the sum of all is sqrt(2 pi)/spacing times the peak of one.  Therefore the
// height of the row does not depend on the number of pieces.
int StarImageFinder::pieces_of(double sigmas, double peak, double& brightest) {
  const double row = peak * std::sqrt(2 * pi) / sigmas;
  brightest = std::max(brightest, std::min(peak, row));
  return static_cast<int>(
      std::clamp(std::ceil(sigmas / spacing_of(row)), 1.0, double{StarTrail::kMostPieces}));
}

// Each part is split as finely as its brightness asks for.
bool StarImageFinder::append_trail(const SceneStar& star, const StarTrail& trail,
                                   std::vector<StarImage>& images) const {
  if (in_batches_) return append_trail_in_batches(star, trail, images);
  std::vector<int> pieces;
  double brightest = 0;
  for (std::size_t k = 0; k < trail.parts(); ++k) {
    const double peak = receive(star, trail.part(k)).peak;
    pieces.push_back(pieces_of(sigmas_of(trail, k), peak, brightest));
  }
  if (!(brightest > kFaintestPeak)) return false;
  std::vector<SkyImage> split;
  for (std::size_t k = 0; k < trail.parts(); ++k) trail.split(k, pieces[k], split);
  for (const SkyImage& piece : split) {
    const Received received = receive(star, piece);
    if (received.placed) images.push_back(received.image);
  }
  return true;
}

bool StarImageFinder::append_pieces(const SceneStar& star, const std::vector<SkyImage>& pieces,
                                    std::vector<StarImage>& images,
                                    const std::vector<WorkingRgb>& tints) const {
  const std::size_t before = images.size();
  double light = 0;
  for (std::size_t k = 0; k < pieces.size(); ++k) {
    const Received received =
        tints.empty() ? receive(star, pieces[k]) : receive(star, pieces[k], tints[k]);
    light += received.peak;
    if (received.placed) images.push_back(received.image);
  }
  if (light > kFaintestPeak) return true;
  images.resize(before);
  return false;
}

}  // namespace domefall
