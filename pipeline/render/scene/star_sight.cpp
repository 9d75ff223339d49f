#include "pipeline/render/scene/star_sight.h"

#include "pipeline/optics/aberration.h"
#include "pipeline/render/scene/star_light.h"

namespace domefall {
namespace {

constexpr double kLeastSource = 1e-4;  // radians; it bounds the light of a star on the axis
constexpr int kMostOrders = 24;        // as many as the renderer tries

// Returns the image of a source without lensing.  The boost from the observer at rest to the tetrad
// multiplies the frequency by `ratio` and divides solid angles by its square.
SkyImage straight_image(const Vantage& vantage, double r, const V3d& source) {
  const AberratedLight at = to_tetrad(vantage.rest, source);
  const double ratio = at.frequency_ratio;
  return {{at.direction}, gravitational_ratio(r) * ratio, 1 / (ratio * ratio)};
}

}  // namespace

StarSight::StarSight(const FrameState& state, const Effects& effects)
    : effects_(effects),
      observer_(state.observer),
      vantage_(vantage_of(state.observer, effects)),
      optics_(make_hole_optics(state.observer.r, state.observer.tetrad,
                               {{true, true, false}, false})) {}

bool StarSight::sees(SkyRegion sky) const {
  if (is_flat(observer_) || !effects_.lensing) return seen_skies(observer_)[sky];
  return observer_.region != Region::kIV && optics_.table_of(sky) != nullptr;
}

int StarSight::orders() const {
  if (is_flat(observer_) || !effects_.lensing) return 1;
  return effects_.amplification == Amplification::kNone ? 2 : kMostOrders;
}

StarSight::Image StarSight::image(SkyRegion sky, const SkyDirection& star, int order) const {
  const V3d source = apply_transposed(observer_.sky_from_tetrad, star.v);
  const SkyImage at = effects_.lensing
                          ? image_of(optics_.table_of(sky), source, order, kLeastSource)
                          : straight_image(vantage_, observer_.r, source);
  const AberratedLight seen = to_observer(vantage_.celerity, at.direction.v);
  // The frequency changes from the star to the tetrad, from there to the observer whose directions
  // are drawn, and from this one to the observer who measures it.
  double g = at.frequency_ratio * seen.frequency_ratio;
  if (vantage_.measured) g *= to_observer(*vantage_.measured, seen.direction).frequency_ratio;
  return {{apply_transposed(observer_.tetrad_from_camera, seen.direction)},
          received_flux(effects_, 1, at.amplification, seen.frequency_ratio, g)};
}

}  // namespace domefall
