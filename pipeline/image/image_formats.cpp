#include "pipeline/image/image_formats.h"

#include <dlfcn.h>
#include <fmt/format.h>

#include "pipeline/base/errors.h"

namespace domefall {
namespace {

// The library stays for good, since OpenImageIO keeps threads.  The dynamic linker looks in the
// program's RUNPATH, which CMakeLists.txt sets for the build tree and for an installation.
const ImageFormats& load_formats() {
  void* loaded = dlopen("libdomefall_openimageio.so", RTLD_LAZY | RTLD_LOCAL);
  using Entry = const Interface* (*)();
  const auto entry =
      loaded ? reinterpret_cast<Entry>(dlsym(loaded, "domefall_openimageio")) : nullptr;
  if (entry) return static_cast<const ImageFormats&>(*entry());
  throw TemporaryError(
      fmt::format("the part of this program that reads images cannot be loaded: {}", dlerror()));
}

}  // namespace

const ImageFormats& image_formats() {
  static const ImageFormats& loaded = load_formats();
  return loaded;
}

}  // namespace domefall
