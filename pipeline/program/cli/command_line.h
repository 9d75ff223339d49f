// This file runs a command line, whose first word is a verb.
#pragma once

namespace domefall {

// This is the exit code for input that is wrong, so that trying again is useless.
inline constexpr int kBadInput = 2;

// Parses the line, does what it asks for, and returns the exit code.  That is 0, or kBadInput for
// options and values that are not understood.  Throws InputError for a verb that there is not, and
// whatever the verb throws.
int run_command_line(int argc, char** argv);

}  // namespace domefall
