// These functions make the manual pages, in the macros of man(7), out of what --help shows.
#pragma once

#include <CLI/CLI.hpp>
#include <string>

namespace domefall {

// Returns domefall(1), with the verbs, exit codes, environment and files.  `date` is that of the
// release, as YYYY-MM-DD.
std::string program_page(const CLI::App& program, const std::string& date);

// Returns domefall-VERB(1), with the verbs below the verb.
std::string verb_page(const CLI::App& verb, const std::string& date);

}  // namespace domefall
