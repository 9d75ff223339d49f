// These functions add the verbs of the command line, which have a file each or share one.
#pragma once

#include <memory>

namespace CLI {
class App;
}

namespace domefall {

// Each adds its subcommand, which does its work when the command line is parsed.
void add_check(CLI::App& app);
void add_render(CLI::App& app);
void add_grade(CLI::App& app);
void add_preview(CLI::App& app);
void add_movie(CLI::App& app);
void add_deliver(CLI::App& app);
void add_sheet(CLI::App& app);
void add_timeline(CLI::App& app);
void add_states(CLI::App& app);
void add_probe(CLI::App& app);
void add_trace(CLI::App& app);
void add_report(CLI::App& app);
void add_stars(CLI::App& app);
void add_sky(CLI::App& app);
void add_farm(CLI::App& app);

// Returns a program with all verbs, their help and the notes that close it.
std::unique_ptr<CLI::App> describe_command_line();

}  // namespace domefall
