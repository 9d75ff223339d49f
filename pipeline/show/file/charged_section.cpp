// What depends on the charge of a hole.
#include <fmt/format.h>

#include <algorithm>

#include "pipeline/show/file/trajectory_section.h"

namespace domefall {

Range resting_radii(const Stage& stage) {
  if (!(stage.spacetime.horizon() > 0)) return kUnitsOfM.at_least(kNearest).at_most(kFarthest);
  return kUnitsOfM.above(stage.spacetime.horizon())
      .because("nothing rests at or inside the horizon")
      .at_most(kFarthest);
}

std::optional<double> read_resting_radius(const Section& s, const Stage& stage,
                                          std::string_view key, const Range& outside) {
  const double inner = stage.spacetime.inner_horizon();
  if (!(inner > kNearest)) return s.required(key, outside);
  const auto r = s.required(key, kUnitsOfM.at_least(kNearest).at_most(kFarthest));
  if (r && !(*r > stage.spacetime.horizon() || *r < inner))
    return s.find(key)->fail(fmt::format(
        "must exceed {} (units of M), or stay below {}, got {}: nothing rests at the horizons or "
        "between them",
        short_number(stage.spacetime.horizon()), short_number(inner), as_written(*s.find(key))));
  return r;
}

Range circling_radii(const Stage& stage) {
  const auto* hole = std::get_if<ChargedHole>(&stage.spacetime.kind());
  if (hole && hole->is_naked())
    return kUnitsOfM.above(hole->charge * hole->charge)
        .because("within r = q^2 the charge repels, and at it bodies rest")
        .at_most(kFarthest);
  return kUnitsOfM.above(stage.spacetime.light_circle())
      .because("at the light circle an orbit needs the speed of light, below it more")
      .at_most(kFarthest);
}

bool turns_within_shows(const Item& item, const TimedTrajectory& read) {
  const auto& [trajectory, timing, placement] = read;
  const double innermost = reach(trajectory).first;
  const auto turn = next_periastron(trajectory, timing.tau_begin);
  if (!(innermost < kNearest && turn && *turn <= timing.tau_end)) return true;
  item.fail(fmt::format("turns at r = {} M; shows go from {} to {} M", short_number(innermost),
                        short_number(kNearest), short_number(kFarthest)));
  return false;
}

}  // namespace domefall
