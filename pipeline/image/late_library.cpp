#include "pipeline/image/late_library.h"

#include <dlfcn.h>
#include <fmt/format.h>

#include "pipeline/image/errors.h"

namespace domefall {

const Interface& load_library(const std::string& name, const char* work) {
  const std::string library = "lib" + name + ".so";
  void* loaded = dlopen(library.c_str(), RTLD_LAZY | RTLD_LOCAL);
  using Entry = const Interface* (*)();
  const auto function = loaded ? reinterpret_cast<Entry>(dlsym(loaded, name.c_str())) : nullptr;
  if (function) return *function();
  const char* reason = dlerror();
  throw TemporaryError(fmt::format("the part of this program that {} cannot be loaded: {}", work,
                                   reason ? reason : library));
}

}  // namespace domefall
