// The rows of tests/reference/kerr_rays.csv and kerr_disc.csv: rays near spinning holes, exact to 20
// digits.
#pragma once

#include <fstream>
#include <map>
#include <sstream>
#include <string>
#include <vector>

#include "pipeline/light/kerr_request.h"
#include "pipeline/light/kerr_start.h"
#include "tests/source_tree.h"

namespace domefall {

struct KerrReference {
  std::string line;
  std::map<std::string, std::string> cells;

  bool has(const std::string& column) const { return !cells.at(column).empty(); }
  const std::string& text(const std::string& column) const { return cells.at(column); }
  long double exact(const std::string& column) const {
    return has(column) ? std::stold(cells.at(column)) : 0;
  }
  double number(const std::string& column) const { return static_cast<double>(exact(column)); }

  KerrPlace at() const {
    return {
        {exact("spin"), exact("charge"), lost_digits(text("spin"))}, exact("r"), exact("theta")};
  }
  KerrDirection direction() const {
    KerrDirection out{exact("delta"), exact("eta"), {}, 0};
    if (!cells.contains("edge") || !has("edge")) return out;
    out.edge = text("edge") == "silhouette" ? KerrEdge::kSilhouette : KerrEdge::kRegionThree;
    out.offset = exact("offset");
    return out;
  }
};

inline std::vector<KerrReference> kerr_references(const std::string& name) {
  std::ifstream file(source_file("tests/reference/" + name));
  std::vector<KerrReference> rows;
  std::vector<std::string> columns;
  for (std::string line; std::getline(file, line);) {
    if (line.starts_with("#")) continue;
    std::vector<std::string> cells;
    std::istringstream text(line);
    for (std::string cell; std::getline(text, cell, ',');) cells.push_back(cell);
    if (columns.empty()) {
      columns = cells;
      continue;
    }
    cells.resize(columns.size());
    KerrReference row{line, {}};
    for (std::size_t i = 0; i < columns.size(); ++i) row.cells[columns[i]] = cells[i];
    rows.push_back(row);
  }
  return rows;
}

}  // namespace domefall
