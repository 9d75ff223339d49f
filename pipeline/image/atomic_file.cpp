#include "pipeline/image/atomic_file.h"

#include <cerrno>
#include <cstring>

#include "pipeline/image/errors.h"
#include "pipeline/image/new_file.h"

namespace domefall {

void throw_file_error(const std::filesystem::path& path, int error) {
  const std::string what = path.string() + ": " + std::strerror(error);
  switch (error) {
    case EISDIR:
    case ENAMETOOLONG:
    case ELOOP:
      throw InputError(what);
    default:
      throw TemporaryError(what);
  }
}

void write_atomically(const std::filesystem::path& path, std::string_view contents) {
  NewFile file(path);
  file.write(contents);
  file.commit();
}

}  // namespace domefall
