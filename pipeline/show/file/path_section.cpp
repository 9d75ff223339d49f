#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>

#include "pipeline/base/csv_file.h"
#include "pipeline/base/errors.h"
#include "pipeline/show/file/trajectory_section.h"
#include "pipeline/show/nearest_word.h"
#include "pipeline/show/state_columns.h"
#include "trajectories/kerr_flight.h"

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

std::optional<PathKey> read_key(const Item& item, const Stage& stage, Lookup& lookup) {
  const Section s(item, {"path.keyframes", "speed"});
  const auto at = s.required("at_m");
  const auto r = s.required("r");
  if (!at || !r) return std::nullopt;
  PathKey key{*at, *r, s.angle("azimuth_deg"), {}, {}};
  read_velocity_at(s, stage, key, lookup);
  return key;
}

// All keys are checked before an error gives up the path.
std::optional<std::vector<PathKey>> read_keyframes(const Item& list, const Stage& stage,
                                                   Lookup& lookup, ReadPathKey* read) {
  const auto items = read_list(list);
  if (!items) return std::nullopt;
  std::vector<PathKey> keys;
  for (const Item& item : *items)
    if (const auto key = read(item, stage, lookup)) keys.push_back(*key);
  return keys.size() == items->size() ? std::optional(keys) : std::nullopt;
}

// These columns of a table of states say what a path is.
constexpr std::string_view kTimeColumn = state_column("proper_time"),
                           kRadiusColumn = state_column("r"), kThroatColumn = state_column("l"),
                           kAzimuthColumn = state_column("azimuth_deg"),
                           kLatitudeColumn = state_column("latitude_deg"),
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

// Reads where a row is, within the bounds of a keyframe.
PathKey read_place(const CsvFile& csv, const Spacetime& spacetime) {
  const bool throat = std::holds_alternative<Wormhole>(spacetime.kind());
  const std::string_view column = throat ? kThroatColumn : kRadiusColumn;
  PathKey key{csv.number(kTimeColumn), csv.number(column), 0, {}, {}};
  // The test is negated against NaN.
  if (!(key.r <= kFarthest && key.r >= (throat ? -kFarthest : kNearest)))
    csv.fail(fmt::format("{} must lie between {} and 1e9 (units of {}), got {}", column,
                         throat ? "-1e9" : "1e-6", throat ? "the throat's radius" : "M",
                         short_number(key.r)));
  if (csv.has(kAzimuthColumn)) key.azimuth = radians(csv.number(kAzimuthColumn));
  if (std::holds_alternative<SpinningHole>(spacetime.kind()) && csv.has(kLatitudeColumn)) {
    const double latitude = csv.number(kLatitudeColumn);
    if (!(std::abs(latitude) <= 90))
      csv.fail("latitude_deg must lie between -90 and 90, got " + short_number(latitude));
    key.theta -= radians(latitude);
  }
  return key;
}

void set_rates(const CsvFile& csv, const Spacetime& spacetime, PathKey& key, Tetrad tetrad) {
  const Celerity<ReferenceTetrad> celerity{csv.number(kRadialColumn),
                                           csv.has(kNormalColumn) ? csv.number(kNormalColumn) : 0,
                                           csv.number(kAzimuthalColumn)};
  if (const auto* hole = std::get_if<SpinningHole>(&spacetime.kind())) {
    if (!(key.r > spacetime.inner_horizon()))
      csv.fail("r must exceed that of the inner horizon, got " + short_number(key.r));
    if (!(kerr_motion(hole->kerr, key.r, key.theta, celerity).energy > 0))
      csv.fail("has a negative energy, which paths do not have");
    set_kerr_rates(hole->kerr, key, celerity);
  } else if (std::abs(celerity.y) > 1e-12) {
    csv.fail("celerity_theta leaves the plane of the path; it must be 0");
  } else if (const auto* wormhole = std::get_if<Wormhole>(&spacetime.kind())) {
    key.radial_rate = celerity.x;
    key.azimuth_rate = celerity.z / wormhole->radius(key.r);
  } else {
    set_rates(spacetime, key, celerity, tetrad);
  }
}

// Reads the table that `domefall states` writes, or any table with some of its columns.
PathTable read_file(const std::filesystem::path& file, const Spacetime& spacetime) {
  const bool throat = std::holds_alternative<Wormhole>(spacetime.kind());
  const bool spins = std::holds_alternative<SpinningHole>(spacetime.kind());
  CsvFile csv(file, {kTimeColumn, throat ? kThroatColumn : kRadiusColumn});
  // Columns of others are welcome, but not in place of one that is left out.
  constexpr std::array known{kTimeColumn,    kRadiusColumn,   kThroatColumn,
                             kAzimuthColumn, kLatitudeColumn, kTetradColumn,
                             kRadialColumn,  kNormalColumn,   kAzimuthalColumn};
  for (const std::string& column : csv.columns())
    if (const std::string meant = did_you_mean(column, known);
        !meant.empty() && !std::ranges::count(kStateColumns, column))
      csv.fail(fmt::format("no path has a column '{}'{}", shown(column), meant));
  PathTable table;
  // Without celerities the path chooses the rates itself (keyframe_path.h).
  const bool moving = csv.has(kRadialColumn) && csv.has(kAzimuthalColumn);
  while (csv.next()) {
    PathKey key = read_place(csv, spacetime);
    // Without this column the path is one of the rain tetrad, which is regular in regions I and II.
    if (csv.has(kTetradColumn)) {
      const Tetrad tetrad = tetrad_named(csv);
      if (tetrad != Tetrad::kRain && (throat || spins))
        csv.fail(fmt::format("tetrad must be rain in this space, got {}", tetrad_name(tetrad)));
      if (!table.keys.empty() && tetrad != table.tetrad)
        csv.fail("the tetrad changes; a path has one, give each part a file and a segment");
      table.tetrad = tetrad;
    }
    if (moving) set_rates(csv, spacetime, key, table.tetrad);
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

std::optional<PathTable> read_path_table(const Section& s, const Stage& stage, Lookup& lookup,
                                         ReadPathKey* read, std::string_view keyframe) {
  const Item* by = s.one_of({"keyframes", "file"});
  if (!by) {
    s.require("keyframes",
              fmt::format(": a list of {{{}}}; or give file, a table of states", keyframe));
    return std::nullopt;
  }
  if (s.find("keyframes")) {
    const auto keys = read_keyframes(*by, stage, lookup, read);
    return keys ? std::optional(PathTable{by, *keys}) : std::nullopt;
  }
  const auto name = read_text(*by);
  const auto file = name ? lookup.file(*by, *name) : std::nullopt;
  if (!file) return std::nullopt;
  try {
    PathTable table = read_file(*file, stage.spacetime);
    table.item = by;
    return table;
  } catch (const InputError& error) {
    return by->fail(std::string("names a table in error: ") + error.what());
  }
}

std::optional<TimedTrajectory> read_path(const Item& item, const Stage& stage, Lookup& lookup) {
  const Section s(item, {"trajectory", "region", "path", "begin", "end", "rates", "pace"});
  const bool mirrored = is_in_region_three(s);
  const auto table = read_path_table(s, stage, lookup, read_key, "at_m, r, azimuth_deg");
  return flown(table, [&](const PathTable& way) -> std::optional<TimedTrajectory> {
    const AcceleratedPath path(way.keys, way.tetrad, stage.spacetime);
    const Defaults whole{path.begin(), Leg::kInward, path.begin(), {}, path.end()};
    const auto timing = read_timing(s, stage, path, whole);
    if (!timing) return std::nullopt;
    return TimedTrajectory{path, *timing, {mirrored}};
  });
}

}  // namespace domefall
