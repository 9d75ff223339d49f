// gnuplot draws the report's plots.  It runs as a program of its own, which reads a script from its
// standard input and writes the drawing to its standard output.
#pragma once

#include <string>

namespace domefall {

// Returns gnuplot's name and version, for example "gnuplot 5.4 patchlevel 4".  Throws InputError if
// gnuplot is not installed or does not work, and TemporaryError if there is no memory for it.
std::string gnuplot_version();

// Returns what the script writes to standard output.  Throws InputError if gnuplot is not
// installed, std::runtime_error with gnuplot's message if the script is faulty or draws nothing,
// and TemporaryError if there is no memory for gnuplot or its files.
std::string run_gnuplot(const std::string& script);

}  // namespace domefall
