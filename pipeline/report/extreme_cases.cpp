#include "pipeline/report/extreme_cases.h"

#include <fmt/core.h>

namespace domefall {

std::string extreme_table() {
  std::string table =
      "| case | tried | what happens | worst | of | bound |\n|---|---|---|---|---|---|\n";
  for (const auto& list :
       {extreme_rays(), extreme_images(), extreme_frames(), extreme_frame_errors()})
    for (const ExtremeCase& c : list) {
      // The tests call the same function, so they and the page cannot tell different things.
      const ExtremeResult result = c.measure();
      table += fmt::format("| {} | {} | {} | {:.2g} | {} | {:.2g} |\n", c.name, c.tried,
                           result.outcome, result.worst, c.quantity, c.bound);
    }
  return table;
}

}  // namespace domefall
