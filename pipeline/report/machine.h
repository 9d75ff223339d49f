// The machine that the report was measured on.
#pragma once

#include <string>

namespace domefall {

struct Machine {
  std::string processor;  // its model, as the system calls it
  unsigned cores;         // as many as the system shows
  std::string compiler;
  std::string version;  // of Domefall
  std::string date;     // of today, in UTC
};

Machine this_machine();

// The same as a table in Markdown, one line for each.
std::string machine_table();

}  // namespace domefall
