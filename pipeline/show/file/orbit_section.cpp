#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "pipeline/show/file/orbit_families.h"
#include "pipeline/show/file/orbit_reading.h"
#include "pipeline/show/file/trajectory_section.h"
#include "trajectories/kruskal_crossing.h"

namespace domefall {
namespace {

constexpr double kFallEnd = 0.05;  // M; where falls end by default

// Returns where falls end by default: next to the singularity, or before the inner horizon.
std::optional<double> end_of_falls(const Stage& stage) {
  const auto* charged = std::get_if<ChargedHole>(&stage.spacetime.kind());
  if (!charged) return kFallEnd;
  if (charged->is_naked()) return std::nullopt;
  return std::max(kFallEnd, charged->inner_horizon() * 1.001);
}

// Returns the speed, against what rests at r, of free fall from rest far away, or NaN where that does
// not come.
double speed_of_fall(const Stage& stage, double r) {
  const auto* charged = std::get_if<ChargedHole>(&stage.spacetime.kind());
  return charged ? charged->free_fall_speed(r) : Schwarzschild::free_fall_speed(r);
}

template <class Orbit>
std::optional<TimedTrajectory> timed(const Section& s, const Stage& stage, const Orbit& orbit,
                                     const Defaults& start, const Placement& placement) {
  const auto timing = read_timing(s, stage, orbit, start);
  if (!timing) return std::nullopt;
  return TimedTrajectory{orbit, *timing, placement};
}

template <class Falls>
auto read_escape(const Section& s, const Item& by, const Falls& falls)
    -> std::optional<decltype(falls.parabola(0))> {
  if (const auto r = s.given("periastron"); r && &by == s.find("periastron"))
    return made(s, by, [&] { return falls.parabola(*r); });
  if (const auto momentum = s.given("angular_momentum"))
    return made(s, by, [&] { return falls.parabola_by_momentum(*momentum); });
  if (const auto excess = s.given("excess"))
    return made(s, by, [&] { return falls.parabola_by_excess(*excess); });
  return std::nullopt;
}

// Reads a hyperbolic orbit, which two quantities give.  An excess stands for the speed beside a
// periastron, and for the impact parameter beside a speed.
template <class Falls>
auto read_scattering(const Section& s, const Item& by, const Falls& falls)
    -> std::optional<decltype(falls.parabola(0))> {
  const Item* excess_item = s.find("excess");
  const auto excess = s.given("excess");
  const auto r = s.given("periastron");
  if (r && excess_item) {
    if (const Item* v = s.find("v_inf"))
      return v->fail("excludes excess, which says how far it lies above the slowest possible");
    if (!excess) return std::nullopt;
    return made(s, *excess_item, [&] { return falls.hyperbola_by_speed_excess(*r, *excess); });
  }
  const auto v = s.required("v_inf");
  if (!v) return std::nullopt;
  if (&by == excess_item) {
    if (!excess) return std::nullopt;
    return made(s, by, [&] { return falls.hyperbola_by_impact_excess(*v, *excess); });
  }
  if (r) return made(s, by, [&] { return falls.hyperbola(*v, *r); });
  if (const auto b = s.given("impact_parameter"))
    return made(s, by, [&] { return falls.hyperbola_by_impact(*v, *b); });
  return std::nullopt;
}

template <class Falls>
auto read_ellipse(const Section& s, const Falls& falls)
    -> std::optional<decltype(falls.parabola(0))> {
  if (s.find("periastron") || s.find("apoastron")) {
    const auto low = s.required("periastron");
    const auto high = s.required("apoastron");
    if (!low || !high) return std::nullopt;
    return made(s, *s.find("periastron"), [&] { return falls.ellipse(*low, *high); });
  }
  const auto e = s.required("eccentricity");
  if (const Item* excess = s.find("excess")) {
    const auto value = s.given("excess");
    if (!e || !value) return std::nullopt;
    return made(s, *excess, [&] { return falls.ellipse_by_excess(*e, *value); });
  }
  const auto p = s.required("semilatus_rectum");
  if (!e || !p) return std::nullopt;
  return made(s, *s.find("semilatus_rectum"), [&] { return falls.ellipse_by_shape(*p, *e); });
}

template <class Falls>
auto read_captured(const Section& s, const Falls& falls)
    -> std::optional<decltype(falls.parabola(0))> {
  const auto from_r = s.required("from_r");
  if (s.find("v_inf")) {
    if (const Item* momentum = s.find("angular_momentum"))
      return momentum->fail("goes with a fall from rest; with v_inf give impact_parameter");
    const auto v = s.given("v_inf");
    const auto b = s.required("impact_parameter");
    if (!from_r || !v || !b) return std::nullopt;
    return made(s, *s.find("impact_parameter"), [&] { return falls.fall_at(*v, *b, *from_r); });
  }
  const double momentum = s.number("angular_momentum");
  if (!from_r) return std::nullopt;
  const Item* blamed = s.find("angular_momentum") ? s.find("angular_momentum") : s.find("from_r");
  return made(s, *blamed, [&] { return falls.fall(momentum, *from_r); });
}

template <class Falls>
auto read_dropped(const Section& s, const Stage& stage, const Falls& falls)
    -> std::optional<decltype(falls.parabola(0))> {
  const auto rest_r = s.given("rest_r", resting_radii(stage));
  const double momentum = s.number("angular_momentum");
  if (!rest_r) return std::nullopt;
  const Item* blamed = s.find("angular_momentum") ? s.find("angular_momentum") : s.find("rest_r");
  return made(s, *blamed, [&] { return falls.drop(*rest_r, momentum); });
}

}  // namespace

// The plane turns by a right angle at most, since an orbit can run backward in it.
Placement placement_of(const V3d& celerity, bool mirrored) {
  Placement placement{mirrored};
  // The components of a celerity are those along R, Theta and Phi, and -Theta is north.
  const double north = -celerity.y, forward = celerity.z;
  if (!(std::hypot(north, forward) > 0)) return placement;
  placement.backward = forward < 0;
  placement.turn = placement.backward ? std::atan2(-north, -forward) : std::atan2(north, forward);
  return placement;
}

void fail_impossible(const Section& s, const Item& asked, const std::string& message) {
  const std::size_t space = message.find(' ');
  const std::string_view quantity = std::string_view(message).substr(0, space);
  // The factory of bound orbits calls the semilatus rectum p (bound_orbit.h).
  const Item* key = s.find(quantity == "p" ? "semilatus_rectum" : quantity);
  if (key)
    key->fail(message.substr(space + 1));
  else
    asked.fail("asks for what does not exist: " + message);
}

std::optional<TimedTrajectory> read_parabolic(const Item& item, const Stage& stage, Lookup&) {
  const Section s = orbit_section(item, "parabolic");
  const bool mirrored = is_in_region_three(s);
  const Item* by = s.one_of({"periastron", "angular_momentum", "excess"});
  if (!by)
    s.require("periastron", " (units of M); or give angular_momentum (units of M), or excess");
  if (!by) return std::nullopt;
  return with_falls(stage.spacetime, [&](const auto& falls) -> std::optional<TimedTrajectory> {
    const auto orbit = read_escape(s, *by, falls);
    return orbit ? timed(s, stage, *orbit, {}, {mirrored}) : std::nullopt;
  });
}

std::optional<TimedTrajectory> read_hyperbolic(const Item& item, const Stage& stage, Lookup&) {
  const Section s = orbit_section(item, "hyperbolic");
  const bool mirrored = is_in_region_three(s);
  const Item* by = s.one_of({"periastron", "impact_parameter"});
  if (!by) by = s.find("excess");
  if (!by) s.require("periastron", " (units of M); or give impact_parameter (units of M)");
  if (!by) return std::nullopt;
  return with_falls(stage.spacetime, [&](const auto& falls) -> std::optional<TimedTrajectory> {
    const auto orbit = read_scattering(s, *by, falls);
    return orbit ? timed(s, stage, *orbit, {}, {mirrored}) : std::nullopt;
  });
}

std::optional<TimedTrajectory> read_bound(const Item& item, const Stage& stage, Lookup&) {
  const Section s = orbit_section(item, "bound");
  // An orbit is given by its turning points or by its shape, and a key of one form excludes each of
  // the other.
  for (const std::string_view shape : {"semilatus_rectum", "eccentricity", "excess"})
    for (const std::string_view turn : {"periastron", "apoastron"}) s.one_of({turn, shape});
  s.one_of({"semilatus_rectum", "excess"});
  const bool mirrored = is_in_region_three(s);
  return with_falls(stage.spacetime, [&](const auto& falls) -> std::optional<TimedTrajectory> {
    const auto orbit = read_ellipse(s, falls);
    if (!orbit) return std::nullopt;
    // By default the orbit begins at the apoastron before the periastron of tau = 0.  Its proper
    // time is half a radial period before that, by the symmetry of the orbit.
    const double apoastron = -orbit->radial_period() / 2;
    return timed(s, stage, *orbit, {apoastron, Leg::kInward, apoastron, {}, {}}, {mirrored});
  });
}

std::optional<TimedTrajectory> read_curved_infall(const Item& item, const Stage& stage, Lookup&) {
  const Section s = orbit_section(item, "infall");
  s.one_of({"rest_r", "v_inf"});
  s.one_of({"rest_r", "impact_parameter"});
  const bool mirrored = is_in_region_three(s);
  const bool dropped = s.find("rest_r") != nullptr;
  Defaults start;
  // A fall from rest begins where it rests, at tau = 0, and from_r is sought from there on.
  if (dropped) start.tau = start.after = 0;
  start.to_r = end_of_falls(stage);
  return with_falls(stage.spacetime, [&](const auto& falls) -> std::optional<TimedTrajectory> {
    const auto orbit = dropped ? read_dropped(s, stage, falls) : read_captured(s, falls);
    return orbit ? timed(s, stage, *orbit, start, {mirrored}) : std::nullopt;
  });
}

std::optional<TimedTrajectory> read_thrown(const Item& item, const Stage& stage, Lookup& lookup) {
  const Section s(item, {"trajectory", "thrown", "speed", "against", "end", "rates", "pace"});
  const auto frame = read_frame(s, stage, "from_r");
  if (!frame) return std::nullopt;
  if (is_outgoing(frame->tetrad))
    return s.find("against")->fail(
        "of a throw must be static, free_fall or constant_t; what comes out of region IV is of "
        "type kruskal");
  const auto own = read_own_celerity(s, stage, *frame, lookup);
  if (!own) return std::nullopt;
  // A throw against the static observer is given as it is.  A throw against another one, whose
  // celerity against the rain is known, is brought to the rain.
  const bool against_static =
      frame->region != Region::kII &&
      frame->celerity == resting_celerity(stage.spacetime, frame->r, frame->tetrad);
  const V3d celerity = against_static ? V3d(*own) : V3d(celerity_against(frame->celerity, *own));
  // The plane of the orbit is that of R and the celerity, so only the length of the part across R
  // shapes the orbit.  Its direction turns the plane (placement_of).
  const double across = std::hypot(celerity.y, celerity.z);
  return with_falls(stage.spacetime, [&](const auto& falls) -> std::optional<TimedTrajectory> {
    const auto orbit = made(s, *s.find("from_r"), [&] {
      return against_static ? falls.throw_from_rest(frame->r, celerity.x, across)
                            : falls.throw_from_tetrad(frame->r, celerity.x, across);
    });
    if (!orbit) return std::nullopt;
    const auto timing = read_end(s, stage, *orbit, 0);
    if (!timing) return std::nullopt;
    const bool turned = !against_static && falls.is_mirrored_throw(frame->r, celerity.x, across);
    return TimedTrajectory{*orbit, *timing,
                           placement_of(celerity, turned != is_mirrored(frame->tetrad))};
  });
}

// An energy that is left out is 1, with which it comes to rest at infinity.
std::optional<TimedTrajectory> read_kruskal(const Item& item, const Stage& stage, Lookup&) {
  const Section s = orbit_section(item, "kruskal");
  // By t -> -t what comes out into region I comes out into III.
  const bool mirrored = is_in_region_three(s);
  const auto energy = s.given("energy");
  const double momentum = s.number("angular_momentum");
  if (s.find("energy") && !energy) return std::nullopt;
  // The factory refuses energies between 0 and 1e-6 (kruskal_crossing.h).
  const Item* blamed = s.find("energy") ? s.find("energy") : &item;
  const auto orbit =
      made(s, *blamed, [&] { return kruskal_crossing(energy.value_or(1), momentum); });
  if (!orbit) return std::nullopt;
  // By default the crossing begins just outside the past singularity.  It ends as near to the
  // future one, if it falls into that.
  Defaults start;
  start.leg = Leg::kOutward;
  start.tau = orbit->time_at(kFallEnd, Leg::kOutward);
  if (std::isfinite(orbit->death())) start.to_r = kFallEnd;
  return timed(s, stage, *orbit, start, {mirrored});
}

// The keys of a spiral say all of it, so that a segment begins where it does.
std::optional<TimedTrajectory> read_spiral(const Item& item, const Stage& stage, Lookup&) {
  const Section s(item, {"trajectory", "region", "spiral", "end", "rates", "pace"});
  const bool mirrored = is_in_region_three(s);
  const auto from_r = s.required("from_r", circling_radii(stage));
  const double turns = s.number("turns");
  if (!from_r) return std::nullopt;
  const auto spiral = made(s, item, [&] { return Spiral(*from_r, turns, stage.spacetime); });
  if (!spiral) return std::nullopt;
  Defaults end;
  end.to_r = end_of_falls(stage);
  const auto timing = read_end(s, stage, *spiral, 0, end);
  if (!timing) return std::nullopt;
  return TimedTrajectory{*spiral, *timing, {mirrored}};
}

std::optional<TimedTrajectory> read_braked(const Item& item, const Stage& stage, Lookup&) {
  const Section s(item, {"trajectory", "region", "braked", "end", "rates", "pace"});
  const bool mirrored = is_in_region_three(s);
  const auto from_r = s.required("from_r", resting_radii(stage)),
             stop_r = s.required("stop_r", resting_radii(stage));
  const auto given = s.given("speed");
  if (!from_r || !stop_r || (s.find("speed") && !given)) return std::nullopt;
  if (*stop_r >= *from_r) {
    const Item& item_of_stop = *s.find("stop_r");
    return item_of_stop.fail(fmt::format("must stay below from_r = {} (units of M), got {}",
                                         short_number(*from_r), as_written(item_of_stop)));
  }
  // Without a speed it goes on where what falls from rest far away passes from_r.
  const double speed = given.value_or(speed_of_fall(stage, *from_r));
  if (std::isnan(speed)) {
    s.require("speed", ", since no free fall from rest far away comes to from_r");
    return std::nullopt;
  }
  const auto flight =
      made(s, item, [&] { return BrakedFlight(*from_r, *stop_r, speed, stage.spacetime); });
  if (!flight) return std::nullopt;
  Defaults end;
  end.to_tau = flight->duration();
  const auto timing = read_end(s, stage, *flight, 0, end);
  if (!timing) return std::nullopt;
  return TimedTrajectory{*flight, *timing, {mirrored}};
}

}  // namespace domefall
