#include <fmt/format.h>
#include <openssl/evp.h>

#include <array>
#include <memory>
#include <stdexcept>
#include <string>

#include "pipeline/deliver/sha256.h"

namespace domefall {
namespace {

void require_done(int done) {
  if (done != 1) throw std::runtime_error("libcrypto cannot make a SHA-256 sum");
}

class LibcryptoSum : public Sha256Sum {
 public:
  LibcryptoSum() : context_(EVP_MD_CTX_new(), EVP_MD_CTX_free) {
    require_done(context_ ? EVP_DigestInit_ex(context_.get(), EVP_sha256(), nullptr) : 0);
  }

  void add(const char* bytes, std::size_t count) override {
    require_done(EVP_DigestUpdate(context_.get(), bytes, count));
  }

  std::string finish() override {
    std::array<unsigned char, EVP_MAX_MD_SIZE> sum{};
    unsigned size = 0;
    require_done(EVP_DigestFinal_ex(context_.get(), sum.data(), &size));
    std::string text;
    for (unsigned k = 0; k < size; ++k) text += fmt::format("{:02x}", sum[k]);
    return text;
  }

 private:
  std::unique_ptr<EVP_MD_CTX, decltype(&EVP_MD_CTX_free)> context_;
};

class LibcryptoSums : public Sha256Sums {
 public:
  std::unique_ptr<Sha256Sum> begin() const override { return std::make_unique<LibcryptoSum>(); }
};

}  // namespace
}  // namespace domefall

extern "C" const domefall::Interface* domefall_libcrypto_sums() {
  static const domefall::LibcryptoSums sums;
  return &sums;
}
