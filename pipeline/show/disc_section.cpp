#include "pipeline/show/disc_section.h"

#include <fmt/format.h>

#include <cmath>

#include "pipeline/show/lookup.h"
#include "pipeline/show/placement.h"

namespace domefall {
namespace {

// The observer's first place lies 10 degrees above the plane, as in Luminet's picture of 1979.
constexpr double kInclinationDeg = 10, kNodeDeg = 90;
constexpr double kWidestDisc = 1e6;
constexpr double kCoolestDiscK = 1000, kHottestDiscK = 1e9, kBrightestDisc = 1e12;

void read_radii(const Section& s, Disc& disc) {
  const Range radius = kUnitsOfM.at_most(kWidestDisc);
  Range stable = radius.at_least(kLastStableOrbit);
  stable.low_reason = "gas inside the last stable orbit falls in, with plunging: true";
  disc.inner = s.number("inner_r", disc.plunging ? radius.at_least(kHorizonRadius) : stable,
                        disc.plunging ? kHorizonRadius : kLastStableOrbit);
  disc.outer = s.number("outer_r", radius.above(kHorizonRadius), disc.outer);
  if (disc.outer > disc.inner) return;
  if (const Item* outer = s.find("outer_r"))
    outer->fail(fmt::format("must exceed inner_r = {} (units of M), got {}",
                            short_number(disc.inner), as_written(*outer)));
  else if (const Item* inner = s.find("inner_r"))
    inner->fail(fmt::format("must be below outer_r = {} (units of M), got {}",
                            short_number(disc.outer), as_written(*inner)));
}

// The elements of celestial mechanics: the angle between the two planes, and the place where matter
// rises to the north of the orbit's.
SkyDirection axis_of(const Show& to, double inclination, double node) {
  const M33d at_node = place_tetrad(to.hole_at, to.heading, node);
  const V3d north = -column(at_node, 1), onward = column(at_node, 2);
  return {(north * std::cos(inclination) - onward * std::sin(inclination)).normalized()};
}

}  // namespace

std::optional<Disc> read_disc(const Section& show, const Show& to) {
  const Item* item = show.find("disc");
  if (item == nullptr) return std::nullopt;
  const Section s(*item, {"inner_r", "outer_r", "inclination_deg", "node_deg", "t_max_k",
                          "luminance_cd_m2", "opacity", "plunging"});
  if (!to.mass_solar) item->fail("needs a black hole: give the show black_hole.mass_solar");
  Disc disc;
  disc.plunging =
      s.word<bool>("plunging", {{"true", true}, {"false", false}}).value_or(disc.plunging);
  read_radii(s, disc);
  disc.normal =
      axis_of(to, radians(s.number("inclination_deg", kDegrees.within(0, 180), kInclinationDeg)),
              radians(s.number("node_deg", kDegrees.within(-360, 360), kNodeDeg)));
  disc.t_max_k =
      s.number("t_max_k", Range{"kelvin"}.within(kCoolestDiscK, kHottestDiscK), disc.t_max_k);
  disc.luminance =
      s.number("luminance_cd_m2", Range{"cd/m^2"}.above(0).at_most(kBrightestDisc), disc.luminance);
  disc.opacity = s.number("opacity", kPureNumber.within(0, 1), disc.opacity);
  return disc;
}

}  // namespace domefall
