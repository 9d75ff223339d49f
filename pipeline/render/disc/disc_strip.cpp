#include "pipeline/render/disc/disc_strip.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "pipeline/base/simd/vector_math.h"
#include "pipeline/render/disc/rim_coverage.h"
#include "pipeline/render/scene/effect_ratios.h"
#include "pipeline/sources/disc/disc_light.h"

namespace domefall {
namespace {

using std::numbers::pi;

// psi changes by less than this (radians) within one division of a pixel.
constexpr double kMostTurn = 0.1;
constexpr int kMostDivisions = 48;

double length(double x, double y) { return std::sqrt(x * x + y * y); }

// A Veil says how much of a pixel's light is left behind several images of a disc.
//
// Within a pixel the rims of the images are almost parallel.  The thin images at the edge of the
// silhouette lie side by side there, so that one does not hide the other although both are in one
// pixel.  Therefore one coordinate from 0 to 1 says where a line parallel to the rims cuts the
// pixel.  It is the part of the pixel on one side of the line.  An image covers an interval of it.
// At most kImages images are laid over one another.
template <int kImages>
class Veil {
 public:
  // Lays an image of this opacity over the part [from, to] of the pixel, 0 <= from <= to <= 1,
  // behind the images that are there.  Returns how much of the image's light is seen, as a part of
  // the pixel.
  double lay(double from, double to, double opacity) {
    divide(from);
    divide(to);
    double seen = 0;
    for (std::size_t k = 0; k < count_; ++k) {
      if (!(start_[k] >= from && start_[k] < to)) continue;
      seen += left_[k] * opacity * width(k);
      left_[k] *= 1 - opacity;
    }
    return seen;
  }

  // Returns the part of the light from behind that is left.
  double left() const {
    double sum = 0;
    for (std::size_t k = 0; k < count_; ++k) sum += left_[k] * width(k);
    return sum;
  }

 private:
  double width(std::size_t k) const { return (k + 1 < count_ ? start_[k + 1] : 1) - start_[k]; }

  // Lets a piece of the pixel begin at `at`, 0 < at < 1.  Other values change nothing.
  void divide(double at) {
    if (!(at > 0 && at < 1)) return;
    const auto end = start_.begin() + static_cast<std::ptrdiff_t>(count_);
    const auto after = std::upper_bound(start_.begin(), end, at);
    const auto k = static_cast<std::size_t>(after - start_.begin());
    if (start_[k - 1] == at) return;
    std::copy_backward(after, end, end + 1);
    std::copy_backward(left_.begin() + static_cast<std::ptrdiff_t>(k) - 1,
                       left_.begin() + static_cast<std::ptrdiff_t>(count_),
                       left_.begin() + static_cast<std::ptrdiff_t>(count_) + 1);
    start_[k] = at;
    ++count_;
  }

  static constexpr std::size_t kPieces = 2 * kImages + 1;
  std::size_t count_ = 1;
  std::array<double, kPieces> start_{0}, left_{1};
};

}  // namespace

DiscPass::Strip::Strip(const DiscPass& pass)
    : pass_(pass), effects_(pass.scene_.effects), disc_(pass.scene_.disc->disc()) {}

void DiscPass::Strip::gather(const Crossings& crossings, int count) {
  light_.fill(WorkingRgb{0, 0, 0});
  looks_only_ = false;
  gather(crossings, count, nullptr);
}

void DiscPass::Strip::look(const Crossings& crossings, int count, const bool* wanted) {
  for (Looks& looks : looks_) looks.count = 0;
  looks_only_ = true;
  gather(crossings, count, wanted);
}

void DiscPass::Strip::gather(const Crossings& crossings, int count, const bool* wanted) {
  taken_.fill({});
  for (int k = 0; k < count; ++k) {
    double& left = left_[static_cast<std::size_t>(k)];
    left = 1;
    if (!(crossings.energy[k] > 0) || (wanted && !wanted[k])) continue;
    const double turn_per = crossings.turn_per[k];
    left = turn_per < kMostTurn && crossings.azimuth_per[k] < 0.5
               ? gather_division(crossings, k,
                                 {crossings.turn[k], turn_per, crossings.azimuth_cosine[k],
                                  crossings.azimuth_sine[k], 1})
               : gather_by_divisions(crossings, k);
  }
  flush();
}

// Divides a pixel so that psi_0 changes little in each division, and returns the part of the light
// from behind that is left.
double DiscPass::Strip::gather_by_divisions(const Crossings& crossings, int k) {
  const PlaneRays& plane = *pass_.plane_;
  const double azimuth = arc_tangent2(crossings.azimuth_sine[k], crossings.azimuth_cosine[k]);
  const double half = std::min(crossings.azimuth_per[k], pi) / 2;
  double left = 0;
  const auto divide = [&](double first, double last) {  // where psi_0 is monotone
    if (!(last > first)) return;
    const double begin = plane.turn_at(first), end = plane.turn_at(last);
    const int count = std::clamp(static_cast<int>(std::ceil(std::abs(end - begin) / kMostTurn)), 1,
                                 kMostDivisions);
    double before = first;
    for (int n = 1; n <= count; ++n) {
      const double until = begin + (end - begin) * n / count;
      const double turned = plane.azimuth_at(until);
      const double sign = first + last < 0 ? -1 : 1;
      const double after = n == count ? last : sign * turned;
      const double part = std::abs(after - before) / (2 * half);
      const SineCosine middle = sin_cos((before + after) / 2);
      left +=
          part * gather_division(crossings, k,
                                 {plane.turn_at((before + after) / 2),
                                  std::abs(end - begin) / count, middle.cosine, middle.sine, part});
      before = after;
    }
  };
  // At the azimuths -pi, 0 and pi, psi_0 has its extremes, so that the pixel is cut there first.
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

// Adds the samples of a division, and returns the part of the light from behind that is left there.
double DiscPass::Strip::gather_division(const Crossings& crossings, int k,
                                        const Division& division) {
  const PlaneImages& images = pass_.plane_->images();
  const double p = crossings.label[k], per = crossings.label_per[k];
  Veil<PlaneImages::kOrders> veil;
  double left = 1;
  for (int order = 0; order < images.orders() && left > 1e-4; ++order) {
    if (p + per < images.least(order) || p - per > images.greatest(order)) continue;
    const double turn = division.turn + order * pi;
    const PlaneImages::Interval rims = images.interval(turn);
    const auto beyond = [&](double rim, double slope) {
      return beyond_rim((p - rim) / length(per, slope * division.turn_per) *
                        label_bend(p, rim, pass_.scene_.state.observer.r));
    };
    const Share share{beyond(rims.high, rims.high_slope), beyond(rims.low, rims.low_slope)};
    if (!(share.to - share.from > 1e-5)) continue;
    const Samples samples = sample(crossings, k, division, turn, rims, share);
    const double absorbed = samples.absorbed / samples.count,
                 opacity = pass_.scene_.state.settings.disc_opacity * absorbed,
                 seen = veil.lay(share.from, share.to, opacity) * division.part;
    taken_[static_cast<std::size_t>(k)][static_cast<std::size_t>(order)] += seen;
    if (absorbed > 0) shade(crossings, k, division, turn, samples, seen / samples.absorbed);
    left = veil.left();
  }
  return left;
}

// Chooses places on the part of an image that a pixel sees: evenly over that part of the interval, so
// that all pixels together count each place once.
DiscPass::Strip::Samples DiscPass::Strip::sample(const Crossings& crossings, int k,
                                                 const Division& division, double turn,
                                                 const PlaneImages::Interval& rims,
                                                 const Share& share) const {
  const double width = rims.high - rims.low, p = crossings.label[k];
  // `per` is the change of p across the pixel, relative to the image.  The slope of the image along
  // psi is interpolated between those of the two rims.
  const double near = std::clamp((p - rims.low) / width, 0.0, 1.0);
  const double slope = rims.low_slope + (rims.high_slope - rims.low_slope) * near;
  const double per = length(crossings.label_per[k], slope * division.turn_per);
  const auto label_at = [&](double covered) {
    return std::clamp(p - distance_to_rim(covered) * per, rims.low, rims.high);
  };
  // There is one sample for each kPart of the interval.
  const double seen = (label_at(share.from) - label_at(share.to)) / width;
  constexpr double kPart = 0.03;
  Samples samples;
  samples.count = std::clamp(static_cast<int>(std::ceil(seen / kPart)), 1, kMostSamples);
  samples.part = seen / samples.count;
  for (int n = 0; n < samples.count; ++n) {
    const double label = label_at(share.to + (share.from - share.to) * (n + 0.5) / samples.count);
    const double u = (label - rims.low) / width;
    const auto at = static_cast<std::size_t>(n);
    samples.u[at] = u;
    samples.gas[at] = pass_.gas_at(crossings, k, turn, label, u, division.azimuth_sine);
    samples.absorbed += samples.gas[at].absorbed;
  }
  return samples;
}

// Notes the samples with their radii, the frequency ratios g as the observer measures them, and their
// weights.
void DiscPass::Strip::shade(const Crossings& crossings, int k, const Division& division,
                            double turn, const Samples& samples, double weight) {
  for (int n = 0; n < samples.count; ++n) {
    const auto at = static_cast<std::size_t>(n);
    const auto [r, g, absorbed] = samples.gas[at];
    samples_.r[count_] = static_cast<float>(r);
    samples_.g[count_] = static_cast<float>(colour_ratio(effects_, g));
    samples_.weight[count_] =
        static_cast<float>(weight * absorbed * surface_brightness_ratio(effects_, g));
    samples_.pixel[count_] = k;
    ++count_;
    if (pass_.pattern_) note_place(crossings, k, division, turn, samples.u[at], samples.part);
    if (count_ == kSize) flush();
  }
}

// Notes the place and the time of the last sample for the pattern.  `part` is the range of u that
// the sample covers.
void DiscPass::Strip::note_place(const Crossings& crossings, int k, const Division& division,
                                 double turn, double u, double part) {
  const PlaneImages::Moment at = pass_.plane_->images().moment(turn, u);
  const double r = 1 / at.w;
  const V3d place = pass_.plane_->place(turn, division.azimuth_cosine, division.azimuth_sine);
  const double time = disc_.slow_light ? pass_.plane_->clock().time_at(r, at.time)
                                       : pass_.plane_->clock().observer_time();
  // Across the pixel the place moves along psi, and at right angles to that about R.  The gas also
  // turns on while the time of emission changes.
  const double moved = length(division.turn_per,
                              sin_cos(turn).sine * crossings.azimuth_per[k] * division.part),
               aged =
                   disc_.slow_light ? disc_.orbits.angular_velocity(r) * at.time_slope * part : 0;
  samples_.place[count_ - 1] = {r, arc_tangent2(place.dot(pass_.quarter_), place.dot(pass_.node_)),
                                time, std::abs(at.w_slope) * part * r * r, length(moved, aged)};
}

// Turns the waiting samples into light and adds it to their pixels.
void DiscPass::Strip::flush() {
  const std::size_t count = count_;
  pass_.scene_.disc->light({samples_.r.data(), count}, {samples_.g.data(), count},
                           {colour_.data(), count});
  count_ = 0;
  if (looks_only_) return note_looks(count);
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
}

// Without a pattern a pixel has one look, with all its light.
void DiscPass::Strip::note_looks(std::size_t count) {
  for (std::size_t k = 0; k < count; ++k) {
    Looks& looks = looks_[static_cast<std::size_t>(samples_.pixel[k])];
    if (pass_.pattern_ || looks.count == 0) {
      if (looks.count++ >= kMostLooks) continue;
      looks.at[static_cast<std::size_t>(looks.count - 1)] = {{0, 0, 0}, samples_.place[k]};
    }
    WorkingRgb& light = looks.at[static_cast<std::size_t>(looks.count - 1)].light;
    light.r += samples_.weight[k] * colour_[k].r;
    light.g += samples_.weight[k] * colour_[k].g;
    light.b += samples_.weight[k] * colour_[k].b;
  }
}

}  // namespace domefall
