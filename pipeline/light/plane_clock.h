// A PlaneClock says when light set out from the matter of region I, in the hole's time t.
#pragma once

#include <optional>

#include "pipeline/base/simd/vector_math.h"
#include "pipeline/light/plane_images.h"
#include "pipeline/spacetime/schwarzschild.h"

namespace domefall {

class PlaneClock {
 public:
  // `null_time` is the observer's.
  PlaneClock(const PlaneView& view, double null_time) : outgoing_(is_outgoing(view.tetrad)) {
    if (const auto* hole = std::get_if<ChargedHole>(&view.space.kind())) charged_.emplace(*hole);
    const double tortoise = view.tortoise();
    // The t of a mirrored observer counts backwards.  With t -> -t, v = t + r* becomes 2 r* - v, and
    // u = t - r* becomes -2 r* - u.
    null_time_ = is_mirrored(view.tetrad) ? (outgoing_ ? -2 : 2) * tortoise - null_time : null_time;
    observer_v_ = outgoing_ ? null_time_ + 2 * tortoise : null_time_;
  }

  // Returns the time t at which light set out from r, whose null coordinate differs by `delay` from
  // the observer's (PlaneImages::Moment::time).
  double time_at(double r, double delay) const {
    const double there = tortoise(r);
    return null_time_ + delay + (outgoing_ ? there : -there);
  }
  // Returns that at which light would set out that falls from the observer's place.
  double observer_time() const { return observer_v_; }

  // Returns r*.  On the horizon, where it is infinite and no pattern shows, it is a finite number.
  double tortoise(double r) const {
    const auto log = [](double x) { return logarithm(x); };
    return charged_ ? charged_->at(r, log) : Schwarzschild::finite_tortoise(r, log);
  }

 private:
  bool outgoing_;
  double null_time_, observer_v_;
  std::optional<PixelTortoise> charged_;
};

}  // namespace domefall
