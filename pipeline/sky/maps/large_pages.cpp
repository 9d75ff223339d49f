#include "pipeline/sky/maps/large_pages.h"

#include <sys/mman.h>

#include <cstdlib>
#include <cstring>
#include <new>

namespace domefall {

std::shared_ptr<void> large_pages(std::size_t bytes) {
  // This is a large page of Linux on x86-64. aligned_alloc() needs a size that is a multiple of it.
  constexpr std::size_t kPage = std::size_t{2} << 20;
  const std::size_t whole = (bytes + kPage - 1) / kPage * kPage;
  void* memory = std::aligned_alloc(kPage, whole);
  if (memory == nullptr) throw std::bad_alloc();
  madvise(memory, whole, MADV_HUGEPAGE);  // the system may ignore this
  // A page comes into being when it is first written, so the advice precedes the zeros.
  std::memset(memory, 0, bytes);
  return {memory, [](void* m) { std::free(m); }};
}

}  // namespace domefall
