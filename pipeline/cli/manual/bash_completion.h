// This file makes the script by which bash completes command lines of domefall.
#pragma once

#include <CLI/CLI.hpp>
#include <string>

namespace domefall {

// Returns the script.  It knows the verbs, their options, the words that values may be, and where
// files, folders or shows belong.  It calls no program and needs bash 4.
std::string bash_completion(const CLI::App& program);

}  // namespace domefall
