#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <boost/multiprecision/cpp_dec_float.hpp>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <numbers>
#include <string_view>
#include <utility>
#include <vector>

#include "pipeline/cli/number_in.h"
#include "pipeline/cli/option_types.h"
#include "pipeline/cli/verbs.h"
#include "pipeline/image/csv_file.h"
#include "pipeline/optics/traced_ray.h"

namespace domefall {
namespace {

class RayTable {
 public:
  explicit RayTable(const std::string& file) : rows_(file, {"observer", "r", "delta"}) {}

  // The cells observer, r, delta, edge, offset of the next ray, as written; false at the end.
  bool next(std::array<std::string, 5>& cells) {
    constexpr std::array<std::string_view, 5> kNames{"observer", "r", "delta", "edge", "offset"};
    if (!rows_.next()) return false;
    for (std::size_t c = 0; c < cells.size(); ++c) cells[c] = rows_.text(kNames[c]);
    return true;
  }

  [[noreturn]] void fail(const std::string& what) const { rows_.fail(what); }

  long double number(const std::string& text, const char* name) const {
    char* end = nullptr;
    const long double value = std::strtold(text.c_str(), &end);
    const bool decimal = text.find_first_not_of("+-.0123456789eE") == std::string::npos;
    if (text.empty() || !decimal || *end != 0 || !std::isfinite(value))
      fail(std::string(name) + " must be a number, got '" + text + "'");
    return value;
  }

  enum { kObserver, kR, kDelta, kEdge, kOffset };

 private:
  CsvFile rows_;
};

constexpr std::array<std::pair<const char*, TraceObserver>, 5> kObservers{
    {{"rain", TraceObserver::kRain},
     {"static", TraceObserver::kStatic},
     {"outgoing", TraceObserver::kOutgoing},
     {"T_II", TraceObserver::kTwo},
     {"T_IV", TraceObserver::kFour}}};

TraceObserver observer_of(const RayTable& table, const std::string& name) {
  for (const auto& [known, observer] : kObservers)
    if (name == known) return observer;
  table.fail("observer must be rain, static, outgoing, T_II or T_IV, got '" + name + "'");
}

// Reads r.  Beyond 1e12 the silhouette is a point to double precision, and below 1e-9 the two skies
// touch.  The distances from the horizon and the light circle come from the decimals, most of which
// a double of an r near them would lose.
Radius radius_of(const RayTable& table, TraceObserver observer, const std::string& text) {
  const long double r = table.number(text, "r");
  if (!(r >= 1e-9L && r <= 1e12L))
    table.fail("r must be from 1e-9 to 1e12 (units of M), got " + text);
  using Decimal = boost::multiprecision::cpp_dec_float_50;
  const Decimal exact(text);
  if (observer == TraceObserver::kStatic && !(exact > 2))
    table.fail("r must exceed 2 (units of M) for a static observer, got " + text);
  const bool inside = observer == TraceObserver::kTwo || observer == TraceObserver::kFour;
  if (inside && !(exact < 2))
    table.fail("r must be below 2 (units of M) for the observers T_II and T_IV, got " + text);
  return {static_cast<double>(exact), static_cast<double>(Decimal(exact - 2)),
          static_cast<double>(Decimal(exact - 3))};
}

// Reads a ray that is given by its offset from an edge.  The sum must be an angle from 0 to pi.
void read_edge(const RayTable& table, const std::string& edge, const std::string& offset,
               RayRequest& q) {
  if (edge != "silhouette" && edge != "region3")
    table.fail("edge must be silhouette, region3 or empty, got '" + edge + "'");
  q.edge = edge == "silhouette" ? Edge::kSilhouette : Edge::kRegionThree;
  if (!has_edge(q.observer, q.at, *q.edge))
    table.fail("this observer sees no edge " + edge + " at this r");
  q.offset = static_cast<double>(table.number(offset, "offset"));
  const double place = edge_delta(q.observer, q.at, *q.edge);
  if (!(q.offset >= -place * (1 + 1e-12) && q.offset <= (M_PI - place) * (1 + 1e-12)))
    table.fail("offset must keep delta from 0 to pi, got " + offset);
}

RayRequest request_of(const RayTable& table, const std::array<std::string, 5>& cell) {
  RayRequest q;
  q.observer = observer_of(table, cell[RayTable::kObserver]);
  q.at = radius_of(table, q.observer, cell[RayTable::kR]);
  if (!cell[RayTable::kEdge].empty()) {
    read_edge(table, cell[RayTable::kEdge], cell[RayTable::kOffset], q);
    return q;
  }
  if (!cell[RayTable::kOffset].empty()) table.fail("offset is given without an edge");
  q.delta = table.number(cell[RayTable::kDelta], "delta");
  // A decimal that is pi rounded up is taken as pi.
  constexpr long double kPi = std::numbers::pi_v<long double>;
  if (!(q.delta >= 0 && q.delta <= kPi * (1 + 1e-12L)))
    table.fail("delta must be from 0 to pi, got " + cell[RayTable::kDelta]);
  q.delta = std::min(q.delta, kPi);
  return q;
}

std::vector<std::string> method_names() {
  std::vector<std::string> names;
  names.reserve(kTraceMethods.size());
  for (const auto& [name, method] : kTraceMethods) names.emplace_back(name);
  return names;
}

TraceMethod method_named(const std::string& name) {
  for (const auto& [known, method] : kTraceMethods)
    if (name == known) return method;
  return TraceMethod::kTable;
}

void trace(const std::string& file, TraceMethod method, const TraceOptions& options) {
  RayTable table(file);
  std::puts("observer,r,delta,edge,offset,origin,phi,one_plus_z,slope,amplification");
  for (std::array<std::string, 5> cell; table.next(cell);) {
    const TracedRay ray = trace_ray(request_of(table, cell), method, options);
    for (const std::string& text : cell) std::printf("%s,", text.c_str());
    std::printf("%s", ray.decided ? name_of(ray.origin) : "");
    for (const double v : {ray.phi, ray.one_plus_z, ray.slope, ray.amplification})
      std::isnan(v) ? std::printf(",") : std::printf(",%.17g", v);
    std::puts("");
  }
}

}  // namespace

void add_trace(CLI::App& app) {
  auto* verb =
      app.add_subcommand("trace", "Rays by number: where they come from, how far they were bent");
  auto table = std::make_shared<std::string>();
  auto method = std::make_shared<std::string>("table");
  auto options = std::make_shared<TraceOptions>();
  verb->add_option("--table", *table, "CSV with the columns observer, r, delta, edge, offset")
      ->type_name(kFileType)
      ->required();
  verb->add_option("--method", *method,
                   "table (what renders frames), exact, or an integrator: rk4 (the paper's own), "
                   "dopri5, rkf78 (the full geodesic equations), binet-dopri5, binet-rkf78")
      ->check(CLI::IsMember(method_names()))
      ->capture_default_str();
  verb->add_option("--tolerance", options->tolerance,
                   "of the integrators, relative, each step, 1e-13 to 1e-3; a ray nearer to an "
                   "edge than that may lose its origin")
      ->check(number_in(1e-13, 1e-3))
      ->capture_default_str();
  verb->callback([table, method, options] { trace(*table, method_named(*method), *options); });
}

}  // namespace domefall
