// A DiscLight is the light of a disc's surface.  The surface is a blackbody of the profile's
// temperature T(r).  An observer sees one of g T, in colour and radiance, where g is the frequency
// observed over the one sent.  The light is scaled so that the hottest ring has the show's
// luminance for whoever moves with it.
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

  // Returns the temperature in the gas's own frame (K).  It is 0 where there is no gas of the
  // profile, whatever the disc's radii are.
  double temperature(double r) const;
  // Returns the light of an opaque disc, in cd/m^2 in the working space, for r in units of M and
  // g >= 0.  It is black where there is no gas, and at most some 1e37.
  WorkingRgb light(double r, double g) const;

  // Returns the same of many places with as many ratios, for pixels.  r > 0 and g >= 0 are finite.
  // Measured against light(), the relative error is below 6e-5.  Next to the last stable orbit,
  // where gas plunges, it is below 2.5e-4, half the largest rounding error of a half float.
  void light(std::span<const float> r, std::span<const float> g, std::span<WorkingRgb> out) const;

 private:
  Disc disc_;
  PageThorneProfile profile_;
  double scale_;  // from a blackbody's luminance to the show's
  // This is log2 T without what is singular in it, at even steps of sqrt(6/r).
  std::vector<float> table_;
};

}  // namespace domefall
