// The lens of a Schwarzschild hole for an observer in free fall.
#pragma once

#include "pipeline/light/spherical_lens.h"

namespace domefall {

class SchwarzschildLens : public SphericalLens {
 public:
  using SphericalLens::SphericalLens;

  std::optional<BodyImage> body_image(double null_time, const BodyMotion& motion, int order,
                                      double radius) const override {
    return image_of_body({optics().at, is_outgoing(optics().tetrad), false}, null_time, motion,
                         order, radius);
  }
  std::optional<GasView> gas_view() const override {
    return GasView{{Schwarzschild{}, optics().at, optics().tetrad}, own_edge()};
  }
  std::optional<SeenPlace> place(double null_time, double r, double psi) const override {
    return seen_place(PlaceView{optics().at, is_outgoing(optics().tetrad), false}, null_time, r,
                      psi);
  }
  std::unique_ptr<const PlaneRays> plane(const PlaneRings& rings, double null_time) const override {
    return std::make_unique<PlaneRays>(PlaneView{Schwarzschild{}, optics().at, optics().tetrad},
                                       null_time, rings);
  }
};

}  // namespace domefall
