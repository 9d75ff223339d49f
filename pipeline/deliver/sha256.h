// SHA-256 sums are made by libcrypto.  To load it would take a tenth of the time of each start of
// the program.  So what calls it is a library of its own, libdomefall_libcrypto_sums.so
// (pipeline/libcrypto_sums), which is loaded for the first sum.
#pragma once

#include <cstddef>
#include <memory>
#include <string>

#include "pipeline/image/late_library.h"

namespace domefall {

class Sha256Sum : public Interface {
 public:
  // Both throw std::runtime_error if libcrypto cannot make sums.
  virtual void add(const char* bytes, std::size_t count) = 0;
  virtual std::string finish() = 0;  // 64 hexadecimal digits
};

class Sha256Sums : public Interface {
 public:
  virtual std::unique_ptr<Sha256Sum> begin() const = 0;
};

// Begins the sum of some bytes.  Throws as load_library, and as Sha256Sum.
std::unique_ptr<Sha256Sum> begin_sha256();

}  // namespace domefall
