#include "pipeline/theatre/delivery/checksum_list.h"

#include <fmt/format.h>
#include <openssl/evp.h>

#include <array>
#include <memory>
#include <stdexcept>

#include "pipeline/base/errors.h"
#include "pipeline/base/regular_file.h"

namespace domefall {
namespace {

constexpr std::size_t kSumDigits = 64;
constexpr std::string_view kBetween = "  ";  // between a sum and its path

bool leads_out(const std::filesystem::path& path) {
  if (path.empty() || path.is_absolute()) return true;
  for (const auto& part : path)
    if (part == "..") return true;
  return false;
}

bool is_listed_line(std::string_view line) {
  constexpr std::string_view kDigits = "0123456789abcdef";
  return line.size() > kSumDigits + kBetween.size() &&
         line.find_first_not_of(kDigits) == kSumDigits &&
         line.substr(kSumDigits).starts_with(kBetween) &&
         !leads_out(line.substr(kSumDigits + kBetween.size()));
}

void require_done(int done) {
  if (done != 1) throw std::runtime_error("libcrypto cannot make a SHA-256 sum");
}

class Sha256Sum {
 public:
  Sha256Sum() : context_(EVP_MD_CTX_new(), EVP_MD_CTX_free) {
    require_done(context_ ? EVP_DigestInit_ex(context_.get(), EVP_sha256(), nullptr) : 0);
  }

  void add(const char* bytes, std::size_t count) {
    require_done(EVP_DigestUpdate(context_.get(), bytes, count));
  }

  std::string finish() {
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

}  // namespace

std::string sha256_of_file(const std::filesystem::path& path) {
  RegularFile file(path);
  Sha256Sum sum;
  std::vector<char> block(std::size_t{1} << 20);
  while (const std::size_t count = file.read(block.data(), block.size()))
    sum.add(block.data(), count);
  return sum.finish();
}

std::string checksum_list(const std::vector<ListedFile>& files) {
  std::string text;
  for (const ListedFile& file : files)
    text.append(file.sha256).append(kBetween).append(file.path).append("\n");
  return text;
}

std::vector<ListedFile> parse_checksum_list(std::string_view text) {
  std::vector<ListedFile> files;
  while (!text.empty()) {
    const auto end = text.find('\n');
    const std::string_view line = text.substr(0, end);
    if (end == std::string_view::npos || !is_listed_line(line))
      throw InputError(fmt::format(
          "line {} is not a SHA-256 sum, two blanks and a file of this folder", files.size() + 1));
    files.push_back({std::string(line.substr(0, kSumDigits)),
                     std::string(line.substr(kSumDigits + kBetween.size()))});
    text.remove_prefix(end + 1);
  }
  return files;
}

}  // namespace domefall
