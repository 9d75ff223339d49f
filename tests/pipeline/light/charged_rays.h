// The rows of tests/reference/charged_rays.csv: rays near charges, exact to 20 digits.
#pragma once

#include <cmath>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include "tests/source_tree.h"
#include "trajectories/directions.h"

namespace domefall {

struct ChargedReference {
  std::string line, edge, origin, beyond;
  long double charge = 0, r = 0, delta = 0, offset = 0;
  double theta = 0, eta = 0;
  bool has_sky = false;  // whether these follow
  V3d place;             // on the sky
  double mino = 0, k = 0, one_plus_z = 0, amplification = 0;
};

inline std::vector<ChargedReference> charged_references() {
  std::ifstream file(source_file("tests/reference/charged_rays.csv"));
  std::vector<ChargedReference> rays;
  for (std::string line; std::getline(file, line);) {
    if (line.starts_with("#") || line.starts_with("kind")) continue;
    std::vector<std::string> cell;
    std::istringstream cells(line);
    for (std::string text; std::getline(cells, text, ',');) cell.push_back(text);
    cell.resize(23);
    const auto long_number = [&](std::size_t column) {
      return cell[column].empty() ? 0 : std::stold(cell[column]);
    };
    const auto number = [&](std::size_t column) {
      return static_cast<double>(long_number(column));
    };
    ChargedReference ray;
    ray.line = line, ray.edge = cell[7], ray.origin = cell[9], ray.beyond = cell[10];
    ray.charge = long_number(2), ray.r = long_number(3);
    ray.delta = long_number(5), ray.offset = long_number(8);
    ray.theta = number(4), ray.eta = number(6);
    ray.has_sky = !cell[13].empty();
    ray.place = V3d(number(13), number(14), number(15));
    ray.mino = number(19), ray.k = number(22);
    ray.one_plus_z = std::abs(number(20)), ray.amplification = number(17);
    rays.push_back(ray);
  }
  return rays;
}

}  // namespace domefall
