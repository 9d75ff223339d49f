#include "pipeline/sky/catalogue/import/json_file.h"

#include <fmt/format.h>

#include "pipeline/image/errors.h"
#include "pipeline/image/map_file.h"
#include "pipeline/image/regular_file.h"

namespace domefall {

nlohmann::json read_json(const std::filesystem::path& file) {
  const MappedFile mapped(require_file(file));
  const std::string_view bytes = mapped.bytes();
  // The parser would report an empty file as damaged at its first byte, which it does not have.
  if (bytes.empty()) throw InputError(file.string() + ": the file is empty");
  try {
    return nlohmann::json::parse(bytes.begin(), bytes.end());
  } catch (const nlohmann::json::parse_error& error) {
    throw InputError(
        fmt::format("{}: byte {}: this is no JSON, or not all of it", file.string(), error.byte));
  } catch (const nlohmann::json::exception&) {  // raised by a number that no double can hold
    throw InputError(file.string() + ": holds a number that cannot be read");
  }
}

}  // namespace domefall
