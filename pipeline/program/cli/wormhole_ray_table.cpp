#include "pipeline/program/cli/wormhole_ray_table.h"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <optional>
#include <string>

#include "pipeline/base/errors.h"
#include "pipeline/light/ray_request.h"
#include "pipeline/light/traced_wormhole.h"

namespace domefall {
namespace {

constexpr std::array kWormholeCells{"profile", "rho", "a", "m", "l", "delta", "edge", "offset"};

// Throws InputError for cells that are no ray.
WormholeRequest wormhole_ray_of(const CsvFile& rows) {
  const auto text = [&](const char* column) { return std::string(rows.text(column)); };
  const auto number = [&](const char* column) { return decimal_number(text(column), column); };
  const auto given = [&](const char* column) {
    return text(column).empty() ? std::nullopt : std::optional(number(column));
  };
  const std::string profile = text("profile"), edge = text("edge");
  const WormholePlace place{profile, number("rho"), given("a"), given("m"), number("l")};
  if (edge.empty()) {
    if (!text("offset").empty()) throw InputError("offset is given without an edge");
    return wormhole_ray_at_angle(place, number("delta"));
  }
  const WormholeRequest request =
      wormhole_ray_at_edge(place, edge, static_cast<double>(number("offset")));
  if (const auto delta = given("delta"))
    require_delta(*delta, request.delta - request.offset, request.offset);
  return request;
}

}  // namespace

bool is_wormhole_ray_table(const CsvFile& rows) { return rows.has("profile") && rows.has("rho"); }

void trace_wormhole_rays(const std::string& file, bool tables) {
  CsvFile rows(file, {"profile", "rho", "a", "m", "l", "delta"});
  for (const char* column : kWormholeCells) fmt::print("{},", column);
  fmt::print("origin,azimuth,slope,one_plus_z,amplification\n");
  while (rows.next()) {
    std::optional<WormholeRequest> request;
    try {
      request = wormhole_ray_of(rows);
    } catch (const InputError& error) {
      rows.fail(error.what());
    }
    for (const char* column : kWormholeCells) fmt::print("{},", rows.text(column));
    const TracedWormhole ray = trace_wormhole(*request, tables);
    const bool from_sky = std::isfinite(ray.azimuth);
    fmt::print("{},{:.17g},{:.17g},{},{:.17g}\n",
               !from_sky ? ""
               : ray.own ? "own"
                         : "other",
               ray.azimuth, ray.slope, from_sky ? "1" : "", ray.amplification);
  }
}

}  // namespace domefall
