// Sky maps in .sky files, whose header's checksum is made right, so that what it guards is reached.
#include "pipeline/sky/maps/sky_file.h"

#include <algorithm>
#include <cmath>
#include <cstring>

#include "pipeline/image/digest.h"
#include "pipeline/image/errors.h"
#include "tests/fuzz/input_file.h"

using namespace domefall;

namespace {

constexpr std::size_t kHeaderBytes = 12, kChecksum = 16, kFileBytes = 24;  // places in the header

std::string repaired(std::string bytes) {
  std::uint32_t header = 0;
  if (bytes.size() < kFileBytes + sizeof(std::uint64_t)) return bytes;
  std::memcpy(&header, bytes.data() + kHeaderBytes, sizeof header);
  if (header > bytes.size()) return bytes;
  const std::uint64_t none = 0, length = bytes.size();
  std::memcpy(bytes.data() + kChecksum, &none, sizeof none);
  std::memcpy(bytes.data() + kFileBytes, &length, sizeof length);
  const std::uint64_t sum = checksum(std::string_view(bytes).substr(0, header));
  std::memcpy(bytes.data() + kChecksum, &sum, sizeof sum);
  return bytes;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const auto path = input_file(repaired(std::string(text_of(data, size))), "input.sky");
  try {
    if (!is_sky_file(path)) return 0;
    SkyFile(path).verify();
  } catch (const InputError&) {
  }
  return 0;
}
