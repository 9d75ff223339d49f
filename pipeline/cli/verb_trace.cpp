#include <cerrno>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <sstream>

#include "pipeline/cli/verbs.h"
#include "pipeline/image/errors.h"
#include "pipeline/optics/silhouette.h"
#include "pipeline/optics/traced_ray.h"

namespace domefall {
namespace {

class RayTable {
 public:
  explicit RayTable(const std::string& file) : file_(file), in_(file) {
    if (!in_) throw InputError(file + ": the table of rays cannot be read");
    std::vector<std::string> header;
    if (!next_row(header)) fail("the table has no header line");
    for (std::size_t k = 0; k < header.size(); ++k)
      for (std::size_t c = 0; c < kNames.size(); ++c)
        if (header[k] == kNames[c]) column_[c] = static_cast<int>(k);
    for (const int needed : {kObserver, kR, kDelta})
      if (column_[needed] < 0) fail("the table has no column " + std::string(kNames[needed]));
    width_ = header.size();
  }

  // The cells observer, r, delta, edge, offset of the next ray, as written; false at the end.
  bool next(std::array<std::string, 5>& cells) {
    std::vector<std::string> row;
    if (!next_row(row)) return false;
    row.resize(std::max(width_, row.size()));
    for (std::size_t c = 0; c < cells.size(); ++c)
      cells[c] = column_[c] < 0 ? "" : row[static_cast<std::size_t>(column_[c])];
    return true;
  }

  [[noreturn]] void fail(const std::string& what) const {
    throw InputError(file_ + ":" + std::to_string(line_) + ": " + what);
  }

  long double number(const std::string& text, const char* name) const {
    char* end = nullptr;
    const long double value = std::strtold(text.c_str(), &end);
    if (text.empty() || *end != 0 || !std::isfinite(value))
      fail(std::string(name) + " must be a number, got '" + text + "'");
    return value;
  }

  enum { kObserver, kR, kDelta, kEdge, kOffset };

 private:
  static constexpr std::array<const char*, 5> kNames{"observer", "r", "delta", "edge", "offset"};

  bool next_row(std::vector<std::string>& row) {
    for (std::string line; std::getline(in_, line);) {
      ++line_;
      if (!line.empty() && line.back() == '\r') line.pop_back();
      if (line.empty() || line[0] == '#') continue;
      row.clear();
      std::istringstream cells(line);
      for (std::string cell; std::getline(cells, cell, ',');) row.push_back(cell);
      return true;
    }
    return false;
  }

  std::string file_;
  std::ifstream in_;
  int line_ = 0;
  std::array<int, 5> column_{-1, -1, -1, -1, -1};
  std::size_t width_ = 0;
};

// The edge and the offset make delta, which must be an angle from the hole.
void check_offset(const RayTable& table, const RayRequest& q, const std::string& text) {
  const double tangent =
      *q.edge == Edge::kSilhouette ? tan_half_silhouette(q.at) : tan_half_region_three(q.at);
  const double edge = 2 * std::atan(tangent), beyond = 2 * std::atan2(1.0, tangent);
  if (!(q.offset >= -edge * (1 + 1e-12) && q.offset <= beyond * (1 + 1e-12)))
    table.fail("offset must keep delta from 0 to pi, got " + text);
}

RayRequest request_of(const RayTable& table, const std::array<std::string, 5>& cell) {
  RayRequest q;
  if (cell[RayTable::kObserver] == "static")
    q.observer = TraceObserver::kStatic;
  else if (cell[RayTable::kObserver] != "rain")
    table.fail("observer must be rain or static, got '" + cell[RayTable::kObserver] + "'");
  const long double r = table.number(cell[RayTable::kR], "r");
  const bool is_static = q.observer == TraceObserver::kStatic;
  // Beyond 1e12 the silhouette is a point to double precision; below 1e-9, the two skies touch.
  if (!(r >= 1e-9L && r <= 1e12L))
    table.fail("r must be from 1e-9 to 1e12 (units of M), got " + cell[RayTable::kR]);
  if (is_static && !(r > 2))
    table.fail("r must exceed 2 (units of M) for a static observer, got " + cell[RayTable::kR]);
  q.at = Radius(r);
  const std::string& edge = cell[RayTable::kEdge];
  if (edge == "silhouette" || edge == "region3") {
    q.edge = edge == "silhouette" ? Edge::kSilhouette : Edge::kRegionThree;
    q.offset = static_cast<double>(table.number(cell[RayTable::kOffset], "offset"));
    if (edge == "region3" && !(r <= 2)) table.fail("edge region3 needs r of at most 2");
    if (!is_static) check_offset(table, q, cell[RayTable::kOffset]);
    return q;
  }
  if (!edge.empty()) table.fail("edge must be silhouette, region3 or empty, got '" + edge + "'");
  q.delta = static_cast<double>(table.number(cell[RayTable::kDelta], "delta"));
  if (!(q.delta >= 0 && q.delta <= M_PI))
    table.fail("delta must be from 0 to pi, got " + cell[RayTable::kDelta]);
  return q;
}

// Observers of the reference table whose light is not traced yet: they need region IV.
bool is_beyond_us(const std::string& observer) {
  return observer == "outgoing" || observer == "T_II" || observer == "T_IV";
}

const char* name_of(Origin origin) {
  return origin == Origin::kSkyOne ? "I" : origin == Origin::kSkyThree ? "III" : "IV";
}

void trace(const std::string& file, const std::string& method) {
  RayTable table(file);
  std::puts("observer,r,delta,edge,offset,origin,phi,one_plus_z,slope,amplification");
  int left_out = 0;
  for (std::array<std::string, 5> cell; table.next(cell);) {
    if (is_beyond_us(cell[RayTable::kObserver])) {
      for (const std::string& text : cell) std::printf("%s,", text.c_str());
      std::puts(",,,,");
      ++left_out;
      continue;
    }
    const RayRequest request = request_of(table, cell);
    const TracedRay ray =
        trace_ray(request, method == "exact" ? TraceMethod::kExact : TraceMethod::kTable);
    for (const std::string& text : cell) std::printf("%s,", text.c_str());
    std::printf("%s", name_of(ray.origin));
    for (const double v : {ray.phi, ray.one_plus_z, ray.slope, ray.amplification})
      std::isnan(v) ? std::printf(",") : std::printf(",%.17g", v);
    std::puts("");
  }
  if (left_out > 0)
    std::fprintf(stderr,
                 "%s: %d rows are of the observers outgoing, T_II or T_IV, which are not traced: "
                 "their results are left empty\n",
                 file.c_str(), left_out);
}

}  // namespace

void add_trace(CLI::App& app) {
  auto* verb =
      app.add_subcommand("trace", "Rays by number: where they come from, how far they were bent");
  auto table = std::make_shared<std::string>();
  auto method = std::make_shared<std::string>("table");
  verb->add_option("--table", *table, "CSV with the columns observer, r, delta, edge, offset")
      ->required();
  verb->add_option("--method", *method, "table (what renders frames) or exact")
      ->check(CLI::IsMember({"table", "exact"}))
      ->capture_default_str();
  verb->callback([table, method] { trace(*table, *method); });
}

}  // namespace domefall
