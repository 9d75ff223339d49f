#include "pipeline/farm/utf8_json.h"

#include <nlohmann/json.hpp>

#include "pipeline/image/errors.h"
#include "pipeline/image/utf8.h"

namespace domefall {
namespace {

void require_utf8_within(const nlohmann::ordered_json& json) {
  if (json.is_string()) require_utf8(json.get_ref<const std::string&>());
  if (!json.is_structured()) return;
  for (const nlohmann::ordered_json& value : json) require_utf8_within(value);
}

}  // namespace

void require_utf8(std::string_view text) {
  const std::string spelt = spell_bad_bytes(text);
  if (spelt != text)
    throw InputError(spelt + ": is not UTF-8, which the plans and jobs of a farm are written in");
}

std::string utf8_json(const nlohmann::ordered_json& json, int indent) {
  require_utf8_within(json);
  return json.dump(indent);
}

}  // namespace domefall
