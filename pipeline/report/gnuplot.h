// Runs gnuplot as a program of its own: a script goes in, and the drawing comes out.
#pragma once

#include <string>

namespace domefall {

// For example "gnuplot 5.4 patchlevel 4".  Throws InputError if there is no gnuplot among the
// programs.
std::string gnuplot_version();

// Returns what the script writes to its standard output.  Throws InputError if there is no gnuplot,
// std::runtime_error with gnuplot's own words if it finds a fault in the script, and TemporaryError
// if there is no memory for either.
std::string run_gnuplot(const std::string& script);

}  // namespace domefall
