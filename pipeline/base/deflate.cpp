#include "pipeline/base/deflate.h"

#include <immintrin.h>
#include <isa-l.h>
#include <sys/mman.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>
#include <memory>
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

// ISA-L's hash drops the lower bits of the address, and its tables of level 1 have 2^13 slots.
constexpr int kGranuleBits = 16;
constexpr std::uint32_t kSlots = 0x1fff;

constexpr std::array<std::uint32_t, 256> crc32c_of_bytes() {
  constexpr std::uint32_t kPolynomial = 0x82f63b78;
  std::array<std::uint32_t, 256> table{};
  for (std::uint32_t byte = 0; byte < table.size(); ++byte) {
    std::uint32_t value = byte;
    for (int bit = 0; bit < 8; ++bit) value = value >> 1 ^ (value & 1 ? kPolynomial : 0);
    table[byte] = value;
  }
  return table;
}

// This is the instruction crc32 of SSE4.2, beginning with 0.
std::uint32_t crc32c(std::uint32_t value) {
  static constexpr std::array kOfBytes = crc32c_of_bytes();
  for (int byte = 0; byte < 4; ++byte) value = value >> 8 ^ kOfBytes[value & 0xff];
  return value;
}

// Returns null where the kernel has no memory left.
void* map_at(std::uintptr_t address, std::size_t bytes) {
  constexpr int kNew = MAP_PRIVATE | MAP_ANONYMOUS;
  void* hint = reinterpret_cast<void*>(address);  // NOLINT(performance-no-int-to-ptr)
  void* place =
      mmap(hint, bytes, PROT_READ | PROT_WRITE, address ? kNew | MAP_FIXED_NOREPLACE : kNew, -1, 0);
  return place == MAP_FAILED ? nullptr : place;
}

// Returns memory for ISA-L's isal_zstream, filled with 0, at an address that ISA-L's output does not
// depend on.
//
// ISA-L (2.30, igzip_icf_body_h1_gr_bt.asm, write_first_byte) hashes the third byte of a stream
// from a register that holds the address of the isal_zstream.  So position 2 is entered into the
// hash table at slot crc32c(address >> 16) instead of its own.  What is unpacked is right, since a
// repetition is compared before it is used.  But which ones are found depends on the address, and
// so do the bytes of about one block of pixels in a thousand.  An address whose slot is 0 makes all
// the same.
MappedMemory stream_memory(std::size_t bytes) {
  // The search begins where the kernel would put new memory and goes down from there, where little
  // is in use.  One granule in 2^13 has slot 0.  Granules that are in use are passed over.
  void* somewhere = map_at(0, bytes);
  if (!somewhere) throw std::bad_alloc();
  auto granule = reinterpret_cast<std::uintptr_t>(somewhere) >> kGranuleBits;
  munmap(somewhere, bytes);
  constexpr int kMostGranules = 1 << 20;
  for (int tried = 0; tried < kMostGranules && granule > 0; ++tried, --granule) {
    if ((crc32c(static_cast<std::uint32_t>(granule)) & kSlots) != 0) continue;
    const std::uintptr_t address = granule << kGranuleBits;
    void* place = map_at(address, bytes);
    if (place == nullptr) continue;
    if (reinterpret_cast<std::uintptr_t>(place) == address) return {place, Unmap{bytes}};
    munmap(place, bytes);  // a kernel before 4.17 takes the address as a wish
  }
  throw std::bad_alloc();
}

__attribute__((target("avx"))) void clear_upper_halves() { _mm256_zeroupper(); }

// One of these is declared before each call of ISA-L, which leaves the upper halves of the vector
// registers in use (2.30).  Until they are cleared, each instruction of SSE that follows on this
// thread waits for the ones before it.  Otherwise OpenColorIO takes ten times as long for a pixel.
class UpperHalvesCleared {
 public:
  UpperHalvesCleared() = default;
  UpperHalvesCleared(const UpperHalvesCleared&) = delete;
  UpperHalvesCleared& operator=(const UpperHalvesCleared&) = delete;
  ~UpperHalvesCleared() {
    static const bool there = __builtin_cpu_supports("avx");
    if (there) clear_upper_halves();
  }
};

}  // namespace

Deflater::Deflater()
    : stream_(stream_memory(sizeof(isal_zstream))), tables_(ISAL_DEF_LVL1_DEFAULT) {}

void Deflater::pack_stream(std::string_view bytes, ByteBlock& out) { pack(bytes, true, out); }

void Deflater::pack_part(std::string_view bytes, ByteBlock& out) { pack(bytes, false, out); }

void Deflater::pack(std::string_view bytes, bool whole, ByteBlock& out) {
  if (bytes.size() > std::numeric_limits<std::uint32_t>::max() / 2)
    throw std::length_error("more bytes than ISA-L packs at once");
  out.reserve(most_packed(bytes.size()));
  // ISA-L 2.30 does not set hist_bits, a bound on distances, so the stream is filled with zeros
  // first.
  isal_zstream& stream = *new (stream_.get()) isal_zstream{};
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

std::string gunzip(std::string_view packed, std::size_t most) {
  constexpr std::size_t kPiece = 1 << 20;
  const auto state = std::make_unique<inflate_state>();
  isal_inflate_init(state.get());
  state->crc_flag = ISAL_GZIP;
  std::string out;
  while (out.size() < most) {
    const std::size_t given = std::min(packed.size(), kPiece), before = out.size();
    state->next_in = bytes_of(packed);
    state->avail_in = static_cast<std::uint32_t>(given);
    out.resize(std::min(most, before + kPiece));
    state->next_out = reinterpret_cast<unsigned char*>(out.data()) + before;
    state->avail_out = static_cast<std::uint32_t>(out.size() - before);
    const UpperHalvesCleared after;
    if (isal_inflate(state.get()) < 0) throw std::runtime_error("is damaged");
    packed.remove_prefix(given - state->avail_in);
    out.resize(out.size() - state->avail_out);
    if (state->block_state == ISAL_BLOCK_FINISH) {
      // What follows the last member is no part of the file, as for the program gzip.
      if (!packed.starts_with(kGzipStart)) break;
      isal_inflate_reset(state.get());
      state->crc_flag = ISAL_GZIP;
    } else if (packed.empty() && state->avail_out > 0) {
      throw std::runtime_error("is cut short");
    }
  }
  return out;
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
