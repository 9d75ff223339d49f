// A Digest is taken of everything that decides a result.  It tells frames of one version of a show
// from those of another.  It is XXH3 of 128 bits, and protects against accident, not malice.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <string_view>

namespace domefall {

class Digest {
 public:
  Digest();
  ~Digest();
  Digest(const Digest&) = delete;
  Digest& operator=(const Digest&) = delete;

  // Each text is preceded by its length, so that neighbours cannot run into each other.
  Digest& add(std::string_view text);
  Digest& add_piece(std::string_view piece);            // of one long text: no length
  Digest& add(double value);                            // by its bits
  Digest& add_file(const std::filesystem::path& file);  // its contents; throws as RegularFile

  std::string hex() const;  // 32 digits

 private:
  struct State;
  std::unique_ptr<State> state_;
};

// Returns XXH3, 64 bits, of bytes alone.  A file's parts are checked with it.
std::uint64_t checksum(std::string_view bytes);

}  // namespace domefall
