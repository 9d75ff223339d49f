#include "pipeline/render/overlay/burn_in_text.h"

#include <fmt/format.h>

#include <cmath>

#include "pipeline/light/kerr_ergosphere.h"
#include "pipeline/light/kerr_lens.h"
#include "pipeline/render/rays/shift_range.h"
#include "pipeline/show/file/show_time.h"

namespace domefall {
namespace {

// Writes a number with about five digits, so that its length changes little from frame to frame.
std::string five_digits(double value) {
  const double size = std::abs(value);
  if (size != 0 && (size < 1e-3 || size >= 1e5)) return fmt::format("{:.3e}", value);
  return fmt::format("{:.{}f}", value, size < 10 ? 4 : size < 1000 ? 2 : 0);
}

std::string motion_text(const Show& show, const ObserverState& o) {
  std::string text;
  if (has_rest(o)) {
    // The celerity is gamma v, and v = gamma v/sqrt(1 + (gamma v)^2).
    const double celerity = static_celerity(o).length();
    text = fmt::format("v = {:.5f} c", speed_of(celerity));
  } else {
    text = fmt::format("gamma v = {} (free fall)", five_digits(o.celerity.length()));
  }
  // With g the observed over the emitted frequency, 1 + z is 1/g.
  if (const auto range = frequency_range(o, own_sky(o), !show.effects.lensing))
    text += fmt::format("\n1+z = {} to {}", five_digits(1 / range->largest),
                        five_digits(1 / range->least));
  return text;
}

std::string place_text(const ObserverState& o) {
  if (is_flat(o)) return "flat space";
  return fmt::format("region {}\nr = {} M{}", region_name(o.region, o.universe), five_digits(o.r),
                     is_in_ergosphere(o) ? "\nin the ergosphere" : "");
}

std::string clock_of(const ObserverState& o) {
  if (is_flat(o)) return fmt::format("tau = {} s", five_digits(o.proper_time));
  return fmt::format("tau = {} M\n{} s", five_digits(o.proper_time),
                     five_digits(o.proper_time * o.spacetime.seconds_per_m()));
}

}  // namespace

bool is_in_ergosphere(const ObserverState& observer) {
  const auto* hole = std::get_if<SpinningHole>(&observer.spacetime.kind());
  return hole && in_ergosphere(kerr_place(*hole, observer));
}

BurnInText burn_in_text(const Show& show, const FrameState& state) {
  const ObserverState& observer = dominant_view(state).observer;
  return {fmt::format("frame {}\n{}", state.frame, clock_text(state.show_time_s)),
          place_text(observer), clock_of(observer), motion_text(show, observer)};
}

}  // namespace domefall
