#include "pipeline/report/reference/reference_swept.h"

#include <gtest/gtest.h>

#include <boost/math/constants/constants.hpp>
#include <fstream>
#include <map>
#include <sstream>
#include <string>

#include "tests/source_tree.h"

namespace domefall {
namespace {

using Cells = std::map<std::string, std::string>;

// Calls use(cells) for each row of a table of exact rays.
template <class Use>
void each_row(const char* file, const Use& use) {
  std::ifstream in(source_file(file));
  std::vector<std::string> names;
  int rows = 0;
  for (std::string line; std::getline(in, line);) {
    if (line.empty() || line[0] == '#') continue;
    std::istringstream stream(line + ",");
    std::vector<std::string> cells;
    for (std::string cell; std::getline(stream, cell, ',');) cells.push_back(cell);
    Cells row;
    for (std::size_t k = 0; k < names.size(); ++k) row[names[k]] = cells.at(k);
    if (names.empty())
      names = cells;
    else
      use(row), ++rows;
  }
  EXPECT_GT(rows, 150);
}

double error(const Real50& found, const std::string& exact) {
  const Real50 value(exact);
  return static_cast<double>(abs(found - value) / std::max(Real50(1), value));
}

TEST(ReferenceSwept, IsThatOfTheExactRaysNearACharge) {
  each_row("tests/reference/charged_rays.csv", [](Cells& row) {
    const Real50 q(row["charge"]), r(row["r"]);
    Real50 delta;
    if (row["offset"].empty()) {
      delta = Real50(row["delta"]);
    } else {
      const ChargedEdges edges = charged_edges(q, r);
      delta = 2 * atan(abs(row["edge"] == "silhouette" ? edges.first : edges.second)) +
              Real50(row["offset"]);
    }
    if (delta == 0 || delta > Real50("3.14159265358979")) return;  // the axis
    const SweptAzimuth swept = reference_charged_ray(q, r, delta);
    const std::string origin = row["origin"] + row["beyond"];
    const ReferenceSky sky = origin == "I"     ? ReferenceSky::kOwn
                             : origin == "III" ? ReferenceSky::kOther
                             : origin == "HE"  ? ReferenceSky::kEarlier
                                               : ReferenceSky::kNone;
    EXPECT_EQ(swept.sky, sky) << row["charge"] << " " << row["r"] << " " << row["delta"];
    if (sky == ReferenceSky::kNone || row["mino"].empty()) return;
    // Mino's time is the azimuth over sqrt K.
    EXPECT_LT(error(swept.azimuth / sqrt(Real50(row["K"])), row["mino"]), 1e-15) << row["r"];
  });
}

TEST(ReferenceSwept, IsThatOfTheExactRaysInWormholes) {
  each_row("tests/reference/wormhole_rays.csv", [](Cells& row) {
    const Real50 rho(row["rho"]);
    WormholeShape shape;
    if (row["profile"] == "dngr")
      shape = {Real50(row["a"].empty() ? "0" : row["a"]) / rho, Real50(row["m"]) / rho};
    const Real50 l = abs(Real50(row["l"])) / rho;
    const Real50 delta = row["offset"].empty() ? Real50(row["delta"])
                                               : throat_angle(shape, l) + Real50(row["offset"]);
    if (delta == 0) return;
    const SweptAzimuth swept = reference_wormhole_ray(shape, l, delta);
    EXPECT_EQ(swept.sky == ReferenceSky::kOwn, row["origin"] == "own");
    EXPECT_LT(error(swept.azimuth, row["azimuth"]), 1e-16) << row["l"] << " " << row["delta"];
  });
}

}  // namespace
}  // namespace domefall
