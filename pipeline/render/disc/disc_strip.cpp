#include "pipeline/render/disc/disc_strip.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "pipeline/disc/disc_shift.h"
#include "pipeline/render/disc/rim_coverage.h"
#include "pipeline/render/disc/veil.h"
#include "pipeline/render/scene/effect_ratios.h"
#include "pipeline/simd/vector_math.h"

namespace domefall {
namespace {

using std::numbers::pi;

// psi changes by less than this (radians) within one division of a pixel.
constexpr double kMostTurn = 0.1;
constexpr int kMostDivisions = 48;

double length(double x, double y) { return std::sqrt(x * x + y * y); }

}  // namespace

DiscPass::Strip::Strip(const DiscPass& pass)
    : pass_(pass), effects_(pass.scene_.effects), disc_(pass.scene_.disc->disc()) {}

void DiscPass::Strip::gather(const Crossings& crossings, int count, const bool* wanted) {
  light_.fill(WorkingRgb{0, 0, 0});
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
  // psi_0 = atan2(up, across cos(azimuth)) grows as |azimuth| grows from 0 to pi.
  const double up = std::abs(pass_.normal_up_), across = pass_.normal_across_;
  const double azimuth = arc_tangent2(crossings.azimuth_sine[k], crossings.azimuth_cosine[k]);
  const double half = std::min(crossings.azimuth_per[k], pi) / 2;
  const auto turn_at = [&](double at) {
    const double turn = arc_tangent2(up, across * sin_cos(at).cosine);
    return turn > 0 ? turn : pi;
  };
  // This inverts turn_at for azimuths from 0 to pi: cos(azimuth) = up cos psi_0/(across sin psi_0).
  const auto azimuth_at = [&](double turn) {
    const SineCosine t = sin_cos(turn);
    const double x = up * t.cosine, length = across * t.sine;
    return arc_tangent2(std::sqrt(std::max(0.0, (length - x) * (length + x))), x);
  };
  double left = 0;
  const auto divide = [&](double first, double last) {  // where psi_0 is monotone
    if (!(last > first)) return;
    const double begin = turn_at(first), end = turn_at(last);
    const int count = std::clamp(static_cast<int>(std::ceil(std::abs(end - begin) / kMostTurn)), 1,
                                 kMostDivisions);
    double before = first;
    for (int n = 1; n <= count; ++n) {
      const double until = begin + (end - begin) * n / count;
      const double turned = azimuth_at(until);
      const double sign = first + last < 0 ? -1 : 1;
      const double after = n == count ? last : sign * turned;
      const double part = std::abs(after - before) / (2 * half);
      const SineCosine middle = sin_cos((before + after) / 2);
      left += part * gather_division(crossings, k,
                                     {turn_at((before + after) / 2), std::abs(end - begin) / count,
                                      middle.cosine, middle.sine, part});
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
  const DiscImages& images = pass_.images_;
  const double p = crossings.label[k], per = crossings.label_per[k];
  Veil<DiscImages::kOrders> veil;
  double left = 1;
  for (int order = 0; order < images.orders() && left > 1e-4; ++order) {
    if (p + per < images.least(order) || p - per > images.greatest(order)) continue;
    const double turn = division.turn + order * pi;
    const DiscImages::Interval rims = images.interval(turn);
    const Share share{
        beyond_rim((p - rims.high) / length(per, rims.high_slope * division.turn_per)),
        beyond_rim((p - rims.low) / length(per, rims.low_slope * division.turn_per))};
    if (!(share.to - share.from > 1e-5)) continue;
    const double seen = veil.lay(share.from, share.to, disc_.opacity);
    shade(crossings, k, division, turn, rims, share, seen * division.part);
    left = veil.left();
  }
  return left;
}

// Adds the light of the part of an image that a pixel sees.  This is the mean over that part of the
// interval, with the pixel's own weights, so that all pixels together count each place once.
void DiscPass::Strip::shade(const Crossings& crossings, int k, const Division& division,
                            double turn, const DiscImages::Interval& rims, const Share& share,
                            double weight) {
  const double width = rims.high - rims.low, p = crossings.label[k];
  // `per` is the change of p across the pixel, relative to the image.  The slope of the image along
  // psi is interpolated between those of the two rims.
  const double near = std::clamp((p - rims.low) / width, 0.0, 1.0);
  const double slope = rims.low_slope + (rims.high_slope - rims.low_slope) * near;
  const double per = length(crossings.label_per[k], slope * division.turn_per);
  const auto label_at = [&](double covered) {
    return std::clamp(p - distance_to_rim(covered) * per, rims.low, rims.high);
  };
  // `seen` is the part of the interval that the pixel covers.  There is one sample for each kPart.
  const double seen = (label_at(share.from) - label_at(share.to)) / width;
  constexpr double kPart = 0.03;
  constexpr int kMost = 32;
  const int count = std::clamp(static_cast<int>(std::ceil(seen / kPart)), 1, kMost);
  for (int n = 0; n < count; ++n) {
    const double label = label_at(share.to + (share.from - share.to) * (n + 0.5) / count);
    const double u = (label - rims.low) / width;
    put(crossings, k, division, turn, label, u, weight / count);
    if (pass_.pattern_) note_place(crossings, k, division, turn, u, seen / count);
    if (count_ == kSize) flush();
  }
}

// Notes one sample: its radius, its frequency ratio g as the observer measures it, and its weight.
void DiscPass::Strip::put(const Crossings& crossings, int k, const Division& division, double turn,
                          double label, double u, double weight) {
  const double r = 1 / pass_.images_.inverse_radius(turn, u);
  const double w0 = 1 / pass_.r_;
  const bool straight = pass_.scene_.tracer.goes_straight();
  // The orbit equation w'^2 = 1/b^2 - w^2 + 2 w^3, taken at the observer, where w' = p, gives
  // 1/b^2 = p^2 + w_0^2 - 2 w_0^3.  Straight light has no cubic term.
  const double inverse_b2 = label * label + w0 * w0 * (straight ? 1 : 1 - 2 * w0);
  const double energy = crossings.energy[k];
  const double momentum = energy / std::sqrt(std::max(inverse_b2, 1e-300));
  // L times `about` is L_n = -L (r^ x e^).n of disc_shift.h.
  const double about =
      (pass_.normal_up_ > 0 ? -1 : 1) * pass_.normal_across_ * division.azimuth_sine;
  const double shift = disc_shift({energy, momentum, momentum * about}, r,
                                  r < kLastStableOrbit && outward(turn, label, u));
  const double g = crossings.rays.frequency[k] / shift;
  samples_.r[count_] = static_cast<float>(r);
  samples_.g[count_] = static_cast<float>(colour_ratio(effects_, g));
  samples_.weight[count_] = static_cast<float>(weight * surface_brightness_ratio(effects_, g));
  samples_.pixel[count_] = k;
  ++count_;
}

// Notes the place and the time of the last sample for the pattern.  `part` is the range of u that
// the sample covers.
void DiscPass::Strip::note_place(const Crossings& crossings, int k, const Division& division,
                                 double turn, double u, double part) {
  const DiscImages::Moment at = pass_.images_.moment(turn, u);
  const SineCosine turned = sin_cos(turn);
  const double r = 1 / at.w;
  // The tangent e^ lies at this azimuth about R from the normal's part across R, as in
  // locate_on_disc_loop.  The place is cos(turn) r^ + sin(turn) e^.
  const double side = pass_.normal_up_ > 0 ? -1 : 1;
  const double along = side * division.azimuth_cosine, beside = side * division.azimuth_sine;
  const double up = pass_.normal_cosine_, aside = pass_.normal_sine_;
  const V3d place(turned.cosine, turned.sine * (along * up - beside * aside),
                  turned.sine * (along * aside + beside * up));
  const double time = disc_.slow_light ? pass_.clock_.time_at(r, at.time) : pass_.clock_.observer_v;
  // Across the pixel the place moves along psi, and at right angles to that about R.  The gas also
  // turns on while the time of emission changes.
  const double moved = length(division.turn_per,
                              turned.sine * crossings.azimuth_per[k] * division.part),
               aged = disc_.slow_light ? angular_velocity(r) * at.time_slope * part : 0;
  samples_.place[count_ - 1] = {r, arc_tangent2(place.dot(pass_.quarter_), place.dot(pass_.node_)),
                                time, std::abs(at.w_slope) * part * r * r, length(moved, aged)};
}

// Says whether light sets out to larger radii.  If so, w grows along the ray back in time.
bool DiscPass::Strip::outward(double turn, double label, double u) const {
  constexpr double kStep = 1e-3;
  const DiscImages::Interval later = pass_.images_.interval(turn + kStep);
  const double then = std::clamp((label - later.low) / (later.high - later.low), 0.0, 1.0);
  return pass_.images_.inverse_radius(turn + kStep, then) > pass_.images_.inverse_radius(turn, u);
}

// Turns the waiting samples into light and adds it to their pixels.
void DiscPass::Strip::flush() {
  const std::size_t count = count_;
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

}  // namespace domefall
