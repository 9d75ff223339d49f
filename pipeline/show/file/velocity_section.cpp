#include <algorithm>
#include <array>
#include <cmath>

#include "pipeline/light/aberration.h"
#include "pipeline/light/lens_store.h"
#include "pipeline/show/file/trajectory_section.h"

namespace domefall {
namespace {

// Velocities are held as gamma v, since a speed in double precision has no Lorentz factor of 1e9.
// gamma^2 - 1 = (gamma v)^2 and 1 - v^2 = 1/gamma^2 are taken as products, which do not cancel.
double gamma_v_of_factor(double factor) { return std::sqrt((factor - 1) * (factor + 1)); }
double gamma_v_of_speed(double v) { return v / std::sqrt((1 - v) * (1 + v)); }

// Reads gamma v from either `speed` or `lorentz_factor`.  With lorentz_factor the speed is not
// read, and if both are given that is reported.
std::optional<double> read_gamma_v(const Section& s) {
  s.one_of({"speed", "lorentz_factor"});
  if (s.find("lorentz_factor")) {
    const auto factor = s.given("lorentz_factor");
    return factor ? std::optional(gamma_v_of_factor(*factor)) : std::nullopt;
  }
  const auto v = s.required("speed");
  return v ? std::optional(gamma_v_of_speed(*v)) : std::nullopt;
}

const Item* two_speeds(const Section& s) {
  for (const char* key : {"speed", "lorentz_factor"})
    if (const Item* item = s.find(key); item && item->node.IsSequence()) return item;
  return nullptr;
}

// What starts from rest has this rapidity, which is not 0, so that there is a direction.
constexpr double kLeastRapidity = 1e-8;

// Returns the rapidities asinh(gamma v) at both ends.  Rapidities add up along a line, so that an
// even change of one is constant acceleration.
std::optional<std::array<double, 2>> read_rapidities(const Section& s, const Item& item) {
  const bool by_factor = &item == s.find("lorentz_factor");
  const auto ends = read_numbers(item, 2, s.range(by_factor ? "lorentz_factor" : "speed"));
  if (!ends) return std::nullopt;
  std::array<double, 2> rapidities{};
  for (std::size_t k = 0; k < 2; ++k) {
    const double gamma_v = by_factor ? gamma_v_of_factor((*ends)[k]) : gamma_v_of_speed((*ends)[k]);
    rapidities[k] = std::max(kLeastRapidity, std::asinh(gamma_v));
  }
  return rapidities;
}

std::optional<V3d> read_components(const Item& item) {
  const Section s(item, {"direction"});
  const V3d v(s.number("radial"), s.number("theta"), s.number("phi"));
  // The largest component is taken out first, so that the squares of small ones do not vanish.
  const double size = std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)});
  if (size > 0) return (v / size).normalized();
  return item.fail("must not be the zero vector; give radial, theta or phi");
}

bool names_sky_place(const Item& item) {
  return peek(item, "ra_deg") || peek(item, "dec_deg") || peek(item, "star");
}

// Returns the direction in which an observer sees a place on the own sky of its tetrad.  The
// stage's axes bring the place into the tetrad, the lens gives its primary image there, and
// aberration turns that into the direction for the observer.
V3d seen_towards(const SkyDirection& place, const Stage& stage, const GivenVelocity& frame) {
  ObserverState observer;
  observer.spacetime = stage.spacetime;
  observer.region = frame.region, observer.tetrad = frame.tetrad, observer.r = frame.r;
  observer.l = frame.l;
  const auto* hole = std::get_if<SpinningHole>(&stage.spacetime.kind());
  const M33d axes = hole ? moved_about(axis_of(*hole), stage.axes, frame.theta, 0) : stage.axes;
  if (hole) observer.sky_from_tetrad = axes;
  const auto lens = LensStore().lens(observer, {{false, false, false}});
  const V3d source = apply_transposed(axes, place.v);
  return to_observer(frame.celerity, lens->primary_image(source)).direction;
}

std::optional<V3d> read_direction(const Item& item, const Stage& stage, const GivenVelocity& frame,
                                  Lookup& lookup) {
  static const Words<V3d, 6> kWords{{{"inward", V3d(-1, 0, 0)},
                                     {"outward", V3d(1, 0, 0)},
                                     {"forward", V3d(0, 0, 1)},
                                     {"backward", V3d(0, 0, -1)},
                                     {"north", V3d(0, -1, 0)},
                                     {"south", V3d(0, 1, 0)}}};
  // Outward leads away from the hole, or from the throat of a wormhole on either side.
  const auto outward = [&frame](V3d v) {
    if (frame.l < 0) v.x = -v.x;
    return v;
  };
  if (const auto direction = meaning(item, kWords)) return outward(*direction);
  if (item.node.IsMap() && !names_sky_place(item)) {
    const auto components = read_components(item);
    return components ? std::optional(outward(*components)) : std::nullopt;
  }
  const auto place = read_sky_place(item, lookup, names_of(kWords));
  if (!place) return std::nullopt;
  if (frame.region == Region::kIV)
    return item.fail("names a place on the sky, but from region IV no sky is seen");
  return seen_towards(*place, stage, frame);
}

const Item* require_direction(const Section& s) {
  return s.require(
      "direction",
      ": a word such as inward or forward, {radial, theta, phi} or a place on the sky");
}

enum class Against { kStatic, kFreeFall, kOutgoing, kConstantT };

bool is_found_in(Against against, Region region) {
  // What is static is outside a horizon, and what rests in t is inside one.  A free fall has come
  // in through the future horizon and so is never in region IV.  What flies outwards has come
  // through the past one and is never in II.
  switch (against) {
    case Against::kStatic:
      return region == Region::kI || region == Region::kIII;
    case Against::kFreeFall:
      return region != Region::kIV;
    case Against::kOutgoing:
      return region != Region::kII;
    case Against::kConstantT:
      break;
  }
  return region == Region::kII || region == Region::kIV;
}

// Returns the radii at which an observer of that kind can be, in that region if one is named.  A
// lower bound that surprises has its reason in the message.
Range radii(Against against, std::optional<Region> region, double horizon, double nearest) {
  if (against == Against::kConstantT) return kUnitsOfM.at_least(nearest).below(horizon);
  if (against == Against::kStatic && !region)
    return kUnitsOfM.above(horizon)
        .because(
            "inside the horizon nothing is static; a velocity there needs 'against: free_fall'")
        .at_most(kFarthest);
  if (!region) return kUnitsOfM.at_least(nearest).at_most(kFarthest);
  if (*region == Region::kI || *region == Region::kIII)
    return kUnitsOfM.above(horizon).because("that is where the region ends").at_most(kFarthest);
  // The horizon belongs to II and IV here, since their tetrads are regular on the one that they
  // cross.
  return kUnitsOfM.at_least(nearest).at_most(horizon);
}

// Returns the region that the show names, or else that of a free fall from region I or of a rise to
// it.
Region region_of(const std::optional<Region>& named, Against against, bool outside) {
  if (named) return *named;
  if (outside) return Region::kI;
  return against == Against::kOutgoing ? Region::kIV : Region::kII;
}

// Returns the tetrad for a region and a kind of observer.  Inside the hole only the region matters.
Tetrad tetrad_of(Region region, Against against) {
  if (region == Region::kIV) return Tetrad::kOutgoing;
  if (region == Region::kII) return Tetrad::kRain;
  const bool out = against == Against::kOutgoing;
  if (region == Region::kI || region == Region::kV) return out ? Tetrad::kOutgoing : Tetrad::kRain;
  return out ? Tetrad::kOutgoingToThree : Tetrad::kRainOfThree;
}

}  // namespace

std::optional<GivenVelocity> read_frame(const Section& s, const Stage& stage,
                                        std::string_view radius_key) {
  const auto against = s.word(
      "against", {Against::kStatic, Against::kFreeFall, Against::kOutgoing, Against::kConstantT});
  const auto region = s.given_word("region", {Region::kI, Region::kII, Region::kIII, Region::kIV});
  if (region && !is_found_in(against, *region))
    return s.find("region")->fail(
        std::string("of ") + region_name(*region) +
        " has no observer of the kind that 'against' names: static is found in I and III, "
        "free_fall in I, II and III, outgoing in I, III and IV, constant_t in II and IV");
  const auto* charged = std::get_if<ChargedHole>(&stage.spacetime.kind());
  if (against == Against::kConstantT && charged && charged->below_extremal <= 0)
    return s.find("against")->fail(
        "of constant_t is what rests in t between two horizons, which a charge of 1 or more leaves "
        "no room for");
  const double horizon = stage.spacetime.horizon();
  const double inner = stage.spacetime.inner_horizon();
  // The regions that a show can name, and what rests in t, lie outside of an inner horizon.
  const bool outside = against == Against::kConstantT || region;
  const double nearest = outside ? std::max(kNearest, inner * (1 + 1e-6)) : kNearest;
  const Range range = radii(against, region, horizon, nearest);
  const auto r = against == Against::kStatic && !region
                     ? read_resting_radius(s, stage, radius_key, range)
                     : s.required(radius_key, range);
  if (!r) return std::nullopt;
  if (against != Against::kStatic && std::isnan(stage.spacetime.fall_celerity(*r)))
    return s.find(radius_key)
        ->fail("is where no free fall from rest far away comes, since the charge turns it above");
  GivenVelocity frame;
  frame.r = *r;
  frame.region = *r < inner ? Region::kV : region_of(region, against, *r > horizon);
  frame.tetrad = tetrad_of(frame.region, against);
  // Observers at rest in r or in t move against the tetrad, and so may what falls or is thrown out.
  if (against == Against::kStatic || against == Against::kConstantT)
    frame.celerity = resting_celerity(stage.spacetime, *r, frame.tetrad);
  else
    frame.celerity.x = stage.spacetime.fall_celerity(*r) * (is_outgoing(frame.tetrad) ? -1 : 1);
  return frame;
}

std::optional<Celerity<GivenFrame>> read_own_celerity(const Section& s, const Stage& stage,
                                                      const GivenVelocity& frame, Lookup& lookup) {
  const auto gamma_v = read_gamma_v(s);
  if (gamma_v && *gamma_v == 0 && !s.find("direction")) return Celerity<GivenFrame>();
  const Item* item = require_direction(s);
  const auto direction = item ? read_direction(*item, stage, frame, lookup) : std::nullopt;
  if (!gamma_v || !direction) return std::nullopt;
  return Celerity<GivenFrame>(*direction * *gamma_v);
}

std::optional<Trajectory> read_velocity_trajectory(const Section& s, const Stage& stage,
                                                   const GivenVelocity& frame, Lookup& lookup) {
  if (const Item* speeds = two_speeds(s)) {
    s.one_of({"speed", "lorentz_factor"});
    const auto rapidities = read_rapidities(s, *speeds);
    const Item* item = require_direction(s);
    const auto direction = item ? read_direction(*item, stage, frame, lookup) : std::nullopt;
    if (!rapidities || !direction) return std::nullopt;
    return SpeedRamp{frame, *direction, (*rapidities)[0], (*rapidities)[1],
                     proper_time_in(stage, stage.duration_s)};
  }
  const auto own = read_own_celerity(s, stage, frame, lookup);
  if (!own) return std::nullopt;
  GivenVelocity held = frame;
  held.celerity = celerity_against(frame.celerity, *own);
  return held;
}

}  // namespace domefall
