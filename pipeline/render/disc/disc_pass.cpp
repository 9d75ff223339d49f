#include "pipeline/render/disc/disc_pass.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "pipeline/disc/disc_shift.h"
#include "pipeline/render/disc/disc_pixels.h"
#include "pipeline/render/disc/veil.h"
#include "pipeline/render/rays/pixel_directions.h"
#include "pipeline/render/scene/effect_ratios.h"

namespace domefall {
namespace {

using std::numbers::pi;
constexpr int kBlock = ViewRayBatch::kSize;

// psi changes by less than this within one division of a pixel.
constexpr double kMostTurn = 0.1;
constexpr int kMostDivisions = 48;

DiscImages images_for(const FrameScene& scene) {
  const Disc& disc = scene.disc->disc();
  return {Radius(scene.state.observer.r),
          is_outgoing(scene.state.observer.tetrad),
          scene.tracer.goes_straight(),
          disc.inner,
          disc.outer,
          disc.pattern.has_value()};
}

// How far a rim is felt, in pixels.
constexpr double kReach = 0.75;

// The part of a pixel on the greater side of a rim, from the distance to it in pixels.  It goes
// from 0 to 1 a little more slowly than the pixel's square would, so that slanted rims look
// straight.
double beyond(double distance) {
  const double x = std::clamp(distance / (2 * kReach) + 0.5, 0.0, 1.0);
  return x * x * (3 - 2 * x);
}
// The inverse, for parts from 0 to 1.
double distance_of(double part) {
  if (part <= 0 || part >= 1) return part <= 0 ? -kReach : kReach;
  if (part == 0.5) return 0;  // the middle of nearly all pixels
  return -2 * kReach * std::sin(std::asin(1 - 2 * part) / 3);
}

double length(double x, double y) { return std::sqrt(x * x + y * y); }

}  // namespace

DiscPass::Clock::Clock(const ObserverState& observer) : outgoing(is_outgoing(observer.tetrad)) {
  const double r = observer.r, tortoise = r + 2 * std::log(std::abs(r / 2 - 1));
  // A mirrored observer's t counts the other way.
  null_time = is_mirrored(observer.tetrad) ? (outgoing ? -2 : 2) * tortoise - observer.null_time
                                           : observer.null_time;
  observer_v = outgoing ? null_time + 2 * tortoise : null_time;
}

double DiscPass::Clock::time_at(double r, double delay) const {
  // On the horizon light sets out an infinite time ago; no pattern is there.
  constexpr double kLeast = 1e-9;
  const double tortoise = r + 2 * std::log(std::max(r / 2 - 1, kLeast));
  return null_time + delay + (outgoing ? tortoise : -tortoise);
}

DiscPass::DiscPass(const FrameScene& scene)
    : scene_(scene),
      images_(images_for(scene)),
      r_(scene.state.observer.r),
      s_(std::sqrt(2 / r_)),
      one_minus_s_((r_ - 2) / (r_ * (1 + s_))),
      label_sign_(is_outgoing(scene.state.observer.tetrad) ? -1 : 1),
      energy_sign_(is_mirrored(scene.state.observer.tetrad) ? -1 : 1),
      clock_(scene.state.observer) {
  const Disc& disc = scene.disc->disc();
  if (disc.pattern) pattern_.emplace(*disc.pattern);
  const V3d normal =
      apply_transposed(scene.state.observer.sky_from_tetrad, scene.disc->disc().normal.v);
  normal_up_ = normal.x;
  normal_across_ = std::hypot(normal.y, normal.z);
  normal_azimuth_ = std::atan2(normal.z, normal.y);
  node_ = apply_transposed(scene.state.observer.sky_from_tetrad, disc.node.v);
  quarter_ = normal.cross(node_);
  // Light that goes straight: cos alpha/(r sin alpha), and the energy of the frame at rest.
  if (scene.tracer.goes_straight()) label_sign_ = 1;
}

// A row's pixels on their way to light: samples of the disc wait until there are enough of them.
class DiscPass::Strip {
 public:
  explicit Strip(const DiscPass& pass)
      : pass_(pass), effects_(pass.scene_.effects), disc_(pass.scene_.disc->disc()) {}

  // Draws on the pixels whose first one is rgb[3].
  void draw(const Pixels& pixels, int count, float* rgb) {
    light_.fill(WorkingRgb{0, 0, 0});
    for (int k = 0; k < count; ++k) {
      left_[static_cast<std::size_t>(k)] = 1;
      if (pixels.energy[k] > 0) look(pixels, k);
    }
    flush();
    const auto exposure = static_cast<float>(pass_.scene_.exposure);
    for (int k = 0; k < count; ++k) {
      const auto left = static_cast<float>(left_[static_cast<std::size_t>(k)]);
      const WorkingRgb& light = light_[static_cast<std::size_t>(k)];
      float* pixel = rgb + 3 * static_cast<std::ptrdiff_t>(k);
      pixel[0] = left * pixel[0] + exposure * light.r;
      pixel[1] = left * pixel[1] + exposure * light.g;
      pixel[2] = left * pixel[2] + exposure * light.b;
    }
  }

 private:
  // A division of a pixel: all of it, as a rule.
  struct Division {
    double turn, turn_per;  // psi_0, and by how much it changes here
    double azimuth_cosine, azimuth_sine;
    double part;  // of the pixel
  };

  void look(const Pixels& pixels, int k) {
    const double turn_per = pixels.turn_per[k];
    left_[static_cast<std::size_t>(k)] =
        turn_per < kMostTurn && pixels.azimuth_per[k] < 0.5
            ? look_at(
                  pixels, k,
                  {pixels.turn[k], turn_per, pixels.azimuth_cosine[k], pixels.azimuth_sine[k], 1})
            : look_at_divisions(pixels, k);
  }

  double look_at_divisions(const Pixels& pixels, int k) {
    // psi_0 = atan2(up, across cos(azimuth)) grows with |azimuth| from 0 to pi.
    const double up = std::abs(pass_.normal_up_), across = pass_.normal_across_;
    const double azimuth = std::atan2(pixels.azimuth_sine[k], pixels.azimuth_cosine[k]);
    const double half = std::min(pixels.azimuth_per[k], pi) / 2;
    const auto turn_at = [&](double at) {
      const double turn = std::atan2(up, across * std::cos(at));
      return turn > 0 ? turn : pi;
    };
    double left = 0;
    const auto divide = [&](double first, double last) {  // where psi_0 is monotone
      if (!(last > first)) return;
      const double begin = turn_at(first), end = turn_at(last);
      const int count = std::clamp(static_cast<int>(std::ceil(std::abs(end - begin) / kMostTurn)),
                                   1, kMostDivisions);
      double before = first;
      for (int n = 1; n <= count; ++n) {
        const double until = begin + (end - begin) * n / count;
        const double turned = std::acos(std::clamp(
            up / across * std::cos(until) / std::max(std::sin(until), 1e-300), -1.0, 1.0));
        const double sign = first + last < 0 ? -1 : 1;
        const double after = n == count ? last : sign * turned;
        const double part = std::abs(after - before) / (2 * half);
        left +=
            part * look_at(pixels, k,
                           {turn_at((before + after) / 2), std::abs(end - begin) / count,
                            std::cos((before + after) / 2), std::sin((before + after) / 2), part});
        before = after;
      }
    };
    double first = azimuth - half;
    const double last = azimuth + half;
    for (const double fold : {-pi, 0.0, pi})
      if (fold > first && fold < last) {
        divide(first, fold);
        first = fold;
      }
    divide(first, last);
    return left;
  }

  // The parts of a pixel that are beyond an image's inner rim, and beyond its outer one.
  struct Share {
    double from, to;
  };

  // Adds the samples of a division, and returns what is left there of the light from behind.
  double look_at(const Pixels& pixels, int k, const Division& division) {
    const DiscImages& images = pass_.images_;
    const double p = pixels.label[k], per = pixels.label_per[k];
    Veil<DiscImages::kOrders> veil;
    double left = 1;
    for (int order = 0; order < images.orders() && left > 1e-4; ++order) {
      if (p + per < images.least(order) || p - per > images.greatest(order)) continue;
      const double turn = division.turn + order * pi;
      const DiscImages::Interval rims = images.interval(turn);
      const Share share{beyond((p - rims.high) / length(per, rims.high_slope * division.turn_per)),
                        beyond((p - rims.low) / length(per, rims.low_slope * division.turn_per))};
      if (!(share.to - share.from > 1e-5)) continue;
      const double seen = veil.lay(share.from, share.to, disc_.opacity);
      shade(pixels, k, division, turn, rims, share, seen * division.part);
      left = veil.left();
    }
    return left;
  }

  // The light of what a pixel sees of an image: the mean over its part of the interval, with the
  // weights by which the pixel sees it, so that all pixels together see each place once.
  void shade(const Pixels& pixels, int k, const Division& division, double turn,
             const DiscImages::Interval& rims, const Share& share, double weight) {
    const double width = rims.high - rims.low;
    // How much of the interval a pixel's reach is.  It is slanted as the rims are, the more the
    // nearer it is to either.
    const double middle = (pixels.label[k] - rims.low) / width, near = std::clamp(middle, 0.0, 1.0);
    const double slope = rims.low_slope + (rims.high_slope - rims.low_slope) * near;
    const double per = length(pixels.label_per[k], slope * division.turn_per) / width;
    const auto part_at = [&](double covered) {
      return std::clamp(middle - distance_of(covered) * per, 0.0, 1.0);
    };
    const double from = part_at(share.to), to = part_at(share.from);
    constexpr double kPart = 0.06;
    constexpr int kMost = 16;
    const int count = std::clamp(static_cast<int>(std::ceil((to - from) / kPart)), 1, kMost);
    for (int n = 0; n < count; ++n) {
      const double u = part_at(share.to + (share.from - share.to) * (n + 0.5) / count);
      const double label = rims.low + u * width;
      put(pixels, k, division, turn, label, u, weight / count);
      if (pass_.pattern_) note_place(pixels, k, division, turn, u, (to - from) / count);
      if (count_ == kBlock) flush();
    }
  }

  void put(const Pixels& pixels, int k, const Division& division, double turn, double label,
           double u, double weight) {
    const double r = 1 / pass_.images_.inverse_radius(turn, u);
    const double w0 = 1 / pass_.r_;
    const bool straight = pass_.scene_.tracer.goes_straight();
    // 1/b^2 = p^2 + w_0^2 - 2 w_0^3
    const double inverse_b2 = label * label + w0 * w0 * (straight ? 1 : 1 - 2 * w0);
    const double energy = pixels.energy[k];
    const double momentum = energy / std::sqrt(std::max(inverse_b2, 1e-300));
    const double about =
        (pass_.normal_up_ > 0 ? -1 : 1) * pass_.normal_across_ * division.azimuth_sine;
    const double shift = disc_shift({energy, momentum, momentum * about}, r,
                                    r < kLastStableOrbit && outward(turn, label, u));
    const double g = pixels.rays.frequency[k] / shift;
    samples_.r[count_] = static_cast<float>(r);
    samples_.g[count_] = static_cast<float>(colour_ratio(effects_, g));
    samples_.weight[count_] = static_cast<float>(weight * surface_brightness_ratio(effects_, g));
    samples_.pixel[count_] = k;
    ++count_;
  }

  // The place and the moment of the last sample, for the pattern.  `part` is what it covers of u.
  void note_place(const Pixels& pixels, int k, const Division& division, double turn, double u,
                  double part) {
    const DiscImages::Moment at = pass_.images_.moment(turn, u);
    const double r = 1 / at.w, sine = std::sin(turn), cosine = std::cos(turn);
    // Around R from the normal's part across it, as locate_loop has it.
    const double side = pass_.normal_up_ > 0 ? -1 : 1;
    const double along = side * division.azimuth_cosine, beside = side * division.azimuth_sine;
    const double up = std::cos(pass_.normal_azimuth_), aside = std::sin(pass_.normal_azimuth_);
    const V3d place(cosine, sine * (along * up - beside * aside),
                    sine * (along * aside + beside * up));
    const double time =
        disc_.slow_light ? pass_.clock_.time_at(r, at.time) : pass_.clock_.observer_v;
    // Around R the place moves by psi and about the axis of psi, at right angles.
    const double turned = length(division.turn_per, sine * pixels.azimuth_per[k] * division.part),
                 aged = disc_.slow_light ? angular_velocity(r) * at.time_slope * part : 0;
    samples_.place[count_ - 1] = {r, std::atan2(place.dot(pass_.quarter_), place.dot(pass_.node_)),
                                  time, std::abs(at.w_slope) * part * r * r, length(turned, aged)};
  }

  // Whether light sets out there to larger radii: back in time along the ray w then grows.
  bool outward(double turn, double label, double u) const {
    constexpr double kStep = 1e-3;
    const DiscImages::Interval later = pass_.images_.interval(turn + kStep);
    const double then = std::clamp((label - later.low) / (later.high - later.low), 0.0, 1.0);
    return pass_.images_.inverse_radius(turn + kStep, then) > pass_.images_.inverse_radius(turn, u);
  }

  void flush() {
    const auto count = static_cast<std::size_t>(count_);
    pass_.scene_.disc->light({samples_.r.data(), count}, {samples_.g.data(), count},
                             {colour_.data(), count});
    if (pass_.pattern_) {
      pass_.pattern_->factors({samples_.place.data(), count}, {factor_.data(), count});
      for (std::size_t k = 0; k < count; ++k) samples_.weight[k] *= factor_[k];
    }
    for (std::size_t k = 0; k < count; ++k) {
      WorkingRgb& light = light_[static_cast<std::size_t>(samples_.pixel[k])];
      const float weight = samples_.weight[k];
      light.r += weight * colour_[k].r;
      light.g += weight * colour_[k].g;
      light.b += weight * colour_[k].b;
    }
    count_ = 0;
  }

  const DiscPass& pass_;
  const Effects& effects_;
  const Disc& disc_;
  std::array<double, kBlock> left_{};
  std::array<WorkingRgb, kBlock> light_{}, colour_{};
  struct {
    std::array<float, kBlock> r, g, weight;
    std::array<int, kBlock> pixel;
    std::array<PatternPlace, kBlock> place;
  } samples_{};
  std::array<float, kBlock> factor_{};
  int count_ = 0;
};

double DiscPass::left_before(const CameraDirection& n, double psi) const {
  // What moves in the plane itself is not behind it.
  constexpr double kInPlane = 1e-6;
  Pixels pixel;
  const double angle = central_pixel_angle(scene_.projection());
  locate(&n, &angle, 1, pixel);
  if (!(pixel.energy[0] > 0)) return 1;
  const double p = pixel.label[0], per = pixel.label_per[0];
  double left = 1;
  for (int order = 0; order < images_.orders(); ++order) {
    const double turn = pixel.turn[0] + order * pi;
    if (turn > psi - kInPlane) break;
    const DiscImages::Interval rims = images_.interval(turn);
    const double covered = beyond((p - rims.low) / per) - beyond((p - rims.high) / per);
    left *= 1 - scene_.disc->disc().opacity * std::clamp(covered, 0.0, 1.0);
  }
  return left;
}

void DiscPass::draw_rows(int first, int end, float* rgb) const {
  const Projection& projection = scene_.projection();
  Strip strip(*this);
  Pixels pixels;
  std::array<double, kBlock> i{}, j{}, angle{};
  std::array<CameraDirection, kBlock> n{};
  for (int row = first; row < end; ++row) {
    const ColumnRange inside = inside_columns(projection, row);
    float* line = rgb + 3 * static_cast<std::ptrdiff_t>(row - first) * columns(projection);
    for (int column = inside.first; column <= inside.last; column += kBlock) {
      const int count = std::min(kBlock, inside.last - column + 1);
      for (int k = 0; k < count; ++k) {
        i[static_cast<std::size_t>(k)] = column + k + 1;
        j[static_cast<std::size_t>(k)] = row + 1;
      }
      find_directions(projection, i.data(), j.data(), count, n.data(), angle.data());
      locate(n.data(), angle.data(), count, pixels);
      strip.draw(pixels, count, line + 3 * static_cast<std::ptrdiff_t>(column));
    }
  }
}

}  // namespace domefall
