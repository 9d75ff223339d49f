#include "pipeline/base/digest.h"

#include <fmt/core.h>
#include <xxhash.h>

#include <cstdint>
#include <vector>

#include "pipeline/base/regular_file.h"

namespace domefall {

struct Digest::State {
  XXH3_state_t* xxh = XXH3_createState();
  State() { XXH3_128bits_reset(xxh); }
  State(const State&) = delete;
  State& operator=(const State&) = delete;
  ~State() { XXH3_freeState(xxh); }
};

Digest::Digest() : state_(std::make_unique<State>()) {}
Digest::~Digest() = default;

Digest& Digest::add(std::string_view text) {
  const std::uint64_t length = text.size();
  XXH3_128bits_update(state_->xxh, &length, sizeof length);
  return add_piece(text);
}

Digest& Digest::add_piece(std::string_view piece) {
  XXH3_128bits_update(state_->xxh, piece.data(), piece.size());
  return *this;
}

Digest& Digest::add(double value) {
  XXH3_128bits_update(state_->xxh, &value, sizeof value);
  return *this;
}

Digest& Digest::add_file(const std::filesystem::path& file) {
  RegularFile in(file);
  Digest contents;
  std::vector<char> block(1 << 20);
  while (const std::size_t count = in.read(block.data(), block.size()))
    XXH3_128bits_update(contents.state_->xxh, block.data(), count);
  return add(contents.hex());
}

std::string Digest::hex() const {
  const XXH128_hash_t hash = XXH3_128bits_digest(state_->xxh);
  return fmt::format("{:016x}{:016x}", hash.high64, hash.low64);
}

std::uint64_t checksum(std::string_view bytes) { return XXH3_64bits(bytes.data(), bytes.size()); }

}  // namespace domefall
