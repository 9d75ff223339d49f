// This file has the option --overlay.
#pragma once

#include <CLI/CLI.hpp>
#include <string>

#include "pipeline/show/show.h"

namespace domefall {

void add_overlay_option(CLI::App& verb, std::string& names);

// Gives a show the overlays of that list.  The show's title then says which these are, so that its
// frames are another show's than those without, and neither takes the place of the other unasked.
// Throws InputError for a name that is no overlay's, and for overlays that a cubemap cannot have.
void overlay(Show& show, const std::string& names);

}  // namespace domefall
