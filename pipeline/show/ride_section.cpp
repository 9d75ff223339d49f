#include "pipeline/show/ride_section.h"

#include <fmt/format.h>

#include "pipeline/show/known_name.h"

namespace domefall {
namespace {

// Returns the body that the observer rides, or reports that the show has none of that name.
const Body* find_body(const Section& s, const Stage& stage) {
  if (!s.require("body", ": the name of the body with which the observer moves")) return nullptr;
  std::map<std::string, const Body*, std::less<>> bodies;
  for (const Body& body : *stage.bodies) bodies.emplace(body.name, &body);
  const auto* body = find_named(s, "body", bodies, "names no body of the show");
  return body ? *body : nullptr;
}

}  // namespace

std::optional<TimedTrajectory> read_ride(const Item& item, const Stage& stage) {
  const Section s(item, {"type", "body", "behind_m", "from_r", "from_leg", "from_tau_m", "to_r",
                         "to_leg", "to_tau_m", "rate_m_per_s", "time_lapse", "pace"});
  const Body* body = find_body(s, stage);
  const double behind = s.number("behind_m", kUnitsOfM.within(-kFarthest, kFarthest), 0);
  if (!body) return std::nullopt;
  Defaults defaults;
  // Light that falls straight in keeps its v, and in that light the observer goes on where the
  // segment before ended.  Whoever follows `behind` later is at each v where the body was at v -
  // behind.
  if (const auto tau = time_of_null(*body, stage.null_time - behind)) {
    // time_of_null() counts from Body::start, and the timing from the trajectory's own zero.
    defaults.tau = body->start + *tau;
  } else if (!s.find("from_r") && !s.find("from_tau_m")) {
    s.find("body")->fail(
        fmt::format("is not there at v = {} M, when the segment begins; give from_tau_m",
                    short_number(stage.null_time - behind)));
    return std::nullopt;
  }
  const auto timing = read_timing(s, stage, body->trajectory, defaults);
  if (!timing) return std::nullopt;
  // `beginning` gives the plane, which is the body's own, so that nothing is mirrored or turned.
  Placement placement{false, body->backward, 0, {}};
  placement.beginning = beginning_beside(*body, double(timing->tau_begin - body->start), behind);
  return TimedTrajectory{body->trajectory, *timing, placement};
}

}  // namespace domefall
