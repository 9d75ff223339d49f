// The optics and the lens of a charge, for an observer in the tetrad T of spacetime/charged.h or in T',
// in any region and universe.
#pragma once

#include <optional>

#include "pipeline/light/charged_azimuth.h"
#include "pipeline/light/hole_optics.h"
#include "pipeline/light/spherical_lens.h"
#include "trajectories/observer_state.h"

namespace domefall {

// Returns the sky in which an observer sees light that started there, if it is known: before the
// first universe there is none.
std::optional<SkyRegion> sky_of(ChargedOrigin origin, const ObserverState& observer);

// Makes the optics without tables.  The view has at most two zones, each of which reaches from an
// edge to the axis:
//
//     outside             the own sky, and within the silhouette that of the universe before
//     II, IV              I and III, in IV those of the universe before
//     inside r_-, naked   the own sky twice: straight from it, and by way of the core
//
// Between them is light that circled for ever, or nothing.  Inside r_x, and where light cannot
// circle, they meet where the azimuth is greatest.  On a horizon the observer's region says on which
// side its place counts.
//
// As an observer comes to an inner horizon, the whole future of a sky shrinks to a point, ever bluer.
// Its light is drawn no bluer than 1e9 times, which no frame tells from more.
HoleOptics make_charged_optics(const ChargedHole& hole, const ObserverState& observer);

class ChargedLens : public SphericalLens {
 public:
  ChargedLens(std::shared_ptr<const HoleOptics> optics, const PerSky<M33d>& axes,
              const ChargedHole& hole, double r)
      : SphericalLens(std::move(optics), axes), hole_(hole), r_(r) {}

  // The observer must be above the inner horizon.
  std::optional<BodyImage> body_image(double null_time, const BodyMotion& motion, int order,
                                      double radius) const override {
    return image_of_body(ChargedPlaceView{hole_, r_, false}, null_time, motion, order, radius);
  }
  std::optional<GasView> gas_view() const override {
    return GasView{{hole_, r_, optics().tetrad}, own_edge()};
  }
  std::optional<SeenPlace> place(double null_time, double r, double psi) const override {
    return seen_place(ChargedPlaceView{hole_, r_, false}, null_time, r, psi);
  }
  std::unique_ptr<const PlaneRays> plane(const PlaneRings& rings, double null_time) const override {
    return std::make_unique<PlaneRays>(PlaneView{hole_, r_, optics().tetrad}, null_time, rings);
  }

 private:
  ChargedHole hole_;
  double r_;
};

}  // namespace domefall
