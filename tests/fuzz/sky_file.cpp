// Sky maps in .sky files, whose header's checksum is made right, so that what it guards is reached.
#include "pipeline/sources/sky/sky_file.h"

#include <algorithm>
#include <cmath>
#include <cstring>

#include "pipeline/base/digest.h"
#include "pipeline/base/errors.h"
#include "tests/fuzz/input_file.h"
#include "tests/fuzz/targets.h"

namespace domefall::fuzz {
namespace {

constexpr std::size_t kHeaderBytes = 12, kChecksum = 16, kFileBytes = 24;  // places in the header

std::string repaired_sky(std::string bytes) {
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

void sky_file(const std::uint8_t* data, std::size_t size) {
  const auto path = input_file(repaired_sky(std::string(text_of(data, size))), "input.sky");
  try {
    if (!is_sky_file(path)) return;
    SkyFile(path).verify();
  } catch (const InputError&) {
  }
}

}  // namespace domefall::fuzz
