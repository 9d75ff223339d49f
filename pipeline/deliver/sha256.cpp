#include "pipeline/deliver/sha256.h"

namespace domefall {

std::unique_ptr<Sha256Sum> begin_sha256() {
  static const auto& loaded = static_cast<const Sha256Sums&>(
      load_library("libdomefall_libcrypto_sums.so", "domefall_libcrypto_sums", "makes checksums"));
  return loaded.begin();
}

}  // namespace domefall
