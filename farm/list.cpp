#include "farm/commands.h"
#include "farm/engine.h"

namespace domefall {

std::string list_of_commands(const FarmPlan& plan) {
  std::string text;
  for (const PlannedChunk& chunk : plan.chunks)
    text += shell_line(render_command(plan, chunk.frames, plan.threads)) + "\n";
  return text;
}

}  // namespace domefall
