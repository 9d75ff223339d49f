#include "pipeline/program/cli/spin_ray_table.h"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <optional>
#include <string>
#include <vector>

#include "pipeline/base/errors.h"
#include "pipeline/light/kerr_ray.h"
#include "pipeline/light/kerr_request.h"
#include "pipeline/light/ray_request.h"
#include "pipeline/light/traced_spin.h"

namespace domefall {
namespace {

constexpr std::array kInput{"spin", "charge", "r", "theta", "delta", "eta", "edge", "offset"};

constexpr const char* kRayColumns =
    "origin,beyond,theta_sky,phi_sky,x,y,z,one_plus_z,amplification,turns,mino";
constexpr const char* kPassageColumns =
    "k,r_there,phi_there,null_time,outgoing,shift_pro,shift_retro,flux_pro,flux_retro";

// Throws InputError for what is no number of a passage.
int passage_number(const std::string& text) {
  const long double k = decimal_number(text, "k");
  if (!(k >= 0 && k <= 1000 && k == std::floor(k)))
    throw InputError(fmt::format("k must be a whole number from 0 to 1000, got '{}'", text));
  return static_cast<int>(k);
}

// Throws InputError for cells that are no ray.
SpinRay ray_of(const CsvFile& rows) {
  const auto text = [&](const char* column) { return std::string(rows.text(column)); };
  const auto number = [&](const char* column) { return decimal_number(text(column), column); };
  SpinRay ray;
  ray.hole = {number("spin"), number("charge"), lost_digits(text("spin"))};
  ray.r = number("r"), ray.theta = number("theta"), ray.eta = number("eta");
  ray.edge = text("edge");
  // With an edge either may be left out; without one delta may not, nor may the offset be given.
  if (ray.edge.empty() || !text("delta").empty()) ray.delta = number("delta");
  if (!ray.edge.empty() && !rows.has("offset")) throw InputError("edge needs a column offset");
  if (!ray.edge.empty() || !text("offset").empty()) ray.offset = number("offset");
  return ray;
}

void print_answer(const TracedSpinRay& ray) {
  fmt::print(",{},{}", ray.origin, ray.beyond);
  if (ray.origin.empty() || !ray.sky) {
    const bool known = !ray.origin.empty();
    fmt::print(",,,,,,{},,,\n", known ? fmt::format("{:.17g}", ray.one_plus_z) : "");
    return;
  }
  const V3d& sky = *ray.sky;
  for (const double v : {std::atan2(std::hypot(sky.x, sky.y), sky.z), std::atan2(sky.y, sky.x),
                         sky.x, sky.y, sky.z, ray.one_plus_z, ray.amplification})
    fmt::print(",{:.17g}", v);
  fmt::print(",{},{:.17g}\n", ray.turns, ray.mino);
}

// Prints the cells of a ray's k-th passage, which are empty where there is none.
void print_passage(const KerrQuestion& asked, int k) {
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

}  // namespace

bool is_spin_ray_table(const CsvFile& rows) { return rows.has("spin"); }

void trace_spin_rays(const std::string& file) {
  CsvFile rows(file, {"spin", "charge", "r", "theta", "delta", "eta"});
  const bool passages = rows.has_as_written("k");  // K is a constant of rays
  for (const char* column : kInput) fmt::print("{},", column);
  fmt::print("{}\n", passages ? kPassageColumns : kRayColumns);
  while (rows.next()) {
    std::optional<TracedSpinRay> traced;
    std::optional<KerrQuestion> asked;
    int k = 0;
    try {
      if (passages) k = passage_number(std::string(rows.text("k")));
      const SpinRay ray = ray_of(rows);
      if (!passages)
        traced = trace_spin_ray(ray);
      else
        asked = kerr_question(ray);
    } catch (const InputError& error) {
      rows.fail(error.what());
    }
    for (const char* column : kInput)
      fmt::print("{}{}", column == kInput.front() ? "" : ",", rows.text(column));
    if (passages) fmt::print(",{}", k);
    if (traced)
      print_answer(*traced);
    else if (asked)
      print_passage(*asked, k);
    else
      fmt::print("{}\n", std::string(8, ','));
  }
}

}  // namespace domefall
