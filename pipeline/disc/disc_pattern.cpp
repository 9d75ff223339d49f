#include "pipeline/disc/disc_pattern.h"

#include <cmath>
#include <numbers>

#include "pipeline/simd/vector_math.h"

namespace domefall {
namespace {

constexpr double kTwoPi = 2 * std::numbers::pi;

// Returns a Gaussian of that standard deviation (radians), wrapped around the circle, with a mean
// of 1.
double wrapped_gaussian(double angle, double sigma) {
  const double x = (angle / kTwoPi - std::floor(angle / kTwoPi + 0.5)) * kTwoPi;
  double sum = 0;
  // What either series leaves out is below 1e-5 of the mean.
  if (sigma < 1.3) {
    for (int k = -1; k <= 1; ++k) {
      const double off = (x + k * kTwoPi) / sigma;
      sum += exponential(-off * off / 2);
    }
    return sum * std::sqrt(kTwoPi) / sigma;
  }
  for (int m = 1; m <= 3; ++m)
    sum += exponential(-m * m * sigma * sigma / 2) * sin_cos(m * x).cosine;
  return 1 + 2 * sum;
}

// Returns the light of the gas and the spot, with the spot spread over the footprint, over the mean
// of the two around the ring.
double spot_factor(const SpotPattern& spot, const PatternPlace& at) {
  const double across = at.r_width / 2, along = at.azimuth_width / 2, own = spot.size / at.r;
  const double high = std::hypot(spot.size, across), wide = std::hypot(own, along);
  const double off = (at.r - spot.r) / high;
  const double mean = (spot.brightness - 1) * spot.size / high * exponential(-off * off / 2) * own /
                      std::sqrt(kTwoPi);
  const double turns = angular_velocity(spot.r) / kTwoPi * at.time;
  const double angle = at.azimuth - spot.azimuth - (turns - std::floor(turns)) * kTwoPi;
  return (1 + mean * wrapped_gaussian(angle, wide)) / (1 + mean);
}

double ring_factor(const RingPattern& rings, const PatternPlace& at) {
  const double turns = (at.r + rings.inward_speed * at.time) / rings.spacing;
  // The mean of a cosine over a pixel is that in its middle times sin(width)/width.  This Gaussian
  // agrees with that factor to second order and does not change sign.
  const double width = std::numbers::pi * at.r_width / rings.spacing;
  const double fading = exponential(-width * width / 6);
  return 1 + rings.contrast * fading * sin_cos((turns - std::floor(turns)) * kTwoPi).cosine;
}

}  // namespace

double angular_velocity(double r) {
  if (r >= kLastStableOrbit) return 1 / (r * std::sqrt(r));
  return (1 - kHorizonRadius / r) * kPlungeTurning / (r * r);
}

DiscPattern::DiscPattern(const PatternKind& kind) : kind_(kind) {
  if (const auto* turbulence = std::get_if<TurbulencePattern>(&kind))
    turbulence_.emplace(*turbulence);
}

void DiscPattern::factors(std::span<const PatternPlace> places, std::span<float> out) const {
  if (turbulence_) return turbulence_->factors(places, out);
  const auto* rings = std::get_if<RingPattern>(&kind_);
  const auto* spot = std::get_if<SpotPattern>(&kind_);
  for (std::size_t k = 0; k < places.size(); ++k)
    out[k] =
        static_cast<float>(rings ? ring_factor(*rings, places[k]) : spot_factor(*spot, places[k]));
}

}  // namespace domefall
