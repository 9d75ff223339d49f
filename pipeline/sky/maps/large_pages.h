// Arrays that are read in no order have memory of their own kind.  It comes in large pages where
// the system has them, so that it takes few of them and the processor keeps the addresses of all.
#pragma once

#include <cstddef>
#include <memory>

namespace domefall {

// Returns this number of bytes, all 0.  Throws std::bad_alloc.
std::shared_ptr<void> large_pages(std::size_t bytes);

}  // namespace domefall
