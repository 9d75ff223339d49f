#include "pipeline/program/cli/charged_ray_table.h"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <numbers>
#include <optional>
#include <string>
#include <string_view>

#include "pipeline/base/errors.h"
#include "pipeline/light/ray_request.h"
#include "pipeline/light/traced_charge.h"
#include "pipeline/program/cli/kerr_ray_table.h"
#include "pipeline/spacetime/kerr.h"
#include "trajectories/directions.h"

namespace domefall {
namespace {

using std::numbers::pi;

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

struct AskedRay {
  ChargedRequest request;
  double theta, eta;
};

// Throws InputError for cells that are no ray.
AskedRay ray_of(const CsvFile& rows) {
  const auto text = [&](const char* column) { return std::string(rows.text(column)); };
  const auto number = [&](const char* column) { return decimal_number(text(column), column); };
  const auto theta = static_cast<double>(number("theta"));
  if (!(theta >= 0 && theta <= pi))
    throw InputError(fmt::format("theta must be from 0 to pi, got {}", theta));
  const std::string edge = text("edge");
  const auto eta = static_cast<double>(number("eta"));
  if (edge.empty()) {
    if (!text("offset").empty()) throw InputError("offset is given without an edge");
    return {charged_ray_at_angle(number("charge"), number("r"), number("delta")), theta, eta};
  }
  const ChargedRequest request = charged_ray_at_edge(number("charge"), number("r"), edge,
                                                     static_cast<double>(number("offset")));
  if (!text("delta").empty()) {
    const long double given = number("delta"), own = request.delta;
    if (!(std::abs(given - own) <= 1e-9L * (own + 2 * std::abs(request.offset))))
      throw InputError(
          fmt::format("delta is {}, and edge and offset give {}; leave one of them out",
                      static_cast<double>(given), static_cast<double>(own)));
  }
  return {request, theta, eta};
}

// A SweptPlane is the plane of a ray about the hole.  The place on the sky that light came from is
// cos(phi) n - sin(phi) e, with n the observer's place and e the light's direction across it.
struct SweptPlane {
  V3d n, e;

  SweptPlane(double theta, double eta)
      : n(std::sin(theta), 0, std::cos(theta)),
        e(std::cos(eta) * std::cos(theta), std::sin(eta), -std::cos(eta) * std::sin(theta)) {}
  V3d place(double phi) const { return n * std::cos(phi) - e * std::sin(phi); }
  // Returns how often z is extreme on the way there.
  int turns(double phi) const {
    double first = std::atan2(-e.z, n.z);
    if (first <= 0) first += pi;
    return phi > first ? 1 + static_cast<int>((phi - first) / pi) : 0;
  }
};

// Returns the names of an origin, and of what the light of the past horizon came from.
std::array<const char*, 2> names_of(const TracedCharge& ray, const ChargedHole& hole) {
  switch (ray.origin) {
    case ChargedOrigin::kOwn:
      return {"I", ""};
    case ChargedOrigin::kParallel:
      return {"III", ""};
    case ChargedOrigin::kBefore:
    case ChargedOrigin::kParallelBefore:
      return {"H", "E"};
    case ChargedOrigin::kDark:
      break;
  }
  if (hole.is_naked()) return {"B", ""};
  return {"H", hole.charge == 0 ? "S" : "B"};
}

void print_answer(const AskedRay& asked) {
  const TracedCharge ray = trace_charge(asked.request);
  const auto [origin, beyond] = names_of(ray, asked.request.hole);
  fmt::print(",{},{}", origin, beyond);
  if (ray.origin == ChargedOrigin::kDark) {
    fmt::print(",,,,,,{:.17g},,,\n", std::abs(ray.energy));
    return;
  }
  const SweptPlane plane(asked.theta, asked.eta);
  const V3d sky = plane.place(ray.phi);
  // On the axis phi = L/(r |E|), if the light came straight.
  const double mino = ray.angular_momentum > 0 ? ray.phi / ray.angular_momentum
                                               : 1 / (asked.request.at.r * std::abs(ray.energy));
  for (const double v : {std::atan2(std::hypot(sky.x, sky.y), sky.z), std::atan2(sky.y, sky.x),
                         sky.x, sky.y, sky.z, std::abs(ray.energy), ray.amplification})
    fmt::print(",{:.17g}", v);
  fmt::print(",{},{:.17g}\n", plane.turns(ray.phi), mino);
}

// Says whether an observer is at the inner horizon of a hole that spins, or inside.
bool is_inside(const CsvFile& rows) {
  const auto number = [&](const char* column) {
    return decimal_number(std::string(rows.text(column)), column);
  };
  return number("r") <= KerrHole{number("spin"), number("charge")}.inner_horizon();
}

}  // namespace

bool is_charged_ray_table(const CsvFile& rows) { return rows.has("spin") && rows.has("charge"); }

void trace_charged_rays(const std::string& file) {
  CsvFile rows(file, {"spin", "charge", "r", "theta", "delta", "eta"});
  const bool passages = rows.has_as_written("k");  // K is a constant of rays
  for (const char* column : kInput) fmt::print("{},", column);
  fmt::print("{}\n", passages ? kPassageColumns : kRayColumns);
  while (rows.next()) {
    std::optional<AskedRay> charged;
    std::optional<AskedKerrRay> spinning;
    int k = 0;
    try {
      if (passages) k = passage_number(std::string(rows.text("k")));
      const bool spins = decimal_number(std::string(rows.text("spin")), "spin") != 0;
      // Inside the inner horizon cells stay empty.
      const bool known = !spins || !is_inside(rows);
      if (known && (spins || passages))
        spinning = asked_kerr_ray(rows);
      else if (known)
        charged = ray_of(rows);
    } catch (const InputError& error) {
      rows.fail(error.what());
    }
    for (const char* column : kInput)
      fmt::print("{}{}", column == kInput.front() ? "" : ",", rows.text(column));
    if (passages) fmt::print(",{}", k);
    if (spinning && passages)
      print_kerr_passage(*spinning, k);
    else if (spinning)
      print_kerr_ray(*spinning);
    else if (charged)
      print_answer(*charged);
    else
      fmt::print("{}\n", std::string(passages ? 8 : 11, ','));
  }
}

}  // namespace domefall
