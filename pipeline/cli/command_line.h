// The command line: its verbs and the options that all of them share.
#pragma once

namespace domefall {

// The exit code for input that is wrong, so that trying again is useless.
inline constexpr int kBadInput = 2;

// Parses the line, does what it asks for, and returns the exit code: 0, or kBadInput for a line
// that no verb understands. What fails while it is done is thrown.
int run_command_line(int argc, char** argv);

}  // namespace domefall
