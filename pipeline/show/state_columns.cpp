#include "pipeline/show/state_columns.h"

#include <numbers>

#include "trajectories/equatorial.h"

namespace domefall {

std::array<StateCell, kStateColumns.size()> state_cells(const FrameState& state) {
  // Seventeen digits give back every double exactly.
  constexpr int kTime = 9, kAngle = 15, kAll = 17;
  const ObserverState& o = state.observer;
  const Equatorial place = equatorial({column(o.sky_from_tetrad, 0)});
  const V3d x = column(o.tetrad_from_camera, 0), y = column(o.tetrad_from_camera, 1),
            z = column(o.tetrad_from_camera, 2);
  const auto* hole = std::get_if<SpinningHole>(&o.spacetime.kind());
  const auto all = [](double value) { return StateNumber{value, kAll}; };
  return {state.frame,
          StateNumber{state.show_time_s, kTime},
          state.segment + 1,
          region_name(o.region),
          tetrad_name(o.tetrad),
          all(o.r),
          all(o.proper_time),
          all(o.celerity.x),
          all(o.celerity.y),
          all(o.celerity.z),
          StateNumber{place.ra_deg, kAngle},
          StateNumber{place.dec_deg, kAngle},
          StateNumber{o.azimuth * 180 / std::numbers::pi, kAngle},
          all(x.x),
          all(x.y),
          all(x.z),
          all(y.x),
          all(y.y),
          all(y.z),
          all(z.x),
          all(z.y),
          all(z.z),
          all(o.null_time),
          o.universe,
          all(o.l),
          StateNumber{hole ? 90 - polar_angle(o, *hole) * 180 / std::numbers::pi : 0, kAngle}};
}

}  // namespace domefall
