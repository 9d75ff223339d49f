// Some catalogues come as JSON files, which others have written and which may hold anything.
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>

namespace domefall {

// Reads a JSON file.  Throws InputError, "FILE: byte N: ...", where the file is no JSON, and as
// MappedFile does.
nlohmann::json read_json(const std::filesystem::path& file);

}  // namespace domefall
