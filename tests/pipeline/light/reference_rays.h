// The rows of tests/reference/rays.csv.
#pragma once

#include <fstream>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

#include "tests/source_tree.h"

namespace domefall {

struct ReferenceRay {
  std::string observer, origin, edge;
  long double r_decimal, delta_decimal;
  double r, delta, offset, phi, one_plus_z, slope, amplification;
};

// A row of tests/reference/positions.csv says where a ray of an observer in rain is at an angle psi of its sweep.
struct ReferencePlace {
  std::string line, r_text;
  long double delta;
  double psi, there;  // r
};

inline std::vector<ReferencePlace> reference_places() {
  std::ifstream file(source_file("tests/reference/positions.csv"));
  std::vector<ReferencePlace> places;
  for (std::string line; std::getline(file, line);) {
    if (!line.starts_with("rain,")) continue;
    std::istringstream cells(line);
    std::string observer, r, delta, psi, origin, there;
    for (std::string* cell : {&observer, &r, &delta, &psi, &origin, &there})
      std::getline(cells, *cell, ',');
    places.push_back({line, r, std::stold(delta), std::stod(psi), std::stod(there)});
  }
  return places;
}

inline constexpr const char* kReferenceObservers[] = {"rain", "static", "outgoing", "T_II", "T_IV"};

inline double number_or_zero(const std::string& text) { return text.empty() ? 0 : std::stod(text); }

inline std::vector<ReferenceRay> reference_rays(const std::string& observer) {
  std::ifstream file(source_file("tests/reference/rays.csv"));
  if (!file) throw std::runtime_error("no " + source_file("tests/reference/rays.csv"));
  std::vector<ReferenceRay> rays;
  for (std::string line; std::getline(file, line);) {
    if (!line.starts_with(observer + ",")) continue;
    std::vector<std::string> cell;
    std::istringstream cells(line);
    for (std::string text; std::getline(cells, text, ',');) cell.push_back(text);
    cell.resize(10);
    rays.push_back({cell[0], cell[5], cell[3], std::stold(cell[1]), std::stold(cell[2]),
                    number_or_zero(cell[1]), number_or_zero(cell[2]), number_or_zero(cell[4]),
                    number_or_zero(cell[6]), number_or_zero(cell[7]), number_or_zero(cell[8]),
                    number_or_zero(cell[9])});
  }
  return rays;
}

}  // namespace domefall
