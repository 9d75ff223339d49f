#include "pipeline/image/encode/stream_memory.h"

#include <sys/mman.h>

#include <array>
#include <cstdint>
#include <new>

namespace domefall {
namespace {

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

}  // namespace

void StreamMemory::Unmap::operator()(void* place) const { munmap(place, bytes); }

StreamMemory::StreamMemory(std::size_t bytes) : place_(nullptr, Unmap{bytes}) {
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
    if (reinterpret_cast<std::uintptr_t>(place) == address) {
      place_.reset(place);
      return;
    }
    munmap(place, bytes);  // a kernel before 4.17 takes the address as a wish
  }
  throw std::bad_alloc();
}

}  // namespace domefall
