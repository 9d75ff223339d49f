#include "pipeline/image/image_formats.h"

#include <dlfcn.h>

#include <string>

#include "pipeline/image/errors.h"

namespace domefall {
namespace {

constexpr const char *kLibrary = "libdomefall_image_formats.so", *kEntry = "domefall_image_formats";

[[noreturn]] void fail() {
  const char* reason = dlerror();
  throw TemporaryError(
      std::string("the part of this program that reads images cannot be loaded: ") +
      (reason ? reason : kLibrary));
}

// The dynamic linker looks in the program's RUNPATH, which CMakeLists.txt sets for the build tree
// and for an installation.  The library is never unloaded, since OpenImageIO keeps threads.
const ImageFormats& load() {
  void* library = dlopen(kLibrary, RTLD_LAZY | RTLD_LOCAL);
  if (!library) fail();
  using Entry = const ImageFormats* (*)();
  const auto entry = reinterpret_cast<Entry>(dlsym(library, kEntry));
  if (!entry) fail();
  return *entry();
}

}  // namespace

const ImageFormats& image_formats() {
  static const ImageFormats& loaded = load();
  return loaded;
}

}  // namespace domefall
