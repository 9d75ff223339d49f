// What the program says to people goes through here: to standard error, and below it the bar of a
// run where that is a terminal.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace domefall {

// Writes one line or several to standard error, the end of the last one added if it lacks.  It is
// written as by printable_lines(), since messages hold names and titles, which may hold anything.
// A bar that is shown makes room and comes back below.
void say(std::string_view text);

// Returns how many columns standard error's terminal has at the moment, or 80 where it does not
// say.
std::size_t terminal_columns();

// Shows a line of plain ASCII, which has to fit, in the place of the bar that was shown before.
void show_bar(std::string_view line);

// Leaves the bar as it stands, on a line of its own.
void end_bar();

// Says whether a bar is shown.  It takes no lock.
bool bar_is_shown();

// Returns a whole number as it stands in sentences, "1,234" for 1234.
std::string with_commas(std::size_t count);

// Returns "1 row" or "1,234 rows" for `what` = "row".
std::string counted(std::size_t count, std::string_view what);

}  // namespace domefall
