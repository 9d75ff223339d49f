#include "pipeline/render/disc/sphere_strip.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "pipeline/base/simd/vector_math.h"
#include "pipeline/render/disc/rim_coverage.h"
#include "pipeline/sources/disc/disc_light.h"

namespace domefall {
namespace {

using std::numbers::pi;

// psi changes by less than this (radians) within one division of a pixel.
constexpr double kMostTurn = 0.1;
constexpr int kMostDivisions = 48;
// Between two nodes of a row, so many pixels apart, the azimuth and psi_0 change by less than this.
constexpr int kSteps = 8;
constexpr double kMostBetween = 0.25;

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

void DiscPass::SphereStrip::locate(const CameraDirection* n, const double* angle, int count) {
  pixels_ = count;
  pass_.locate(n, angle, count, crossings_);
}

DiscPass::Strip::Sighting DiscPass::SphereStrip::sighting(int k) const {
  const Crossings& crossings = crossings_;
  Sighting at;
  if (!(crossings.energy[k] > 0)) {
    at.sight = kNoLight;
    at.clearance = kFar;
    return at;
  }
  // Where the azimuth or psi_0 changes too much from node to node, the clearance stays 0.
  const double turned = kSteps * crossings.azimuth_per[k];
  const double toward = pass_.plane_->across() * crossings.azimuth_cosine[k];
  const double up = pass_.plane_->up(), from_plane = std::sqrt(up * up + toward * toward);
  if (turned > kMostBetween || turned * pass_.plane_->across() > kMostBetween * from_plane)
    return at;
  const double p = crossings.label[k], per = crossings.label_per[k];
  const PlaneImages& images = pass_.plane_->images();
  double clearance = kFar;
  // Each order sets two bits of the sight.  A ray far from the range of an order needs no interval.
  for (int order = 0; order < images.orders(); ++order) {
    const double beneath = (images.least(order) - p) / per,
                 above = (p - images.greatest(order)) / per;
    Side place = kBeneath;
    constexpr double kNotNear = 4 * kSteps;
    if (above > kNotNear) {
      place = kAbove;
    } else if (!(beneath > kNotNear)) {
      const double turn = crossings.turn[k] + order * pi, turn_per = crossings.turn_per[k];
      const PlaneImages::Interval rims = images.interval(turn);
      const double over_low = (p - rims.low) / (per + std::abs(rims.low_slope) * turn_per),
                   over_high = (p - rims.high) / (per + std::abs(rims.high_slope) * turn_per);
      clearance = std::min({clearance, std::abs(over_low), std::abs(over_high)});
      if (over_high >= 0) {
        place = kAbove;
      } else if (over_low >= 0) {
        const double u = (p - rims.low) / (rims.high - rims.low);
        const double stable = disc_.orbits.last_stable();
        const bool plunges = disc_.inner < stable && images.inverse_radius(turn, u) * stable > 1;
        place = plunges ? kWherePlunging : kWithin;
      }
    }
    at.sight |= static_cast<unsigned>(place) << (2 * order);
    if (place == kBeneath || place == kAbove) continue;
    at.lit = true;
    if (pass_.scene_.state.settings.disc_opacity == 1 && disc_.is_opaque()) break;
  }
  at.clearance = clearance;
  return at;
}

double DiscPass::SphereStrip::gather_pixel(int k) {
  if (!(crossings_.energy[k] > 0)) return 1;
  const double turn_per = crossings_.turn_per[k];
  return turn_per < kMostTurn && crossings_.azimuth_per[k] < 0.5
             ? gather_division(k, {crossings_.turn[k], turn_per, crossings_.azimuth_cosine[k],
                                   crossings_.azimuth_sine[k], 1})
             : gather_by_divisions(k);
}

// Divides a pixel so that psi_0 changes little in each division, and returns the part of the light
// from behind that is left.
double DiscPass::SphereStrip::gather_by_divisions(int k) {
  const PlaneRays& plane = *pass_.plane_;
  const double azimuth = arc_tangent2(crossings_.azimuth_sine[k], crossings_.azimuth_cosine[k]);
  const double half = std::min(crossings_.azimuth_per[k], pi) / 2;
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
      left += part *
              gather_division(k, {plane.turn_at((before + after) / 2),
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
double DiscPass::SphereStrip::gather_division(int k, const Division& division) {
  const PlaneImages& images = pass_.plane_->images();
  const double p = crossings_.label[k], per = crossings_.label_per[k];
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
    const Samples samples = sample(k, division, turn, rims, share);
    const double absorbed = samples.absorbed / samples.count,
                 opacity = pass_.scene_.state.settings.disc_opacity * absorbed,
                 seen = veil.lay(share.from, share.to, opacity) * division.part;
    take(k, order) += seen;
    if (absorbed > 0)
      for (int n = 0; n < samples.count; ++n) {
        const auto at = static_cast<std::size_t>(n);
        add(k, samples.gas[at], seen / samples.absorbed,
            pass_.pattern_ ? place(k, division, turn, samples.u[at], samples.part)
                           : PatternPlace{});
      }
    left = veil.left();
  }
  return left;
}

// Chooses places on the part of an image that a pixel sees: evenly over that part of the interval, so
// that all pixels together count each place once.
DiscPass::SphereStrip::Samples DiscPass::SphereStrip::sample(int k, const Division& division,
                                                             double turn,
                                                             const PlaneImages::Interval& rims,
                                                             const Share& share) const {
  const double width = rims.high - rims.low, p = crossings_.label[k];
  // `per` is the change of p across the pixel, relative to the image.  The slope of the image along
  // psi is interpolated between those of the two rims.
  const double near = std::clamp((p - rims.low) / width, 0.0, 1.0);
  const double slope = rims.low_slope + (rims.high_slope - rims.low_slope) * near;
  const double per = length(crossings_.label_per[k], slope * division.turn_per);
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
    samples.gas[at] = pass_.gas_at(crossings_, k, turn, label, u, division.azimuth_sine);
    samples.absorbed += samples.gas[at].absorbed;
  }
  return samples;
}

// Returns the place and the time of a sample for the pattern.  `part` is the range of u that
// the sample covers.
PatternPlace DiscPass::SphereStrip::place(int k, const Division& division, double turn, double u,
                                          double part) const {
  const PlaneImages::Moment at = pass_.plane_->images().moment(turn, u);
  const double r = 1 / at.w;
  const V3d there = pass_.plane_->place(turn, division.azimuth_cosine, division.azimuth_sine);
  const double time = disc_.slow_light ? pass_.plane_->clock().time_at(r, at.time)
                                       : pass_.plane_->clock().observer_time();
  // Across the pixel the place moves along psi, and at right angles to that about R.  The gas also
  // turns on while the time of emission changes.
  const double moved = length(division.turn_per,
                              sin_cos(turn).sine * crossings_.azimuth_per[k] * division.part),
               aged =
                   disc_.slow_light ? disc_.orbits.angular_velocity(r) * at.time_slope * part : 0;
  return {r, arc_tangent2(there.dot(pass_.quarter_), there.dot(pass_.node_)), time,
          std::abs(at.w_slope) * part * r * r, length(moved, aged)};
}

}  // namespace domefall
