// The light of a disc's surface: a blackbody of the profile's temperature T(r), of which an
// observer sees one of g T, g the frequency observed over the one sent, in colour and radiance.  It
// is scaled so that the hottest ring has the show's luminance for who moves with it.
#pragma once

#include <span>
#include <vector>

#include "pipeline/colour/colour_space.h"
#include "pipeline/disc/disc.h"
#include "pipeline/disc/page_thorne.h"

namespace domefall {

class DiscLight {
 public:
  explicit DiscLight(const Disc& disc);

  const Disc& disc() const { return disc_; }

  // Kelvin, in the gas's own frame; 0 where there is no gas of the profile, whatever the disc's
  // radii are.
  double temperature(double r) const;
  // cd/m^2 in the working space, of an opaque disc: r in units of M, g >= 0.  Black where there is
  // no gas, and at most some 1e37.
  WorkingRgb light(double r, double g) const;

  // The same of many places with as many ratios, for pixels.  r > 0 and g >= 0 are finite.
  // Measured against light(): a relative error below 6e-5, and below 2.5e-4 next to the last stable
  // orbit where gas plunges, half of what a half float rounds.
  void light(std::span<const float> r, std::span<const float> g, std::span<WorkingRgb> out) const;

 private:
  Disc disc_;
  PageThorneProfile profile_;
  double scale_;  // from a blackbody's luminance to the show's
  // log2 T without what is singular in it, at even steps of sqrt(6/r).
  std::vector<float> table_;
};

}  // namespace domefall
