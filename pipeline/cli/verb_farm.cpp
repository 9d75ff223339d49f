#include <CLI/CLI.hpp>

#include "pipeline/cli/verbs.h"

namespace domefall {

void add_farm(CLI::App& app) {
  auto* verb =
      app.add_subcommand("farm", "A show over many machines: how it goes, and whether it is whole");
  verb->require_subcommand(1);
  add_farm_status(*verb);
  add_farm_verify(*verb);
}

}  // namespace domefall
