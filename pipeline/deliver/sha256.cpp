#include "pipeline/deliver/sha256.h"

namespace domefall {

std::unique_ptr<Sha256Sum> begin_sha256() {
  static const auto& loaded =
      late_library<Sha256Sums>("domefall_libcrypto_sums", "makes checksums");
  return loaded.begin();
}

}  // namespace domefall
