#include "pipeline/show/file/trajectory_section.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <numbers>

namespace domefall {
namespace {

std::optional<TimedTrajectory> paced(const Section& s, const Trajectory& trajectory, Timing timing,
                                     bool mirrored) {
  if (!read_pace(s, trajectory, timing)) return std::nullopt;
  return TimedTrajectory{trajectory, timing, {mirrored}};
}

Timing timing_of(const Rate& rate) { return {0, rate.span, Pace::kSteady, rate.begin, rate.end}; }

std::optional<TimedTrajectory> read_static(const Item& item, const Stage& stage, Lookup&) {
  const Section s(item, {"trajectory", "region", "static", "rates"});
  Timing timing{0, proper_time_in(stage, stage.duration_s)};
  if (stage.spacetime.is_flat()) {
    for (const char* key : {"r", "rate_m_per_s", "time_lapse"})
      if (const Item* given = s.find(key))
        given->fail("needs a black hole; in flat space leave it out");
    return TimedTrajectory{StaticObserver{}, timing, {}};
  }
  const auto r = read_resting_radius(s, stage, "r",
                                     kUnitsOfM.above(stage.spacetime.horizon())
                                         .because("nothing holds still at or inside the horizon")
                                         .at_most(kFarthest));
  const bool mirrored = is_in_region_three(s);
  // The observer's clock runs in real time, unless a show in which other things move wants another
  // rate.
  if (find_end(s, {})) {
    const auto rate = read_rate(s, stage);
    if (!rate) return std::nullopt;
    timing = timing_of(*rate);
  }
  if (!r) return std::nullopt;
  return TimedTrajectory{StaticObserver{*r, stage.spacetime}, timing, {mirrored}};
}

std::optional<TimedTrajectory> read_circular(const Item& item, const Stage& stage, Lookup&) {
  const Section s(item, {"trajectory", "region", "circular", "rates", "pace"});
  find_end(s, {"orbits"});
  const auto r = s.required("r", circling_radii(stage));
  const bool mirrored = is_in_region_three(s);
  const double turn =
      2 * std::numbers::pi * r.value_or(1) * stage.spacetime.circling_time(r.value_or(1));
  const auto rate = read_rate(s, stage, r ? std::optional(turn) : std::nullopt);
  if (!r || !rate) return std::nullopt;
  // Between the two circles of light of a naked singularity.
  if (!(turn > 0)) {
    const double q = std::get<ChargedHole>(stage.spacetime.kind()).charge;
    const double apart = std::sqrt(9 - 8 * q * q);
    return s.find("r")->fail(fmt::format(
        "must not be from {} to {} (units of M), got {}: between the two circles of "
        "light an orbit needs more than the speed of light",
        short_number((3 - apart) / 2), short_number((3 + apart) / 2), as_written(*s.find("r"))));
  }
  Trajectory circle = CircularOrbit{*r};
  if (const auto* hole = std::get_if<ChargedHole>(&stage.spacetime.kind()))
    circle = ChargedCircle{*hole, *r};
  return paced_circle(item, s, stage, circle, turn, *rate, mirrored);
}

std::optional<Rate> read_fall_time(const Section& s, const Stage& stage, const RadialInfall& fall) {
  const auto rate = read_rate(s, stage);
  if (!rate || rate->span <= proper_time_to(fall, kNearest)) return rate;
  s.one_of({"rate_m_per_s", "time_lapse"})
      ->fail(fmt::format("lets {} M of proper time pass in the segment, but from r = {} the "
                         "singularity is {} M away; slow it down, shorten duration_s or give to_r",
                         short_number(rate->span), short_number(fall.from_r),
                         short_number(lifetime(fall))));
  return std::nullopt;
}

// Reads a radial fall from rest at infinity.  The keys of other falls, which read_infall() sends
// elsewhere, are known here so that a misspelling of one gets the right hint.
std::optional<TimedTrajectory> read_radial_infall(const Item& item, const Stage& stage, Lookup&) {
  const Section s(item, {"trajectory", "region", "infall", "begin", "end", "rates", "pace"});
  const Item* given = find_end(s, {"to_r"});
  const Item* to = s.find("to_r");
  const auto to_r = s.given("to_r");
  const auto from_r = s.required("from_r");
  if (!from_r || (to && !to_r)) return std::nullopt;
  // A radial fall from rest at infinity has r^(3/2) linear in tau, so that both ends are found in
  // closed form.
  const RadialInfall fall{*from_r};
  const bool mirrored = is_in_region_three(s);
  if (given && !to) {
    const Item* pace = s.find("pace");
    if (pace && is_word(*pace, "slowing")) return pace->fail("of 'slowing' needs to_r, not a rate");
    if (!in_range(*s.find("from_r"), *from_r, kUnitsOfM.at_least(kNearest))) return std::nullopt;
    const auto rate = read_fall_time(s, stage, fall);
    return rate ? paced(s, fall, timing_of(*rate), mirrored) : std::nullopt;
  }
  // The end that does not lie below the beginning may be the default, and then from_r is blamed.
  const double end = s.number("to_r");
  if (end >= *from_r)
    return (to ? to : s.find("from_r"))
        ->fail(to ? fmt::format("must stay below from_r = {} (units of M), got {}: a free fall "
                                "only goes inward",
                                short_number(*from_r), as_written(*to))
                  : fmt::format("must exceed {} (units of M), the default of to_r, got {}: a free "
                                "fall only goes inward",
                                short_number(end), as_written(*s.find("from_r"))));
  Timing timing{0, proper_time_to(fall, end)};
  if (!read_end_rates(s, stage, timing)) return std::nullopt;
  return paced(s, fall, timing, mirrored);
}

std::optional<TimedTrajectory> read_velocity(const Item& item, const Stage& stage, Lookup& lookup) {
  const Section s(item, {"trajectory", "velocity", "against", "speed", "pace"});
  GivenVelocity observer;
  if (!stage.spacetime.is_flat()) {
    const auto frame = read_frame(s, stage);
    if (!frame) return std::nullopt;
    observer = *frame;
  } else {
    for (const char* key : {"r", "region"})
      if (const Item* given = s.find(key))
        given->fail("needs a black hole; in flat space leave it out");
  }
  const auto trajectory = read_velocity_trajectory(s, stage, observer, lookup);
  if (!trajectory) return std::nullopt;
  return paced(s, *trajectory, {0, proper_time_in(stage, stage.duration_s)}, false);
}

std::optional<TimedTrajectory> read_continue(const Item& item, const Stage& stage, Lookup&) {
  const bool wormhole = stage.spacetime.is<Wormhole>();
  const Section s(item, {"trajectory", wormhole ? "end in a wormhole" : "end", "rates", "pace"});
  if (!stage.before)
    return item.fail(
        "goes on with the trajectory of the segment before, but this is the first segment");
  const auto timing = read_end(s, stage, stage.before->trajectory, stage.before->timing.tau_end);
  if (!timing) return std::nullopt;
  Placement placement = stage.before->placement;
  placement.turn = 0;
  placement.beginning.reset();
  return TimedTrajectory{stage.before->trajectory, *timing, placement};
}

// Reads an observer who moves as a body of the show does.
std::optional<TimedTrajectory> read_with_body(const Item& item, const Stage& stage, Lookup&) {
  const Section s(item, {"trajectory", "body", "begin", "end", "rates", "pace"});
  const Item* name = s.require("body", ": the name of the body with which the observer moves");
  std::map<std::string, const Body*, std::less<>> bodies;
  for (const Body& body : *stage.bodies) bodies.emplace(body.name, &body);
  const auto* found = name ? find_named(*name, bodies, "names no body of the show") : nullptr;
  const Body* body = found ? *found : nullptr;
  const double behind = s.number("behind_m");
  if (!body) return std::nullopt;
  Defaults defaults;
  // Light that falls straight in keeps its v, and in that light the observer goes on where the
  // segment before ended.  Whoever follows `behind` later is at each v where the body was at v -
  // behind.
  if (const auto tau = time_of_null(stage.spacetime, *body, stage.null_time - behind)) {
    // time_of_null() counts from Body::start, and the timing from the trajectory's own zero.
    defaults.tau = body->start + *tau;
  } else if (!s.find("from_r") && !s.find("from_tau_m")) {
    return s.find("body")->fail(
        fmt::format("is not there at v = {} M, when the segment begins; give from_tau_m",
                    short_number(stage.null_time - behind)));
  }
  const auto timing = read_timing(s, stage, body->trajectory, defaults);
  if (!timing) return std::nullopt;
  // `beginning` gives the plane, which is the body's own, so that nothing is mirrored or turned.
  Placement placement{false, body->backward, 0, {}};
  placement.beginning =
      beginning_beside(stage.spacetime, *body, double(timing->tau_begin - body->start), behind);
  return TimedTrajectory{body->trajectory, *timing, placement};
}

bool is_curved(const Item& item) {
  static constexpr std::array<std::string_view, 8> kKeys{
      "rest_r",   "angular_momentum", "v_inf",  "impact_parameter",
      "from_leg", "from_tau_m",       "to_leg", "to_tau_m"};
  return std::any_of(kKeys.begin(), kKeys.end(),
                     [&item](std::string_view key) { return peek(item, key).has_value(); });
}

// Reads a fall, by the closed form of RadialInfall where its keys allow that.
std::optional<TimedTrajectory> read_infall(const Item& item, const Stage& stage, Lookup& lookup) {
  return is_curved(item) || !stage.spacetime.is<Schwarzschild>()
             ? read_curved_infall(item, stage, lookup)
             : read_radial_infall(item, stage, lookup);
}

using Reader = std::optional<TimedTrajectory> (*)(const Item& item, const Stage& stage,
                                                  Lookup& lookup);

// A Type holds the word for a kind of trajectory, its readers near a hole, in a wormhole and about a
// hole that spins, and whether flat space has that kind.  A null reader goes with the reason why there
// is no such motion, as does a charge that has none.
struct Type {
  std::string_view name;
  Reader near_hole, in_wormhole = nullptr, about_spin = nullptr;
  bool in_flat_space = false;
  std::string_view not_in_wormhole{}, not_near_charge{}, not_when_naked{}, not_about_spin{};
};

constexpr std::string_view kNothingPulls =
    "nothing pulls in a wormhole: what moves freely there is of type infall or thrown";
constexpr std::string_view kNoEscape =
    "about a hole that spins what comes from far away and leaves again is of type thrown";
constexpr std::string_view kNoBodies = "bodies move near holes without charge only";

// These are the types of trajectory that a show can name.  Those that a body can follow come first.
constexpr std::array kTypes{
    Type{"static", read_static, read_wormhole_rest, read_spin_rest, true},
    Type{"circular", read_circular, read_wormhole_circle, read_spin_circle},
    Type{.name = "parabolic",
         .near_hole = read_parabolic,
         .not_in_wormhole = kNothingPulls,
         .not_about_spin = kNoEscape},
    Type{.name = "hyperbolic",
         .near_hole = read_hyperbolic,
         .not_in_wormhole = kNothingPulls,
         .not_about_spin = kNoEscape},
    Type{.name = "bound",
         .near_hole = read_bound,
         .about_spin = read_spin_bound,
         .not_in_wormhole = kNothingPulls},
    Type{"infall", read_infall, read_wormhole_fall, read_spin_fall},
    Type{"thrown", read_thrown, read_wormhole_throw, read_spin_throw},
    Type{.name = "kruskal",
         .near_hole = read_kruskal,
         .not_in_wormhole = "a wormhole has no horizon, and no singularity to come from",
         .not_near_charge = "the singularity of a charge repels, and nothing comes out of it",
         .not_about_spin = "what comes out of a hole that spins is not computed"},
    Type{.name = "spiral",
         .near_hole = read_spiral,
         .not_in_wormhole =
             "nothing pulls in a wormhole: give a path, whose keyframes may go around and in",
         .not_when_naked = "nothing falls into a naked singularity; give a path",
         .not_about_spin =
             "about a hole that spins give a path, whose keyframes may go around and in"},
    Type{.name = "braked",
         .near_hole = read_braked,
         .not_in_wormhole = "a path whose last keyframe has speed: 0 comes to a stop in a wormhole",
         .not_about_spin =
             "a path whose last keyframe has speed: 0 comes to a stop about a hole that spins"},
    Type{"path", read_path, read_wormhole_path, read_spin_path},
    Type{"velocity", read_velocity, read_wormhole_velocity, read_spin_velocity, true},
    Type{.name = "body",
         .near_hole = read_with_body,
         .about_spin = read_with_body,
         .not_in_wormhole = kNoBodies,
         .not_near_charge = kNoBodies},
    Type{"continue", read_continue, read_continue, read_continue, true}};

// Says why a type of motion does not exist there.  Nothing is said of one that does.
std::string_view why_not(const Type& type, const Spacetime& spacetime) {
  if (spacetime.is<Wormhole>()) return type.not_in_wormhole;
  if (spacetime.is<SpinningHole>()) return type.not_about_spin;
  const auto* charged = std::get_if<ChargedHole>(&spacetime.kind());
  if (charged && charged->is_naked() && !type.not_when_naked.empty()) return type.not_when_naked;
  return charged ? type.not_near_charge : std::string_view();
}

// Reports keys that only a hole that spins gives a meaning, or only one that does not.  Returns true if
// there are none.
bool fits_spin(const Item& item, const Stage& stage) {
  bool fits = true;
  if (const auto region = peek(item, "region"); region && stage.spacetime.is<SpinningHole>()) {
    region->fail(
        "is of holes without spin; about one that spins shows are in this universe, I and II");
    fits = false;
  }
  for (const char* key : {"latitude_deg", "inclination_deg", "retrograde", "dragged"})
    if (const auto given = peek(item, key); given && !stage.spacetime.is<SpinningHole>()) {
      given->fail("is of motion about a hole that spins; give black_hole.spin");
      fits = false;
    }
  return fits;
}

// Where the horizons are one, or none, light and travellers from the other exterior come nowhere.
bool has_region_one_alone(const Spacetime& spacetime) {
  const auto* charged = std::get_if<ChargedHole>(&spacetime.kind());
  return charged && charged->below_extremal <= 0;
}

constexpr std::array<std::string_view, kTypes.size()> kTypeNames = [] {
  std::array<std::string_view, kTypes.size()> names;
  for (std::size_t k = 0; k < names.size(); ++k) names[k] = kTypes[k].name;
  return names;
}();
constexpr std::size_t kTypesOfBodies = 7;
static_assert(kTypeNames[kTypesOfBodies - 1] == "thrown" &&
              kTypeNames[kTypesOfBodies] == "kruskal");

}  // namespace

std::vector<std::string_view> trajectories_of_bodies(const Spacetime& spacetime) {
  std::vector<std::string_view> names;
  for (const Type& type : std::span(kTypes).first(kTypesOfBodies))
    if (why_not(type, spacetime).empty()) names.push_back(type.name);
  return names;
}

std::optional<TimedTrajectory> paced_circle(const Item& item, const Section& s, const Stage& stage,
                                            const Trajectory& circle, double period,
                                            const Rate& rate, bool mirrored) {
  const double orbits = rate.span / period;
  if (orbits > kMostOrbits * (1 + 1e-9)) {  // the given number comes back rounded
    const Item* pace = s.one_of({"rate_m_per_s", "time_lapse"});
    return (pace ? *pace : item)
        .fail(fmt::format("makes {} orbits in the segment; at most {} are possible",
                          short_number(orbits), short_number(kMostOrbits)));
  }
  Timing timing = timing_of(rate);
  // A number of orbits fixes the end, so that two rates only shape the way there.
  if (s.find("orbits") && !read_end_rates(s, stage, timing)) return std::nullopt;
  return paced(s, circle, timing, mirrored);
}

bool is_in_region_three(const Section& s) { return s.word("region", {false, true}); }

std::optional<TimedTrajectory> read_trajectory(const Item& item, const Stage& stage,
                                               Lookup& lookup) {
  const auto type = peek(item, "type");
  if (!type) {
    if (item.node.IsMap())
      item.problems->add(item.at, item.path + ".type is missing: " + listed(kTypeNames));
    else
      item.fail("must be a map with a type, e.g. {type: infall, from_r: 30}, got " + kind_of(item));
    return std::nullopt;
  }
  const auto chosen = read_choice(*type, kTypeNames);
  if (!chosen) return std::nullopt;
  const Type& kind = kTypes[*chosen];
  if (stage.spacetime.is_flat() && !kind.in_flat_space)
    return type->fail(
        fmt::format("'{}' needs a black hole: give the show black_hole.mass_solar", kind.name));
  if (const std::string_view why = why_not(kind, stage.spacetime); !why.empty())
    return type->fail(fmt::format("of '{}' is not possible: {}", kind.name, why));
  if (has_region_one_alone(stage.spacetime))
    if (const auto region = peek(item, "region"); region && !is_word(*region, "I"))
      return region->fail("must be I, which a hole with a charge of 1 or more has alone");
  if (!fits_spin(item, stage)) return std::nullopt;
  const Reader reader = stage.spacetime.is<Wormhole>()       ? kind.in_wormhole
                        : stage.spacetime.is<SpinningHole>() ? kind.about_spin
                                                             : kind.near_hole;
  const auto read = reader(item, stage, lookup);
  return read && turns_within_shows(item, *read) ? read : std::nullopt;
}

}  // namespace domefall
