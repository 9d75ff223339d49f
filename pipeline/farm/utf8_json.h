// Paths and names may be any bytes, while JSON is UTF-8.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <string_view>

namespace domefall {

// Throws InputError, whose message is readable, for a text that is not UTF-8.
void require_utf8(std::string_view text);

// Returns the JSON as text, indented by that many blanks, or in one line where the indent is
// negative.  Throws as require_utf8() for each text in it.
std::string utf8_json(const nlohmann::ordered_json& json, int indent = -1);

}  // namespace domefall
