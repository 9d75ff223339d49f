#include <fmt/format.h>

#include <array>
#include <cmath>
#include <stdexcept>

#include "pipeline/base/csv_file.h"
#include "pipeline/base/errors.h"
#include "pipeline/show/file/trajectory_section.h"
#include "pipeline/show/state_columns.h"

namespace domefall {
namespace {

constexpr std::array<Tetrad, 4> kTetrads{Tetrad::kRain, Tetrad::kOutgoing, Tetrad::kRainOfThree,
                                         Tetrad::kOutgoingToThree};

// Phi is (1/r) d/dphi in the plane of the path.
void set_rates(const Spacetime& spacetime, PathKey& key, const Celerity<ReferenceTetrad>& celerity,
               Tetrad tetrad) {
  key.radial_rate = radial_rate(spacetime, key.r, tetrad, celerity);
  key.azimuth_rate = celerity.z / key.r;
}

void read_velocity_at(const Section& s, const Stage& stage, PathKey& key, Lookup& lookup) {
  if (!s.find("speed") && !s.find("lorentz_factor")) return;
  if (!(stage.spacetime.lapse_squared(key.r) > 0)) {
    s.one_of({"speed", "lorentz_factor"})
        ->fail(fmt::format("is measured by what is static, which exists outside r = {} M only; "
                           "leave it out",
                           short_number(stage.spacetime.horizon())));
    return;
  }
  GivenVelocity frame;
  frame.r = key.r;
  frame.celerity = resting_celerity(stage.spacetime, key.r, frame.tetrad);
  const auto own = read_speed_on_path(s, stage, frame, lookup);
  if (!own) return;
  // The R of the static observer is sqrt(f) d/dr.
  key.radial_rate = own->x * std::sqrt(stage.spacetime.lapse_squared(key.r));
  key.azimuth_rate = own->z / key.r;
}

// Reads the keys of a path from a list in the show file.  All keys are checked before an error
// gives up the path.
std::optional<std::vector<PathKey>> read_path_keys(const Item& list, const Stage& stage,
                                                   Lookup& lookup) {
  const auto items = read_list(list);
  if (!items) return std::nullopt;
  std::vector<PathKey> keys;
  bool good = true;
  for (const Item& item : *items) {
    const Section s(item, {"path.keyframes", "speed"});
    const auto at = s.required("at_m");
    const auto r = s.required("r");
    good = good && at && r;
    if (!at || !r) continue;
    PathKey key{*at, *r, s.angle("azimuth_deg"), {}, {}};
    read_velocity_at(s, stage, key, lookup);
    keys.push_back(key);
  }
  return good ? std::optional(keys) : std::nullopt;
}

// These columns of a table of states say what a path is.
constexpr std::string_view kTimeColumn = state_column("proper_time"),
                           kRadiusColumn = state_column("r"),
                           kAzimuthColumn = state_column("azimuth_deg"),
                           kTetradColumn = state_column("tetrad"),
                           kRadialColumn = state_column("celerity_r"),
                           kNormalColumn = state_column("celerity_theta"),
                           kAzimuthalColumn = state_column("celerity_phi");

// Returns the tetrad that a row of a table names.  Throws InputError, with the line, for any other
// word.
Tetrad tetrad_named(const CsvFile& table) {
  const std::string_view name = table.text(kTetradColumn);
  for (const Tetrad tetrad : kTetrads)
    if (name == tetrad_name(tetrad)) return tetrad;
  table.fail("tetrad must be rain, outgoing, rain_of_III or outgoing_to_III, got '" +
             std::string(name) + "'");
}

// A Table is what a file says of a path, which has one tetrad throughout.
struct Table {
  std::vector<PathKey> keys;
  Tetrad tetrad = Tetrad::kRain;
};

// Reads the table that `domefall states` writes, or any table with some of its columns.
Table read_table(const std::filesystem::path& file, const Spacetime& spacetime) {
  CsvFile csv(file, {kTimeColumn, kRadiusColumn});
  Table table;
  // Without celerities the path chooses the rates itself (accelerated_path.h).
  const bool moving = csv.has(kRadialColumn) && csv.has(kAzimuthalColumn);
  while (csv.next()) {
    PathKey key{csv.number(kTimeColumn), csv.number(kRadiusColumn), 0, {}, {}};
    // A file is held to the radii of shows as a keyframe is, and the test is negated against NaN.
    if (!(key.r >= kNearest && key.r <= kFarthest))
      csv.fail("r must lie between 1e-6 and 1e9 (units of M), got " + short_number(key.r));
    if (csv.has(kAzimuthColumn)) key.azimuth = radians(csv.number(kAzimuthColumn));
    // Without this column the path is one of the rain tetrad, which is regular in regions I and II.
    if (csv.has(kTetradColumn)) {
      const Tetrad tetrad = tetrad_named(csv);
      if (!table.keys.empty() && tetrad != table.tetrad)
        csv.fail("the tetrad changes; a path has one, give each part a file and a segment");
      table.tetrad = tetrad;
    }
    if (csv.has(kNormalColumn) && std::abs(csv.number(kNormalColumn)) > 1e-12)
      csv.fail("celerity_theta leaves the plane of the path; it must be 0");
    if (moving)
      set_rates(spacetime, key, {csv.number(kRadialColumn), 0, csv.number(kAzimuthalColumn)},
                table.tetrad);
    table.keys.push_back(key);
  }
  return table;
}

}  // namespace

std::optional<Celerity<GivenFrame>> read_speed_on_path(const Section& s, const Stage& stage,
                                                       const GivenVelocity& frame, Lookup& lookup) {
  if (!s.find("speed") && !s.find("lorentz_factor")) return std::nullopt;
  auto own = read_own_celerity(s, stage, frame, lookup);
  // Rounding may leave a little of Theta in a direction that lies in the plane.
  if (own && std::abs(own->y) > 1e-12 * own->length())
    return s.find("direction")->fail("leaves the plane of the path; give radial and phi only");
  return own;
}

std::optional<TimedTrajectory> read_path(const Item& item, const Stage& stage, Lookup& lookup) {
  const Section s(item, {"trajectory", "region", "path", "begin", "end", "rates", "pace"});
  const Item* by = s.one_of({"keyframes", "file"});
  const bool mirrored = is_in_region_three(s);
  if (!by) {
    s.require("keyframes", ": a list of {at_m, r, azimuth_deg}; or give file, a table of states");
    return std::nullopt;
  }
  Table table;
  try {
    if (s.find("keyframes")) {
      const auto keys = read_path_keys(*by, stage, lookup);
      if (!keys) return std::nullopt;
      table.keys = *keys;
    } else {
      const auto name = read_text(*by);
      const auto file = name ? lookup.file(*by, *name) : std::nullopt;
      if (!file) return std::nullopt;
      table = read_table(*file, stage.spacetime);
    }
    const AcceleratedPath path(table.keys, table.tetrad, stage.spacetime);
    const Defaults whole{path.begin(), Leg::kInward, path.begin(), {}, path.end()};
    const auto timing = read_timing(s, stage, path, whole);
    if (!timing) return std::nullopt;
    return TimedTrajectory{path, *timing, {mirrored}};
  } catch (const std::domain_error& error) {
    by->fail(std::string("cannot be flown: ") + error.what());
  } catch (const InputError& error) {
    by->fail(std::string("names a table in error: ") + error.what());
  }
  return std::nullopt;
}

}  // namespace domefall
