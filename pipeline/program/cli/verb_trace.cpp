#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cmath>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "pipeline/base/csv_file.h"
#include "pipeline/base/errors.h"
#include "pipeline/light/ray_request.h"
#include "pipeline/program/cli/number_in.h"
#include "pipeline/program/cli/option_types.h"
#include "pipeline/program/cli/spin_ray_table.h"
#include "pipeline/program/cli/verbs.h"
#include "pipeline/program/cli/wormhole_ray_table.h"

namespace domefall {
namespace {

// RayCells are the cells of a ray, as written.
struct RayCells {
  std::string observer, r, delta, edge, offset, psi;
};

class RayTable {
 public:
  explicit RayTable(const std::string& file) : rows_(file, {"observer", "r", "delta"}) {}

  bool next(RayCells& cells) {
    if (!rows_.next()) return false;
    cells = {cell("observer"), cell("r"), cell("delta"), cell("edge"), cell("offset"), cell("psi")};
    return true;
  }

  bool asks_for_positions() const { return rows_.has("psi"); }

  // Returns where the ray is after having swept psi, or nothing where it has ended or the cell is
  // empty.  Throws InputError, with the line, for a psi that is no angle.
  std::optional<TracedPlace> place(const RayCells& cells, const RayRequest& ray, TraceMethod method,
                                   const TraceOptions& options) const {
    if (cells.psi.empty()) return std::nullopt;
    try {
      const auto psi = static_cast<double>(decimal_number(cells.psi, "psi"));
      if (!(psi >= 0)) throw InputError(fmt::format("psi must be at least 0, got {}", psi));
      return trace_place(ray, psi, method, options);
    } catch (const InputError& error) {
      rows_.fail(error.what());
    }
  }

  // Throws InputError, with the line, for cells that are no ray.
  RayRequest request(const RayCells& cells) const {
    try {
      return request_of(cells);
    } catch (const InputError& error) {
      rows_.fail(error.what());
    }
  }

 private:
  std::string cell(std::string_view name) const { return std::string(rows_.text(name)); }

  static RayRequest request_of(const RayCells& cells) {
    const TraceObserver observer = trace_observer(cells.observer);
    const Radius at = decimal_radius(cells.r);
    if (!cells.edge.empty()) {
      const RayRequest ray = ray_at_edge(
          observer, at, cells.edge, static_cast<double>(decimal_number(cells.offset, "offset")));
      if (!cells.delta.empty()) require_delta(ray, decimal_number(cells.delta, "delta"));
      return ray;
    }
    if (!cells.offset.empty()) throw InputError("offset is given without an edge");
    return ray_at_angle(observer, at, decimal_number(cells.delta, "delta"));
  }

  CsvFile rows_;
};

std::vector<std::string> method_names() {
  std::vector<std::string> names;
  names.reserve(kTraceMethods.size());
  for (const auto& [name, method] : kTraceMethods) names.emplace_back(name);
  return names;
}

constexpr double kNothing = std::numeric_limits<double>::quiet_NaN();

// Prints a further cell, which is empty for NaN.
void print_cell(double value) {
  fmt::print(",");
  if (!std::isnan(value)) fmt::print("{:.17g}", value);
}

void trace(const std::string& file, TraceMethod method, const TraceOptions& options) {
  if (is_spin_ray_table(CsvFile(file))) {
    if (is_integrator(method))
      throw InputError(
          "rays near a charge or a spinning hole are traced by the exact integral, not by an "
          "integrator");
    trace_spin_rays(file);
    return;
  }
  RayTable table(file);
  const bool positions = table.asks_for_positions();
  fmt::print("observer,r,delta,edge,offset,origin,phi,one_plus_z,slope,amplification{}\n",
             positions ? ",r_there,null_time" : "");
  for (RayCells cells; table.next(cells);) {
    const RayRequest request = table.request(cells);
    const TracedRay ray = trace_ray(request, method, options);
    for (const std::string* text :
         {&cells.observer, &cells.r, &cells.delta, &cells.edge, &cells.offset})
      fmt::print("{},", *text);
    fmt::print("{}", ray.decided ? name_of(ray.origin) : "");
    for (const double v : {ray.phi, ray.one_plus_z, ray.slope, ray.amplification}) print_cell(v);
    if (positions) {
      const std::optional<TracedPlace> place = table.place(cells, request, method, options);
      print_cell(place ? place->r : kNothing);
      print_cell(place ? place->null_time : kNothing);
    }
    fmt::print("\n");
  }
}

}  // namespace

void add_trace(CLI::App& app) {
  auto* verb =
      app.add_subcommand("trace", "Rays by number: where they come from, how far they were bent");
  auto table = std::make_shared<std::string>();
  auto method = std::make_shared<std::string>("table");
  auto options = std::make_shared<TraceOptions>();
  add_file(*verb, "--table", *table,
           "CSV with the columns observer, r, delta and perhaps edge, offset, psi; near a "
           "charge or a spinning hole spin, charge, r, theta, delta, eta and perhaps edge, "
           "offset, and k for the k-th passage of the equatorial plane")
      ->required();
  verb->add_option("--method", *method,
                   "table (what renders frames), exact, or an integrator: rk4 (the paper's own), "
                   "dopri5, rkf78 (the full geodesic equations), binet-dopri5, binet-rkf78")
      ->check(CLI::IsMember(method_names()))
      ->capture_default_str();
  add_number(*verb, "--tolerance", options->tolerance,
             "of the integrators, relative, each step, 1e-13 to 1e-3; a ray nearer to an "
             "edge than that may lose its origin",
             1e-13, 1e-3);
  verb->callback([table, method, options] {
    const TraceMethod by = trace_method(*method);
    if (!is_wormhole_ray_table(CsvFile(*table))) return trace(*table, by, *options);
    if (is_integrator(by))
      throw InputError("rays in a wormhole are traced by table or exact, not by an integrator");
    trace_wormhole_rays(*table, by == TraceMethod::kTable);
  });
}

}  // namespace domefall
