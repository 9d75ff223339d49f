#include "pipeline/program/cli/kerr_ray_table.h"

#include <fmt/format.h>

#include <optional>
#include <vector>

#include "pipeline/light/kerr_ray.h"

namespace domefall {

void print_kerr_passage(const KerrQuestion& asked, int k) {
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
