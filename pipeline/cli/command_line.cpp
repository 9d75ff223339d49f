#include "pipeline/cli/command_line.h"

#include <CLI/CLI.hpp>

#include "pipeline/cli/verbs.h"
#include "pipeline/simd/dispatch.h"

namespace domefall {

int run_command_line(int argc, char** argv) {
  CLI::App app("Black-hole shows for planetariums: a show file in, graded Domemaster frames out");
  app.set_version_flag("--version", "domefall " DOMEFALL_VERSION);
  app.require_subcommand(1);
  add_check(app);
  add_render(app);
  add_grade(app);
  add_preview(app);
  add_states(app);
  add_probe(app);
  add_trace(app);
  add_report(app);
  add_stars(app);
  add_sky(app);
  // A wrong DOMEFALL_SIMD is told before anything is made.
  app.parse_complete_callback([] { simd_in_use(); });
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : kBadInput;
  }
  return 0;
}

}  // namespace domefall
