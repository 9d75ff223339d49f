#include "pipeline/base/unpacked_file.h"

#include <fmt/format.h>

#include "pipeline/base/deflate.h"
#include "pipeline/base/errors.h"
#include "pipeline/base/regular_file.h"

namespace domefall {
namespace {

std::string first_unpacked(std::string_view bytes, const std::filesystem::path& file,
                           std::uint64_t most) {
  try {
    return gunzip(bytes, most);
  } catch (const std::runtime_error& error) {
    throw InputError(file.string() + ": the gzip file " + error.what());
  }
}

}  // namespace

bool is_gzip(std::string_view bytes) { return bytes.starts_with(kGzipStart); }

std::string unpacked(std::string_view bytes, const std::filesystem::path& file,
                     std::uint64_t most) {
  std::string out = first_unpacked(bytes, file, most + 1);
  if (out.size() > most)
    throw InputError(fmt::format(
        "{}: the gzip file holds more than {} bytes; unpack it by gunzip and name the result",
        file.string(), most));
  return out;
}

std::string start_of_unpacked(const std::filesystem::path& file, std::size_t count) {
  if (!is_gzip(start_of_file(file, kGzipStart.size()))) return start_of_file(file, count);
  return first_unpacked(MappedFile(file).bytes(), file, count);
}

UnpackedFile::UnpackedFile(const std::filesystem::path& file)
    : file_(file),
      packed_(is_gzip(file_.bytes())),
      unpacked_(packed_ ? unpacked(file_.bytes(), file) : "") {}

}  // namespace domefall
