#include "pipeline/image/late_library.h"

#include <dlfcn.h>

#include <string>

#include "pipeline/image/errors.h"

namespace domefall {

const Interface& load_library(const char* library, const char* entry, const char* work) {
  void* loaded = dlopen(library, RTLD_LAZY | RTLD_LOCAL);
  using Entry = const Interface* (*)();
  const auto function = loaded ? reinterpret_cast<Entry>(dlsym(loaded, entry)) : nullptr;
  if (function) return *function();
  const char* reason = dlerror();
  throw TemporaryError(std::string("the part of this program that ") + work +
                       " cannot be loaded: " + (reason ? reason : library));
}

}  // namespace domefall
