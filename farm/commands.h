// The command lines of a plan, and how a shell and JSON take them.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "farm/plan.h"

namespace domefall {

using Words = std::vector<std::string>;

// Returns the command line by which any machine renders a chunk.
Words render_command(const FarmPlan& plan, const std::string& frames, int threads);

// Returns the command lines that make what the plan asks for of its frames: movie and delivery, by
// their names.
std::vector<std::pair<std::string, Words>> product_commands(const FarmPlan& plan);

// Returns what comes after the frames where other programs run it.  Each step waits for the one
// before, and the first verifies and repairs.
std::vector<std::pair<std::string, Words>> later_steps(const FarmPlan& plan);

// Returns a word as a POSIX shell takes it literally.  It is in single quotes where it has anything
// but letters, digits and %+,-./:=@_ .  Throws InputError for one with a control character, since
// lines are what lists are made of, and some shells and managers read no quotes.
std::string shell_word(std::string_view word);

std::string shell_line(const Words& words);

// Throws InputError, whose message is readable, for a text that is not UTF-8 or has a control
// character.  Paths and names may be any bytes, while JSON is UTF-8, and its texts become arguments
// and lines.
void require_utf8(std::string_view text);

// Returns the JSON as text, indented by that many blanks, or in one line where the indent is
// negative.  Throws as require_utf8() for each text in it.
std::string utf8_json(const nlohmann::ordered_json& json, int indent = -1);

}  // namespace domefall
