// Tables as text, with and without a header.
#include "pipeline/base/csv_file.h"
#include "pipeline/base/errors.h"
#include "tests/fuzz/input_file.h"
#include "tests/fuzz/targets.h"

namespace domefall::fuzz {

void table(const std::uint8_t* data, std::size_t size) {
  const auto file = input_file(text_of(data, size));
  try {
    CsvFile table(file, {"a"});
    while (table.next()) {
      table.number("a", -1, 1);
      table.number("b", 0, 1e300);
      if (table.has("name")) table.text("name");
      table.required("a", -1, 1);
    }
  } catch (const InputError&) {
  }
  try {
    CsvFile table(file, '\t', {"a", "b"});
    while (table.next()) table.number("b");
  } catch (const InputError&) {
  }
}

}  // namespace domefall::fuzz
