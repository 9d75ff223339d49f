// The manual pages, in the macros of man(7), made of what --help shows.
#pragma once

#include <CLI/CLI.hpp>
#include <string>

namespace domefall {

// domefall(1): the verbs, exit codes, environment and files.  `date` is that of the release, as
// YYYY-MM-DD.
std::string program_page(const CLI::App& program, const std::string& date);

// domefall-VERB(1), with the verbs below it.
std::string verb_page(const CLI::App& verb, const std::string& date);

}  // namespace domefall
