#include "pipeline/sky/catalogue/import/json_file.h"

#include "pipeline/image/errors.h"
#include "pipeline/image/map_file.h"

namespace domefall {

nlohmann::json read_json(const std::filesystem::path& file) {
  const MappedFile mapped(file);
  const std::string_view bytes = mapped.bytes();
  if (bytes.empty()) throw InputError(file.string() + ": the file is empty");
  try {
    return nlohmann::json::parse(bytes.begin(), bytes.end());
  } catch (const nlohmann::json::parse_error& error) {
    throw InputError(file.string() + ": byte " + std::to_string(error.byte) +
                     ": this is no JSON, or not all of it");
  } catch (const nlohmann::json::exception&) {  // a number beyond all bounds
    throw InputError(file.string() + ": holds a number that cannot be read");
  }
}

}  // namespace domefall
