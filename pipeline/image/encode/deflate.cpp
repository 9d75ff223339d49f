#include "pipeline/image/encode/deflate.h"

#include <immintrin.h>
#include <isa-l.h>

#include <algorithm>
#include <limits>
#include <new>
#include <stdexcept>

namespace domefall {
namespace {

// What cannot be packed is stored in blocks of up to 65535 bytes, each with 5 bytes before it.  The
// bound reckons with blocks of half that size.  The rest are wrappers and the block that ends a
// part.
std::size_t most_packed(std::size_t bytes) {
  constexpr std::size_t kBlock = 32768, kBlockHead = 5, kWrappers = 1024;
  return bytes + (bytes / kBlock + 1) * kBlockHead + kWrappers;
}

// isa-l.h lacks const even where the bytes are only read.
unsigned char* bytes_of(std::string_view bytes) {
  return const_cast<unsigned char*>(reinterpret_cast<const unsigned char*>(bytes.data()));
}

__attribute__((target("avx"))) void clear_upper_halves() { _mm256_zeroupper(); }

// One of these is declared before each call of ISA-L, which leaves the upper halves of the vector
// registers in use (2.30).  Until they are cleared, each instruction of SSE that follows on this
// thread waits for the ones before it.  Otherwise OpenColorIO takes ten times as long for a pixel.
class UpperHalvesCleared {
 public:
  UpperHalvesCleared() = default;
  UpperHalvesCleared(const UpperHalvesCleared&) = delete;
  UpperHalvesCleared(UpperHalvesCleared&&) = delete;
  UpperHalvesCleared& operator=(const UpperHalvesCleared&) = delete;
  UpperHalvesCleared& operator=(UpperHalvesCleared&&) = delete;
  ~UpperHalvesCleared() {
    static const bool there = __builtin_cpu_supports("avx");
    if (there) clear_upper_halves();
  }
};

}  // namespace

Deflater::Deflater() : stream_(sizeof(isal_zstream)), tables_(ISAL_DEF_LVL1_DEFAULT) {}

void Deflater::pack_stream(std::string_view bytes, ByteBlock& out) { pack(bytes, true, out); }

void Deflater::pack_part(std::string_view bytes, ByteBlock& out) { pack(bytes, false, out); }

void Deflater::pack(std::string_view bytes, bool whole, ByteBlock& out) {
  if (bytes.size() > std::numeric_limits<std::uint32_t>::max() / 2)
    throw std::length_error("more bytes than ISA-L packs at once");
  out.reserve(most_packed(bytes.size()));
  // ISA-L 2.30 does not set hist_bits, a bound on distances, so the stream is filled with zeros
  // first.
  isal_zstream& stream = *new (stream_.data()) isal_zstream{};
  isal_deflate_stateless_init(&stream);
  stream.level = 1;
  stream.level_buf = tables_.data();
  stream.level_buf_size = static_cast<std::uint32_t>(tables_.size());
  stream.gzip_flag = whole ? IGZIP_ZLIB : IGZIP_DEFLATE;
  stream.end_of_stream = whole;
  stream.flush = whole ? NO_FLUSH : FULL_FLUSH;
  stream.next_in = bytes_of(bytes);
  stream.avail_in = static_cast<std::uint32_t>(bytes.size());
  stream.next_out = out.data();
  stream.avail_out = static_cast<std::uint32_t>(out.capacity());
  const UpperHalvesCleared after;
  if (isal_deflate_stateless(&stream) != COMP_OK || stream.avail_in != 0)
    throw std::logic_error("ISA-L could not pack a part of an image");
  out.set_size(stream.total_out);
}

unsigned crc32_of(std::string_view bytes, unsigned before) {
  const UpperHalvesCleared after;
  return crc32_gzip_refl(before, bytes_of(bytes), bytes.size());
}

unsigned adler32_of(std::string_view bytes, unsigned before) {
  const UpperHalvesCleared after;
  return isal_adler32(before, bytes_of(bytes), bytes.size());
}

// Both sums are modulo 65521.  The low half is 1 plus all bytes, and the high half adds up the low
// halves after each byte.
unsigned adler32_joined(unsigned first, unsigned second, std::size_t count) {
  constexpr std::uint64_t kPrime = 65521;
  const std::uint64_t low1 = first & 0xffff, high1 = first >> 16, low2 = second & 0xffff,
                      high2 = second >> 16;
  const std::uint64_t low = (low1 + low2 + kPrime - 1) % kPrime,
                      high = (high1 + high2 + count % kPrime * (low1 + kPrime - 1)) % kPrime;
  return static_cast<unsigned>(high << 16 | low);
}

}  // namespace domefall
