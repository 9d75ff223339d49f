#include <CLI/CLI.hpp>

#include "pipeline/cli/verbs.h"

namespace domefall {

void add_farm(CLI::App& app) {
  CLI::App* farm = app.add_subcommand("farm", "Render a show on many machines, and verify it");
  farm->require_subcommand(1);
  add_farm_submit(*farm);
  add_farm_status(*farm);
  add_farm_verify(*farm);
  add_farm_work(*farm);
  add_farm_conclude(*farm);
}

}  // namespace domefall
