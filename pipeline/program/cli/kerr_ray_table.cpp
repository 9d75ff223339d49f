#include "pipeline/program/cli/kerr_ray_table.h"

#include <fmt/format.h>

#include <cmath>
#include <string>
#include <vector>

#include "pipeline/base/errors.h"
#include "pipeline/light/kerr_ray.h"
#include "pipeline/light/kerr_request.h"
#include "pipeline/light/ray_request.h"

namespace domefall {

AskedKerrRay asked_kerr_ray(const CsvFile& row) {
  const auto text = [&](const char* column) { return std::string(row.text(column)); };
  const auto number = [&](const char* column) { return decimal_number(text(column), column); };
  const KerrHole hole{number("spin"), number("charge"), lost_digits(text("spin"))};
  AskedKerrRay asked{kerr_place(hole, number("r"), number("theta")), {}};
  const std::string edge = text("edge");
  if (edge.empty()) {
    if (!text("offset").empty()) throw InputError("offset is given without an edge");
    asked.direction = kerr_direction(number("delta"), number("eta"));
    return asked;
  }
  asked.direction = kerr_direction_at_edge(asked.at, edge, number("offset"), number("eta"));
  if (text("delta").empty()) return asked;
  const long double given = number("delta"), own = kerr_delta(asked.at, asked.direction);
  if (!(std::abs(given - own) <= 1e-9L * (own + 2 * std::abs(asked.direction.offset))))
    throw InputError(fmt::format("delta is {}, and edge and offset give {}; leave one of them out",
                                 static_cast<double>(given), static_cast<double>(own)));
  return asked;
}

void print_kerr_ray(const AskedKerrRay& asked) {
  const TracedKerr ray = trace_kerr(asked.at, asked.direction);
  if (ray.origin == KerrOrigin::kPastHorizon) {
    fmt::print(",H,,,,,,,{:.17g},,,\n", std::abs(ray.energy));
    return;
  }
  fmt::print(",{},", ray.origin == KerrOrigin::kOwn ? "I" : "III");
  const V3d& sky = ray.sky;
  for (const double v : {std::atan2(std::hypot(sky.x, sky.y), sky.z), std::atan2(sky.y, sky.x),
                         sky.x, sky.y, sky.z, std::abs(ray.energy), ray.amplification})
    fmt::print(",{:.17g}", v);
  fmt::print(",{},{:.17g}\n", ray.turns, ray.mino);
}

void print_kerr_passage(const AskedKerrRay& asked, int k) {
  const std::vector<KerrPassage> passages = kerr_passages(asked.at, asked.direction);
  if (k >= static_cast<int>(passages.size())) {
    fmt::print(",,,,,,,,\n");
    return;
  }
  const KerrPassage& passage = passages[static_cast<std::size_t>(k)];
  const KerrHole& hole = asked.at.hole;
  fmt::print(",{:.17g},{:.17g},{:.17g},{}", passage.r, passage.phi, passage.null_time,
             passage.outgoing ? 1 : 0);
  for (const bool prograde : {true, false}) {
    const std::optional<double> shift = circling_shift(hole, passage, prograde);
    fmt::print("{}", shift ? fmt::format(",{:.17g}", *shift) : ",");
  }
  for (const bool prograde : {true, false})
    fmt::print("{}", hole.charge == 0
                         ? fmt::format(",{:.17g}", page_thorne_flux(hole, passage.r, prograde))
                         : ",");
  fmt::print("\n");
}

}  // namespace domefall
