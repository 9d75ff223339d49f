#include "pipeline/light/charged_azimuth.h"

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include "tests/source_tree.h"

namespace domefall {
namespace {

// A row of tests/reference/charged_rays.csv.
struct ChargedReference {
  std::string line, edge, origin, beyond;
  long double charge, r, delta, offset;
  double mino, k, one_plus_z;
};

std::vector<ChargedReference> charged_references() {
  std::ifstream file(source_file("tests/reference/charged_rays.csv"));
  std::vector<ChargedReference> rays;
  for (std::string line; std::getline(file, line);) {
    if (line.starts_with("#") || line.starts_with("kind")) continue;
    std::vector<std::string> cell;
    std::istringstream cells(line);
    for (std::string text; std::getline(cells, text, ',');) cell.push_back(text);
    cell.resize(23);
    const auto number = [&](std::size_t column) {
      return cell[column].empty() ? 0 : std::stold(cell[column]);
    };
    rays.push_back({line, cell[7], cell[9], cell[10], number(2), number(3), number(5), number(8),
                    static_cast<double>(number(19)), static_cast<double>(number(22)),
                    static_cast<double>(std::abs(number(20)))});
  }
  return rays;
}

ChargedRay ray_of(const ChargedView& view, const ChargedReference& row) {
  if (row.edge.empty()) return view.ray_at(polar_angle(row.delta));
  const Critical edge = row.edge == "silhouette" ? Critical::kFirst : Critical::kSecond;
  return view.ray_off_edge(edge, static_cast<double>(row.offset));
}

std::string name_of(ChargedOrigin origin, bool naked) {
  switch (origin) {
    case ChargedOrigin::kOwn:
      return "I,";
    case ChargedOrigin::kParallel:
      return "III,";
    case ChargedOrigin::kBefore:
      return "H,E";
    case ChargedOrigin::kParallelBefore:
      return "none";
    case ChargedOrigin::kDark:
      break;
  }
  return naked ? "B," : "H,B";
}

TEST(ChargedReferenceRows, HaveTheRightOriginAndAzimuth) {
  const std::vector<ChargedReference> rows = charged_references();
  ASSERT_EQ(rows.size(), 361);
  double worst = 0;
  for (const ChargedReference& row : rows) {
    const ChargedHole hole(1, row.charge);
    const ChargedView view(hole, hole.at(row.r));
    const ChargedRay ray = ray_of(view, row);
    ASSERT_EQ(name_of(view.origin_of(ray), hole.is_naked()), row.origin + "," + row.beyond)
        << row.line;
    EXPECT_NEAR(std::abs(static_cast<double>(view.energy(ray))), row.one_plus_z,
                1e-12 * row.one_plus_z)
        << row.line;
    if (row.mino == 0) continue;
    const double phi = row.mino * std::sqrt(row.k), error = std::abs(view.azimuth(ray) - phi);
    worst = std::max(worst, error / std::max(1.0, phi));
    EXPECT_LT(error, 2e-11) << row.line;
  }
  RecordProperty("worst", std::to_string(worst));
  std::cout << "worst " << worst << "\n";
}

}  // namespace
}  // namespace domefall
