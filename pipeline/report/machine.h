// Timings compare only within one machine, so the report says on which one it was measured.
#pragma once

#include <string>

namespace domefall {

struct Machine {
  std::string processor;  // its model, as the system calls it
  unsigned cores;         // logical processors, as the system counts them
  std::string compiler;
  std::string version;  // of Domefall
  std::string date;     // of today, in UTC
};

Machine this_machine();

// Returns the members of this_machine() as a table in Markdown.
std::string machine_table();

}  // namespace domefall
