#include "pipeline/show/exposure_section.h"

#include "pipeline/show/channel_values.h"

namespace domefall {

Exposure read_exposure(const Section& show) {
  const Section s = subsection(show, "exposure", {"ev", "shutter_deg"});
  // A film camera's shutter of 360 degrees is open from one frame to the next.
  constexpr double kWholeTurn = 360;
  return {s.number("ev", kStops, 0),
          s.number("shutter_deg", kDegrees.within(0, kWholeTurn), 0) / kWholeTurn};
}

}  // namespace domefall
