// JSON files of others, the one door to nlohmann's library.
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>

namespace domefall {

// Throws InputError: "FILE: byte N: ..." where it is no JSON.
nlohmann::json read_json(const std::filesystem::path& file);

}  // namespace domefall
